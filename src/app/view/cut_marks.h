// SPDX-License-Identifier: Apache-2.0
// What the paper's figures show of a cut beside the body: where the blade went, what it opened, what it divided.
#pragma once

#include <vector>

#include "app/view/picture.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Adds the surfaces that strokes sweep, as translucent triangles of `Ink::kTrajectory`: violet in the paper's
/// Figure 3. Cost: O(points of the strokes).
void mark_trajectory(const std::vector<Stroke>& strokes, Marks& marks);

/// Turns the walls of all cuts into triangles of `Ink::kIncision`, the incision faces of that figure, with their edges:
/// the frame gets a topology of its own that shows them no more. Where both lips lie at one place, one is marked.
/// Cost: O(n log n) of the frame's triangles.
void mark_incision(SurfaceFrame& frame, Marks& marks);

/// Adds a ball of `Ink::kVertex` wherever there are vertices that a cut divided: those on walls, but for its front.
/// Where lips touch there is one ball for both.
///
/// @param frame  of this mesh. Cost: O(n log n) of its points.
void mark_cut_vertices(const TetMesh& mesh, const SurfaceFrame& frame, Marks& marks);

}  // namespace app
}  // namespace v0
}  // namespace incise
