// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "app/view/picture.h"
#include "incise/core/result.h"
#include "render/gl_object.h"
#include "render/mirrored_buffer.h"
#include "render/renderer.h"
#include "render/shadow_pass.h"
#include "render/surface_normals.h"
#include "render/surface_places.h"
#include "render/view_matrices.h"

namespace incise {
inline namespace v0 {
namespace render {

/// The triangles of a surface on the graphics processor, and the ways to draw them.
class SurfacePass {
 public:
  static Result<SurfacePass> create();

  /// Uploads what changed, and says what that cost. Errors: kBadArgument for triangles with points that there are not,
  /// kUnsupported for too many triangles; what was uploaded stays then.
  Status upload(const app::SurfaceFrame& frame, DrawStatistics& statistics);

  /// Skin, walls and triangles inside; without skin where that is translucent. Writes depth.
  /// `shadows`: null for none.
  void draw_opaque(const app::ViewOptions& options, const ViewMatrices& view, const ShadowPass* shadows) const;
  /// Depths alone, for the program that is in use.
  void draw_shadows() const { draw(); }
  /// Skin by its opacity over what is there: what faces away first, then the nearest that faces the eye.
  void draw_translucent(const app::ViewOptions& options, const ViewMatrices& view) const;
  /// Lines of one pixel, dark on bright ground and bright on dark.
  void draw_wireframe(const app::ViewOptions& options, const ViewMatrices& view) const;

 private:
  enum class Only : int { kAll, kNoSkin, kSkin };

  [[nodiscard]] Status check(const app::SurfaceFrame& frame) const;
  void set_up();
  void use(const GlObject& program, const app::ViewOptions& options, const ViewMatrices& view, Only only) const;
  void draw() const;

  GlObject all_, some_, wire_;         // programs; `some_` leaves triangles out
  GlObject all_shaded_, some_shaded_;  // with shadows

  GlObject array_, palette_, noise_, looks_texture_;
  MirroredBuffer positions_, normals_, places_, triangles_, looks_;
  SurfacePlaces place_of_;
  SurfaceNormals averages_;
  std::shared_ptr<const app::SurfaceTopology> topology_;  // as uploaded
  int most_looks_ = 0;
};

}  // namespace render
}  // namespace v0
}  // namespace incise
