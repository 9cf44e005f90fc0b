// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cut/crumbs.h"
#include "cut/incision_face.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Takes the largest face that a crumb hangs on out of `incision`, see `keep_crumbs`: the crumb stays joined by it.
/// What a crumb is `kCrumb` says.
///
/// The paper has no crumbs, as its sheets are planar and its bodies rest while they are cut; where a body moves, the
/// strips of two frames pass a vertex on both sides, and what lies between is closed in. Returns how many crumbs. Cost:
/// that of `keep_crumbs`, and up to 85 tets for each side of a face.
std::uint64_t keep_paper_crumbs(const TetMesh& mesh, std::vector<IncisionFace>& incision, CrumbScratch& scratch);

}  // namespace v0
}  // namespace incise
