// SPDX-License-Identifier: Apache-2.0
// What is seen of a body that carries a fine surface: the surface as its skin, and the walls of its cuts.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
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

/// A triangle slot of a `SurfaceDrawing`.
struct DrawnTriangle {
  /// What it is.
  enum class Kind : std::uint8_t {
    kFree,  ///< nothing: a free slot
    kSkin,  ///< of the fine surface
    kWall,  ///< a face of the mesh, of a cut
    kRim,   ///< between the rims of both, counted as a wall
  };
  std::array<std::uint32_t, 3> points{};  ///< slots of points, counter-clockwise seen from outside
  std::uint32_t stroke = 0;               ///< of walls and rims: its stroke's number
  Kind kind = Kind::kFree;                ///< what it is
};

/// Keeps what is to be drawn of a body that carries a fine surface, and draws anew only what changed.
///
/// Slots are stable: what did not change keeps its own. What it draws depends on the surface and the mesh as they
/// stand, as `draw` has it; only the slots depend on the way. Not thread-safe. Memory: about 200 bytes per triangle
/// that is drawn, and 16 per tet.
class SurfaceDrawing {
 public:
  /// Draws all of it. The surface must have caught up with the journal, which is the mesh's. Cost: O(tets + triangles).
  SurfaceDrawing(const EmbeddedSurface& surface, const TetMesh& mesh, const Journal& journal = {});
  SurfaceDrawing(SurfaceDrawing&&) noexcept;
  SurfaceDrawing& operator=(SurfaceDrawing&&) noexcept;
  ~SurfaceDrawing();

  /// Catches up with the surface, which must have caught up with the journal; all three are those that it was made of.
  /// Returns whether there was anything to catch up with. Cost: O(tets and triangles that changed, and the tets around
  /// their vertices); all is drawn anew where the journal has trimmed steps that it has not seen, where steps were
  /// undone and others made since, and where the surface was followed more than once.
  bool follow(const EmbeddedSurface& surface, const TetMesh& mesh, const Journal& journal);

  /// All slots of points; the tet that carries a free one is invalid.
  [[nodiscard]] const std::vector<DrawnPoint>& points() const;
  /// All slots of triangles.
  [[nodiscard]] const std::vector<DrawnTriangle>& triangles() const;
  /// Tets and triangles of the surface that the last `follow` looked at, a measure of its work.
  [[nodiscard]] std::size_t looked_at() const;
  /// What it draws, without free slots. Cost: O(triangles).
  [[nodiscard]] DrawnSurface packed() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// What is to be drawn. Where the skin of the mesh meets a wall, vertices of walls are drawn at the nearest points of
/// the fine surface, and what is left between its rim and theirs is filled by triangles on the points of both. Both
/// must have caught up with the journal. Cost: O(tets + triangles). Whoever draws after every step keeps a
/// `SurfaceDrawing` instead.
[[nodiscard]] DrawnSurface draw(const EmbeddedSurface& surface, const TetMesh& mesh);

/// Where the points are, as the body stands, and their normals of unit length. Cost: O(points + triangles).
void fill(const DrawnSurface& drawn, const TetMesh& mesh, std::vector<Vec3>& positions, std::vector<Vec3>& normals);

/// Where the points were when the body stood as `mesh`, an earlier state of the mesh that `drawn` was made of: each is
/// bound there to the tet that holds it, on the side of its triangles. So a skin that was cut later is one again.
/// Cost: O(tets + points), about 3 µs per point.
[[nodiscard]] std::vector<Vec3> earlier_places(const DrawnSurface& drawn, const TetMesh& mesh);

}  // namespace v0
}  // namespace incise
