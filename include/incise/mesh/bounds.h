// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/geom/box.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// The smallest box around the rest positions of all vertices that tets use; empty for a mesh without tets.
/// Cost: O(vertices).
[[nodiscard]] Box rest_bounds(const TetMesh& mesh);

/// The same around the body as it stands.
[[nodiscard]] Box current_bounds(const TetMesh& mesh);

}  // namespace v0
}  // namespace incise
