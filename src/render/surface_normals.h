// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Averages the normals of triangles at their points, and keeps its memory from one time to the next.
class SurfaceNormals {
 public:
  /// Per point twice the areas of its triangles along their normals, summed; of no set length. Zero where there is no
  /// triangle, and at creases as they were found last: between a crease and points with normals these alone count, so
  /// that edges look like edges. Corners of triangles must be below `positions.size()`. Valid until the next call.
  /// Cost: about 3 ns per triangle.
  const std::vector<Eigen::Vector3f>& average(std::span<const std::array<std::uint32_t, 3>> triangles,
                                              std::span<const Eigen::Vector3f> positions);
  /// Finds the creases, where triangles that meet differ by more than about 75 degrees: after the triangles changed.
  /// They stay while a body only moves. Cost: about 8 ns per triangle.
  void find_creases(std::span<const std::array<std::uint32_t, 3>> triangles,
                    std::span<const Eigen::Vector3f> positions);

 private:
  // Four floats that the compilers keep in one register; the fourth is ballast.
  using Four = float __attribute__((vector_size(16)));

  static Four turned(Four v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }
  static Four cross(Four a, Four b) { return turned(a * turned(b) - turned(a) * b); }
  static float length(Four v);
  void sum(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Eigen::Vector3f> positions);

  std::vector<Four> points_, sums_;
  std::vector<float> areas_;  // scratch: of the triangles around each point
  std::vector<float> keeps_;  // per point: 0 at creases, else 1
  std::vector<Eigen::Vector3f> normals_;
};

}  // namespace render
}  // namespace v0
}  // namespace incise
