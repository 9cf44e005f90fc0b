// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/picture.h"
#include "incise/core/result.h"
#include "render/gl_object.h"
#include "render/mark_rows.h"
#include "render/mirrored_buffer.h"
#include "render/renderer.h"
#include "render/view_matrices.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Lines of any width, balls and translucent triangles beside the surface, the rims and the front edges of its cuts.
class MarksPass {
 public:
  static Result<MarksPass> create();

  /// Uploads what changed, and adds that to the statistics.
  void upload(const app::Picture& picture, DrawStatistics& statistics);
  /// Triangles, rims, lines and balls, in this order; all but triangles write depth.
  void draw(app::Theme theme, const ViewMatrices& view) const;

 private:
  void set_up();
  void use(const GlObject& program, app::Theme theme, const ViewMatrices& view) const;
  void draw_twice(const GlObject& program, std::size_t instances) const;
  void draw_rims(app::Theme theme, const ViewMatrices& view) const;
  void draw_lines(app::Theme theme, const ViewMatrices& view) const;
  void draw_balls(app::Theme theme, const ViewMatrices& view) const;
  void draw_corners(app::Theme theme, const ViewMatrices& view) const;

  GlObject line_program_, rim_program_, ball_program_, fill_program_;
  GlObject line_array_, rim_array_, ball_array_, corner_array_;
  MirroredBuffer line_buffer_, rim_buffer_, ball_buffer_, corner_buffer_;
  MarkRows rows_;
};

}  // namespace render
}  // namespace v0
}  // namespace incise
