// SPDX-License-Identifier: Apache-2.0
#include "surface_normals.h"

namespace incise::inline v0 {
namespace render {

void average_normals(std::span<const std::array<std::uint32_t, 3>> triangles,
                     std::span<const Eigen::Vector3f> positions, std::vector<Eigen::Vector3f>& normals) {
  normals.assign(positions.size(), Eigen::Vector3f::Zero());
  const Eigen::Vector3f* at = positions.data();
  Eigen::Vector3f* sum = normals.data();
  // A shader brings them to unit length, at no cost here. Free slots add zero.
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3f area = (at[b] - at[a]).cross(at[c] - at[a]);
    sum[a] += area;
    sum[b] += area;
    sum[c] += area;
  }
}

}  // namespace render
}  // namespace incise::inline v0
