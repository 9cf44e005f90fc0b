// SPDX-License-Identifier: Apache-2.0
#include "render/marks_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "render/ink_style.h"
#include "render/marks_shaders.h"
#include "render/thread_timer.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr float kFrontWidth = 1.6F, kContourWidth = 0.6F;  // pixels
constexpr float kMostMarkPixels = 1024;                        // of widths and radii

/// How an array of instances (`divisor` 1) or vertices (0) is laid out.
class Layout {
 public:
  Layout(const GlObject& array, const MirroredBuffer& buffer, std::size_t stride, unsigned divisor)
      : stride_(static_cast<GLsizei>(stride)), divisor_(divisor) {
    glBindVertexArray(array.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  }
  Layout& floats(int count, std::size_t offset) {
    glVertexAttribPointer(next_, count, GL_FLOAT, GL_FALSE, stride_, reinterpret_cast<const void*>(offset));
    return enable();
  }
  Layout& numbers(int count, std::size_t offset) {
    glVertexAttribIPointer(next_, count, GL_UNSIGNED_INT, stride_, reinterpret_cast<const void*>(offset));
    return enable();
  }

 private:
  Layout& enable() {
    glVertexAttribDivisor(next_, divisor_);
    glEnableVertexAttribArray(next_++);
    return *this;
  }

  unsigned next_ = 0;
  GLsizei stride_;
  unsigned divisor_;
};

std::uint32_t style_of(app::Ink ink) {
  return std::min(static_cast<std::uint32_t>(ink), static_cast<std::uint32_t>(kInks - 1));
}

float in_pixels(float size) {
  return size > 0 ? std::min(size, kMostMarkPixels) : 1.0F;
}

void set_styles(const GlObject& program, app::Theme theme) {
  const auto styles = ink_styles(theme);
  static_assert(kStyles == 14, "the arrays of the shaders have as many");
  std::array<std::array<float, 3>, kStyles> inks, casings;
  std::array<std::array<int, 3>, kStyles> shapes;
  for (std::size_t i = 0; i < kStyles; ++i) {
    inks[i] = styles[i].color;
    casings[i] = styles[i].casing;
    shapes[i] = {static_cast<int>(styles[i].line), static_cast<int>(styles[i].ball), static_cast<int>(styles[i].fill)};
  }
  const auto count = static_cast<GLsizei>(kStyles);
  glUniform3fv(location(program, "inks"), count, inks[0].data());
  glUniform3fv(location(program, "casings"), count, casings[0].data());
  glUniform3iv(location(program, "shapes"), count, shapes[0].data());
}

}  // namespace

Result<MarksPass> MarksPass::create() {
  auto lines = make_program("lines", kMarksPrelude, kLineVertex, kLineFragment);
  if (!lines.ok()) return lines.error();
  auto balls = make_program("balls", kMarksPrelude, kBallVertex, kBallFragment);
  if (!balls.ok()) return balls.error();
  auto fills = make_program("translucent triangles", kMarksPrelude, kFillVertex, kFillFragment);
  if (!fills.ok()) return fills.error();
  MarksPass pass;
  pass.line_program_ = std::move(lines).value();
  pass.ball_program_ = std::move(balls).value();
  pass.fill_program_ = std::move(fills).value();
  pass.set_up();
  return pass;
}

void MarksPass::set_up() {
  line_buffer_ = MirroredBuffer(GL_ARRAY_BUFFER);
  ball_buffer_ = MirroredBuffer(GL_ARRAY_BUFFER);
  corner_buffer_ = MirroredBuffer(GL_ARRAY_BUFFER);
  line_array_ = make_vertex_array();
  ball_array_ = make_vertex_array();
  corner_array_ = make_vertex_array();
  Layout(line_array_, line_buffer_, sizeof(Line), 1)
      .floats(3, offsetof(Line, from))
      .floats(3, offsetof(Line, to))
      .floats(1, offsetof(Line, width))
      .numbers(3, offsetof(Line, style));
  Layout(ball_array_, ball_buffer_, sizeof(Ball), 1)
      .floats(3, offsetof(Ball, centre))
      .floats(1, offsetof(Ball, radius))
      .numbers(2, offsetof(Ball, style));
  Layout(corner_array_, corner_buffer_, sizeof(Corner), 0)
      .floats(3, offsetof(Corner, at))
      .floats(1, offsetof(Corner, opacity))
      .numbers(1, offsetof(Corner, style));
  glBindVertexArray(0);
}

void MarksPass::gather_lines(const app::Picture& picture) {
  lines_.clear();
  const app::SurfaceFrame& surface = picture.surface;
  // Beside tissue that looks like tissue a line of the mesh's would be out of place.
  const bool is_mesh = picture.options.color != app::ColorBy::kTissue || picture.options.shows_wireframe;
  if (surface.topology && picture.options.shows_front && is_mesh) {
    for (const auto& [from, to] : surface.topology->front_edges) {
      if (from >= surface.positions.size() || to >= surface.positions.size()) continue;
      lines_.push_back({surface.positions[from], surface.positions[to], kFrontWidth, kFrontStyle, 0, 0});
    }
  }
  if (surface.topology && picture.options.shows_surface) {
    for (const auto& [from, to] : surface.topology->contour_edges) {
      if (from >= surface.positions.size() || to >= surface.positions.size()) continue;
      lines_.push_back({surface.positions[from], surface.positions[to], kContourWidth, kContourStyle, 2, 0});
    }
  }
  const bool has_instruments = !picture.marks.instruments.empty();
  for (const app::Marks::Line& line : picture.marks.lines) {
    // The instrument itself is seen; of its edge only what is inside the tissue is not.
    const bool is_inside = has_instruments && line.is_on_top && line.ink == app::Ink::kBlade;
    const std::uint32_t depth = is_inside ? 3 : line.is_on_top ? 1 : 0;
    lines_.push_back({line.from, line.to, in_pixels(line.width), style_of(line.ink), depth, line.is_dashed ? 1U : 0U});
  }
}

void MarksPass::gather_balls(const app::Marks& marks) {
  balls_.clear();
  for (const app::Marks::Ball& ball : marks.balls) {
    const float radius = ball.is_in_pixels ? in_pixels(ball.radius) : ball.radius;
    balls_.push_back({ball.centre, radius, style_of(ball.ink), ball.is_in_pixels ? 1U : 0U});
  }
}

void MarksPass::gather_corners(const app::Picture& picture) {
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

void MarksPass::upload(const app::Picture& picture, DrawStatistics& statistics) {
  ThreadTimer watch;
  gather_lines(picture);
  gather_balls(picture.marks);
  gather_corners(picture);
  statistics.marks = lines_.size() + balls_.size() + corners_.size() / 3;
  statistics.compare_ms += watch.lap();
  statistics.bytes_uploaded += line_buffer_.update(lines_.data(), lines_.size(), sizeof(Line));
  statistics.bytes_uploaded += ball_buffer_.update(balls_.data(), balls_.size(), sizeof(Ball));
  statistics.bytes_uploaded += corner_buffer_.update(corners_.data(), corners_.size(), sizeof(Corner));
  statistics.upload_ms += watch.lap();
}

void MarksPass::use(const GlObject& program, app::Theme theme, const ViewMatrices& view) const {
  glUseProgram(program.id());
  glUniformMatrix4fv(location(program, "to_view"), 1, GL_FALSE, view.to_view.data());
  glUniformMatrix4fv(location(program, "to_clip"), 1, GL_FALSE, view.to_clip.data());
  glUniform2f(location(program, "pixels"), static_cast<float>(view.viewport.width),
              static_cast<float>(view.viewport.height));
  glUniform1f(location(program, "pixel_scale"), view.pixel_scale);
  set_styles(program, theme);
}

void MarksPass::draw_corners(app::Theme theme, const ViewMatrices& view) const {
  if (corners_.empty()) return;
  use(fill_program_, theme, view);
  glBindVertexArray(corner_array_.id());
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners_.size()));
  glDepthMask(GL_TRUE);
}

void MarksPass::draw_lines(app::Theme theme, const ViewMatrices& view) const {
  if (lines_.empty()) return;
  use(line_program_, theme, view);
  glBindVertexArray(line_array_.id());
  const auto count = static_cast<GLsizei>(lines_.size());
  if (std::any_of(lines_.begin(), lines_.end(),
                  [](const Line& line) { return line.is_top == 1 || line.is_top == 3; })) {
    glUniform1i(location(line_program_, "is_behind"), 1);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
  }
  glUniform1i(location(line_program_, "is_behind"), 0);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

void MarksPass::draw_balls(app::Theme theme, const ViewMatrices& view) const {
  if (balls_.empty()) return;
  use(ball_program_, theme, view);
  glBindVertexArray(ball_array_.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(balls_.size()));
}

void MarksPass::draw(app::Theme theme, const ViewMatrices& view) const {
  glEnable(GL_BLEND);
  draw_corners(theme, view);
  draw_lines(theme, view);
  draw_balls(theme, view);
  glDisable(GL_BLEND);
}

}  // namespace render
}  // namespace v0
}  // namespace incise
