// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cut/strip.h"
#include "cut/surface_index.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Whether any part of a sheet's border lies inside the body at rest. If so the cut ends there, at a front from which
/// others may go on, or begins at one. A sheet without such a part cuts right through whatever it meets. Exact. Cost:
/// O(segments), and that of the cells of the surface index that they pass through.
[[nodiscard]] bool lies_in_body(const TetMesh& mesh, const SurfaceIndex& surface,
                                std::span<const Strip::Segment> border);

}  // namespace v0
}  // namespace incise
