// SPDX-License-Identifier: Apache-2.0
#include "surface_normals.h"

#include <cmath>

namespace incise::inline v0 {
namespace render {

const std::vector<Eigen::Vector3f>& SurfaceNormals::average(std::span<const std::array<std::uint32_t, 3>> triangles,
                                                            std::span<const Eigen::Vector3f> positions) {
  const std::size_t count = positions.size();
  points_.resize(count);
  normals_.resize(count);
  sums_.assign(count, Four{});
  for (std::size_t i = 0; i < count; ++i) points_[i] = Four{positions[i].x(), positions[i].y(), positions[i].z(), 0};
  const Four* at = points_.data();
  Four* sum = sums_.data();
  // A shader brings them to unit length, at no cost here. Free slots add zero.
  for (const auto& [a, b, c] : triangles) {
    Four area = cross(at[b] - at[a], at[c] - at[a]);
    area[3] = std::sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    sum[a] += area;
    sum[b] += area;
    sum[c] += area;
  }
  for (std::size_t i = 0; i < count; ++i)
    normals_[i] = is_crease(sum[i]) ? Eigen::Vector3f::Zero().eval() : normal_of(sum[i]);
  return normals_;
}

}  // namespace render
}  // namespace incise::inline v0
