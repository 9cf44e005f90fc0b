// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/geom/vec.h"
#include "incise/mesh/tet_soup.h"

namespace incise {
inline namespace v0 {

/// Puts the points and tets of `more`, moved by `move`, behind those of `all`: two bodies that share nothing, even
/// where points are in the same place. Tets without labels are of region 0. Walls, origins and fronts of cuts are left
/// out: both are to be without. Cost: O(points + tets) of `more`.
void append(const TetSoup& more, const Vec3& move, TetSoup& all);

}  // namespace v0
}  // namespace incise
