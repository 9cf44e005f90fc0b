// SPDX-License-Identifier: Apache-2.0
// Edges of the walls, sorted and each once; around each the tets are walked ring by ring, and where there are several
// rings each gets a midpoint (docs/internals.md, 3.9).
#include "cut/pinched_edges.h"

#include <algorithm>
#include <vector>

#include "incise/mesh/verbs.h"

namespace incise {
inline namespace v0 {

namespace {

/// Two fans of tets that touch along a whole edge.
class PinchedEdges {
 public:
  PinchedEdges(const TetMesh& mesh, std::span<const Side> walls, StarWalker& walker)
      : mesh_(mesh), walls_(walls), walker_(walker) {}

  /// Calls visit(a, b, fans), with one tet of each fan, for each such edge, until that returns false; it may divide the
  /// edge.
  template <class Visit>
  void for_each(Visit&& visit) {
    std::vector<WallEdge> edges = edges_of_walls();
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto [a, b, seed] = edges[i];
      if (i > 0 && edges[i - 1].a == a && edges[i - 1].b == b) continue;
      const std::vector<TetId> fans = fans_around(a, b);
      if (fans.size() > 1 && !visit(a, b, fans)) return;
    }
  }

 private:
  struct WallEdge {
    VertexId a, b;
    TetId seed;
    bool operator<(const WallEdge& other) const {
      if (a != other.a) return a < other.a;
      return b != other.b ? b < other.b : seed < other.seed;
    }
  };
  std::vector<WallEdge> edges_of_walls() const {
    std::vector<WallEdge> edges;
    for (const Side side : walls_) {
      if (!mesh_.is_live(side.tet()) || !mesh_.link(side).is_boundary()) continue;
      const auto v = mesh_.vertices(side);
      for (unsigned k = 0; k < 3; ++k) {
        edges.push_back({std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3]), side.tet()});
      }
    }
    return edges;
  }
  /// One tet of each face-connected fan around an edge.
  std::vector<TetId> fans_around(VertexId a, VertexId b) {
    std::vector<TetId> fans, seen;
    const std::vector<TetId> star = walker_.star(mesh_, a);
    for (const TetId tet : star) {
      if (mesh_.corner_of(tet, b) == 4 || std::find(seen.begin(), seen.end(), tet) != seen.end()) {
        continue;
      }
      fans.push_back(tet);
      walk_edge_ring(
          mesh_, a, b, tet, [](Side) { return false; }, [&](TetId other) { seen.push_back(other); });
    }
    return fans;
  }

  const TetMesh& mesh_;
  std::span<const Side> walls_;
  StarWalker& walker_;
};

}  // namespace

std::uint64_t part_pinched_edges(Transaction& transaction, std::span<const Side> walls, StarWalker& walker) {
  std::uint64_t parted = 0;
  PinchedEdges(transaction.mesh(), walls, walker).for_each([&](VertexId a, VertexId b, std::span<const TetId> fans) {
    for (const TetId fan : fans) {
      if (const SplitEdgePlan plan = plan_split_edge(transaction.mesh(), a, b, fan, 0.5)) apply(transaction, plan);
    }
    ++parted;
    return true;
  });
  return parted;
}

bool has_pinched_edges(const TetMesh& mesh, std::span<const Side> walls, StarWalker& walker) {
  bool has_some = false;
  PinchedEdges(mesh, walls, walker).for_each([&](VertexId, VertexId, std::span<const TetId>) {
    has_some = true;
    return false;
  });
  return has_some;
}

}  // namespace v0
}  // namespace incise
