// SPDX-License-Identifier: Apache-2.0
// Each end of a flagged edge is compared with what crosses that edge, the strip or the whole sheet, and once with
// each; lengths of stars are measured only where the sheet is close (docs/internals.md, 3.12).
#include "paper/coincidence.h"

#include <algorithm>
#include <cmath>

#include "cut/constants.h"
#include "incise/mesh/edge_length.h"

namespace incise {
inline namespace v0 {

namespace {

bool coincides(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, double longest, StarWalker& walker) {
  const auto hit = sheet.tree().closest(mesh.rest(vertex), kCoincident * longest);
  return hit.is_valid() &&
         std::sqrt(hit.distance2) <= kCoincident * mean_edge_length_at(mesh, vertex, walker.star(mesh, vertex));
}

}  // namespace

void mark_coincident(const TetMesh& mesh, const SheetSoFar& sheet, Neighbourhood& near, StarWalker& walker) {
  double longest = 0;
  for (const CutEdge& edge : near.edges.edges()) {
    if (edge.is_flagged()) longest = std::max(longest, (mesh.rest(edge.b) - mesh.rest(edge.a)).norm());
  }
  near.coincidence = kCoincident * longest;
  const auto mark = [&](const CutEdge& edge, const Sheet& crossed, unsigned asked) {
    for (const VertexId v : {edge.a, edge.b}) {
      std::uint32_t& memo = near.index_of_vertex[v.value];
      if ((memo & asked) != 0 || near.is_on[v.value] != 0) continue;
      memo |= asked;
      if (coincides(mesh, crossed, v, longest, walker)) near.mark_on(v);
    }
  };
  for (const CutEdge& edge : near.edges.edges()) {
    if (!edge.is_flagged()) continue;
    if (sheet.is_of_strip(edge.crossings.triangle)) {
      mark(edge, sheet.strip(), 1U);
    } else {
      mark(edge, sheet.whole(), 2U);
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
