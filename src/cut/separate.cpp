// SPDX-License-Identifier: Apache-2.0
#include "cut/separate.h"

#include <algorithm>
#include <span>

#include "incise/mesh/verbs.h"

namespace incise::inline v0 {

namespace {

constexpr unsigned kMaxPinchRounds = 8;

class Separator {
 public:
  Separator(Transaction& transaction, std::vector<IncisionFace> incision, const std::vector<TetId>& new_tets,
            std::uint32_t tag, SeparationScratch& scratch)
      : transaction_(transaction),
        mesh_(transaction.mesh()),
        incision_(std::move(incision)),
        new_tets_(new_tets),
        tag_(tag),
        scratch_(scratch) {}
  Separator(const Separator&) = delete;
  Separator& operator=(const Separator&) = delete;
  ~Separator() { clear_marks(); }

  Separation run(const std::function<void()>& before_copies) {
    for (unsigned round = 0; round <= kMaxPinchRounds; ++round) {
      find_copies();
      if (round == kMaxPinchRounds || !bisect_pinched_edges()) {
        break;
      }
    }
    before_copies();
    apply_copies();
    open_faces();
    return result_;
  }

 private:
  struct Part {
    VertexId vertex;
    TetId tet;           ///< one of its tets
    std::uint32_t copy;  ///< 0 keeps the vertex
    std::uint8_t bits;   ///< of `shape`
  };
  struct Corner {
    VertexId vertex;
    TetId tet;
  };
  struct SeededVertex {
    VertexId vertex;
    std::uint32_t seeds;
  };

  void find_copies() {
    clear_marks();
    scratch_.incision.ensure(mesh_.tet_slots());
    scratch_.copies.ensure(mesh_.tet_slots());
    touched_.clear();
    parts_.clear();
    copies_ = 0;
    for (const IncisionFace& face : incision_) {
      mark(face.a);
      mark(face.b);
    }
    collect_seeds();
    divide_stars();
  }
  void mark(Side side) {
    std::uint8_t& bits = scratch_.incision[side.tet().value];
    if (bits == 0) {
      scratch_.marked.push_back(side.tet());
    }
    bits = static_cast<std::uint8_t>(bits | 1U << side.side());
  }
  [[nodiscard]] bool is_incision(Side side) const {
    return ((unsigned{scratch_.incision[side.tet().value]} >> side.side()) & 1U) != 0;
  }
  void clear_marks() {
    for (const TetId tet : scratch_.marked) scratch_.incision[tet.value] = 0;
    for (const TetId tet : scratch_.reached) scratch_.copies[tet.value] = {};
    scratch_.marked.clear();
    scratch_.reached.clear();
  }
  /// Every vertex of the incision with every tet beside it; also split points at which tets meet without a face.
  void collect_seeds() {
    seeds_.clear();
    vertices_.clear();
    scratch_.index_of_vertex.ensure(mesh_.vertex_slots());
    for (const IncisionFace& face : incision_) {
      for (const VertexId v : mesh_.vertices(face.a)) {
        add_seed(v, face.a.tet());
        add_seed(v, face.b.tet());
      }
    }
    add_singleton_seeds();
  }
  void add_seed(VertexId v, TetId tet) {
    std::uint32_t& index = scratch_.index_of_vertex[v.value];
    if (index == 0) {
      vertices_.push_back({v, 0});
      index = static_cast<std::uint32_t>(vertices_.size());
    }
    ++vertices_[index - 1].seeds;
    seeds_.push_back({v, tet});
  }
  /// Paper, Algorithm 2: a new vertex whose tets are more than can be reached from one of them is a singleton vertex.
  /// Arises only where the input's tets touch along an edge without sharing a face.
  void add_singleton_seeds() {
    if (!mesh_.touched_itself_at_load()) {
      return;
    }
    for (const TetId tet : new_tets_) {
      if (!mesh_.is_live(tet)) {
        continue;
      }
      for (const VertexId v : mesh_.vertices(tet)) {
        if (is_new(v)) {
          add_seed(v, tet);
        }
      }
    }
  }
  /// Sorts the seeds by vertex, in the order in which the vertices were met, and divides one star after the other.
  void divide_stars() {
    std::vector<std::uint32_t> next(vertices_.size() + 1, 0);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      next[i + 1] = next[i] + vertices_[i].seeds;
    }
    std::vector<TetId> tets(seeds_.size());
    for (const Corner& seed : seeds_) {
      tets[next[scratch_.index_of_vertex[seed.vertex.value] - 1]++] = seed.tet;
    }
    for (std::size_t i = 0, begin = 0; i < vertices_.size(); begin = next[i++]) {
      scratch_.index_of_vertex[vertices_[i].vertex.value] = 0;
      divide_star(vertices_[i].vertex, {tets.data() + begin, tets.data() + next[i]});
    }
  }
  [[nodiscard]] bool is_new(VertexId v) const { return !mesh_.origin(v).is_valid(); }

  /// One part per face-connected group of the star; the first keeps the vertex.
  void divide_star(VertexId v, std::span<const TetId> seeds) {
    const std::size_t first_part = parts_.size();
    for (const TetId seed : seeds) {
      if (copy_of(seed, v) == 0) {
        const std::uint32_t copy = parts_.size() == first_part ? 0 : ++copies_;
        parts_.push_back({v, seed, copy, flood(v, seed, copy)});
      }
    }
    if (parts_.size() == first_part + 1) {  // still whole: what ended here before ends here now
      parts_.back().bits = static_cast<std::uint8_t>(parts_.back().bits | (mesh_.shape_of(v) & shape::kFront));
    }
  }
  /// Assigns a copy of `v` to the tets that can be reached from `seed` without crossing the incision. Returns what the
  /// part is bounded by so far, as `shape` bits.
  std::uint8_t flood(VertexId v, TetId seed, std::uint32_t copy) {
    unsigned bits = mesh_.shape_of(v) & shape::kPinched;
    part_.assign(1, seed);
    assign(seed, mesh_.corner_of(seed, v), v, copy);
    for (std::size_t i = 0; i < part_.size(); ++i) {
      const TetId tet = part_[i];
      const TetVertices& corners = mesh_.vertices(tet);
      const TetLinks& links = mesh_.links(tet);
      for (unsigned s = 0; s < 4; ++s) {
        if (corners[s] == v) {
          continue;
        }
        if (links[s].is_boundary()) {
          bits |= links[s].tag() == 0 ? shape::kSkin : shape::kWall;
        } else if (!is_incision(Side(tet, s))) {
          const TetId next = links[s].side().tet();
          const unsigned corner = mesh_.corner_of(next, v);
          if (scratch_.copies[next.value][corner] == 0) {
            assign(next, corner, v, copy);
            part_.push_back(next);
            __builtin_prefetch(&mesh_.links(next));
          }
        }
      }
    }
    return static_cast<std::uint8_t>(bits);
  }
  // A corner is stored as copy + 1, so that 0 means "not reached yet".
  void assign(TetId tet, unsigned corner, VertexId v, std::uint32_t copy) {
    SeparationScratch::CornerCopies& copies = scratch_.copies[tet.value];
    if ((copies[0] | copies[1] | copies[2] | copies[3]) == 0) {
      scratch_.reached.push_back(tet);
    }
    copies[corner] = copy + 1;
    if (copy != 0) {
      touched_.push_back({v, tet});
    }
  }
  [[nodiscard]] std::uint32_t copy_of(TetId tet, VertexId v) const {
    return scratch_.copies[tet.value][mesh_.corner_of(tet, v)];
  }

  // --- pinched edges -------------------------------------------------------------------------------------------------

  /// Whether a face leaves both ends of one of its edges whole: then the edge is at the front, or pinched.
  [[nodiscard]] bool keeps_edge(const IncisionFace& face, VertexId a, VertexId b) const {
    return copy_of(face.a.tet(), a) == copy_of(face.b.tet(), a) && copy_of(face.a.tet(), b) == copy_of(face.b.tet(), b);
  }
  struct Fan {
    TetId lowest;
    std::uint32_t copy_a, copy_b;
  };
  [[nodiscard]] Fan fan_at(VertexId a, VertexId b, TetId seed) const {
    Fan fan{seed, copy_of(seed, a), copy_of(seed, b)};
    walk_edge_ring(
        mesh_, a, b, seed, [&](Side side) { return is_incision(side); },
        [&](TetId tet) { fan.lowest = std::min(fan.lowest, tet); });
    return fan;
  }
  /// Whether a face stays joined: none of its vertices comes apart.
  [[nodiscard]] bool is_latent(const IncisionFace& face) const {
    const auto v = mesh_.vertices(face.a);
    return std::all_of(v.begin(), v.end(),
                       [&](VertexId x) { return copy_of(face.a.tet(), x) == copy_of(face.b.tet(), x); });
  }
  void unmark(Side side) {
    std::uint8_t& bits = scratch_.incision[side.tet().value];
    bits = static_cast<std::uint8_t>(bits & ~(1U << side.side()));
  }
  /// Edges that need a look: kept by a face and not just the front inside the body, or in more than two incision faces,
  /// or in two and on a surface.
  void find_suspects(std::vector<std::array<VertexId, 2>>& suspects) {
    scratch_.edges.clear();
    for (const IncisionFace& face : incision_) {
      if (is_latent(face)) {
        unmark(face.a);
        unmark(face.b);
        continue;
      }
      const auto v = mesh_.vertices(face.a);
      for (unsigned k = 0; k < 3; ++k) {
        const VertexId a = std::min(v[k], v[(k + 1) % 3]), b = std::max(v[k], v[(k + 1) % 3]);
        CutEdge& edge = scratch_.edges[scratch_.edges.find_or_add(a, b)];
        ++edge.crossings;
        edge.is_blocked |= keeps_edge(face, a, b);
      }
    }
    for (const CutEdge& edge : scratch_.edges.edges()) {
      const bool is_on_surface = (mesh_.shape_of(edge.a) & mesh_.shape_of(edge.b)) != 0;
      const bool may_be_pinched = edge.is_blocked && (edge.crossings > 1 || is_on_surface);
      if (may_be_pinched || edge.crossings > 2 || (edge.crossings == 2 && is_on_surface)) {
        suspects.push_back({edge.a, edge.b});
      }
    }
    std::sort(suspects.begin(), suspects.end());
  }
  [[nodiscard]] bool is_pinched(const std::vector<Fan>& fans) const {
    for (std::size_t i = 0; i < fans.size(); ++i) {
      for (std::size_t j = i + 1; j < fans.size(); ++j) {
        if (fans[i].lowest != fans[j].lowest && fans[i].copy_a == fans[j].copy_a && fans[i].copy_b == fans[j].copy_b) {
          return true;
        }
      }
    }
    return false;
  }
  bool bisect_pinched_edges() {
    std::vector<std::array<VertexId, 2>> suspects;
    find_suspects(suspects);
    if (suspects.empty()) {
      return false;
    }
    std::vector<std::array<VertexId, 2>> pinched;
    collect_pinched(suspects, pinched);
    bool has_changed = false;
    for (const auto& [a, b] : pinched) {
      has_changed |= bisect(a, b);
    }
    return has_changed;
  }
  void collect_pinched(const std::vector<std::array<VertexId, 2>>& suspects,
                       std::vector<std::array<VertexId, 2>>& pinched) {
    std::vector<std::vector<Fan>> fans(suspects.size());
    for (const IncisionFace& face : incision_) {
      if (!is_incision(face.a)) {
        continue;
      }
      const auto v = mesh_.vertices(face.a);
      for (unsigned k = 0; k < 3; ++k) {
        const std::array<VertexId, 2> key = {std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])};
        const auto at = std::lower_bound(suspects.begin(), suspects.end(), key);
        if (at != suspects.end() && *at == key) {
          auto& list = fans[static_cast<std::size_t>(at - suspects.begin())];
          list.push_back(fan_at(key[0], key[1], face.a.tet()));
          list.push_back(fan_at(key[0], key[1], face.b.tet()));
        }
      }
    }
    for (std::size_t i = 0; i < suspects.size(); ++i) {
      if (is_pinched(fans[i])) {
        pinched.push_back(suspects[i]);
      }
    }
  }
  bool bisect(VertexId a, VertexId b) {
    const auto contains = [&](const IncisionFace& face) {
      return mesh_.corner_of(face.a.tet(), a) < 4 && mesh_.corner_of(face.a.tet(), b) < 4 &&
             mesh_.vertices(face.a.tet())[face.a.side()] != a && mesh_.vertices(face.a.tet())[face.a.side()] != b;
    };
    const auto face = std::find_if(incision_.begin(), incision_.end(), contains);
    if (face == incision_.end()) {
      return false;
    }
    const SplitEdgePlan plan = plan_split_edge(mesh_, a, b, face->a.tet(), 0.5);
    if (!plan) {  // a flat tet at the edge cannot be divided: the incision leaves the edge out
      std::erase_if(incision_, contains);
      return true;
    }
    std::vector<IncisionFace> halved;
    std::vector<IncisionFace> kept;
    // Where the input touched itself, faces of another fan of tets may share the edge: they keep it whole.
    const auto is_in_ring = [&](const IncisionFace& f) {
      return std::find(plan.ring.begin(), plan.ring.end(), f.a.tet()) != plan.ring.end();
    };
    for (const IncisionFace& f : incision_) {
      (contains(f) && is_in_ring(f) ? halved : kept).push_back(f);
    }
    // Faces that keep their extent may still belong to a tet of the ring: they follow it to the half that holds them.
    const SplitEdgeResult split = apply(transaction_, plan);
    for (IncisionFace& f : kept) {
      f = {side_after(f.a, a, split), side_after(f.b, a, split)};
    }
    for (const IncisionFace& f : halved) {
      const SplitHalves& ta = halves_of(f.a.tet(), split);
      const SplitHalves& tb = halves_of(f.b.tet(), split);
      kept.push_back({Side(ta.keeps_a, f.a.side()), Side(tb.keeps_a, f.b.side())});
      kept.push_back({Side(ta.keeps_b, f.a.side()), Side(tb.keeps_b, f.b.side())});
    }
    incision_ = std::move(kept);
    ++result_.pinched_edges;
    return true;
  }
  static const SplitHalves& halves_of(TetId tet, const SplitEdgeResult& split) {
    return *std::find_if(split.halves.begin(), split.halves.end(), [&](const SplitHalves& h) { return h.tet == tet; });
  }
  /// A side opposite a or b moves to the half that keeps the other end.
  [[nodiscard]] Side side_after(Side side, VertexId a, const SplitEdgeResult& split) const {
    const auto halves = std::find_if(split.halves.begin(), split.halves.end(),
                                     [&](const SplitHalves& h) { return h.tet == side.tet(); });
    if (halves == split.halves.end()) {
      return side;
    }
    const bool holds_a = mesh_.vertices(halves->keeps_a)[side.side()] != a;
    return {holds_a ? halves->keeps_a : halves->keeps_b, side.side()};
  }

  // --- carrying out --------------------------------------------------------------------------------------------------

  void apply_copies() {
    std::vector<VertexId> copy_ids(copies_ + std::size_t{1});
    for (const Part& part : parts_) {
      const VertexId id = part.copy == 0 ? part.vertex : transaction_.copy_vertex(part.vertex);
      copy_ids[part.copy] = part.copy == 0 ? VertexId() : id;
      transaction_.set_tet_of(id, part.tet);
      transaction_.set_shape(id, part.bits);
    }
    for (const Corner& corner : touched_) {
      const unsigned c = mesh_.corner_of(corner.tet, corner.vertex);
      transaction_.set_corner(corner.tet, c, copy_ids[scratch_.copies[corner.tet.value][c] - 1]);
    }
    result_.copied_vertices = copies_;
  }
  void open_faces() {
    for (const IncisionFace& face : incision_) {
      if (is_same_face(face)) {
        ++result_.latent_faces;
      } else {
        transaction_.open(face.a, face.b, tag_);
        mark_wall(transaction_, face);
        ++result_.opened_faces;
      }
    }
  }
  [[nodiscard]] bool is_same_face(const IncisionFace& face) const {
    const auto u = mesh_.vertices(face.a), v = mesh_.vertices(face.b);
    return std::all_of(u.begin(), u.end(), [&](VertexId x) { return x == v[0] || x == v[1] || x == v[2]; });
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  std::vector<IncisionFace> incision_;
  const std::vector<TetId>& new_tets_;
  std::uint32_t tag_;
  SeparationScratch& scratch_;
  std::vector<Corner> touched_, seeds_;
  std::vector<SeededVertex> vertices_;
  std::vector<TetId> part_;
  std::vector<Part> parts_;
  std::uint32_t copies_ = 0;
  Separation result_;
};

}  // namespace

void mark_wall(Transaction& transaction, const IncisionFace& face) {
  const TetMesh& mesh = transaction.mesh();
  const auto a = mesh.vertices(face.a), b = mesh.vertices(face.b);
  const auto mark = [&](VertexId v, bool is_shared) {
    const unsigned bits = mesh.shape_of(v) | shape::kWall | (is_shared ? shape::kFront : 0U);
    if (bits != mesh.shape_of(v)) {
      transaction.set_shape(v, static_cast<std::uint8_t>(bits));
    }
  };
  for (const VertexId v : a) mark(v, std::find(b.begin(), b.end(), v) != b.end());
  for (const VertexId v : b) mark(v, std::find(a.begin(), a.end(), v) != a.end());
}

Separation separate(Transaction& transaction, std::vector<IncisionFace> incision, const std::vector<TetId>& new_tets,
                    std::uint32_t tag, SeparationScratch& scratch, const std::function<void()>& before_copies) {
  return Separator(transaction, std::move(incision), new_tets, tag, scratch).run(before_copies);
}

}  // namespace incise::inline v0
