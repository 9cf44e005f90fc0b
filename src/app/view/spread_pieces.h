// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/surface_view.h"
#include "incise/mesh/components.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Moves the face-connected pieces of a body apart in what is seen of it, so that the walls of its cuts can be looked
/// at. The mesh stays as it is. A middle is that of the box around the vertices as they stand.
///
/// Each piece is moved along from the body's middle to the piece's middle, by `share` of the width of the body's box in
/// that direction. Pieces whose middle coincides with the body's stay.
///
/// @param pieces  of this mesh. @param share  at least 0; 0 changes nothing.
/// @param frame   of this mesh, as `SurfaceView` fills it; where pieces share a point it goes with one of them.
/// A pure function. Cost: O(points + tets).
void spread_pieces(const TetMesh& mesh, const Components& pieces, double share, SurfaceFrame& frame);

}  // namespace app
}  // namespace v0
}  // namespace incise
