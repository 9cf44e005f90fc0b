// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/view/surface_view.h"
#include "incise/mesh/drawn_surface.h"
#include "incise/mesh/embedded_surface.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Shows a fine surface that a body carries in the place of the skin of its mesh.
class FineView {
 public:
  /// Takes a surface that is bound.
  explicit FineView(EmbeddedSurface surface) : surface_(std::move(surface)) {}

  /// Binds one to a mesh as it stands. Errors: as `EmbeddedSurface::bind`.
  static Result<FineView> bind(FineSurface surface, const TetMesh& mesh, const Journal& journal);

  /// Catches up with the journal and fills a frame, with points that stand for vertices of their tets and without lines
  /// at rims, which would be dots where triangles are fine. Where the surface cannot follow it is bound anew. Errors:
  /// as `EmbeddedSurface::bind`. Cost: that of `EmbeddedSurface::follow` and `SurfaceDrawing::follow`, and O(points),
  /// where the journal moved some 30 bytes per triangle more.
  Status show(const TetMesh& mesh, const Journal& journal, SurfaceFrame& frame);

  /// What it shows, as `show` left it, which must have been called. Cost: O(triangles).
  [[nodiscard]] DrawnSurface drawn() const { return drawing_->packed(); }
  /// The surface itself.
  [[nodiscard]] const EmbeddedSurface& surface() const { return surface_; }

 private:
  /// How deep a point of a wall lies, and where it was when that was found.
  struct Depth {
    Vec3 rest = Vec3::Zero();
    float depth = -1;  // unknown
  };

  Status follow(const TetMesh& mesh, const Journal& journal);
  void publish(const TetMesh& mesh);
  void add_triangles(const TetMesh& mesh, SurfaceTopology& topology) const;
  void add_points(const TetMesh& mesh, SurfaceTopology& topology);
  [[nodiscard]] float depth_of(std::size_t point);

  EmbeddedSurface surface_;
  std::optional<SurfaceDrawing> drawing_;
  std::shared_ptr<const SurfaceTopology> topology_;
  std::uint64_t version_ = 0;
  std::vector<Depth> depths_;  // of points of walls
};

}  // namespace app
}  // namespace v0
}  // namespace incise
