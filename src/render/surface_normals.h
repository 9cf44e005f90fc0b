// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/geom/vec.h"

namespace incise::inline v0 {
namespace render {

/// Averages the normals of triangles at their points, and keeps its memory from one time to the next.
class SurfaceNormals {
 public:
  /// Per point twice the areas of its triangles along their normals, summed; of no set length. Zero where there is no
  /// triangle, and at creases, where triangles that meet differ by more than about 75 degrees: between a crease and
  /// points with normals these alone count, so that edges look like edges. Corners of triangles must be below
  /// `positions.size()`. Valid until the next call. Cost: about 4 ns per triangle.
  const std::vector<Eigen::Vector3f>& average(std::span<const std::array<std::uint32_t, 3>> triangles,
                                              std::span<const Eigen::Vector3f> positions);

 private:
  // Four floats that the compilers keep in one register; the fourth of a sum has the areas alone.
  using Four = float __attribute__((vector_size(16)));

  static Four turned(Four v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }
  static Four cross(Four a, Four b) { return turned(a * turned(b) - turned(a) * b); }

  static Eigen::Vector3f normal_of(Four sum) { return {sum[0], sum[1], sum[2]}; }
  static bool is_crease(Four sum) {
    constexpr float kLeast = 0.8F * 0.8F;  // squared: of the areas that point one way
    return sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2] < kLeast * sum[3] * sum[3];
  }

  std::vector<Four> points_, sums_;
  std::vector<Eigen::Vector3f> normals_;
};

}  // namespace render
}  // namespace incise::inline v0
