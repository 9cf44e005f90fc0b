// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cut/cut_context.h"
#include "cut/sweep.h"

namespace incise {
inline namespace v0 {
namespace lab {

/// Removes every tet one of whose edges the sheet crosses: what is left of the cut is a gap with jagged walls, which
/// get `tag`. Vertices without tets go, too.
///
/// **Source:** the paper's [7] and [8]: S. Cotin, H. Delingette, N. Ayache, "A hybrid elastic model for real-time
/// cutting", The Visual Computer 16, 2000; C. Forest, H. Delingette, N. Ayache, "Removing tetrahedra from a manifold
/// mesh", Computer Animation 2002. Readings: without the refinement of [8]; what then hangs at a vertex alone comes
/// off, and along an edge alone as well, where [8] removes more tets or moves vertices to stay manifold. A blade
/// exactly along faces takes the tets on one side of them. Cost: one pass over the mesh, then O(removed tets · stars).
Status remove_elements(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads);

}  // namespace lab
}  // namespace v0
}  // namespace incise
