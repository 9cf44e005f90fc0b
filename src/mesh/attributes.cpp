// SPDX-License-Identifier: Apache-2.0
// Attributes follow the journal with a copy of the tets' vertices and rest positions of their own, so that every step
// is seen as it was however far the mesh has gone on. What a step overwrites is swapped with its record: undo and redo
// are the same exchange.
#include "incise/mesh/attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "mesh/constants.h"

namespace incise {
inline namespace v0 {

namespace {

constexpr std::uint32_t kMaxWidth = 64;

/// A sorted table of the elements that a step names; find() in O(log n).
template <class IdType, class T>
class StepTable {
 public:
  void add(IdType id, T value) { entries_.push_back({id, value}); }
  void sort() {
    std::stable_sort(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] IdType key(std::size_t i) const { return entries_[i].first; }
  [[nodiscard]] const T& value(std::size_t i) const { return entries_[i].second; }
  [[nodiscard]] const T* find(IdType id) const {
    const auto at = first(id);
    return at != entries_.end() && at->first == id ? &at->second : nullptr;
  }
  /// Calls `visit(value)` for every entry of `id`, in the order of addition.
  template <class Visit>
  void for_each(IdType id, Visit&& visit) const {
    for (auto at = first(id); at != entries_.end() && at->first == id; ++at) {
      visit(at->second);
    }
  }

 private:
  [[nodiscard]] auto first(IdType id) const {
    return std::lower_bound(entries_.begin(), entries_.end(), id, [](const auto& e, IdType i) { return e.first < i; });
  }
  std::vector<std::pair<IdType, T>> entries_;
};

}  // namespace

/// Applies one step that has not been applied before: what both ways to read it share.
class Attributes::Stepper {
 public:
  Stepper(Attributes& all, const Step& step, Record& record) : all_(all), step_(step), record_(record) {}

  /// By the lists, or, where a step changed one place several times, edit by edit.
  static void run(Attributes& all, const Step& step, Record& record);

 protected:
  class ByLists;
  class ByEdits;

  using Weights = std::array<double, 4>;

  /// A consumed tet and its children; of an edit: all of its tets.
  struct Family {
    double volume = 0, children_volume = 0;
    std::uint32_t children = 0;
    bool is_pooled = false;  // its children do not fill it: see `find_pool`
  };

  static double* at(Attribute& attribute, std::uint32_t slot) {
    return attribute.values.data() + std::size_t{slot} * attribute.spec.width;
  }
  /// The vertex whose value a vertex has so far: a copy of this step has none of its own before `copied` is applied.
  [[nodiscard]] VertexId resolve(VertexId vertex) const {
    const VertexId* root = roots_.find(vertex);
    return root == nullptr ? vertex : *root;
  }

  static bool is_field(const Attribute& attribute) {
    return attribute.spec.transfer == Transfer::kInterpolate || attribute.spec.transfer == Transfer::kInherit;
  }
  /// A new element of an attribute that is not handed down: nothing yet to conserve, or soon computed.
  static void start(Attribute& attribute, std::uint32_t slot) {
    if (attribute.spec.transfer == Transfer::kRecompute) {
      fill_initial(attribute, slot);
    } else {
      std::fill_n(at(attribute, slot), attribute.spec.width, 0.0);
    }
  }
  void give_birth(Attribute& attribute, const BornVertex& born) {
    if (attribute.spec.transfer == Transfer::kInterpolate) {
      mix(attribute, born.id, born.parents, born.weights);
    } else if (attribute.spec.transfer == Transfer::kInherit) {
      unsigned best = 0;
      for (unsigned p = 1; p < 4; ++p) {
        if (born.parents[p].is_valid() && born.weights[p] > born.weights[best]) best = p;
      }
      std::copy_n(at(attribute, resolve(born.parents[best]).value), attribute.spec.width, at(attribute, born.id.value));
    } else {
      start(attribute, born.id.value);
    }
  }
  void mix(Attribute& attribute, VertexId to, const TetVertices& from, const Weights& weights) {
    std::array<double, kMaxWidth> sum{};
    for (unsigned p = 0; p < 4; ++p) {
      if (!from[p].is_valid()) continue;
      const double* value = at(attribute, resolve(from[p]).value);
      for (std::uint32_t k = 0; k < attribute.spec.width; ++k) {
        sum[k] += weights[p] * value[k];
      }
    }
    std::copy_n(sum.begin(), attribute.spec.width, at(attribute, to.value));
  }
  [[nodiscard]] double density(Attribute& attribute, VertexId vertex, std::uint32_t k) const {
    const double lumped = all_.lumped_[vertex];
    return lumped > 0 ? at(attribute, vertex.value)[k] / lumped : 0.0;
  }

  /// Enters the vertices that hand on all but a sliver, with the share that they keep: it is summed, since a difference
  /// would be rounding, or 0, or less. `losses`: lumped volumes, in the order of the vertices; `keeps(v, corner)`:
  /// whether a vertex keeps what a corner of it holds.
  template <class Keeps>
  void find_spent(std::span<const std::pair<VertexId, double>> losses, const Keeps& keeps) {
    for (std::size_t i = 0; i < losses.size();) {
      const VertexId v = losses[i].first;
      double left = all_.lumped_[v];
      for (; i < losses.size() && losses[i].first == v; ++i) left -= losses[i].second;
      if (all_.lumped_[v] > 0 && left < kDigitsLost * all_.lumped_[v]) {
        const double kept = lumped_star(v, [&](std::uint32_t corner) { return keeps(v, corner); });
        spent_.add(v, std::clamp(kept / all_.lumped_[v], 0.0, 1.0));
      }
    }
  }
  /// The lumped volume of those corners at a vertex that count; the same sum whatever the order of the lists.
  template <class Counts>
  [[nodiscard]] double lumped_star(VertexId v, const Counts& counts) const {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = all_.first_corner_[v]; i != kInvalidIndex; i = all_.next_corner_[i]) {
      if (counts(i)) corners.push_back(i);
    }
    std::sort(corners.begin(), corners.end());
    double sum = 0;
    for (const std::uint32_t i : corners) sum += 0.25 * all_.volume(all_.tets_[TetId(i >> 2U)]);
    return sum;
  }
  /// Takes a quarter away; from spent vertices all at once.
  void take(Attribute& attribute, std::uint32_t k, VertexId v, double quarter) {
    if (spent_.find(v) == nullptr) at(attribute, v.value)[k] -= quarter;
  }
  void spend(Attribute& attribute, std::uint32_t k) {
    for (std::size_t i = 0; i < spent_.size(); ++i) at(attribute, spent_.key(i).value)[k] *= spent_.value(i);
  }
  /// The lumped volumes of spent vertices, once they have their new tets.
  void lump_spent() {
    for (std::size_t i = 0; i < spent_.size(); ++i) {
      all_.lumped_[spent_.key(i)] = lumped_star(spent_.key(i), [](std::uint32_t /*corner*/) { return true; });
    }
  }

  /// Moves a vertex with its copies; shrinking tets around it hand material to growing ones.
  void exchange(std::span<const MovedVertex> twins) {
    group_.clear();
    for (const MovedVertex& moved : twins) {
      group_.push_back(moved.id);
      copies_.for_each(moved.id, [&](VertexId copy) { group_.push_back(copy); });
    }
    find_star();
    before_.clear();
    for (const TetId tet : star_) before_.push_back(all_.volume(all_.tets_[tet]));
    for (const VertexId v : group_) all_.rest_[v] = twins.front().rest;
    after_.clear();
    double lost = 0, won = 0;
    for (std::size_t i = 0; i < star_.size(); ++i) {
      after_.push_back(all_.volume(all_.tets_[star_[i]]));
      lost += std::max(0.0, before_[i] - after_[i]);
      won += std::max(0.0, after_[i] - before_[i]);
    }
    if (lost > 0 && won > 0) {
      for (Attribute& attribute : all_.attributes_) {
        if (attribute.spec.transfer == Transfer::kConserve) flow(attribute, std::min(1.0, won / lost), won);
      }
    }
    for (std::size_t i = 0; i < star_.size(); ++i) {
      for (const VertexId v : all_.tets_[star_[i]]) all_.lumped_[v] += 0.25 * (after_[i] - before_[i]);
    }
  }
  /// The tets around the group, ascending, whatever the order of the lists.
  void find_star() {
    star_.clear();
    for (const VertexId v : group_) {
      for (std::uint32_t i = all_.first_corner_[v]; i != kInvalidIndex; i = all_.next_corner_[i]) {
        star_.push_back(TetId(i >> 2U));
      }
    }
    std::sort(star_.begin(), star_.end());
    star_.erase(std::unique(star_.begin(), star_.end()), star_.end());
    for (const TetId tet : star_) {
      all_.touch(record_, tet);
      for (const VertexId v : all_.tets_[tet]) all_.touch(record_, v);
    }
  }
  /// `scale`: the part of the lost volume that is won elsewhere; a star that shrinks as a whole keeps the rest.
  void flow(Attribute& attribute, double scale, double won) {
    const bool is_lumped = attribute.spec.domain == Domain::kVertex;
    for (std::uint32_t k = 0; k < attribute.spec.width; ++k) {
      double pool = 0;
      quarters_.assign(star_.size(), Weights{});
      for (std::size_t i = 0; i < star_.size(); ++i) {
        const double part = scale * std::max(0.0, before_[i] - after_[i]);
        for (unsigned c = 0; c < (is_lumped ? 4U : 1U) && part > 0; ++c) {
          quarters_[i][c] = is_lumped ? 0.25 * part * density(attribute, all_.tets_[star_[i]][c], k)
                                      : at(attribute, star_[i].value)[k] * (part / before_[i]);
          pool += quarters_[i][c];
        }
      }
      for (std::size_t i = 0; i < star_.size(); ++i) {
        const double gain = pool * (std::max(0.0, after_[i] - before_[i]) / won);
        if (!is_lumped) {
          at(attribute, star_[i].value)[k] += gain - quarters_[i][0];
          continue;
        }
        for (unsigned c = 0; c < 4; ++c) {
          at(attribute, all_.tets_[star_[i]][c].value)[k] += 0.25 * gain - quarters_[i][c];
        }
      }
    }
  }

  void retire() {
    for (Attribute& attribute : all_.attributes_) {
      if (attribute.spec.domain == Domain::kTet) {
        for (const ConsumedTet& tet : step_.consumed) clear(attribute, tet.id.value);
      } else {
        for (const VertexId v : step_.died) clear(attribute, v.value);
      }
    }
    for (const VertexId v : step_.died) all_.lumped_[v] = 0;
  }
  static void clear(Attribute& attribute, std::uint32_t slot) {
    std::fill_n(at(attribute, slot), attribute.spec.width, 0.0);
  }

  Attributes& all_;
  const Step& step_;
  Record& record_;
  StepTable<VertexId, VertexId> roots_;   // of copies: the vertex that was there before the copies
  StepTable<VertexId, VertexId> copies_;  // of roots
  std::vector<Weights> quarters_;
  StepTable<VertexId, double> spent_;  // the share of its value that a vertex keeps

 private:
  // Of the vertices that move:
  std::vector<VertexId> group_;
  std::vector<TetId> star_;
  std::vector<double> before_, after_;  // volumes, by star
};

/// All of a step at once: its lists tell the net effect.
class Attributes::Stepper::ByLists : private Stepper {
 public:
  using Stepper::Stepper;

  void run() {
    tabulate();
    touch_all();
    for (Attribute& attribute : all_.attributes_) {
      if (attribute.spec.domain == Domain::kVertex) give_vertex_values(attribute);
    }
    measure();
    for (Attribute& attribute : all_.attributes_) {
      if (attribute.spec.domain == Domain::kTet) {
        give_tet_values(attribute);
      } else if (attribute.spec.transfer == Transfer::kConserve) {
        hand_on(attribute);
      }
    }
    rebuild();
    for (const MovedVertex& moved : step_.moved) {
      exchange({&moved, 1});
    }
    retire();
  }

 private:
  void tabulate() {
    std::vector<std::pair<VertexId, VertexId>> chain;
    for (const CopiedVertex& copy : step_.copied) {
      roots_.add(copy.id, copy.source);
    }
    roots_.sort();
    for (const CopiedVertex& copy : step_.copied) {
      VertexId root = copy.source;
      for (const VertexId* next = roots_.find(root); next != nullptr; next = roots_.find(root)) {
        root = *next;
      }
      chain.emplace_back(copy.id, root);
    }
    roots_ = {};
    for (const auto& [copy, root] : chain) {
      roots_.add(copy, root);
      copies_.add(root, copy);
    }
    roots_.sort();
    copies_.sort();
    for (const VertexId vertex : step_.died) died_.add(vertex, true);
    died_.sort();
    for (std::uint32_t i = 0; i < step_.consumed.size(); ++i) parents_.add(step_.consumed[i].id, i);
    parents_.sort();
  }

  void touch_all() {
    const auto touch = [&](TetId tet, const TetVertices& vertices) {
      all_.touch(record_, tet);
      for (const VertexId v : vertices) all_.touch(record_, v);
    };
    for (const BornVertex& born : step_.born) all_.touch(record_, born.id);
    for (const MovedVertex& moved : step_.moved) all_.touch(record_, moved.id);
    for (const CopiedVertex& copied : step_.copied) all_.touch(record_, copied.id);
    for (const ConsumedTet& tet : step_.consumed) touch(tet.id, tet.vertices);
    for (const ProducedTet& tet : step_.produced) touch(tet.id, tet.vertices);
    for (const RewiredTet& tet : step_.rewired) {
      touch(tet.id, tet.old_vertices);
      touch(tet.id, tet.vertices);
    }
    for (const VertexId vertex : step_.died) all_.touch(record_, vertex);
    // All volumes up to `exchange` are those before the moves: there the children of a tet fill it.
    for (const BornVertex& born : step_.born) all_.rest_[born.id] = born.rest;
    for (const CopiedVertex& copied : step_.copied) all_.rest_[copied.id] = all_.rest_[resolve(copied.id)];
  }
  void give_vertex_values(Attribute& attribute) {
    const std::uint32_t width = attribute.spec.width;
    for (const BornVertex& born : step_.born) {
      give_birth(attribute, born);
    }
    if (attribute.spec.transfer == Transfer::kInterpolate) {
      for (const MovedVertex& moved : step_.moved) {
        mix(attribute, moved.id, moved.basis, moved.weights);
      }
    }
    for (const CopiedVertex& copied : step_.copied) {
      if (is_field(attribute)) {
        std::copy_n(at(attribute, copied.source.value), width, at(attribute, copied.id.value));
      } else {
        start(attribute, copied.id.value);
      }
    }
  }

  void measure() {
    families_.resize(step_.consumed.size());
    for (std::size_t i = 0; i < families_.size(); ++i) {
      families_[i].volume = all_.volume(step_.consumed[i].vertices);
    }
    for (const ProducedTet& child : step_.produced) {
      volumes_.push_back(all_.volume(child.vertices));
      if (const std::uint32_t* parent = parents_.find(child.parent)) {
        families_[*parent].children_volume += volumes_.back();
        ++families_[*parent].children;
      }
    }
    find_pool();
    tabulate_losses();
    find_spent(losses_, [&](VertexId v, std::uint32_t corner) { return keeps(v, corner); });
  }
  /// Whether a consumed tet hands on what it holds; one without children leaves it with its corners.
  [[nodiscard]] bool hands_on(std::size_t consumed) const {
    return families_[consumed].children > 0 || families_[consumed].is_pooled;
  }
  /// The lumped volumes that vertices hand on, in their order.
  void tabulate_losses() {
    for (std::size_t i = 0; i < step_.consumed.size(); ++i) {
      if (!hands_on(i)) continue;
      for (const VertexId v : step_.consumed[i].vertices) losses_.emplace_back(v, 0.25 * families_[i].volume);
    }
    for (std::uint32_t i = 0; i < step_.rewired.size(); ++i) {
      const RewiredTet& tet = step_.rewired[i];
      rewired_.add(tet.id, i);
      const double quarter = 0.25 * all_.volume(tet.old_vertices);
      for (unsigned c = 0; c < 4; ++c) {
        if (tet.old_vertices[c] != tet.vertices[c]) losses_.emplace_back(tet.old_vertices[c], quarter);
      }
    }
    rewired_.sort();
    std::stable_sort(losses_.begin(), losses_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  /// Whether a vertex keeps what a corner of it holds.
  [[nodiscard]] bool keeps(VertexId v, std::uint32_t corner) const {
    const TetId tet(corner >> 2U);
    if (const std::uint32_t* parent = parents_.find(tet)) return !hands_on(*parent);
    const std::uint32_t* changed = rewired_.find(tet);
    return changed == nullptr || step_.rewired[*changed].vertices[corner & 3U] == v;
  }
  /// Children that a front made anew fill the tets before them together, not each its own parent. Those families share
  /// what they hold, if together they keep their volume.
  void find_pool() {
    double before = 0, after = 0;
    for (Family& family : families_) {
      family.is_pooled = std::abs(family.children_volume - family.volume) > kVolumeRounding * family.volume;
      before += family.is_pooled ? family.volume : 0.0;
      after += family.is_pooled ? family.children_volume : 0.0;
    }
    pool_volume_ = std::abs(after - before) <= kVolumeRounding * before ? after : 0.0;
    for (Family& family : families_) family.is_pooled &= pool_volume_ > 0;
  }
  /// What the children of the pool lack of what its tets held, per volume. `held(i)`: by the i-th consumed tet.
  template <class Held>
  [[nodiscard]] double missing_density(const Held& held) const {
    if (!(pool_volume_ > 0)) return 0;
    double missing = 0;
    for (std::size_t i = 0; i < families_.size(); ++i) missing += families_[i].is_pooled ? held(i) : 0.0;
    for (std::size_t i = 0; i < step_.produced.size(); ++i) {
      const std::uint32_t* parent = parents_.find(step_.produced[i].parent);
      if (parent != nullptr && families_[*parent].is_pooled) missing -= held(*parent) * share_of(i);
    }
    return missing / pool_volume_;
  }
  /// What a produced tet gets of what its parent held; `missing` as above.
  [[nodiscard]] double portion(std::size_t produced, double held, double missing) const {
    const std::uint32_t* parent = parents_.find(step_.produced[produced].parent);
    const bool is_pooled = parent != nullptr && families_[*parent].is_pooled;
    return held * share_of(produced) + (is_pooled ? missing * volumes_[produced] : 0.0);
  }
  /// The part of its parent that a produced tet gets.
  [[nodiscard]] double share_of(std::size_t produced) const {
    const std::uint32_t* parent = parents_.find(step_.produced[produced].parent);
    if (parent == nullptr) {
      return 0;
    }
    const Family& family = families_[*parent];
    if (family.is_pooled) return family.volume > 0 ? volumes_[produced] / family.volume : 0.0;
    return family.children_volume > 0 ? volumes_[produced] / family.children_volume : 1.0 / family.children;
  }

  void give_tet_values(Attribute& attribute) {
    for (std::size_t i = 0; i < step_.produced.size(); ++i) {
      const ProducedTet& child = step_.produced[i];
      const double* from = at(attribute, child.parent.value);
      double* to = at(attribute, child.id.value);
      if (is_field(attribute)) {
        std::copy_n(from, attribute.spec.width, to);
        continue;
      }
      start(attribute, child.id.value);
    }
    for (std::uint32_t k = 0; attribute.spec.transfer == Transfer::kConserve && k < attribute.spec.width; ++k) {
      const double missing =
          missing_density([&](std::size_t i) { return at(attribute, step_.consumed[i].id.value)[k]; });
      for (std::size_t i = 0; i < step_.produced.size(); ++i) {
        const ProducedTet& child = step_.produced[i];
        at(attribute, child.id.value)[k] = portion(i, at(attribute, child.parent.value)[k], missing);
      }
    }
  }

  /// Material goes from the corners of consumed tets to those of their children, from old vertices to their copies.
  void hand_on(Attribute& attribute) {
    for (std::uint32_t k = 0; k < attribute.spec.width; ++k) {
      take_quarters(attribute, k);
      spend(attribute, k);
      for (std::size_t i = 0; i < step_.consumed.size(); ++i) {
        if (!hands_on(i)) {
          leave_behind(attribute, k, i);
          continue;
        }
        for (unsigned c = 0; c < 4; ++c) take(attribute, k, step_.consumed[i].vertices[c], quarters_[i][c]);
      }
      const auto held = [&](std::size_t i) {
        const Weights& q = quarters_[i];
        return q[0] + q[1] + q[2] + q[3];
      };
      const double missing = missing_density(held);
      for (std::size_t i = 0; i < step_.produced.size(); ++i) {
        if (const std::uint32_t* parent = parents_.find(step_.produced[i].parent)) {
          const double quarter = portion(i, held(*parent), missing) * 0.25;
          for (const VertexId v : step_.produced[i].vertices) at(attribute, v.value)[k] += quarter;
        }
      }
      for (std::size_t i = 0; i < step_.rewired.size(); ++i) {
        const RewiredTet& tet = step_.rewired[i];
        for (unsigned c = 0; c < 4; ++c) {
          if (tet.old_vertices[c] == tet.vertices[c]) continue;
          take(attribute, k, tet.old_vertices[c], rewired_quarters_[i][c]);
          at(attribute, tet.vertices[c].value)[k] += rewired_quarters_[i][c];
        }
      }
    }
  }
  /// What the tets hold of each of their corners' values, all at the densities before the step.
  void take_quarters(Attribute& attribute, std::uint32_t k) {
    quarters_.resize(step_.consumed.size());
    rewired_quarters_.resize(step_.rewired.size());
    for (std::size_t i = 0; i < quarters_.size(); ++i) {
      for (unsigned c = 0; c < 4; ++c) {
        quarters_[i][c] = 0.25 * families_[i].volume * density(attribute, step_.consumed[i].vertices[c], k);
      }
    }
    for (std::size_t i = 0; i < rewired_quarters_.size(); ++i) {
      const TetVertices& old_vertices = step_.rewired[i].old_vertices;
      const double volume = all_.volume(old_vertices);
      for (unsigned c = 0; c < 4; ++c) {
        rewired_quarters_[i][c] = 0.25 * volume * density(attribute, old_vertices[c], k);
      }
    }
  }
  /// A consumed tet without children: dead corners leave their quarters to the living ones.
  void leave_behind(Attribute& attribute, std::uint32_t k, std::size_t consumed) {
    const TetVertices& vertices = step_.consumed[consumed].vertices;
    double orphaned = 0;
    unsigned living = 0;
    for (unsigned c = 0; c < 4; ++c) {
      if (died_.find(vertices[c]) == nullptr) {
        ++living;
      } else {
        at(attribute, vertices[c].value)[k] -= quarters_[consumed][c];
        orphaned += quarters_[consumed][c];
      }
    }
    for (unsigned c = 0; c < 4 && living > 0; ++c) {
      if (died_.find(vertices[c]) == nullptr) at(attribute, vertices[c].value)[k] += orphaned / living;
    }
  }

  /// Brings the connectivity and the lumped volumes up to date.
  void rebuild() {
    const auto lump = [&](const TetVertices& vertices, double volume) {
      for (const VertexId v : vertices) all_.lumped_[v] += 0.25 * volume;
    };
    for (std::size_t i = 0; i < step_.consumed.size(); ++i) {
      all_.unlink(step_.consumed[i].id);
      lump(step_.consumed[i].vertices, -families_[i].volume);
    }
    for (std::size_t i = 0; i < step_.produced.size(); ++i) {
      all_.link(step_.produced[i].id, step_.produced[i].vertices);
      lump(step_.produced[i].vertices, volumes_[i]);
    }
    for (const RewiredTet& tet : step_.rewired) {
      const double volume = all_.volume(tet.old_vertices);
      all_.unlink(tet.id);
      all_.link(tet.id, tet.vertices);
      lump(tet.old_vertices, -volume);
      lump(tet.vertices, volume);
    }
    lump_spent();
  }

  StepTable<VertexId, bool> died_;
  StepTable<TetId, std::uint32_t> parents_;  // index into consumed
  std::vector<Family> families_;             // by consumed
  std::vector<double> volumes_;              // by produced
  double pool_volume_ = 0;                   // of the children in pooled families; 0 where there are none
  std::vector<Weights> rewired_quarters_;
  std::vector<std::pair<VertexId, double>> losses_;
  StepTable<TetId, std::uint32_t> rewired_;  // index into step_.rewired
};

/// One edit after the other.
class Attributes::Stepper::ByEdits : private Stepper {
 public:
  using Stepper::Stepper;

  /// One edit after the other: each finds the values and places that the one before it left.
  void run() {
    std::size_t consumed = 0, produced = 0;
    for (std::size_t i = 0; i < step_.edits.size(); ++i) {
      const Edit& edit = step_.edits[i];
      consumed_ = std::span(step_.edit_consumed).subspan(consumed, edit.consumed_end - consumed);
      produced_ = std::span(step_.edit_produced).subspan(produced, edit.produced_end - produced);
      consumed = edit.consumed_end;
      produced = edit.produced_end;
      if (edit.kind == Edit::Kind::kMove) {
        const std::span<const MovedVertex> twins = twins_at(i);
        resample(twins);
        i += twins.size() - 1;
      } else {
        remesh(edit);
      }
    }
    retire();
  }

 private:
  /// The moves from an edit on that take copies of one vertex to one place: what one side of a wall loses the other
  /// wins.
  [[nodiscard]] std::span<const MovedVertex> twins_at(std::size_t edit) const {
    const std::size_t first = step_.edits[edit].vertex;
    std::size_t count = 1;
    const auto is_twin = [&](const Edit& next) {
      const MovedVertex& moved = step_.moved[first];
      return next.kind == Edit::Kind::kMove && next.vertex == first + count &&
             step_.moved[next.vertex].old_rest == moved.old_rest && step_.moved[next.vertex].rest == moved.rest;
    };
    while (edit + count < step_.edits.size() && is_twin(step_.edits[edit + count])) ++count;
    return std::span(step_.moved).subspan(first, count);
  }
  void resample(std::span<const MovedVertex> twins) {
    for (const MovedVertex& moved : twins) {
      all_.touch(record_, moved.id);
      for (Attribute& attribute : all_.attributes_) {
        if (attribute.spec.domain == Domain::kVertex && attribute.spec.transfer == Transfer::kInterpolate) {
          mix(attribute, moved.id, moved.basis, moved.weights);
        }
      }
    }
    exchange(twins);
  }

  /// A cavity gives way to its new tets: what it held becomes theirs.
  void remesh(const Edit& edit) {
    touch_cavity();
    if (edit.vertex != kInvalidIndex) bear(step_.born[edit.vertex]);
    find_parents();
    measure_cavity();
    relink();
    for (Attribute& attribute : all_.attributes_) {
      if (attribute.spec.domain == Domain::kTet) {
        refill_tets(attribute);
      } else if (attribute.spec.transfer == Transfer::kConserve) {
        for (std::uint32_t k = 0; k < attribute.spec.width; ++k) refill_vertices(attribute, k);
      }
    }
    lump_cavity();
  }
  void touch_cavity() {
    const auto touch = [&](const auto& tet) {
      all_.touch(record_, tet.id);
      for (const VertexId v : tet.vertices) all_.touch(record_, v);
    };
    for (const ConsumedTet& tet : consumed_) touch(tet);
    for (const ProducedTet& tet : produced_) touch(tet);
  }
  void bear(const BornVertex& born) {
    all_.rest_[born.id] = born.rest;
    for (Attribute& attribute : all_.attributes_) {
      if (attribute.spec.domain == Domain::kVertex) give_birth(attribute, born);
    }
  }
  /// Parents stand in about the order of their children, so the search goes on where it found the last one.
  void find_parents() {
    parent_of_.clear();
    std::uint32_t at = 0;
    for (const ProducedTet& child : produced_) {
      for (std::size_t tries = 0; consumed_[at].id != child.parent && tries < consumed_.size(); ++tries) {
        at = at + 1 == consumed_.size() ? 0 : at + 1;
      }
      parent_of_.push_back(at);
    }
  }
  void measure_cavity() {
    families_.assign(consumed_.size(), Family{});
    old_volumes_.clear();
    volumes_.clear();
    for (const ConsumedTet& tet : consumed_) old_volumes_.push_back(all_.volume(tet.vertices));
    for (std::size_t i = 0; i < produced_.size(); ++i) {
      volumes_.push_back(all_.volume(produced_[i].vertices));
      families_[parent_of_[i]].children_volume += volumes_.back();
      ++families_[parent_of_[i]].children;
    }
    unite_families();
  }
  /// The cavity is one family, unless it spans a border between regions: only splits do, where every tet has its own.
  void unite_families() {
    const auto is_first = [&](const ProducedTet& tet) { return tet.region == produced_.front().region; };
    const auto is_childless = [](const Family& family) { return family.children == 0; };
    is_one_family_ = std::all_of(produced_.begin(), produced_.end(), is_first) ||
                     std::any_of(families_.begin(), families_.end(), is_childless);
    for (std::size_t i = 1; is_one_family_ && i < families_.size(); ++i) {
      families_[0].children_volume += families_[i].children_volume;
      families_[0].children += families_[i].children;
    }
    families_.resize(is_one_family_ ? 1 : families_.size());
  }
  [[nodiscard]] std::size_t family_of(std::size_t consumed) const { return is_one_family_ ? 0 : consumed; }
  [[nodiscard]] double share_in_family(std::size_t produced) const {
    const Family& family = families_[family_of(parent_of_[produced])];
    return family.children_volume > 0 ? volumes_[produced] / family.children_volume : 1.0 / family.children;
  }
  /// Brings the connectivity up to date, and finds the vertices that are left without tets.
  void relink() {
    for (const ConsumedTet& tet : consumed_) all_.unlink(tet.id);
    for (const ProducedTet& tet : produced_) all_.link(tet.id, tet.vertices);
    orphans_.clear();
    for (const ConsumedTet& tet : consumed_) {
      for (const VertexId v : tet.vertices) {
        const bool is_new = std::find(orphans_.begin(), orphans_.end(), v) == orphans_.end();
        if (all_.first_corner_[v] == kInvalidIndex && is_new) orphans_.push_back(v);
      }
    }
  }

  void refill_tets(Attribute& attribute) {
    const std::uint32_t width = attribute.spec.width;
    held_.clear();
    pools_.assign(families_.size() * width, 0.0);
    for (std::size_t i = 0; i < consumed_.size(); ++i) {
      const double* value = at(attribute, consumed_[i].id.value);
      held_.insert(held_.end(), value, value + width);
      for (std::uint32_t k = 0; k < width; ++k) pools_[family_of(i) * width + k] += value[k];
      clear(attribute, consumed_[i].id.value);
    }
    for (std::size_t i = 0; i < produced_.size(); ++i) {
      double* to = at(attribute, produced_[i].id.value);
      if (is_field(attribute)) {
        std::copy_n(held_.data() + parent_of_[i] * width, width, to);
        continue;
      }
      start(attribute, produced_[i].id.value);
      const double* pool = pools_.data() + family_of(parent_of_[i]) * width;
      for (std::uint32_t k = 0; attribute.spec.transfer == Transfer::kConserve && k < width; ++k) {
        to[k] = pool[k] * share_in_family(i);
      }
    }
  }
  void refill_vertices(Attribute& attribute, std::uint32_t k) {
    pools_.assign(families_.size(), 0.0);
    quarters_.resize(consumed_.size());
    for (std::size_t i = 0; i < consumed_.size(); ++i) {
      for (unsigned c = 0; c < 4; ++c) {
        quarters_[i][c] = 0.25 * old_volumes_[i] * density(attribute, consumed_[i].vertices[c], k);
        pools_[family_of(i)] += quarters_[i][c];
      }
    }
    for (std::size_t i = 0; i < consumed_.size(); ++i) {
      for (unsigned c = 0; c < 4; ++c) at(attribute, consumed_[i].vertices[c].value)[k] -= quarters_[i][c];
    }
    for (const VertexId v : orphans_) {  // what rounding, or tets without volume, left
      pools_[0] += std::exchange(at(attribute, v.value)[k], 0.0);
    }
    for (std::size_t i = 0; i < produced_.size(); ++i) {
      const double quarter = 0.25 * pools_[family_of(parent_of_[i])] * share_in_family(i);
      for (const VertexId v : produced_[i].vertices) at(attribute, v.value)[k] += quarter;
    }
  }
  void lump_cavity() {
    for (std::size_t i = 0; i < consumed_.size(); ++i) {
      for (const VertexId v : consumed_[i].vertices) all_.lumped_[v] -= 0.25 * old_volumes_[i];
    }
    for (std::size_t i = 0; i < produced_.size(); ++i) {
      for (const VertexId v : produced_[i].vertices) all_.lumped_[v] += 0.25 * volumes_[i];
    }
  }

  // Of the edit at work:
  std::span<const ConsumedTet> consumed_;
  std::span<const ProducedTet> produced_;
  std::vector<Family> families_;          // one of all, or by consumed_
  std::vector<double> volumes_;           // by produced_
  std::vector<std::uint32_t> parent_of_;  // index into consumed_, by produced_
  std::vector<double> old_volumes_;       // by consumed_
  std::vector<VertexId> orphans_;
  std::vector<double> held_, pools_;  // values by consumed_; sums by family
  bool is_one_family_ = true;
};

void Attributes::Stepper::run(Attributes& all, const Step& step, Record& record) {
  if (step.edits.empty()) {
    ByLists(all, step, record).run();
  } else {
    ByEdits(all, step, record).run();
  }
}

Attributes::Attributes(const TetMesh& mesh, const Journal& journal)
    : base_(journal.position()), base_serial_(journal.serial_before(journal.position())) {
  resize(mesh.vertex_slots(), mesh.tet_slots());
  mesh.for_each_vertex([&](VertexId v) { rest_[v] = mesh.rest(v); });
  mesh.for_each_tet([&](TetId tet) {
    link(tet, mesh.vertices(tet));
    const double quarter = 0.25 * volume(mesh.vertices(tet));
    for (const VertexId v : mesh.vertices(tet)) lumped_[v] += quarter;
  });
}

Result<AttributeId> Attributes::add(const TetMesh& mesh, AttributeSpec spec) {
  const auto refuse = [&](const std::string& what) {
    return Error{ErrorCode::kBadArgument, "attribute '" + spec.name + "': " + what, {}};
  };
  if (spec.name.empty()) return refuse("needs a name");
  if (find(spec.name).is_valid()) return refuse("the name is taken");
  if (spec.width < 1 || spec.width > kMaxWidth) return refuse("the width must lie in [1, 64]");
  if ((spec.transfer == Transfer::kRecompute) != static_cast<bool>(spec.recompute)) {
    return refuse("a function belongs to the policy recompute, and to no other");
  }
  if (!spec.initial.empty() && spec.initial.size() != spec.width) return refuse("needs `width` initial values");
  if (mesh.vertex_slots() != rest_.size() || mesh.tet_slots() != tets_.size()) {
    return refuse("the mesh has changed: call follow() first");
  }
  spec.initial.resize(spec.width, 0.0);
  attributes_.push_back({std::move(spec), {}});
  Attribute& attribute = attributes_.back();
  const auto id = AttributeId(static_cast<std::uint32_t>(attributes_.size() - 1));
  const auto start = [&](std::uint32_t slot) {
    fill_initial(attribute, slot);
    if (attribute.spec.recompute) attribute.spec.recompute(mesh, slot, value(id, slot));
  };
  if (attribute.spec.domain == Domain::kVertex) {
    attribute.values.resize(rest_.size() * attribute.spec.width, 0.0);
    mesh.for_each_vertex([&](VertexId v) { start(v.value); });
  } else {
    attribute.values.resize(tets_.size() * attribute.spec.width, 0.0);
    mesh.for_each_tet([&](TetId t) { start(t.value); });
  }
  return id;
}

AttributeId Attributes::find(const std::string& name) const {
  for (std::uint32_t i = 0; i < attributes_.size(); ++i) {
    if (attributes_[i].spec.name == name) return AttributeId(i);
  }
  return {};
}

/// How many of the applied steps are applied still; none where the journal does not tell any more.
std::optional<std::size_t> Attributes::common_with(const Journal& journal) const {
  if (journal.position() < base_) return std::nullopt;
  for (std::size_t common = std::min(journal.position() - base_, applied_); base_ + common >= journal.first();
       --common) {
    const std::uint64_t serial = common == 0 ? base_serial_ : records_[common - 1].serial;
    if (journal.serial_before(base_ + common) == serial) return common;
    if (common == 0) break;
  }
  return std::nullopt;
}

Status Attributes::follow(const Journal& journal, const TetMesh& mesh) {
  const std::optional<std::size_t> common = common_with(journal);
  if (!common) {
    return Error{ErrorCode::kBadArgument,
                 "the journal stands at step " + std::to_string(journal.position()) + " and keeps those from " +
                     std::to_string(journal.first()) + " on: the attributes, which began at step " +
                     std::to_string(base_) + " and stand at step " + std::to_string(position()) +
                     ", cannot get there; construct them anew",
                 {journal.position(), journal.first(), base_, position()}};
  }
  while (applied_ > *common) {
    swap_with(records_[--applied_]);
  }
  while (position() < journal.position()) {
    apply(journal.step(position()));
  }
  recompute_last(mesh);
  forget_trimmed(journal);
  return {};
}

/// An undone step comes back as it was left; a new one drops those that were undone.
void Attributes::apply(const Step& step) {
  if (applied_ < records_.size() && records_[applied_].serial == step.serial) {
    swap_with(records_[applied_++]);
    return;
  }
  records_.resize(applied_);
  Record& record = records_.emplace_back();
  record.serial = step.serial;
  record.vertex_slots = static_cast<std::uint32_t>(rest_.size());
  record.tet_slots = static_cast<std::uint32_t>(tets_.size());
  record.values.resize(attributes_.size());
  std::uint32_t vertex_slots = record.vertex_slots, tet_slots = record.tet_slots;
  for (const VertexId v : step.new_vertices) vertex_slots = std::max(vertex_slots, v.value + 1);
  for (const TetId t : step.new_tets) tet_slots = std::max(tet_slots, t.value + 1);
  resize(vertex_slots, tet_slots);
  Stepper::run(*this, step, record);
  mark(record, false);
  ++applied_;
}

/// What the journal cannot undo needs no record.
void Attributes::forget_trimmed(const Journal& journal) {
  for (; base_ < journal.first(); ++base_, --applied_) {
    base_serial_ = records_.front().serial;
    records_.pop_front();
  }
}

void Attributes::resize(std::uint32_t vertex_slots, std::uint32_t tet_slots) {
  rest_.resize(vertex_slots, Vec3::Zero());
  lumped_.resize(vertex_slots, 0.0);
  first_corner_.resize(vertex_slots, kInvalidIndex);
  tets_.resize(tet_slots, kNoVertices);
  next_corner_.resize(std::size_t{tet_slots} * 4, kInvalidIndex);
  is_touched_vertex_.ensure(vertex_slots);
  is_touched_tet_.ensure(tet_slots);
  for (Attribute& attribute : attributes_) {
    const std::size_t slots = attribute.spec.domain == Domain::kVertex ? vertex_slots : tet_slots;
    attribute.values.resize(slots * attribute.spec.width, 0.0);
  }
}

void Attributes::fill_initial(Attribute& attribute, std::uint32_t slot) {
  std::copy(attribute.spec.initial.begin(), attribute.spec.initial.end(),
            attribute.values.begin() + std::size_t{slot} * attribute.spec.width);
}

void Attributes::link(TetId tet, const TetVertices& vertices) {
  tets_[tet] = vertices;
  for (unsigned c = 0; c < 4; ++c) {
    const std::uint32_t corner = tet.value * 4 + c;
    next_corner_[corner] = first_corner_[vertices[c]];
    first_corner_[vertices[c]] = corner;
  }
}

void Attributes::unlink(TetId tet) {
  for (unsigned c = 0; c < 4; ++c) {
    const std::uint32_t corner = tet.value * 4 + c;
    std::uint32_t* at = &first_corner_[tets_[tet][c]];
    while (*at != corner) {
      at = &next_corner_[*at];
    }
    *at = next_corner_[corner];
  }
  tets_[tet] = kNoVertices;
}

/// The rest volume; 0 for the flat or inverted tets of dirty input.
double Attributes::volume(const TetVertices& v) const {
  const Vec3& a = rest_[v[0]];
  const double volume6 = (rest_[v[1]] - a).cross(rest_[v[2]] - a).dot(rest_[v[3]] - a);
  return volume6 > 0 ? volume6 / 6.0 : 0.0;
}

void Attributes::touch(Record& record, VertexId vertex) {
  if (is_touched_vertex_[vertex.value] != 0) {
    return;
  }
  is_touched_vertex_[vertex.value] = 1;
  record.vertices.push_back({vertex, rest_[vertex], lumped_[vertex]});
  for (std::uint32_t a = 0; a < record.values.size(); ++a) {
    if (attributes_[a].spec.domain == Domain::kVertex) {
      const std::span<const double> old = value(AttributeId(a), vertex.value);
      record.values[a].insert(record.values[a].end(), old.begin(), old.end());
    }
  }
}

void Attributes::touch(Record& record, TetId tet) {
  if (is_touched_tet_[tet.value] != 0) {
    return;
  }
  is_touched_tet_[tet.value] = 1;
  record.tets.push_back({tet, tets_[tet]});
  for (std::uint32_t a = 0; a < record.values.size(); ++a) {
    if (attributes_[a].spec.domain == Domain::kTet) {
      const std::span<const double> old = value(AttributeId(a), tet.value);
      record.values[a].insert(record.values[a].end(), old.begin(), old.end());
    }
  }
}

void Attributes::mark(const Record& record, bool is_touched) {
  const std::uint8_t bit = is_touched ? 1 : 0;
  for (const SavedVertex& saved : record.vertices) is_touched_vertex_[saved.id.value] = bit;
  for (const SavedTet& saved : record.tets) is_touched_tet_[saved.id.value] = bit;
}

void Attributes::swap_with(Record& record) {
  const auto vertex_slots = static_cast<std::uint32_t>(rest_.size());
  const auto tet_slots = static_cast<std::uint32_t>(tets_.size());
  resize(std::max(vertex_slots, record.vertex_slots), std::max(tet_slots, record.tet_slots));
  std::vector<bool> is_revived_tet, is_revived_vertex;
  for (SavedTet& saved : record.tets) {
    is_revived_tet.push_back(!tets_[saved.id][0].is_valid());
    const TetVertices now = tets_[saved.id];
    if (now[0].is_valid()) unlink(saved.id);
    if (saved.vertices[0].is_valid()) link(saved.id, saved.vertices);
    saved.vertices = now;
  }
  for (SavedVertex& saved : record.vertices) {
    is_revived_vertex.push_back(lumped_[saved.id] == 0 && saved.lumped > 0);
    std::swap(rest_[saved.id], saved.rest);
    std::swap(lumped_[saved.id], saved.lumped);
  }
  for (std::size_t a = 0; a < attributes_.size(); ++a) {
    swap_values(record, a, attributes_[a].spec.domain == Domain::kVertex ? is_revived_vertex : is_revived_tet);
  }
  resize(record.vertex_slots, record.tet_slots);
  record.vertex_slots = vertex_slots;
  record.tet_slots = tet_slots;
}

void Attributes::swap_values(Record& record, std::size_t attribute, const std::vector<bool>& is_revived) {
  Attribute& a = attributes_[attribute];
  const std::uint32_t width = a.spec.width;
  for (std::size_t i = 0; i < is_revived.size(); ++i) {
    const std::uint32_t slot = a.spec.domain == Domain::kVertex ? record.vertices[i].id.value : record.tets[i].id.value;
    if (attribute < record.values.size()) {
      double* now = a.values.data() + std::size_t{slot} * width;
      std::swap_ranges(now, now + width, record.values[attribute].data() + i * width);
    } else if (is_revived[i]) {  // the attribute is younger than the step
      fill_initial(a, slot);
    }
  }
}

/// Evaluates functions for what was touched since the mesh was last seen. Steps that were passed in between get their
/// values when an undo stops at them.
void Attributes::recompute_last(const TetMesh& mesh) {
  if (applied_ == 0 || records_[applied_ - 1].is_recomputed) {
    return;
  }
  Record& last = records_[applied_ - 1];
  last.is_recomputed = true;
  const bool has_functions = std::any_of(attributes_.begin(), attributes_.end(),
                                         [](const Attribute& a) { return a.spec.transfer == Transfer::kRecompute; });
  if (!has_functions) {
    return;
  }
  mark(last, true);
  for (std::size_t i = applied_ - 1; i-- > 0 && !records_[i].is_recomputed;) {
    for (const SavedVertex& saved : records_[i].vertices) {
      if (saved.id.value < rest_.size()) touch(last, saved.id);
    }
    for (const SavedTet& saved : records_[i].tets) {
      if (saved.id.value < tets_.size()) touch(last, saved.id);
    }
  }
  mark(last, false);
  for (const SavedVertex& saved : last.vertices) {
    if (mesh.is_live(saved.id)) recompute(mesh, Domain::kVertex, saved.id.value);
  }
  for (const SavedTet& saved : last.tets) {
    if (mesh.is_live(saved.id)) recompute(mesh, Domain::kTet, saved.id.value);
  }
}

void Attributes::recompute(const TetMesh& mesh, Domain domain, std::uint32_t slot) {
  for (std::uint32_t a = 0; a < attributes_.size(); ++a) {
    const AttributeSpec& spec = attributes_[a].spec;
    if (spec.domain == domain && spec.recompute) spec.recompute(mesh, slot, value(AttributeId(a), slot));
  }
}

}  // namespace v0
}  // namespace incise
