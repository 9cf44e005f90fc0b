// SPDX-License-Identifier: Apache-2.0
// Where the surface of a tool is.
#pragma once

#include <limits>

#include "incise/sim/contact.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// Where a tool's surface is, seen from a vertex: below 0, the vertex is inside it.
struct Touch {
  double distance = std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::Zero(), surface = Vec3::Zero();
};

/// `inner`: a point of the tissue behind the vertex, which tells on which side of a flat it belongs.
[[nodiscard]] Touch touch_of(const Tool& tool, const Vec3& point, const Vec3& inner);

}  // namespace detail
}  // namespace v0
}  // namespace incise
