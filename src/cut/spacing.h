// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "cut/constants.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// The mean edge length at rest of a few tets, 64 to 128 of them spread over the slots: a scale for overlaps and slits.
/// 0 for an empty mesh. Cost: O(1).
double typical_spacing(const TetMesh& mesh);

/// The same before the body was cut, as far as the mesh still tells: of tets without a vertex on a wall, where an
/// eighth of those that are looked at are such; else of all.
double uncut_spacing(const TetMesh& mesh);
/// The mean volume of tets likewise, in length units cubed.
double uncut_volume(const TetMesh& mesh);

/// How long edges around a place may have been before cuts made them `length` long, in a mesh whose typical edge before
/// it was cut is `spacing` long: that, but by a factor of 8 longer at most, for a mesh may be finer in places.
[[nodiscard]] inline double uncut_length(double length, double spacing) {
  return std::max(length, std::min(spacing, kMostShortened * length));
}

}  // namespace v0
}  // namespace incise
