// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/mesh/embedded_surface.h"

namespace incise {
inline namespace v0 {

/// A point on an edge of the surface where it is parted or, between two walls, divided.
struct EdgePoint {
  double t = 0;            ///< share of the edge
  std::uint32_t low = 0;   ///< point slot of the part before it
  std::uint32_t high = 0;  ///< of the part behind it; the same where the edge is divided and not parted
  [[nodiscard]] bool is_parted() const { return low != high; }
};
/// Along an edge.
using EdgeChain = std::vector<EdgePoint>;

/// What the division of a triangle asks for; `SurfaceKeeper` has the answers.
class PointMaker {
 public:
  virtual ~PointMaker() = default;
  /// The chain of the edge between two points inside a triangle.
  virtual EdgeChain divide(std::uint32_t from, std::uint32_t to) = 0;
  /// Points at the same places that hang on what is in the middle of the three.
  virtual std::array<std::uint32_t, 3> copy_to_middle(const std::array<std::uint32_t, 3>& points) = 0;
};

/// A triangle of points, with the chain of each edge, from its corner to the next.
struct DividedTriangle {
  std::array<std::uint32_t, 3> points;
  std::array<EdgeChain, 3> chains;
};

/// Divides a triangle along the walls that its edges cross; appends the parts, `root` and `next` unset. An edge that is
/// crossed more than once is halved between two walls first, so that each triangle has no edge with more than one.
void divide_triangle(const DividedTriangle& triangle, PointMaker& maker, std::vector<FineTriangle>& parts);

/// The chain as seen from the other end of its edge.
[[nodiscard]] EdgeChain reversed(const EdgeChain& chain);

}  // namespace v0
}  // namespace incise
