// SPDX-License-Identifier: Apache-2.0
// Text of the shaders that draw the surface. The prelude may define ONLY_SOME (leave triangles out) or WIRE (lines).
#pragma once

namespace incise {
inline namespace v0 {
namespace render {

inline constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 to_view, to_clip;
out vec3 view_position, view_normal;
void main() {
  vec4 p = to_view * vec4(position, 1);
  vec3 n = mat3(to_view) * normal;
  float size = length(n);
  view_position = p.xyz;
  view_normal = size > 0.0 ? n / size : vec3(0);
  gl_Position = to_clip * p;
}
)";

inline constexpr const char* kSurfaceFragment = R"(
in vec3 view_position, view_normal;
uniform usamplerBuffer looks;
uniform sampler2D palette;  // row 0: labels, row 1: quality
uniform int color_by, only;
uniform bool shows_newest, is_flat_light;
uniform float opacity, rim;
uniform vec3 lone_wire;     // red below 0: lines lie on a surface
out vec4 color;

const uint kWall = 1u, kNewest = 2u, kInside = 4u;
const int kTissue = 0, kRegion = 1, kStroke = 2, kQuality = 3;

// A gamma of 2 instead of sRGB's: next to the same, and much cheaper where the processor draws.
vec3 to_linear(vec3 c) { return c * c; }
vec3 to_screen(vec3 c) { return sqrt(clamp(c, 0.0, 1.0)); }
vec3 label(uint number) { return to_linear(texelFetch(palette, ivec2(int(number), 0), 0).rgb); }

vec3 tissue(uint flags) {
  if ((flags & kInside) != 0u) return to_linear(vec3(0.66, 0.67, 0.69));
  if ((flags & kWall) == 0u) return to_linear(vec3(0.91, 0.70, 0.62));
  vec3 wet = to_linear(vec3(0.74, 0.15, 0.15));
  if (shows_newest && (flags & kNewest) != 0u) wet = mix(wet, to_linear(vec3(0.96, 0.66, 0.12)), 0.26);
  return wet;
}

vec3 base_color(uvec4 look) {
  bool is_wall = (look.r & kWall) != 0u;
  if (color_by == kQuality) return to_linear(texelFetch(palette, ivec2(int(look.a), 1), 0).rgb);
  if (color_by == kRegion) return label(look.b) * (is_wall ? 0.55 : 1.0);
  if (color_by == kTissue) return tissue(look.r);
  return is_wall ? label(look.g) : to_linear(vec3(0.70, 0.71, 0.73));
}

// Towards the eye, unit.
vec3 facing_normal(bool is_flat, vec3 to_eye) {
  vec3 flat_normal = normalize(cross(dFdx(view_position), dFdy(view_position)));  // of either side
  bool has_none = is_flat || dot(view_normal, view_normal) < 0.05;
  vec3 n = has_none ? flat_normal : normalize(view_normal) * (gl_FrontFacing ? 1.0 : -1.0);
  // Normals averaged on coarse meshes lean away from the eye at outlines; no light would then fit.
  return normalize(n + max(0.0, 0.05 - dot(n, to_eye)) * to_eye);
}

float wrapped(vec3 n, vec3 light, float wrap) { return max(0.0, (dot(n, light) + wrap) / (1.0 + wrap)); }

const vec3 kKey = normalize(vec3(-0.45, 0.65, 0.70)), kFill = normalize(vec3(0.85, 0.05, 0.45));

vec3 lit(vec3 base, vec3 n, vec3 to_eye, float gloss) {
  float sky = 0.5 + 0.5 * n.y;
  vec3 light = mix(vec3(0.10, 0.09, 0.09), vec3(0.19, 0.20, 0.22), sky);
  light += vec3(0.78, 0.76, 0.72) * wrapped(n, kKey, 0.25) + vec3(0.21, 0.22, 0.25) * wrapped(n, kFill, 0.4);
  float edge = 1.0 - max(0.0, dot(n, to_eye));
  edge *= edge;
  vec3 c = base * light + vec3(0.75, 0.85, 1.0) * (rim * 0.35 * edge * edge * sky);
  float shine = max(0.0, dot(n, normalize(kKey + to_eye)));
  shine *= shine;
  shine *= shine;
  shine *= shine;
  return c + vec3(1.0, 0.97, 0.94) * gloss * (gloss > 0.1 ? shine * shine * shine * shine : shine * shine);
}

// For colours that tell a number: bright enough everywhere to be read.
vec3 flatly_lit(vec3 base, vec3 n, vec3 to_eye) { return base * (0.48 + 0.52 * wrapped(n, kKey, 0.6)); }

void main() {
  uvec4 look = texelFetch(looks, gl_PrimitiveID);
  bool is_wall = (look.r & kWall) != 0u, is_inside = (look.r & kInside) != 0u;
#ifdef ONLY_SOME
  if ((only == 2) != (look.r == 0u)) discard;
#endif
  vec3 base = base_color(look);
#ifdef WIRE
  float lightness = dot(base, vec3(0.21, 0.72, 0.07));
  vec3 line = lightness > 0.2 ? to_screen(base * 0.22) : to_screen(mix(base, vec3(0.9), 0.11));
  color = vec4(lone_wire.r < 0.0 ? line : lone_wire, opacity);
#else
  vec3 to_eye = normalize(-view_position);
  vec3 n = facing_normal(is_inside, to_eye);
  if (!gl_FrontFacing && look.r == 0u) base *= vec3(0.38, 0.30, 0.30);
  vec3 c = is_flat_light ? flatly_lit(base, n, to_eye) : lit(base, n, to_eye, is_inside ? 0.0 : is_wall ? 0.22 : 0.05);
  color = vec4(to_screen(c), opacity);
#endif
}
)";

}  // namespace render
}  // namespace v0
}  // namespace incise
