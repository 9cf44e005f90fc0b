// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "incise/improve/options.h"
#include "incise/mesh/transaction.h"
#include "paper/held.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// The new place of a contour vertex C between its neighbours A and B: beside their middle, as far from the line AB as
/// before, so that the area inside the contour stays.
///
/// The closed form C′ = C − ((C − M)·u) u with M = (A + B)/2, u = (B − A)/|B − A| of equations 2 to 4: the same point,
/// and defined where A, C, B lie on a line, too (there it is M). C itself where A and B coincide.
/// **Source:** Paper §3.4, equations 2–4, Figure 9.
Vec3 smooth_on_contour(const Vec3& c, const Vec3& a, const Vec3& b);

/// The new place of a vertex of an incision face: the mean of its neighbours there, reached parallel to the plane that
/// fits them best, so that the volume about stays. `neighbours`: at least one.
/// **Source:** Paper §3.4.
Vec3 smooth_on_wall(const Vec3& place, std::span<const Vec3> neighbours);

/// Boundary Laplacian Smoothing of the contours and then of the faces of incisions, among `vertices`, one pass each in
/// the order given. Skin stays but for the contours on it; corners stay. Moves that would turn a tet over or make it
/// bad-shaped are shortened (`move_towards`). The two lips are smoothed on their own.
/// Cost: O(their stars). **Source:** Paper §3.4, Figures 9 and 10.
MaintainStatistics smooth_boundary(Transaction& transaction, const std::vector<VertexId>& vertices,
                                   const Held& held = {});

}  // namespace paper
}  // namespace v0
}  // namespace incise
