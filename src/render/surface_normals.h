// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/geom/vec.h"

namespace incise::inline v0 {
namespace render {

/// Sums at each point twice the areas of its triangles along their normals; of no set length, zero where there is no
/// triangle. Corners of triangles must be below `positions.size()`. Cost: about 4 ns per triangle.
void average_normals(std::span<const std::array<std::uint32_t, 3>> triangles,
                     std::span<const Eigen::Vector3f> positions, std::vector<Eigen::Vector3f>& normals);

}  // namespace render
}  // namespace incise::inline v0
