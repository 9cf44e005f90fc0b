// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cut/cut_context.h"
#include "cut/sweep.h"
#include "incise/mesh/transaction.h"
#include "paper/neighbourhood.h"

namespace incise {
inline namespace v0 {
namespace lab {

/// Moves of each crossed edge the nearer end to the nearest point of the sheet, the nearest vertex first, where no tet
/// turns over; those alone that cross it within `reach`, in (0, 0.5], of its length. `near` as `find_crossings` has
/// left it. Counts go to `statistics`. Cost: O(crossed edges · log + stars).
void move_onto(Transaction& transaction, const Sheet& sheet, const Neighbourhood& near, double reach,
               CutStatistics& statistics);

/// Moves vertices onto the sheet instead of dividing tets: of each crossed edge the nearer end, to the nearest point of
/// the sheet, the nearest vertex first, where no tet turns over; then opens the faces between tets whose centres lie on
/// either side of the sheet. The number of tets stays; walls get `tag`.
///
/// **Source:** the paper's [9]: H.-W. Nienhuys, A. F. van der Stappen, "A surgery simulation supporting cuts and finite
/// element deformation", MICCAI 2001. Reading: the path is known in advance, so that faces are chosen by the tets'
/// centres; there the blade's path within each step chooses them. Vertices of the skin move like all others. Cost: one
/// pass over the mesh, then O(cut tets · stars).
Status snap_nodes(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads);

}  // namespace lab
}  // namespace v0
}  // namespace incise
