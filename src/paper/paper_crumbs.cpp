// SPDX-License-Identifier: Apache-2.0
// The rules of crumbs that `keep_crumbs` asks for, with sizes taken from uncut tets and from the largest tet nearby
// (docs/internals.md, 3.12).
#include "paper/paper_crumbs.h"

#include <algorithm>

#include "cut/spacing.h"
#include "paper/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// The volume of the largest tet among one and those that are up to some faces away from it, walls not passed.
double largest_volume_about(const TetMesh& mesh, TetId tet, unsigned faces) {
  double largest = mesh.rest_volume(tet);
  if (faces == 0) return largest;
  for (const Link link : mesh.links(tet)) {
    if (!link.is_boundary()) {
      largest = std::max(largest, largest_volume_about(mesh, link.side().tet(), faces - 1));
    }
  }
  return largest;
}

}  // namespace

std::uint64_t keep_paper_crumbs(const TetMesh& mesh, std::vector<IncisionFace>& incision, CrumbScratch& scratch) {
  const double least = paper::kCrumbOfMean * uncut_volume(mesh);
  CrumbRules rules;
  rules.limit = [&mesh, least](TetId tet) {
    return std::max(least, paper::kCrumb * largest_volume_about(mesh, tet, paper::kCrumbReach));
  };
  rules.hangs_on_one_face = true;
  std::vector<IncisionFace> dropped;
  return keep_crumbs(mesh, rules, incision, dropped, scratch);
}

}  // namespace v0
}  // namespace incise
