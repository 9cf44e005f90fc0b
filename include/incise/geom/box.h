// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// A closed box with sides along the axes; empty unless told otherwise. Lengths in the mesh's unit.
struct Box {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());   ///< least corner
  Vec3 hi = Vec3::Constant(-std::numeric_limits<double>::infinity());  ///< greatest corner

  /// Whether no point lies in it.
  [[nodiscard]] bool is_empty() const { return !(lo.x() <= hi.x() && lo.y() <= hi.y() && lo.z() <= hi.z()); }

  /// Grows to hold a point.
  void extend(const Vec3& point) {
    lo = lo.cwiseMin(point);
    hi = hi.cwiseMax(point);
  }
  /// Grows to hold another box.
  void extend(const Box& other) {
    lo = lo.cwiseMin(other.lo);
    hi = hi.cwiseMax(other.hi);
  }

  /// Whether two boxes have a point in common; boxes that only touch do.
  [[nodiscard]] bool overlaps(const Box& o) const {
    return lo.x() <= o.hi.x() && o.lo.x() <= hi.x() && lo.y() <= o.hi.y() && o.lo.y() <= hi.y() && lo.z() <= o.hi.z() &&
           o.lo.z() <= hi.z();
  }
  /// Squared distance from a point to the nearest point of the box; 0 inside.
  [[nodiscard]] double distance2(const Vec3& p) const { return (lo - p).cwiseMax(p - hi).cwiseMax(0.0).squaredNorm(); }
};

/// Whether a segment passes through a box that is larger by `margin` ≥ 0 on all sides; touching counts.
[[nodiscard]] inline bool segment_meets(const Box& box, double margin, const Vec3& p, const Vec3& q) {
  double from = 0, to = 1;
  for (int k = 0; k < 3; ++k) {
    const double lo = box.lo[k] - margin - p[k], hi = box.hi[k] + margin - p[k], way = q[k] - p[k];
    if (way == 0) {
      if (lo > 0 || hi < 0) return false;
      continue;
    }
    from = std::max(from, std::min(lo / way, hi / way));
    to = std::min(to, std::max(lo / way, hi / way));
  }
  return from <= to;
}

}  // namespace v0
}  // namespace incise
