// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/incision_face.h"
#include "paper/incision_front.h"
#include "paper/sheet_so_far.h"

namespace incise {
inline namespace v0 {

/// Drops from `incision` the faces between collision points of which both tets lie on one side of the sheet.
///
/// Where a sheet turns sharply, faces whose vertices lie on both its parts span the corner: with their three collision
/// points they are incision faces (paper §2.2), but the sheet does not pass there, and what they enclose with the sheet
/// would come off as a crumb. They are told by how often the way from the corner of one tet that is opposite, through
/// the middle of the face, to that of the other crosses the sheet; a corner that lies on the sheet, too, gives way to
/// its tet's centre. `points`, ascending, are the collision points with the sheet's normals; only faces between whose
/// vertices it turns by more than 45° are asked, and only where all of these lie within
/// `coincidence` of the sheet as far as it is known. Differs from the paper, whose blades have no corners. Cost:
/// O(faces · log points), and O(log triangles) for each that is asked.
void keep_between_sides(const TetMesh& mesh, const std::vector<CollisionPoint>& points, double coincidence,
                        const SheetSoFar& sheet, std::vector<IncisionFace>& incision);

}  // namespace v0
}  // namespace incise
