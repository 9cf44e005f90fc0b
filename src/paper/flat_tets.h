// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/incision_face.h"
#include "cut/sweep.h"
#include "paper/incision_front.h"
#include "paper/neighbourhood.h"

namespace incise {
inline namespace v0 {

/// Drops from `incision` the faces on one side of each tet along the sheet: one all corners of which are collision
/// points, or would be if the sheet went on.
///
/// Such a tet lies between two sheets of faces that are incision faces by their vertices (paper §2.2). Were both
/// opened, it would come off as a crumb. Where it is on the lip of an incision already, what faces the other way is
/// tissue, and stays joined; elsewhere it stays with what is below the sheet. The tip of what the stroke cuts off from
/// an older wall that it crosses is no such tet: it has a point that the stroke has made, and is joined to both sides
/// of the sheet. `points`, ascending, are the collision points of the sheet, `tag` that of the stroke. Differs from the
/// paper, whose planar sheets have no such tets. Cost: O(faces · log points), and a search of the sheet for each corner
/// on a wall.
void keep_flat_tets_joined(const TetMesh& mesh, const Neighbourhood& near, const std::vector<CollisionPoint>& points,
                           const Sheet& sheet, std::uint32_t tag, StarWalker& walker,
                           std::vector<IncisionFace>& incision);

}  // namespace v0
}  // namespace incise
