// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cut/crumbs.h"
#include "cut/incision_face.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Takes the faces that a crumb hangs on out of `incision`, see `keep_crumbs`: it stays joined to the piece behind the
/// largest. A crumb has less than 0.02 of the cube of the longest edge about, or of half of `spacing`, the mesh's
/// typical edge, where that is more.
///
/// The paper has no crumbs, as its sheets are planar and its bodies rest while they are cut; where a body moves, the
/// strips of two frames pass a vertex on both sides, and what lies between is closed in. Returns how many crumbs. Cost:
/// that of `keep_crumbs`.
std::uint64_t keep_paper_crumbs(const TetMesh& mesh, double spacing, std::vector<IncisionFace>& incision,
                                CrumbScratch& scratch);

}  // namespace v0
}  // namespace incise
