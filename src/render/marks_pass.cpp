// SPDX-License-Identifier: Apache-2.0
// Lines and balls are instances of four corners that the vertex shader pulls apart to their width in pixels; patterns
// are drawn by the fragment shaders.
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

using Line = MarkRows::Line;
using Rim = MarkRows::Rim;
using Ball = MarkRows::Ball;
using Corner = MarkRows::Corner;

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

void set_styles(const GlObject& program, app::Theme theme) {
  const auto styles = ink_styles(theme);
  static_assert(kStyles == 18 && kContourStyle == 17, "the shaders have these numbers");
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
  auto rims = make_program("rims", kMarksPrelude, kRimVertex, kRimFragment);
  if (!rims.ok()) return rims.error();
  auto balls = make_program("balls", kMarksPrelude, kBallVertex, kBallFragment);
  if (!balls.ok()) return balls.error();
  auto fills = make_program("translucent triangles", kMarksPrelude, kFillVertex, kFillFragment);
  if (!fills.ok()) return fills.error();
  MarksPass pass;
  pass.line_program_ = std::move(lines).value();
  pass.rim_program_ = std::move(rims).value();
  pass.ball_program_ = std::move(balls).value();
  pass.fill_program_ = std::move(fills).value();
  pass.set_up();
  return pass;
}

void MarksPass::set_up() {
  line_buffer_ = MirroredBuffer(GL_ARRAY_BUFFER);
  rim_buffer_ = MirroredBuffer(GL_ARRAY_BUFFER);
  ball_buffer_ = MirroredBuffer(GL_ARRAY_BUFFER);
  corner_buffer_ = MirroredBuffer(GL_ARRAY_BUFFER);
  line_array_ = make_vertex_array();
  rim_array_ = make_vertex_array();
  ball_array_ = make_vertex_array();
  corner_array_ = make_vertex_array();
  Layout(line_array_, line_buffer_, sizeof(Line), 1)
      .floats(3, offsetof(Line, from))
      .floats(3, offsetof(Line, to))
      .floats(1, offsetof(Line, width))
      .numbers(3, offsetof(Line, style));
  Layout(rim_array_, rim_buffer_, sizeof(Rim), 1)
      .floats(3, offsetof(Rim, before))
      .floats(3, offsetof(Rim, from))
      .floats(3, offsetof(Rim, to))
      .floats(3, offsetof(Rim, after));
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

void MarksPass::upload(const app::Picture& picture, DrawStatistics& statistics) {
  ThreadTimer watch;
  rows_.gather(picture);
  const std::vector<Line>& lines = rows_.lines();
  const std::vector<Rim>& rims = rows_.rims();
  const std::vector<Ball>& balls = rows_.balls();
  const std::vector<Corner>& corners = rows_.corners();
  statistics.marks = lines.size() + rims.size() + balls.size() + corners.size() / 3;
  statistics.compare_ms += watch.lap();
  statistics.bytes_uploaded += line_buffer_.update(lines.data(), lines.size(), sizeof(Line));
  statistics.bytes_uploaded += rim_buffer_.update(rims.data(), rims.size(), sizeof(Rim));
  statistics.bytes_uploaded += ball_buffer_.update(balls.data(), balls.size(), sizeof(Ball));
  statistics.bytes_uploaded += corner_buffer_.update(corners.data(), corners.size(), sizeof(Corner));
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
  if (rows_.corners().empty()) return;
  use(fill_program_, theme, view);
  glBindVertexArray(corner_array_.id());
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(rows_.corners().size()));
  glDepthMask(GL_TRUE);
}

/// First all, with their soft borders, which hide nothing of each other; then the opaque cores, whose depth hides what
/// comes later.
void MarksPass::draw_twice(const GlObject& program, std::size_t instances) const {
  for (const bool is_core : {false, true}) {
    glUniform1i(location(program, "is_core"), is_core ? 1 : 0);
    glDepthMask(is_core ? GL_TRUE : GL_FALSE);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances));
  }
}

void MarksPass::draw_rims(app::Theme theme, const ViewMatrices& view) const {
  if (rows_.rims().empty()) return;
  use(rim_program_, theme, view);
  glBindVertexArray(rim_array_.id());
  draw_twice(rim_program_, rows_.rims().size());
}

void MarksPass::draw_lines(app::Theme theme, const ViewMatrices& view) const {
  if (rows_.lines().empty()) return;
  use(line_program_, theme, view);
  glBindVertexArray(line_array_.id());
  if (std::any_of(rows_.lines().begin(), rows_.lines().end(), [](const Line& line) { return line.depth != 0; })) {
    glUniform1i(location(line_program_, "is_behind"), 1);
    glUniform1i(location(line_program_, "is_core"), 0);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(rows_.lines().size()));
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
  }
  glUniform1i(location(line_program_, "is_behind"), 0);
  draw_twice(line_program_, rows_.lines().size());
  // Casings hide what comes later, too: translucent skin.
  glUniform1i(location(line_program_, "is_core"), 0);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(rows_.lines().size()));
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void MarksPass::draw_balls(app::Theme theme, const ViewMatrices& view) const {
  if (rows_.balls().empty()) return;
  use(ball_program_, theme, view);
  glBindVertexArray(ball_array_.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(rows_.balls().size()));
}

void MarksPass::draw(app::Theme theme, const ViewMatrices& view) const {
  glEnable(GL_BLEND);
  draw_corners(theme, view);
  draw_rims(theme, view);
  draw_lines(theme, view);
  draw_balls(theme, view);
  glDisable(GL_BLEND);
}

}  // namespace render
}  // namespace v0
}  // namespace incise
