// SPDX-License-Identifier: Apache-2.0
// Cayley's formula: a turning without sines.
#pragma once

#include <Eigen/LU>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// The turning by a small angle: a rotation whatever the angle, and as good as exact where it is small.
///
/// @param angle  about its direction, by its length in radians.
[[nodiscard]] inline Mat3 turning_by(const Vec3& angle) {
  Mat3 half;
  const Vec3 a = 0.5 * angle;
  half << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return (Mat3::Identity() - half).inverse() * (Mat3::Identity() + half);
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
