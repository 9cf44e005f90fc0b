// SPDX-License-Identifier: Apache-2.0
#include "support/star_separation.h"

#include <algorithm>
#include <array>
#include <map>

#include "incise/mesh/star.h"
#include "incise/mesh/verbs.h"
#include "paper/cut_edge.h"

namespace incise::test {

namespace {

constexpr unsigned kMaxPinchRounds = 8;

class Separator {
 public:
  Separator(Transaction& transaction, std::vector<IncisionFace> incision, std::uint32_t tag)
      : transaction_(transaction), mesh_(transaction.mesh()), incision_(std::move(incision)), tag_(tag) {}

  Separation run() {
    for (unsigned round = 0; round <= kMaxPinchRounds; ++round) {
      find_copies();
      if (round == kMaxPinchRounds || !bisect_pinched_edges()) {
        break;
      }
    }
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

  void find_copies() {
    is_incision_.assign(mesh_.tet_slots(), {});
    copy_of_.assign(mesh_.tet_slots(), {});
    touched_.clear();
    parts_.clear();
    copies_ = 0;
    for (const IncisionFace& face : incision_) {
      mark(face.a);
      mark(face.b);
    }
    collect_seeds();
    for (const auto& [vertex, tets] : seeds_) divide_star(vertex, tets);
  }
  void mark(Side side) { is_incision_[side.tet().value][side.side()] = true; }
  void unmark(Side side) { is_incision_[side.tet().value][side.side()] = false; }
  [[nodiscard]] bool is_incision(Side side) const { return is_incision_[side.tet().value][side.side()]; }
  /// Every vertex of the incision with every tet beside it.
  void collect_seeds() {
    seeds_.clear();
    for (const IncisionFace& face : incision_) {
      for (const VertexId v : mesh_.vertices(face.a)) {
        seeds_[v].push_back(face.a.tet());
        seeds_[v].push_back(face.b.tet());
      }
    }
  }
  /// One part per face-connected group of the star; the first keeps the vertex.
  void divide_star(VertexId v, const std::vector<TetId>& seeds) {
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
          if (copy_of_[next.value][corner] == 0) {
            assign(next, corner, v, copy);
            part_.push_back(next);
          }
        }
      }
    }
    return static_cast<std::uint8_t>(bits);
  }
  // A corner is stored as copy + 1, so that 0 means "not reached yet".
  void assign(TetId tet, unsigned corner, VertexId v, std::uint32_t copy) {
    copy_of_[tet.value][corner] = copy + 1;
    if (copy != 0) touched_.push_back({v, tet});
  }
  [[nodiscard]] std::uint32_t copy_of(TetId tet, VertexId v) const {
    return copy_of_[tet.value][mesh_.corner_of(tet, v)];
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
  /// Edges that need a look: kept by a face and not just the front inside the body, or in more than two incision faces,
  /// or in two and on a surface.
  void find_suspects(std::vector<std::array<VertexId, 2>>& suspects) {
    edges_.clear();
    for (const IncisionFace& face : incision_) {
      if (is_latent(face)) {
        unmark(face.a);
        unmark(face.b);
        continue;
      }
      const auto v = mesh_.vertices(face.a);
      for (unsigned k = 0; k < 3; ++k) {
        const VertexId a = std::min(v[k], v[(k + 1) % 3]), b = std::max(v[k], v[(k + 1) % 3]);
        CutEdge& edge = edges_[edges_.find_or_add(a, b)];
        ++edge.crossings.count;
        edge.is_blocked |= keeps_edge(face, a, b);
      }
    }
    for (const CutEdge& edge : edges_.edges()) {
      const bool is_on_surface = (mesh_.shape_of(edge.a) & mesh_.shape_of(edge.b)) != 0;
      const bool may_be_pinched = edge.is_blocked && (edge.crossings.count > 1 || is_on_surface);
      if (may_be_pinched || edge.crossings.count > 2 || (edge.crossings.count == 2 && is_on_surface)) {
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
      transaction_.set_corner(corner.tet, c, copy_ids[copy_of_[corner.tet.value][c] - 1]);
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
  std::uint32_t tag_;
  std::vector<std::array<bool, 4>> is_incision_;       // by tet slot and side
  std::vector<std::array<std::uint32_t, 4>> copy_of_;  // by tet slot: 1 + the copy that each corner gets; 0 not reached
  std::map<VertexId, std::vector<TetId>> seeds_;
  EdgeTable edges_;
  std::vector<Corner> touched_;
  std::vector<TetId> part_;
  std::vector<Part> parts_;
  std::uint32_t copies_ = 0;
  Separation result_;
};

}  // namespace

Separation separate_stars(TetMesh& mesh, std::vector<IncisionFace> incision, std::uint32_t tag) {
  Transaction transaction(mesh);
  const Separation result = Separator(transaction, std::move(incision), tag).run();
  transaction.commit();
  return result;
}

}  // namespace incise::test
