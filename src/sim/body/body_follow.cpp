// SPDX-License-Identifier: Apache-2.0
// How the solver's data follow the mesh: tets that a step touched leave their stars and come back as they are now.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "incise/geom/box.h"
#include "incise/mesh/journal_visitor.h"
#include "sim/body/body_rewind.h"
#include "sim/body/body_state.h"
#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {

using detail::Held;
using detail::Hold;

// --- from the mesh

std::array<Vec3, 4> DeformableBody::State::corners_at_rest(TetId t) const {
  const TetVertices& v = tets[t];
  return {rest[v[0]], rest[v[1]], rest[v[2]], rest[v[3]]};
}

std::array<Vec3, 4> DeformableBody::State::corners(TetId t) const {
  const TetVertices& v = tets[t];
  return {places[v[0].value], places[v[1].value], places[v[2].value], places[v[3].value]};
}

namespace {

/// Lamé's parameters as the energy has them, in kg/(L s²).
struct Stiffness {
  double lambda, mu;
  double shared;  ///< of Lamé's λ, what vertices resist with
};

double own_share(const Material& material, bool is_averaged) {
  if (!is_averaged || material.poisson <= detail::kOwnPoisson) return material.lambda();
  Material stiff = material;
  stiff.poisson = detail::kOwnPoisson;
  return stiff.lambda();
}

Stiffness stiffness_of(const Material& material, double unit, bool is_averaged) {
  // Pa are kg/(m s²): by metres per unit they become kg/(L s²). The energy's own λ is Lamé's + μ: only then are small
  // strains Hooke's (Smith et al. 2018, section 3.4).
  const double mu = material.mu() * unit;
  const double own = own_share(material, is_averaged);
  return {own * unit + mu, mu, (material.lambda() - own) * unit};
}

/// Of all that relaxes, by the shear modulus at rest.
double relaxing_share(const Material& material) {
  double sum = 0;
  for (const PronyTerm& term : material.prony) sum += term.share;
  return sum;
}

}  // namespace

detail::Element DeformableBody::State::element(TetId t) const {
  return is_bone(t) ? detail::Element{} : soft_element(t, true);
}

/// What relaxes resists shear alone: its −μ (J − 1) takes μ/3 from the modulus of volume, which its λ gives back.
detail::Element DeformableBody::State::soft_element(TetId t, bool has_offset) const {
  const Material& material = materials.of(regions[t]);
  const std::array<Vec3, 4> p = corners_at_rest(t);
  Stiffness stiffness = stiffness_of(material, unit(), nodal.is_on);
  const double at_rest = stiffness.mu;
  double stiffening = stars.stiffens ? material.stiffening : 0.0;
  if (is_viscous) {
    const double more = relaxing_share(material);
    stiffness.lambda += more * stiffness.mu / 3;
    stiffness.mu *= 1 + more;
    stiffening *= 1 + more;
  }
  detail::Element element = (has_offset ? detail::element_of : detail::slopes_of)(
      p, stiffness.lambda, stiffness.mu, options.thinnest, 6 * options.crumb, stiffness.shared, stiffening);
  if (stars.has_fibres && material.fibre_young > 0) {
    detail::add_fibres(p, Vec3(material.fibre[0], material.fibre[1], material.fibre[2]), material.fibre_young * unit(),
                       options.thinnest, element);
  }
  for (unsigned k = 0; is_viscous && k < material.prony.size(); ++k) {
    if (material.prony[k].share > 0) {
      detail::set_metric(p, material.prony[k].share * at_rest, options.thinnest, metric(t, k), element);
    }
  }
  return element;
}

void DeformableBody::State::ensure(std::uint32_t slots, std::uint32_t tet_slots) {
  tets.resize(tet_slots);
  regions.resize(tet_slots);
  rest.resize(slots, Vec3::Zero());
  held.resize(slots, Held::kNot);
  places.resize(slots, Vec3::Zero());
  rows.ensure(slots);
  floats.resize(std::size_t{4} * slots);
  motions.resize(slots);
  travelled.resize(slots);
  in_crumb.resize(slots);
  piece_of.resize(slots);
  stars.ensure(slots, tet_slots);
  packed.ensure(slots);
  order.ensure(slots);
  if (nodal.is_on) nodal.ensure(slots, tet_slots);
}

/// A tet that was flat at load has no part in the body.
bool DeformableBody::State::add_tet(const TetMesh& mesh, TetId t) {
  if (!mesh.is_live(t)) return false;
  tets[t] = mesh.vertices(t);
  const std::array<Vec3, 4> p = corners_at_rest(t);
  if (!(detail::six_volumes(p) > 0)) {
    tets[t][0] = VertexId();
    return false;
  }
  regions[t] = mesh.region(t);
  note_bone(t);
  const detail::Element element = is_bone(t) ? detail::Element{} : soft_element(t, false);
  stars.add(t, tets[t], element);
  if (nodal.is_on) nodal.put(t, detail::six_volumes(p), element);
  note_changed(tets[t]);
  return true;
}

bool DeformableBody::State::remove_tet(TetId t) {
  if (t.value >= tets.size() || !tets[t][0].is_valid()) return false;
  stars.remove(t, tets[t]);
  note_bone(t);
  note_changed(tets[t]);
  tets[t][0] = VertexId();
  return true;
}

void DeformableBody::State::note_changed(const TetVertices& vertices) {
  for (const VertexId v : vertices) {
    if (has_changed_star[v.value] != 0) continue;
    has_changed_star[v.value] = 1;
    changed.push_back(v.value);
  }
}

/// What follows from a vertex' star.
void DeformableBody::State::settle_vertex(VertexId v) {
  detail::Motion& motion = motions[v];
  motion.diagonal = stars.diagonal(v);
  lattice.locate(v, rest[v]);
  double sum = 0;
  std::uint32_t count = 0;
  detail::SweepOrder::for_each_neighbour(stars, v, [&](VertexId n) {
    sum += (rest[n] - rest[v]).norm();
    ++count;
  });
  motion.reach = count > 0 ? static_cast<float>(0.25 * sum / count) : 0.0F;
  if (held[v] == Held::kRigidly || bones.is_fixed(v)) set_momentum(v, Vec3::Zero());
  if (count == 0 || held[v] == Held::kRigidly || bones.is_fixed(v)) {
    order.drop(v);
  } else {
    order.settle(v, stars);
    order.wake(v);
  }
}

/// Vertices that follow each other are seldom neighbours, so that one visit need not wait for the one before it.
static void interleave(std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> window;
  for (std::size_t begin = 0; begin < order.size(); begin += detail::kOrderWindow) {
    const std::size_t end = std::min(order.size(), begin + detail::kOrderWindow);
    window.assign(order.begin() + static_cast<std::ptrdiff_t>(begin), order.begin() + static_cast<std::ptrdiff_t>(end));
    std::size_t next = begin;
    for (std::size_t first = 0; first < detail::kOrderStride; ++first) {
      for (std::size_t i = first; i < window.size(); i += detail::kOrderStride) order[next++] = window[i];
    }
  }
}

/// Sorts vertices along the longest axis, in slabs of about one edge, which are walked through strip by strip: what a
/// visit reads was read a moment ago, whatever order the file has. Layers of a grid are slabs: between two boundaries.
static void sort_in_slabs(std::vector<std::uint32_t>& vertices, const IdArray<VertexId, Vec3>& rest) {
  if (vertices.empty()) return;
  Box box;
  for (const std::uint32_t v : vertices) box.extend(rest[VertexId(v)]);
  const Vec3 size = box.hi - box.lo;
  Eigen::Index axis = 0;
  size.maxCoeff(&axis);
  const Eigen::Index second = (axis + 1) % 3, third = (axis + 2) % 3;
  const double across = size[second] / size[axis], up = size[third] / size[axis];  // the box by its length: at most 1
  double slabs = 1;
  while (slabs * slabs * slabs * across * up < static_cast<double>(vertices.size()) && slabs < detail::kMostSlabs)
    ++slabs;
  const double thickness = size[axis] / slabs;
  const auto along = [&](std::uint32_t v, Eigen::Index k) {
    return thickness > 0 ? std::floor((rest[VertexId(v)][k] - box.lo[k]) / thickness + 0.5) : 0.0;
  };
  using Key = std::tuple<double, double, double, double, double, std::uint32_t>;
  std::vector<Key> keys;
  for (const std::uint32_t v : vertices) {
    const Vec3& p = rest[VertexId(v)];
    keys.emplace_back(along(v, axis), along(v, second), p[third], p[axis], p[second], v);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size(); ++i) vertices[i] = std::get<5>(keys[i]);
}

/// Stars are laid out as the sweeps go: they are read in a row.
void DeformableBody::State::lay_out_stars() {
  std::vector<std::uint32_t> count(rest.size()), sorted;
  for (const TetVertices& tet : tets) {
    if (tet[0].is_valid()) {
      for (const VertexId v : tet) ++count[v.value];
    }
  }
  for (std::uint32_t v = 0; v < count.size(); ++v) {
    if (count[v] > 0) sorted.push_back(v);
  }
  sort_in_slabs(sorted, rest);
  interleave(sorted);
  rows.arrange(sorted);
  for (const std::uint32_t v : sorted) stars.lay_out(VertexId(v), count[v]);
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    if (!tets[TetId(t)][0].is_valid()) continue;
    const detail::Element here = element(TetId(t));
    stars.add(TetId(t), tets[TetId(t)], here);
    if (nodal.is_on) nodal.put(TetId(t), detail::six_volumes(corners_at_rest(TetId(t))), here);
  }
  for (const std::uint32_t v : sorted) packed.update(VertexId(v), stars, rows);
  if (nodal.is_on) {
    for (const std::uint32_t v : sorted) nodal.update(VertexId(v), stars);
  }
  std::vector<bool> is_first(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) is_first[i] = i < sorted.size() / 2;
  order.begin(sorted, is_first, stars);
}

/// Whether some material is of a kind that block descent alone knows.
template <class Is>
bool DeformableBody::State::has_material(const Is& is) const {
  if (options.relaxation != Relaxation::kBlockDescent) return false;
  return is(materials.fallback) || std::any_of(materials.by_region.begin(), materials.by_region.end(),
                                               [&](const Materials::Entry& e) { return is(e.material); });
}

/// Volumes are averaged where that makes a difference.
bool DeformableBody::State::is_to_average() const {
  return options.average_volumes && has_material([](const Material& m) { return m.poisson > detail::kOwnPoisson; });
}

void DeformableBody::State::build(const TetMesh& mesh) {
  nodal.is_on = is_to_average();
  stars.has_fibres = has_material([](const Material& m) { return m.fibre_young > 0; });
  stars.stiffens = stars.has_fibres || has_material([](const Material& m) { return m.stiffening > 0; });
  is_viscous = has_material([](const Material& m) { return m.is_viscous(); });
  has_bones = has_material([](const Material& m) { return m.rigid; });
  ensure(mesh.vertex_slots(), mesh.tet_slots());
  mesh.for_each_vertex([&](VertexId v) {
    rest[v] = mesh.rest(v);
    places[v.value] = mesh.current(v);
  });
  std::vector<double> mass(mesh.vertex_slots());
  double volumes = 0;
  const double volume_unit = unit() * unit() * unit();
  mesh.for_each_tet([&](TetId t) {
    tets[t] = mesh.vertices(t);
    const double volume6 = detail::six_volumes(corners_at_rest(t));
    if (!(volume6 > 0)) {
      tets[t][0] = VertexId();
      return;
    }
    regions[t] = mesh.region(t);
    const double share = materials.of(regions[t]).density * volume_unit * volume6 / 24;
    for (const VertexId v : tets[t]) mass[v.value] += share;
    volumes += volume6;
  });
  if (options.crumb == 0 && volumes > 0)
    options.crumb = detail::kLeastLump * volumes / 6 / static_cast<double>(mesh.tet_count());
  lay_out_stars();
  mass_id = *attributes.add(mesh, {"mass", Domain::kVertex, 1, Transfer::kConserve, {}, {}});
  momentum_id = *attributes.add(mesh, {"momentum", Domain::kVertex, 3, Transfer::kConserve, {}, {}});
  if (is_viscous) add_metrics(mesh);
  std::copy(mass.begin(), mass.end(), masses());
  for (std::uint32_t v = 0; v < rest.size(); ++v) settle_vertex(VertexId(v));
  if (options.self.on) contact.read_all(*this, mesh);
  largest_crumb = detail::kCrumbPiece * volumes / 6 / static_cast<double>(std::max<std::size_t>(mesh.tet_count(), 1));
  centre();
  label_pieces();
  bones_changed = has_bones;
}

// --- holds

void DeformableBody::State::set_hold(VertexId v, const Hold& hold) {
  holds[v.value] = hold;
  held[v] = hold.is_rigid() ? Held::kRigidly : Held::kBySpring;
}

void DeformableBody::State::clear_hold(VertexId v) {
  if (held[v] != Held::kNot) holds.erase(v.value);
  held[v] = Held::kNot;
}

Vec3 DeformableBody::State::held_place(const Vec3& at_rest, const Vec3& shift, const TetVertices& basis,
                                       const std::array<double, 4>& weights) const {
  Vec3 place = at_rest;
  for (unsigned i = 0; i < 4; ++i) {
    if (!basis[i].is_valid() || weights[i] == 0) continue;
    const bool is_held = basis[i].value < held.size() && held[basis[i]] != Held::kNot;
    const auto hold = is_held ? holds.find(basis[i].value) : holds.end();
    place += weights[i] * (is_held ? Vec3(hold->second.target - hold->second.rest) : shift);
  }
  return place;
}

// --- through the journal

void DeformableBody::State::note_tet(TetId t) {
  if (is_touched_tet[t.value] != 0) return;
  is_touched_tet[t.value] = 1;
  touched.tets.push_back(t.value);
}

void DeformableBody::State::note_fresh(VertexId v, Fresh how) {
  if (is_fresh[v.value] == 0) touched.fresh.push_back(v.value);
  is_fresh[v.value] = std::max(is_fresh[v.value], static_cast<std::uint8_t>(how));
}

namespace {

/// Takes steps in: notes what they put in place, and hands holds and pieces on.
///
/// A birth between vertices that are all held rigidly is held as they are; a copy is held as its source. A slot that
/// was somebody else's is not held as that one was.
class StepFollower final : private JournalVisitor {
 public:
  explicit StepFollower(DeformableBody::State& state) : s_(state) {}

  void follow(const Step& step) {
    step.for_each_tet_before([&](TetId tet) { s_.note_tet(tet); });
    for (const TetId tet : step.new_tets) s_.note_tet(tet);
    visit(step, *this, StepReading::kNet);
    // The tets around a moved vertex have other rest shapes, even where the step does not name them.
    for (const VertexId v : moved_) {
      s_.note_fresh(v, Fresh::kMoved);
      s_.stars.for_each_tet(v, [&](TetId t) { s_.note_tet(t); });
    }
    moved_.clear();
  }

 private:
  using Fresh = DeformableBody::State::Fresh;

  void born(const BornVertex& born) override {
    s_.note_fresh(born.id, Fresh::kNew);
    s_.clear_hold(born.id);
    bool is_held = true;
    for (unsigned i = 0; i < 4; ++i) {
      if (!born.parents[i].is_valid() || std::abs(born.weights[i]) < detail::kNoWeight) continue;
      is_held = is_held && s_.held[born.parents[i]] == Held::kRigidly;
      s_.piece_of[born.id] = s_.piece_of[born.parents[i]];
    }
    if (is_held) s_.set_hold(born.id, {std::numeric_limits<double>::infinity(), born.current, born.rest});
  }
  void moved(const MovedVertex& moved) override {
    moved_.push_back(moved.id);
    if (s_.held[moved.id] == Held::kNot) return;
    Hold& hold = s_.holds[moved.id.value];
    hold.target = s_.held_place(moved.rest, hold.target - hold.rest, moved.basis, moved.weights);
    hold.rest = moved.rest;
  }
  void copied(const CopiedVertex& copied) override {
    s_.note_fresh(copied.id, Fresh::kNew);
    s_.clear_hold(copied.id);
    if (s_.held[copied.source] != Held::kNot) s_.set_hold(copied.id, Hold(s_.holds[copied.source.value]));
    s_.piece_of[copied.id] = s_.piece_of[copied.source];
  }

  DeformableBody::State& s_;
  std::vector<VertexId> moved_;  // of the step: noted behind what is new
};

}  // namespace

/// Whether a tet that may have changed has.
bool DeformableBody::State::differs(const TetMesh& mesh, TetId t) const {
  const bool was_live = t.value < tets.size() && tets[t][0].is_valid(), is_live = mesh.is_live(t);
  if (!was_live || !is_live) return was_live || is_live;
  if (tets[t] != mesh.vertices(t) || regions[t] != mesh.region(t)) return true;
  const auto is_new = [&](VertexId v) { return is_fresh[v.value] != 0; };
  return std::any_of(tets[t].begin(), tets[t].end(), is_new);
}

Result<FollowReport> DeformableBody::follow(const Journal& journal, const TetMesh& mesh) {
  State& s = *state_;
  FollowReport report;
  const JournalCursor::Way way = s.cursor.way_to(journal);
  if (way == JournalCursor::Way::kNone) return report;
  const bool has_rewound = way == JournalCursor::Way::kElsewhere;
  detail::Rewind rewind;
  if (has_rewound) rewind.begin(s);
  if (Status status = s.attributes.follow(journal, mesh); !status) return status.error();
  const auto vertex_slots = std::max(mesh.vertex_slots(), static_cast<std::uint32_t>(s.rest.size()));
  const auto tet_slots = std::max(mesh.tet_slots(), static_cast<std::uint32_t>(s.tets.size()));
  s.ensure(vertex_slots, tet_slots);
  s.is_touched_tet.ensure(tet_slots);
  s.is_fresh.ensure(vertex_slots);
  s.has_changed_star.ensure(vertex_slots);
  if (has_rewound) {
    rewind.compare(s, mesh);
  } else {
    StepFollower follower(s);
    for (std::size_t i = s.cursor.position(); i < journal.position(); ++i) follower.follow(journal.step(i));
  }
  s.drop_lost_pulls(mesh);
  s.drop_lost_ties(mesh);
  s.cursor.move_to(journal);
  s.remove_touched(mesh, report);
  s.put_fresh(mesh);
  s.add_touched(mesh, report);
  if (has_rewound) rewind.put_back(s);
  if (has_rewound && s.is_viscous) s.forget_stresses();
  s.settle_changed();
  s.ensure(mesh.vertex_slots(), mesh.tet_slots());
  if (s.options.self.on) s.follow_contact(mesh, has_rewound);
  s.finish_follow(has_rewound, report);
  return report;
}

/// Leaves in `touched.tets` those that did change.
void DeformableBody::State::remove_touched(const TetMesh& mesh, FollowReport& report) {
  for (const std::uint32_t t : touched.tets) is_touched_tet[t] = 0;
  if (options.self.on) named_tets = touched.tets;
  std::erase_if(touched.tets, [&](std::uint32_t t) { return !differs(mesh, TetId(t)); });
  note_energy();
  for (const std::uint32_t t : touched.tets) report.removed_tets += remove_tet(TetId(t)) ? 1U : 0U;
}

void DeformableBody::State::put_fresh(const TetMesh& mesh) {
  for (const std::uint32_t slot : touched.fresh) {
    const VertexId v(slot);
    is_fresh[slot] = 0;
    if (!mesh.is_live(v)) continue;
    rest[v] = mesh.rest(v);
    places[slot] = held[v] == Held::kRigidly ? holds[slot].target : mesh.current(v);
    round_place(v);
  }
}

void DeformableBody::State::add_touched(const TetMesh& mesh, FollowReport& report) {
  for (const std::uint32_t t : touched.tets) report.added_tets += add_tet(mesh, TetId(t)) ? 1U : 0U;
  for (const std::uint32_t v : changed) stars.close(VertexId(v));
}

void DeformableBody::State::settle_changed() {
  for (const std::uint32_t v : changed) packed.update(VertexId(v), stars, rows);
  if (nodal.is_on) {
    for (const std::uint32_t v : changed) nodal.update(VertexId(v), stars);
  }
  for (const std::uint32_t v : changed) {
    has_changed_star[v] = 0;
    dissolve_crumb_at(VertexId(v));
    settle_vertex(VertexId(v));
  }
  changed.clear();
}

/// What was put in place goes towards its balance.
void DeformableBody::State::finish_follow(bool has_rewound, FollowReport& report) {
  release_lost_holds();
  std::erase_if(touched.fresh, [&](std::uint32_t v) { return v >= places.size() || !order.moves(VertexId(v)); });
  report.fresh_vertices = touched.fresh.size();
  stale_pieces = std::max(stale_pieces, 1U);
  if (bones_changed) bones.find(*this);
  relax(touched.fresh, 4);
  if (!has_rewound) report.fresh_vertices += balance();
  touched.tets.clear();
  touched.fresh.clear();
}

void DeformableBody::State::follow_contact(const TetMesh& mesh, bool has_rewound) {
  if (has_rewound) {
    contact.read_all(*this, mesh);
  } else {
    contact.read(*this, mesh, named_tets);
  }
  contact.forget(*this, touched.fresh);
}

void DeformableBody::State::release_lost_holds() {
  std::erase_if(holds, [&](const auto& hold) {
    const VertexId v(hold.first);
    if (is_live(v)) return false;
    lost_holds[hold.first] = hold.second;
    if (v.value < held.size()) held[v] = Held::kNot;
    return true;
  });
}

/// What pulled at a vertex that died does not pull at the one that has its slot now.
void DeformableBody::State::drop_lost_pulls(const TetMesh& mesh) {
  for (Pull& pull : pulls) {
    for (unsigned i = 0; i < 4; ++i) {
      if (pull.weights[i] == 0) continue;
      const VertexId v = pull.vertices[i];
      if (!mesh.is_live(v) || is_fresh[v.value] == static_cast<std::uint8_t>(Fresh::kNew)) pull.stiffness = 0;
    }
  }
}

}  // namespace v0
}  // namespace incise
