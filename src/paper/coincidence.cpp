// SPDX-License-Identifier: Apache-2.0
#include "paper/coincidence.h"

#include <algorithm>
#include <cmath>

#include "cut/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// Mean distance from a vertex to its neighbours.
double mean_edge_length(const TetMesh& mesh, VertexId centre, const std::vector<TetId>& star) {
  std::vector<VertexId> neighbours;
  double sum = 0;
  for (const TetId tet : star) {
    for (const VertexId v : mesh.vertices(tet)) {
      if (v != centre && std::find(neighbours.begin(), neighbours.end(), v) == neighbours.end()) {
        neighbours.push_back(v);
        sum += (mesh.rest(v) - mesh.rest(centre)).norm();
      }
    }
  }
  return sum / static_cast<double>(neighbours.size());
}

bool coincides(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, double longest, StarWalker& walker) {
  const auto hit = sheet.tree().closest(mesh.rest(vertex), kCoincident * longest);
  return hit.is_valid() &&
         std::sqrt(hit.distance2) <= kCoincident * mean_edge_length(mesh, vertex, walker.star(mesh, vertex));
}

}  // namespace

void mark_coincident(const TetMesh& mesh, const Sheet& sheet, Neighbourhood& near, StarWalker& walker) {
  double longest = 0;
  for (const CutEdge& edge : near.edges.edges()) {
    if (edge.is_flagged()) longest = std::max(longest, (mesh.rest(edge.b) - mesh.rest(edge.a)).norm());
  }
  for (const CutEdge& edge : near.edges.edges()) {
    if (!edge.is_flagged()) continue;
    for (const VertexId v : {edge.a, edge.b}) {
      std::uint32_t& asked = near.index_of_vertex[v.value];
      if (asked != 0) continue;
      asked = 1;
      if (coincides(mesh, sheet, v, longest, walker)) near.mark_on(v);
    }
  }
  for (const CutEdge& edge : near.edges.edges()) {
    near.index_of_vertex[edge.a.value] = near.index_of_vertex[edge.b.value] = 0;
  }
  for (NearTet& tet : near.tets) {
    for (unsigned c = 0; c < 4; ++c) {
      tet.on = static_cast<std::uint8_t>(tet.on | near.is_on[mesh.vertices(tet.id)[c].value] << c);
    }
  }
}

}  // namespace v0
}  // namespace incise
