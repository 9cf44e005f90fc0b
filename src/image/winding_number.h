// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/geom/box.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace image {

/// How often triangles wind around a point: 1 or -1 inside a closed surface, 0 outside, in between near holes.
///
/// Triangles that are far away count as one dipole. Uses no libm. **Source:** G. Barill et al., "Fast winding numbers
/// for soups and clouds", 2018; A. van Oosterom, J. Strackee, "The solid angle of a plane triangle", 1983.
class WindingNumber {
 public:
  using Triangle = std::array<std::uint32_t, 3>;
  WindingNumber(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles);

  /// Within a few hundredths of the exact number. Cost: about 1 µs far from the surface, some near it.
  [[nodiscard]] double operator()(const Vec3& p) const;

 private:
  struct Node {
    Vec3 middle = Vec3::Zero(), area = Vec3::Zero();  ///< of the triangles in it: weighted with area, and vectors
    double radius2 = 0;                               ///< of a ball around `middle` that has them all, squared
    std::uint32_t begin = 0, end = 0;                 ///< triangles, in the tree's order
    std::uint32_t second = 0;                         ///< child; the first follows its parent; 0: leaf
  };
  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<std::array<Vec3, 3>> corners_;
  std::vector<Node> nodes_;
};

/// The angle of the vector (x, y) from the x axis, in (-π, π], by + − × ÷ alone; within 1e-9.
[[nodiscard]] double angle_of(double y, double x);

}  // namespace image
}  // namespace v0
}  // namespace incise
