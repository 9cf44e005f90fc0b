// SPDX-License-Identifier: Apache-2.0
// Three means that differ in how often an edge counts: by its tets or once.
#include "incise/mesh/edge_length.h"

#include <algorithm>
#include <vector>

namespace incise {
inline namespace v0 {

double mean_edge_length(const TetMesh& mesh) {
  double sum = 0;
  std::size_t count = 0;
  mesh.for_each_tet([&](TetId t) {
    for (const auto& [a, b] : kEdgeCorners)
      sum += (mesh.rest(mesh.vertices(t)[a]) - mesh.rest(mesh.vertices(t)[b])).norm();
    count += 6;
  });
  return count > 0 ? sum / static_cast<double>(count) : 1.0;
}

double mean_edge_length_at(const TetMesh& mesh, VertexId vertex, std::span<const TetId> star) {
  std::vector<VertexId> neighbours;
  double sum = 0;
  for (const TetId tet : star) {
    for (const VertexId v : mesh.vertices(tet)) {
      if (v != vertex && std::find(neighbours.begin(), neighbours.end(), v) == neighbours.end()) {
        neighbours.push_back(v);
        sum += (mesh.rest(v) - mesh.rest(vertex)).norm();
      }
    }
  }
  return sum / static_cast<double>(neighbours.size());
}

double mean_edge_length_by_tets(const TetMesh& mesh, VertexId vertex, std::span<const TetId> star) {
  double sum = 0;
  for (const TetId tet : star) {
    for (const VertexId v : mesh.vertices(tet)) sum += (mesh.rest(v) - mesh.rest(vertex)).norm();
  }
  return sum / static_cast<double>(3 * star.size());
}

}  // namespace v0
}  // namespace incise
