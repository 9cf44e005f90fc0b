// SPDX-License-Identifier: Apache-2.0
// Which numbers materials, options, hooks, tools and sutures may have: within as much as a body may extend over, so
// that no energy overflows, and a body that is handed such a number goes on to be one.
#pragma once

#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// 0 or more.
[[nodiscard]] inline bool is_size(double number) {
  return number >= 0 && number <= kGreatestExtent;
}

/// Above 0.
[[nodiscard]] inline bool is_real_size(double number) {
  return number > 0 && number <= kGreatestExtent;
}

/// Each component, of any sign.
[[nodiscard]] inline bool is_place(const Vec3& vector) {
  return (vector.array().abs() <= kGreatestExtent).all();
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
