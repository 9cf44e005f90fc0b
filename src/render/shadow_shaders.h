// SPDX-License-Identifier: Apache-2.0
// Text of what shaders look shadows up by.
#pragma once

namespace incise {
inline namespace v0 {
namespace render {

/// The prelude of programs that look shadows up.
inline constexpr const char* kShadowLookup = R"(
#define SHADOWS
)";

/// In front of fragment shaders that ask for `shade()`: 1 in the light, 0 in shadow, and 1 without SHADOWS.
inline constexpr const char* kShadowFunction = R"(
#ifdef SHADOWS
uniform sampler2DShadow shadows;
in vec3 in_light;
float shade() {
  vec2 inside = step(abs(in_light.xy - 0.5), vec2(0.499));
  if (inside.x * inside.y == 0.0 || in_light.z > 1.0) return 1.0;
  const float reach = 1.6 / 1024.0;
  float sum = texture(shadows, in_light);
  sum += texture(shadows, in_light + vec3(reach, 0.6 * reach, 0)) + texture(shadows, in_light - vec3(reach, 0.6 * reach, 0));
  sum += texture(shadows, in_light + vec3(-0.6 * reach, reach, 0)) + texture(shadows, in_light + vec3(0.6 * reach, -reach, 0));
  return 0.2 * sum;
}
#else
float shade() { return 1.0; }
#endif
)";

}  // namespace render
}  // namespace v0
}  // namespace incise
