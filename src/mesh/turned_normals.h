// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// A direction turned as `from` turns into `to`, by the shortest way; all of unit length.
[[nodiscard]] Vec3 turned(const Vec3& direction, const Vec3& from, const Vec3& to);

/// Turns each normal as the triangles at its point turned. Sums of triangles' normals, weighted by area, at rest and as
/// they stand; a normal without triangles stays.
[[nodiscard]] Vec3 turned_with(const Vec3& normal, const Vec3& sum_at_rest, const Vec3& sum_now);

}  // namespace v0
}  // namespace incise
