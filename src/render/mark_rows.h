// SPDX-License-Identifier: Apache-2.0
// Marks as the rows of numbers that shaders take, without what draws them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "app/view/picture.h"
#include "render/rim_strip.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Lines, balls and translucent triangles beside the surface, its rims, and the front edges of its cuts.
class MarkRows {
 public:
  struct Line {
    Eigen::Vector3f from, to;
    float width;          // pixels
    std::uint32_t style;  // of ink_styles
    std::uint32_t depth;  // 1: faintly seen through what is in front; 2: only behind a surface
    std::uint32_t is_dashed;
  };
  /// A stretch of a wound's rim, and the rim's points before and after it: its own ends where the rim does not go on.
  struct Rim {
    Eigen::Vector3f before, from, to, after;
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

  /// Replaces all rows by those of a picture; corners are in the order of their triangles, the furthest first.
  void gather(const app::Picture& picture);

  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<Rim>& rims() const { return rims_; }
  [[nodiscard]] const std::vector<Ball>& balls() const { return balls_; }
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }

 private:
  void gather_front(const app::SurfaceFrame& surface);
  void gather_rims(const app::SurfaceFrame& surface);
  void gather_lines(const app::Marks& marks);
  void gather_balls(const app::Marks& marks);
  void gather_corners(const app::Picture& picture);

  RimStrip strip_;
  std::vector<Line> lines_;
  std::vector<Rim> rims_;
  std::vector<Ball> balls_;
  std::vector<Corner> corners_;
  std::vector<std::pair<float, std::uint32_t>> order_;  // scratch: of triangles, by depth
};

}  // namespace render
}  // namespace v0
}  // namespace incise
