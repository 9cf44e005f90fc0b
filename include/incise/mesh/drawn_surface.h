// SPDX-License-Identifier: Apache-2.0
// What is seen of a body that carries a fine surface: the surface as its skin, and the walls of its cuts.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/mesh/embedded_surface.h"

namespace incise {
inline namespace v0 {

/// A point that is drawn.
struct DrawnPoint {
  Vec3 rest = Vec3::Zero();         ///< its place at rest
  Binding binding;                  ///< what carries it
  std::array<double, 2> texture{};  ///< see `DrawnSurface`
  Vec3 normal = Vec3::Zero();       ///< of skin, at rest; of walls zero: theirs are made as they stand
};

/// A skin that is finer than the mesh, and the walls of the mesh drawn up to it, for a renderer or a file.
///
/// Points of skin have the surface's texture coordinates. Walls have coordinates by their places at rest, in length
/// units along the two axes that they face away from least, so that a pattern stays in the material however it is cut.
struct DrawnSurface {
  std::vector<DrawnPoint> points;                   ///< those of skin, then those of walls; the two share none
  std::size_t skin_points = 0;                      ///< how many are of skin
  std::vector<std::array<std::uint32_t, 3>> skin;   ///< counter-clockwise seen from outside
  std::vector<std::array<std::uint32_t, 3>> walls;  ///< likewise; triangles at rims that close gaps come last
  std::vector<std::uint32_t> wall_strokes;          ///< of each of `walls`: its stroke's number
  std::size_t rim_triangles = 0;                    ///< how many of `walls` are such
  std::uint64_t version = 0;                        ///< `EmbeddedSurface::version` that it was made of
};

/// What is to be drawn. Where the skin of the mesh meets a wall, vertices of walls are drawn at the nearest points of
/// the fine surface, and what is left between its rim and theirs is filled by triangles on the points of both. Both
/// must have caught up with the journal. Cost: O(tets + triangles).
[[nodiscard]] DrawnSurface draw(const EmbeddedSurface& surface, const TetMesh& mesh);

/// Where the points are, as the body stands, and their normals of unit length. Cost: O(points + triangles).
void fill(const DrawnSurface& drawn, const TetMesh& mesh, std::vector<Vec3>& positions, std::vector<Vec3>& normals);

/// Where the points were when the body stood as `mesh`, an earlier state of the mesh that `drawn` was made of: each is
/// bound there to the tet that holds it, on the side of its triangles. So a skin that was cut later is one again.
/// Cost: O(tets + points), about 3 µs per point.
[[nodiscard]] std::vector<Vec3> earlier_places(const DrawnSurface& drawn, const TetMesh& mesh);

}  // namespace v0
}  // namespace incise
