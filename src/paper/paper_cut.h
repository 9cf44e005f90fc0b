// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Cuts a mesh along a whole stroke as the paper does, after the fact: its sections 2.2 to 2.4.
///
/// Every edge that the sweep crosses is bisected, faces of three collision points are opened where Algorithms 1 and 2
/// find their vertices dividable; where the sweep ends inside an element nothing comes apart (§4.5). A sweep that meets
/// itself is cut in parts, in the order of time, with up to two journal steps for each: the cut, and the repair of
/// edges that two fans of tets share. Appends nothing where the blade misses. Walls get `tag`, which must be in [1,
/// 2^31). `threads` in [1, 256] search the mesh; the result does not depend on it. Errors: kBadArgument for a malformed
/// stroke, kOutOfMemory where ids or memory would run out; the mesh is then as before. Cost: one pass over the mesh for
/// each part, then O(cut tets · rounds).
Result<CutStatistics> cut_as_paper(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                   unsigned threads, StageTimes& times);

}  // namespace v0
}  // namespace incise
