// SPDX-License-Identifier: Apache-2.0
#include "cut/pinched_edges.h"

#include <algorithm>

#include "incise/mesh/verbs.h"

namespace incise {
inline namespace v0 {

namespace {

/// Two fans of tets that touch along a whole edge.
class PinchedEdges {
 public:
  PinchedEdges(Transaction& transaction, const std::vector<IncisionFace>& opened, StarWalker& walker)
      : transaction_(transaction), mesh_(transaction.mesh()), incision_(opened), walker_(walker) {}

  /// Each fan gets a midpoint of its own.
  std::uint64_t part() {
    std::uint64_t parted = 0;
    std::vector<WallEdge> edges = edges_of_walls();
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size();) {
      const WallEdge edge = edges[i];
      const std::vector<TetId> fans = fans_around(edge.a, edge.b);
      for (const TetId fan : fans) {
        if (fans.size() < 2) {
          continue;
        }
        if (const SplitEdgePlan plan = plan_split_edge(mesh_, edge.a, edge.b, fan, 0.5)) {
          apply(transaction_, plan);
        }
      }
      parted += fans.size() > 1 ? 1U : 0U;
      while (i < edges.size() && edges[i].a == edge.a && edges[i].b == edge.b) {
        ++i;
      }
    }
    return parted;
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
    for (const IncisionFace& face : incision_) {
      if (!mesh_.link(face.a).is_boundary()) {
        continue;
      }
      for (const Side side : {face.a, face.b}) {
        const auto v = mesh_.vertices(side);
        for (unsigned k = 0; k < 3; ++k) {
          edges.push_back({std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3]), side.tet()});
        }
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

  Transaction& transaction_;
  const TetMesh& mesh_;
  const std::vector<IncisionFace>& incision_;
  StarWalker& walker_;
};

}  // namespace

std::uint64_t part_pinched_edges(Transaction& transaction, const std::vector<IncisionFace>& incision,
                                 StarWalker& walker) {
  return PinchedEdges(transaction, incision, walker).part();
}

}  // namespace v0
}  // namespace incise
