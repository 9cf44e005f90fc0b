// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/mesh/star.h"
#include "paper/neighbourhood.h"
#include "paper/sheet_so_far.h"

namespace incise {
inline namespace v0 {

/// Marks the vertices with a flagged edge that coincide with the part of the sheet that crosses it (within
/// `kCoincident` of their mean edge): they take part in the cut themselves, since a split point there would be the
/// vertex given twice. Then notes of each near tet which corners do, those marked before included. Cost: one star per
/// vertex close to the sheet.
void mark_coincident(const TetMesh& mesh, const SheetSoFar& sheet, Neighbourhood& neighbourhood, StarWalker& walker);

}  // namespace v0
}  // namespace incise
