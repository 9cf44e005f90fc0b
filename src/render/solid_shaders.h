// SPDX-License-Identifier: Apache-2.0
// Text of the shaders that draw solids: the lights of the surface's, on steel and cloth.
#pragma once

namespace incise {
inline namespace v0 {
namespace render {

inline constexpr const char* kSolidVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 finish;
layout(location = 3) in float gloss;
uniform mat4 to_view, to_clip;
out vec3 view_position, view_normal;
out vec4 tint;
out float shine;
#ifdef SHADOWS
uniform mat4 to_light;
uniform float shadow_lift;
out vec3 in_light;
#endif
void main() {
  vec4 p = to_view * vec4(position, 1);
  view_position = p.xyz;
  view_normal = mat3(to_view) * normal;
  tint = finish;
  shine = gloss;
#ifdef SHADOWS
  in_light = (to_light * vec4(position + shadow_lift * normal, 1)).xyz;
#endif
  gl_Position = to_clip * p;
}
)";

inline constexpr const char* kSolidFragment = R"(
in vec3 view_position, view_normal;
in vec4 tint;
in float shine;
out vec4 color;

const vec3 kKey = normalize(vec3(-0.45, 0.65, 0.70)), kFill = normalize(vec3(0.85, 0.05, 0.45));

float wrapped(vec3 n, vec3 light, float wrap) { return max(0.0, (dot(n, light) + wrap) / (1.0 + wrap)); }

// What polished steel mirrors: a bright ceiling with a lamp, a dark floor.
vec3 room(vec3 d) {
  float up = smoothstep(-0.35, 0.75, d.y);
  float lamp = max(0.0, dot(d, kKey));
  lamp *= lamp;
  lamp *= lamp;
  return mix(vec3(0.30, 0.31, 0.32), vec3(0.78, 0.81, 0.84), up) + vec3(1.1, 1.05, 1.0) * lamp * lamp * lamp;
}

void main() {
  vec3 to_eye = normalize(-view_position), n = normalize(view_normal);
  if (dot(n, to_eye) < 0.0) n = -n;
  float lit = shade();
  float sky = 0.5 + 0.5 * n.y;
  vec3 base = tint.rgb * tint.rgb;
  vec3 light = mix(vec3(0.10, 0.09, 0.09), vec3(0.19, 0.20, 0.22), sky);
  light += lit * vec3(0.78, 0.76, 0.72) * wrapped(n, kKey, 0.25) + vec3(0.21, 0.22, 0.25) * wrapped(n, kFill, 0.4);
  vec3 c = base * light;
  if (shine > 0.0) c = mix(c, base * room(reflect(-to_eye, n)), 0.75 * shine);
  color = vec4(sqrt(clamp(c, 0.0, 1.0)), tint.a);
}
)";

}  // namespace render
}  // namespace v0
}  // namespace incise
