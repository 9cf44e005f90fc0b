// SPDX-License-Identifier: Apache-2.0
// The regions that a triangle surface walls in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace image {

/// What a surface is made of.
struct SurfaceCells {
  using Triangle = std::array<std::uint32_t, 3>;
  /// The walls of a region without holes, turned outwards.
  struct Cell {
    std::vector<Triangle> triangles;
    double volume = 0;  ///< of the region; where the walls pass through themselves by signs, and not below 0
  };
  std::vector<Cell> closed;    ///< in the order of their first triangles
  std::vector<Triangle> open;  ///< triangles that no closed cell has: sheets, fins, all of a part with a hole
  std::size_t open_edges = 0;  ///< edges of one triangle alone
};

/// Finds the cells: each triangle has two sides, and at each edge the sides that face each other belong together. So
/// cells that share a face, an edge or a point are told apart, and how triangles turn does not matter.
/// @param triangles  of three different points each, none twice.
/// Cost: O(n log n), about 1 µs per triangle.
[[nodiscard]] SurfaceCells find_cells(const std::vector<Vec3>& points,
                                      const std::vector<SurfaceCells::Triangle>& triangles);

}  // namespace image
}  // namespace v0
}  // namespace incise
