// SPDX-License-Identifier: Apache-2.0
// Rodrigues' rotation by the cross product of two unit vectors, without an angle.
#include "mesh/turned_normals.h"

#include "mesh/constants.h"

namespace incise {
inline namespace v0 {
Vec3 turned(const Vec3& direction, const Vec3& from, const Vec3& to) {
  const double cosine = from.dot(to);
  if (1 + cosine < kOppositeNormals) return to;
  const Vec3 axis = from.cross(to);
  const Vec3 across = axis.cross(direction);
  return (direction + across + axis.cross(across) / (1 + cosine)).normalized();
}

Vec3 turned_with(const Vec3& normal, const Vec3& sum_at_rest, const Vec3& sum_now) {
  const double length = sum_at_rest.norm(), length_now = sum_now.norm();
  if (!(length > 0) || !(length_now > 0)) return normal;
  return turned(normal, sum_at_rest / length, sum_now / length_now);
}

}  // namespace v0
}  // namespace incise
