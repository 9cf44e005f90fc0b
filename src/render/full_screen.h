// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace incise {
inline namespace v0 {
namespace render {

/// A triangle that covers the screen, furthest back. To be drawn as three vertices without attributes.
inline constexpr const char* kFullScreenVertex = R"(
out vec2 place;  // (0, 0) lower left, (1, 1) upper right
void main() {
  place = vec2((gl_VertexID & 1) * 2, (gl_VertexID >> 1) * 2);
  gl_Position = vec4(2.0 * place - 1.0, 1, 1);
}
)";

}  // namespace render
}  // namespace v0
}  // namespace incise
