// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/view/picture.h"
#include "incise/core/result.h"
#include "render/gl_object.h"
#include "render/mirrored_buffer.h"
#include "render/renderer.h"
#include "render/view_matrices.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Lines of any width, balls and translucent triangles beside the surface, and the front edges of its cuts.
class MarksPass {
 public:
  static Result<MarksPass> create();

  /// Uploads what changed, and adds that to the statistics.
  void upload(const app::Picture& picture, DrawStatistics& statistics);
  /// Triangles, lines and balls, in this order; lines and balls write depth.
  void draw(app::Theme theme, const ViewMatrices& view) const;

 private:
  struct Line {
    Eigen::Vector3f from, to;
    float width;           // pixels
    std::uint32_t style;   // of ink_styles
    std::uint32_t is_top;  // 1: faintly seen through what is in front
    std::uint32_t is_dashed;
  };
  struct Ball {
    Eigen::Vector3f centre;
    float radius;
    std::uint32_t style;
    std::uint32_t is_in_pixels;
  };
  struct Corner {
    Eigen::Vector3f at;
    float opacity;
    std::uint32_t style;
  };

  void set_up();
  void gather_lines(const app::Picture& picture);
  void gather_balls(const app::Marks& marks);
  void gather_corners(const app::Picture& picture);
  void use(const GlObject& program, app::Theme theme, const ViewMatrices& view) const;
  void draw_lines(app::Theme theme, const ViewMatrices& view) const;
  void draw_balls(app::Theme theme, const ViewMatrices& view) const;
  void draw_corners(app::Theme theme, const ViewMatrices& view) const;

  GlObject line_program_, ball_program_, fill_program_;
  GlObject line_array_, ball_array_, corner_array_;
  MirroredBuffer line_buffer_, ball_buffer_, corner_buffer_;
  std::vector<Line> lines_;
  std::vector<Ball> balls_;
  std::vector<Corner> corners_;
  std::vector<std::pair<float, std::uint32_t>> order_;  // scratch: of triangles, by depth
};

}  // namespace render
}  // namespace v0
}  // namespace incise
