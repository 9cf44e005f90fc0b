// SPDX-License-Identifier: Apache-2.0
#include "cut/separate.h"

#include <algorithm>

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
    bool operator<(const Corner& other) const {
      return vertex != other.vertex ? vertex < other.vertex : tet < other.tet;
    }
    bool operator==(const Corner& other) const { return vertex == other.vertex && tet == other.tet; }
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
    const std::vector<Corner> seeds = find_seeds();
    for (std::size_t i = 0; i < seeds.size();) {
      std::size_t end = i + 1;
      while (end < seeds.size() && seeds[end].vertex == seeds[i].vertex) {
        ++end;
      }
      divide_star(seeds, i, end);
      i = end;
    }
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
  std::vector<Corner> find_seeds() {
    std::vector<Corner> seeds;
    seeds.reserve(incision_.size() * 6);
    for (const IncisionFace& face : incision_) {
      for (const VertexId v : mesh_.vertices(face.a)) {
        seeds.push_back({v, face.a.tet()});
        seeds.push_back({v, face.b.tet()});
      }
    }
    add_singleton_seeds(seeds);
    std::sort(seeds.begin(), seeds.end());
    seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
    return seeds;
  }
  /// Paper, Algorithm 2: a new vertex whose tets are more than can be reached from one of them is a singleton vertex.
  /// Arises only where the input's tets touch along an edge without sharing a face.
  void add_singleton_seeds(std::vector<Corner>& seeds) {
    if (!mesh_.touched_itself_at_load()) {
      return;
    }
    for (const TetId tet : new_tets_) {
      if (!mesh_.is_live(tet)) {
        continue;
      }
      for (const VertexId v : mesh_.vertices(tet)) {
        if (is_new(v)) {
          seeds.push_back({v, tet});
        }
      }
    }
  }
  [[nodiscard]] bool is_new(VertexId v) const { return !mesh_.origin(v).is_valid(); }

  /// One part per face-connected group of the star; the first keeps the vertex.
  void divide_star(const std::vector<Corner>& seeds, std::size_t begin, std::size_t end) {
    const VertexId v = seeds[begin].vertex;
    const std::size_t first_part = parts_.size();
    for (std::size_t i = begin; i < end; ++i) {
      if (i > begin && is_in_some_part(v, seeds[i].tet)) {
        continue;
      }
      const auto& flood =
          scratch_.walker.flood(mesh_, v, seeds[i].tet, [&](Side side) { return is_incision(side); });
      const std::uint32_t copy = parts_.size() == first_part ? 0 : ++copies_;
      parts_.push_back({v, seeds[i].tet, copy, bits_of(v, flood)});
      for (const TetId tet : flood) {
        assign(tet, v, copy);
      }
    }
    const bool is_whole = parts_.size() == first_part + 1;
    if (is_whole) {
      parts_.back().bits = static_cast<std::uint8_t>(parts_.back().bits | shape::kFront);
    }
  }
  // A corner is stored as copy + 1, so that 0 means "not reached yet".
  void assign(TetId tet, VertexId v, std::uint32_t copy) {
    std::array<std::uint32_t, 4>& copies = scratch_.copies[tet.value];
    if ((copies[0] | copies[1] | copies[2] | copies[3]) == 0) {
      scratch_.reached.push_back(tet);
    }
    copies[mesh_.corner_of(tet, v)] = copy + 1;
    if (copy != 0) {
      touched_.push_back({v, tet});
    }
  }
  [[nodiscard]] bool is_in_some_part(VertexId v, TetId tet) const {
    return scratch_.copies[tet.value][mesh_.corner_of(tet, v)] != 0;
  }
  [[nodiscard]] std::uint32_t copy_of(TetId tet, VertexId v) const {
    return scratch_.copies[tet.value][mesh_.corner_of(tet, v)];
  }
  [[nodiscard]] std::uint8_t bits_of(VertexId v, const std::vector<TetId>& part) const {
    unsigned bits = mesh_.shape_of(v) & shape::kPinched;
    for (const TetId tet : part) {
      for (unsigned s = 0; s < 4; ++s) {
        if (mesh_.vertices(tet)[s] == v) {
          continue;
        }
        const Link link = mesh_.links(tet)[s];
        if (is_incision(Side(tet, s)) || (link.is_boundary() && link.tag() != 0)) {
          bits |= shape::kWall;
        } else if (link.is_boundary()) {
          bits |= shape::kSkin;
        }
      }
    }
    return static_cast<std::uint8_t>(bits);
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
    walk_edge_ring(mesh_, a, b, seed, [&](Side side) { return is_incision(side); },
                   [&](TetId tet) { fan.lowest = std::min(fan.lowest, tet); });
    return fan;
  }
  /// Edges that need a look: kept by a face, or in more than two incision faces, or in two and on a surface.
  void find_suspects(std::vector<std::array<VertexId, 2>>& suspects) {
    scratch_.edges.clear();
    for (const IncisionFace& face : incision_) {
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
      if ((edge.is_blocked && edge.crossings > 1) || edge.crossings > 2 || (edge.crossings == 2 && is_on_surface)) {
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
    if (!plan) {
      return false;
    }
    std::vector<IncisionFace> halved;
    std::vector<IncisionFace> kept;
    for (const IncisionFace& f : incision_) {
      (contains(f) ? halved : kept).push_back(f);
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
  std::vector<Corner> touched_;
  std::vector<Part> parts_;
  std::uint32_t copies_ = 0;
  Separation result_;
};

}  // namespace

Separation separate(Transaction& transaction, std::vector<IncisionFace> incision, const std::vector<TetId>& new_tets,
                    std::uint32_t tag, SeparationScratch& scratch) {
  return Separator(transaction, std::move(incision), new_tets, tag, scratch).run();
}

}  // namespace incise::inline v0
