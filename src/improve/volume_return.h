// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "improve/care.h"

namespace incise {
inline namespace v0 {

/// Gives a body the volume back that a change at a vertex took: the vertices of walls and of curved skin beside it
/// move, all equally far, across the one surface that each is part of. `lost6` is six times the volume; the star of the
/// vertex is what `care.changed` holds, to which the stars of those that moved are added.
///
/// The volume is linear in one vertex alone, so each gives its share in turn, and the last one what is left: the body
/// has its volume but for rounding. Returns false where none may move, or one would have to by more than `kReturn` of
/// the edges that the body came with, leave its surface, or invert a tet, at rest or now; some have moved then. Cost:
/// O(stars), about 10 µs. **Source:** as `CloseMerger`, whose merged vertex alone gives back; here it stays where it
/// is.
bool return_volume(Care& care, VertexId centre, double lost6);

}  // namespace v0
}  // namespace incise
