// SPDX-License-Identifier: Apache-2.0
// Marks become plain rows, translucent triangles sorted from far to near; those whose depth is no number are left out,
// since sorting asks for an order.
#include "render/mark_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "render/ink_style.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr float kFrontWidth = 1.6F;      // pixels
constexpr float kMostMarkPixels = 1024;  // of widths and radii
constexpr std::uint32_t kOnTop = 1, kBehind = 2;

std::uint32_t style_of(app::Ink ink) {
  return std::min(static_cast<std::uint32_t>(ink), static_cast<std::uint32_t>(kInks - 1));
}

float in_pixels(float size) {
  return size > 0 ? std::min(size, kMostMarkPixels) : 1.0F;
}

}  // namespace

void MarkRows::gather(const app::Picture& picture) {
  lines_.clear();
  balls_.clear();
  rims_.clear();
  const app::ViewOptions& options = picture.options;
  // Beside tissue that looks like tissue a line of the mesh's would be out of place.
  const bool is_mesh = options.color != app::ColorBy::kTissue || options.shows_wireframe;
  if (picture.surface.topology && options.shows_front && is_mesh) gather_front(picture.surface);
  if (picture.surface.topology && options.shows_surface) gather_rims(picture.surface);
  gather_lines(picture.marks);
  gather_balls(picture.marks);
  gather_corners(picture);
}

void MarkRows::gather_front(const app::SurfaceFrame& surface) {
  const auto style = static_cast<std::uint32_t>(kFrontStyle);
  for (const auto& [from, to] : surface.topology->front_edges) {
    if (from >= surface.positions.size() || to >= surface.positions.size()) continue;
    lines_.push_back({surface.positions[from], surface.positions[to], kFrontWidth, style, 0, 0});
  }
}

void MarkRows::gather_rims(const app::SurfaceFrame& surface) {
  strip_.find(surface.topology);
  const std::vector<Eigen::Vector3f>& at = surface.positions;
  if (at.size() != surface.topology->vertices.size()) return;
  for (const auto& [before, from, to, after] : strip_.stretches()) {
    rims_.push_back({at[before], at[from], at[to], at[after]});
  }
}

void MarkRows::gather_lines(const app::Marks& marks) {
  const bool has_instruments = !marks.instruments.empty();
  for (const app::Marks::Line& line : marks.lines) {
    // The instrument itself is seen; of its edge only what is inside the tissue is not.
    const bool is_inside = has_instruments && line.is_on_top && line.ink == app::Ink::kBlade;
    const std::uint32_t depth = is_inside ? kBehind : line.is_on_top ? kOnTop : 0;
    lines_.push_back({line.from, line.to, in_pixels(line.width), style_of(line.ink), depth, line.is_dashed ? 1U : 0U});
  }
}

void MarkRows::gather_balls(const app::Marks& marks) {
  for (const app::Marks::Ball& ball : marks.balls) {
    const float radius = ball.is_in_pixels ? in_pixels(ball.radius) : ball.radius;
    balls_.push_back({ball.centre, radius, style_of(ball.ink), ball.is_in_pixels ? 1U : 0U});
  }
}

void MarkRows::gather_corners(const app::Picture& picture) {
  const std::vector<app::Marks::Triangle>& triangles = picture.marks.triangles;
  const Eigen::Vector3f towards_eye = picture.camera.backward().cast<float>();
  order_.clear();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i].corners;
    order_.emplace_back(towards_eye.dot(a + b + c), static_cast<std::uint32_t>(i));
  }
  // NaNs would break the order that sorting asks for.
  std::erase_if(order_, [](const auto& one) { return !(one.first == one.first); });
  std::sort(order_.begin(), order_.end());
  corners_.clear();
  for (const auto& [depth, i] : order_) {
    const app::Marks::Triangle& triangle = triangles[i];
    for (const Eigen::Vector3f& at : triangle.corners) {
      corners_.push_back({at, triangle.opacity, style_of(triangle.ink)});
    }
  }
}

}  // namespace render
}  // namespace v0
}  // namespace incise
