// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/geom/box.h"
#include "incise/mesh/components.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The box around the largest piece as it stands, and around every piece whose middle is no further from its middle
/// than its size: what has fallen away is left out. Empty for a mesh without tets. Cost: O(tets).
[[nodiscard]] Box bounds_of_main_pieces(const TetMesh& mesh, const Components& pieces);
/// Of the box of what is drawn, which a clip plane may have cut down, the part in `bounds_of_main_pieces`; all of it
/// where they have nothing in common. Cost: O(tets).
[[nodiscard]] Box main_part(const Box& drawn, const TetMesh& mesh, const Components& pieces);

}  // namespace app
}  // namespace v0
}  // namespace incise
