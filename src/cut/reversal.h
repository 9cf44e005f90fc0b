// SPDX-License-Identifier: Apache-2.0
// A step taken back by a step of its own: history goes on, and the mesh is as it was before.
#pragma once

#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Restores what a step changed, by a new step: connectivity, rest positions and ids are bit for bit as before it.
///
/// `mesh` must be as right after `step`, but for current positions: what came after it must have been taken back too.
/// Unlike undo it needs no past positions: vertices that come back stand where their material stands now, and the others
/// stay where they are. Returns the step, not appended yet. Cost: O(t·v) for t tets and v vertices that come back or
/// move. Source: ours.
[[nodiscard]] Step reversal_of(TetMesh& mesh, const Step& step);

}  // namespace v0
}  // namespace incise
