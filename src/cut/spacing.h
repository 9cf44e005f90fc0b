// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// The mean edge length at rest of a few tets, 64 to 128 of them spread over the slots: a scale for overlaps and slits.
/// 0 for an empty mesh. Cost: O(1).
double typical_spacing(const TetMesh& mesh);

/// The same before the body was cut, as far as the mesh still tells: of tets without a vertex on a wall, where an
/// eighth of those that are looked at are such; else of all.
double uncut_spacing(const TetMesh& mesh);

}  // namespace v0
}  // namespace incise
