// SPDX-License-Identifier: Apache-2.0
// Sums of the triangles' vector areas at their points; where these cancel each other too far there is a crease. Four
// floats at a time, in one pass without branches.
#include "render/surface_normals.h"

#include <cmath>

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr float kLeast = 0.8F;  // of the areas around a point that point one way, where there is no crease

}  // namespace

void SurfaceNormals::sum(std::span<const std::array<std::uint32_t, 3>> triangles,
                         std::span<const Eigen::Vector3f> positions) {
  const std::size_t count = positions.size();
  points_.resize(count);
  sums_.assign(count, Four{});
  for (std::size_t i = 0; i < count; ++i) points_[i] = Four{positions[i].x(), positions[i].y(), positions[i].z(), 0};
  const Four* at = points_.data();
  Four* sum = sums_.data();
  // A shader brings them to unit length, at no cost here. Free slots add zero.
  for (const auto& [a, b, c] : triangles) {
    const Four area = cross(at[b] - at[a], at[c] - at[a]);
    sum[a] += area;
    sum[b] += area;
    sum[c] += area;
  }
}

void SurfaceNormals::find_creases(std::span<const std::array<std::uint32_t, 3>> triangles,
                                  std::span<const Eigen::Vector3f> positions) {
  sum(triangles, positions);
  areas_.assign(positions.size(), 0);
  for (const auto& [a, b, c] : triangles) {
    const float area = length(cross(points_[b] - points_[a], points_[c] - points_[a]));
    areas_[a] += area;
    areas_[b] += area;
    areas_[c] += area;
  }
  keeps_.resize(positions.size());
  for (std::size_t i = 0; i < keeps_.size(); ++i) keeps_[i] = length(sums_[i]) < kLeast * areas_[i] ? 0.0F : 1.0F;
}

const std::vector<Eigen::Vector3f>& SurfaceNormals::average(std::span<const std::array<std::uint32_t, 3>> triangles,
                                                            std::span<const Eigen::Vector3f> positions) {
  sum(triangles, positions);
  keeps_.resize(positions.size(), 1);
  normals_.resize(positions.size());
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    const Four normal = sums_[i] * keeps_[i];
    normals_[i] = {normal[0], normal[1], normal[2]};
  }
  return normals_;
}

float SurfaceNormals::length(Four v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

}  // namespace render
}  // namespace v0
}  // namespace incise
