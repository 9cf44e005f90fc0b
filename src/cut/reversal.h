// SPDX-License-Identifier: Apache-2.0
// A step taken back by steps of their own: history goes on, and the mesh is as it was before.
#pragma once

#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Restores what step `index` of the journal changed, and appends one step that does so, or two where tets come back
/// beside some that live on with other vertices, in which they lay: these are put aside by the first, and all come by
/// their ids with the second. Connectivity, rest positions and ids are bit for bit as before the step.
///
/// `mesh` must be as right after it, but for current positions: what came later must have been taken back too. Unlike
/// undo this needs no past positions: vertices that come back stand where their material stands now, and the others
/// stay where they are. Cost: O(t·v) for t tets and v vertices that come back or move. Source: ours.
void reverse(TetMesh& mesh, Journal& journal, std::size_t index);

}  // namespace v0
}  // namespace incise
