// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/sweep.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// The tets whose boxes meet the boxes of the sheet's triangles: every tet that the sheet crosses, and a few more;
/// ascending. The paper's collision detection (§2.2), broad phase.
/// Cost: O(vertices + tets), about 4 ns per tet, for the first rejection by slabs; then O(near tets · log triangles).
std::vector<TetId> find_near_tets(const TetMesh& mesh, const Sheet& sheet, unsigned threads = 1);

}  // namespace v0
}  // namespace incise
