// SPDX-License-Identifier: Apache-2.0
// Algorithms 1 and 2 line by line, on the link of a vertex: incision faces are edges there, cutting edges their ends
// (docs/internals.md, 3.12).
#include "paper/dividable.h"

#include <algorithm>
#include <map>

namespace incise {
inline namespace v0 {

namespace {

/// An incision face at a vertex, seen in the vertex's link: an edge between its two other vertices.
struct LinkEdge {
  VertexId from, to;
  Side side;
};

/// The paper's recursion on one set of incision faces.
class PaperSeparator {
 public:
  PaperSeparator(Transaction& transaction, std::vector<IncisionFace> incision, std::uint32_t tag, StarWalker& walker)
      : transaction_(transaction),
        mesh_(transaction.mesh()),
        incision_(std::move(incision)),
        tag_(tag),
        walker_(walker),
        marks_(transaction.mesh().tet_slots()) {
    for (const IncisionFace& face : incision_) {
      mark(face.a);
      mark(face.b);
      for (const VertexId v : mesh_.vertices(face.a)) {
        tets_of_.try_emplace(v);
      }
    }
    for (auto& [vertex, tets] : tets_of_) {
      tets = walker_.star(mesh_, vertex);
    }
    if (mesh_.touched_itself_at_load()) find_all_fans();
  }

  /// Algorithm 1. Lines 1-6 find the potential vertices of type II; every vertex of a face may be of type I.
  std::vector<VertexId> find_dividable_vertices() {
    std::vector<VertexId> potential;
    for (const IncisionFace& face : incision_) {
      if (is_joined_incision(face.a)) {
        for (const VertexId v : mesh_.vertices(face.a)) {
          potential.push_back(v);
        }
      }
    }
    std::sort(potential.begin(), potential.end());
    potential.erase(std::unique(potential.begin(), potential.end()), potential.end());
    std::erase_if(potential, [&](VertexId v) { return dividability_of(v) == Dividability::kNot; });
    return potential;
  }

  Separation run() {
    bool has_changed = true;
    while (has_changed) {
      has_changed = divide_all_dividable();
      has_changed |= divide_all_singletons();
    }
    count_faces();
    set_shapes();
    return result_;
  }

 private:
  /// Where two fans of tets touched along an edge at load, what divides the edge lies in both, and a walk from one does
  /// not come to the other. All tets around a new vertex are new.
  void find_all_fans() {
    std::map<VertexId, std::vector<TetId>> around;
    for (const VertexId v : transaction_.new_vertices()) around.try_emplace(v);
    for (const TetId tet : transaction_.new_tets()) {
      for (const VertexId v : mesh_.vertices(tet)) {
        if (const auto at = around.find(v); at != around.end()) at->second.push_back(tet);
      }
    }
    for (auto& [vertex, tets] : around) {
      if (!tets.empty() && walker_.star(mesh_, vertex).size() < tets.size()) tets_of_[vertex] = std::move(tets);
    }
  }
  void mark(Side side) {
    marks_.ensure(std::size_t{side.tet().value} + 1);
    marks_[side.tet().value] = static_cast<std::uint8_t>(marks_[side.tet().value] | 1U << side.side());
  }
  /// An incision face that still joins its two tets.
  [[nodiscard]] bool is_joined_incision(Side side) const {
    return ((unsigned{marks_[side.tet().value]} >> side.side()) & 1U) != 0 && !mesh_.link(side).is_boundary();
  }
  [[nodiscard]] bool is_surface_edge(VertexId a, VertexId b, TetId seed) const {
    return !walk_edge_ring(
        mesh_, a, b, seed, [](Side) { return false; }, [](TetId) {});
  }

  // --- Algorithm 1
  // -----------------------------------------------------------------------------------------------------

  bool divide_all_dividable() {
    bool has_changed = false;
    for (const VertexId v : find_dividable_vertices()) {
      has_changed |= divide(v);
    }
    return has_changed;
  }
  Dividability dividability_of(VertexId v) {
    const std::vector<LinkEdge> faces = faces_at(v);
    if (has_sector(v, faces)) {
      return Dividability::kSector;
    }
    return has_circle(faces) ? Dividability::kCircle : Dividability::kNot;
  }
  std::vector<LinkEdge> faces_at(VertexId v) const {
    std::vector<LinkEdge> faces;
    const auto tets = tets_of_.find(v);
    for (const TetId tet : tets->second) {
      for (unsigned s = 0; s < 4; ++s) {
        const Side side(tet, s);
        if (mesh_.vertices(tet)[s] == v || !is_joined_incision(side) || mesh_.link(side).side() < side) {
          continue;
        }
        std::array<VertexId, 2> others;
        unsigned count = 0;
        for (const VertexId w : mesh_.vertices(side)) {
          if (w != v) others[count++] = w;
        }
        faces.push_back({others[0], others[1], side});
      }
    }
    return faces;
  }
  /// Line 9: two different cutting edges at v that a path of incision faces connects.
  bool has_sector(VertexId v, const std::vector<LinkEdge>& faces) {
    std::map<VertexId, bool> is_surface;
    for (const LinkEdge& face : faces) {
      for (const VertexId w : {face.from, face.to}) {
        if (is_surface.find(w) == is_surface.end()) {
          is_surface[w] = is_surface_edge(v, w, face.side.tet());
        }
      }
    }
    std::map<VertexId, VertexId> root;
    for (const auto& [w, on_surface] : is_surface) {
      root[w] = w;
    }
    const auto find = [&](VertexId w) {
      while (root[w] != w) w = root[w];
      return w;
    };
    for (const LinkEdge& face : faces) {
      root[find(face.from)] = find(face.to);
    }
    std::map<VertexId, unsigned> surface_ends;
    for (const auto& [w, on_surface] : is_surface) {
      if (on_surface && ++surface_ends[find(w)] == 2) {
        return true;
      }
    }
    return false;
  }
  static bool has_circle(const std::vector<LinkEdge>& faces) {
    std::map<VertexId, VertexId> root;
    for (const LinkEdge& face : faces) {
      root[face.from] = face.from;
      root[face.to] = face.to;
    }
    const auto find = [&](VertexId w) {
      while (root[w] != w) w = root[w];
      return w;
    };
    for (const LinkEdge& face : faces) {
      const VertexId a = find(face.from), b = find(face.to);
      if (a == b) {
        return true;
      }
      root[a] = b;
    }
    return false;
  }
  /// Subdivision of a vertex (§2.3): one group of its tets, told apart by the incision faces, gets a copy.
  bool divide(VertexId v) {
    for (const LinkEdge& face : faces_at(v)) {
      const std::vector<TetId> group =
          walker_.flood(mesh_, v, face.side.tet(), [&](Side side) { return is_joined_incision(side); });
      if (!walker_.is_seen(mesh_.link(face.side).side().tet())) {
        give_copy(v, group);
        return true;
      }
    }
    return false;
  }

  // --- Algorithm 2
  // -----------------------------------------------------------------------------------------------------

  bool divide_all_singletons() {
    std::vector<VertexId> vertices;
    for (const auto& [v, tets] : tets_of_) {
      vertices.push_back(v);
    }
    bool has_changed = false;
    for (const VertexId v : vertices) {
      while (divide_singleton(v)) {
        has_changed = true;
      }
    }
    return has_changed;
  }
  /// Algorithm 2, with the loop of line 2 read as "while new tets are added".
  bool divide_singleton(VertexId v) {
    const std::vector<TetId>& tets = tets_of_[v];
    if ((mesh_.shape_of(v) & shape::kPinched) != 0) {
      return false;
    }
    const std::vector<TetId> reached = walker_.flood(mesh_, v, tets.front(), [](Side) { return false; });
    if (reached.size() >= tets.size()) {
      return false;
    }
    give_copy(v, reached);
    ++result_.singleton_vertices;
    return true;
  }

  /// Assigns a copy of `v` to the tets of `group`, and opens the incision faces that this takes apart.
  void give_copy(VertexId v, const std::vector<TetId>& group) {
    const VertexId copy = transaction_.copy_vertex(v);
    std::vector<TetId> sorted = group;
    std::sort(sorted.begin(), sorted.end());
    const auto is_in_group = [&](TetId tet) { return std::binary_search(sorted.begin(), sorted.end(), tet); };
    for (const TetId tet : sorted) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        if (mesh_.vertices(tet)[s] != v && !link.is_boundary() && !is_in_group(link.side().tet())) {
          transaction_.open({tet, s}, link.side(), tag_);
        }
      }
      transaction_.set_corner(tet, mesh_.corner_of(tet, v), copy);
    }
    std::vector<TetId>& rest = tets_of_[v];
    std::erase_if(rest, is_in_group);
    transaction_.set_tet_of(v, rest.front());
    transaction_.set_tet_of(copy, sorted.front());
    tets_of_[copy] = std::move(sorted);
    ++result_.copied_vertices;
  }

  void count_faces() {
    for (const IncisionFace& face : incision_) {
      ++(mesh_.link(face.a).is_boundary() ? result_.opened_faces : result_.latent_faces);
    }
  }
  void set_shapes() {
    for (const auto& [v, tets] : tets_of_) {
      unsigned bits = mesh_.shape_of(v) & shape::kPinched;
      for (const TetId tet : tets) {
        for (unsigned s = 0; s < 4; ++s) {
          const Link link = mesh_.links(tet)[s];
          if (mesh_.vertices(tet)[s] != v && link.is_boundary()) {
            bits |= link.tag() == 0 ? shape::kSkin : shape::kWall;
          }
        }
      }
      transaction_.set_shape(v, static_cast<std::uint8_t>(bits));
    }
    for (const IncisionFace& face : incision_) {
      if (mesh_.link(face.a).is_boundary()) {
        mark_wall(transaction_, face);
      }
    }
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  std::vector<IncisionFace> incision_;
  std::uint32_t tag_;
  StarWalker& walker_;
  ZeroedArray<std::uint8_t> marks_;
  std::map<VertexId, std::vector<TetId>> tets_of_;
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

std::vector<VertexId> find_dividable_vertices(Transaction& transaction, const std::vector<IncisionFace>& incision,
                                              StarWalker& walker) {
  return PaperSeparator(transaction, incision, 1, walker).find_dividable_vertices();
}

Separation separate_as_paper(Transaction& transaction, std::vector<IncisionFace> incision, std::uint32_t tag,
                             StarWalker& walker) {
  return PaperSeparator(transaction, std::move(incision), tag, walker).run();
}

}  // namespace v0
}  // namespace incise
