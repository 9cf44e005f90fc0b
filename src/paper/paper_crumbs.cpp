// SPDX-License-Identifier: Apache-2.0
#include "paper/paper_crumbs.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {

namespace {

double longest_edge_squared(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  double longest = 0;
  for (unsigned a = 0; a < 4; ++a) {
    for (unsigned b = a + 1; b < 4; ++b) longest = std::max(longest, (mesh.rest(v[b]) - mesh.rest(v[a])).squaredNorm());
  }
  return longest;
}

/// Of a tet and of those beside it.
double longest_edge_about(const TetMesh& mesh, TetId tet) {
  double longest = longest_edge_squared(mesh, tet);
  for (const Link link : mesh.links(tet)) {
    if (!link.is_boundary()) longest = std::max(longest, longest_edge_squared(mesh, link.side().tet()));
  }
  return std::sqrt(longest);
}

}  // namespace

std::uint64_t keep_paper_crumbs(const TetMesh& mesh, double spacing, std::vector<IncisionFace>& incision,
                                CrumbScratch& scratch) {
  CrumbRules rules;
  rules.limit = [&mesh, spacing](TetId tet) {
    return crumb_limit(std::max(longest_edge_about(mesh, tet), 0.5 * spacing));
  };
  std::vector<IncisionFace> dropped;
  return keep_crumbs(mesh, rules, incision, dropped, scratch);
}

}  // namespace v0
}  // namespace incise
