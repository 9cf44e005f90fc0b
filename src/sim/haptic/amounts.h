// SPDX-License-Identifier: Apache-2.0
// Which numbers options, snapshots and ticks may have: beyond these bounds, which no device and no tissue comes near,
// products of four of them could overflow, and a force be no number.
#pragma once

#include "incise/geom/vec.h"
#include "sim/haptic/constants.h"

namespace incise {
inline namespace v0 {
namespace detail {

[[nodiscard]] inline bool is_amount(double number) {
  return number >= 0 && number <= kGreatestAmount;
}

[[nodiscard]] inline bool is_positive(double number) {
  return number >= kLeastAmount && number <= kGreatestAmount;
}

/// Each component, of any sign.
[[nodiscard]] inline bool is_within_bounds(const Vec3& vector) {
  return (vector.array().abs() <= kGreatestAmount).all();
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
