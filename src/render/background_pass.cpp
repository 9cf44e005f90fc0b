// SPDX-License-Identifier: Apache-2.0
// One triangle that is larger than the picture, and no vertices: the shader makes them from their numbers.
#include "render/background_pass.h"

#include <epoxy/gl.h>

#include "render/full_screen.h"
#include "render/ink_style.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr const char* kBackgroundFragment = R"(
in vec2 place;
uniform vec3 top, bottom;
out vec4 color;
void main() { color = vec4(mix(bottom, top, smoothstep(0.0, 1.0, place.y)), 1); }
)";

}  // namespace

Result<BackgroundPass> BackgroundPass::create() {
  auto program = make_program("background", "", kFullScreenVertex, kBackgroundFragment);
  if (!program.ok()) return program.error();
  BackgroundPass pass;
  pass.program_ = std::move(program).value();
  pass.array_ = make_vertex_array();
  return pass;
}

void BackgroundPass::draw(app::Theme theme) const {
  const Grounds grounds = grounds_of(theme);
  glUseProgram(program_.id());
  glUniform3fv(location(program_, "top"), 1, grounds.top.data());
  glUniform3fv(location(program_, "bottom"), 1, grounds.bottom.data());
  glBindVertexArray(array_.id());
  glDisable(GL_DEPTH_TEST);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace render
}  // namespace v0
}  // namespace incise
