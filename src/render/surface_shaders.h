// SPDX-License-Identifier: Apache-2.0
// Text of the shaders that draw the surface. The prelude may define ONLY_SOME (leave triangles out), WIRE (lines) or
// SHADOWS (with shadow_pass.h's function in front).
#pragma once

namespace incise {
inline namespace v0 {
namespace render {

inline constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;  // place in the rest shape, and depth below the skin, in extents of the body
uniform mat4 to_view, to_clip;
out vec3 view_position, view_normal;
out vec4 place;
#ifdef SHADOWS
uniform mat4 to_light;
uniform float shadow_lift;
out vec3 in_light;
#endif
void main() {
  place = rest;
  vec4 p = to_view * vec4(position, 1);
  vec3 n = mat3(to_view) * normal;
  float size = length(n);
  view_position = p.xyz;
  view_normal = size > 0.0 ? n / size : vec3(0);
#ifdef SHADOWS
  float length_of = length(normal);
  vec3 outwards = length_of > 0.0 ? normal / length_of : vec3(0);
  in_light = (to_light * vec4(position + shadow_lift * outwards, 1)).xyz;
#endif
  gl_Position = to_clip * p;
}
)";

inline constexpr const char* kSurfaceFragment = R"(
in vec3 view_position, view_normal;
in vec4 place;
uniform usamplerBuffer looks;
uniform sampler3D noise;  // repeats
uniform sampler2D palette;  // row 0: labels, row 1: quality
uniform int color_by, only;
uniform int tissue_look;    // 0: skin over fat and muscle, 1: liver, 2: vessel, 3: bone
uniform uint red_from;      // look.a from which a tet is bad-shaped
uniform bool shows_newest, is_flat_light;
uniform float opacity, rim;
uniform float extent;       // of the body at rest, length units
uniform vec3 lone_wire;     // red below 0: lines lie on a surface
out vec4 color;

const uint kWall = 1u, kNewest = 2u, kInside = 4u, kSmall = 8u;
const int kTissue = 0, kRegion = 1, kStroke = 2, kQuality = 3, kDefects = 4;

// A gamma of 2 instead of sRGB's: next to the same, and much cheaper where the processor draws.
vec3 to_linear(vec3 c) { return c * c; }
vec3 to_screen(vec3 c) { return sqrt(clamp(c, 0.0, 1.0)); }
vec3 label(uint number) { return to_linear(texelFetch(palette, ivec2(int(number), 0), 0).rgb); }

// The pattern is that of the rest shape: it sticks to the tissue as this moves and is cut. In [0, 1].
float rough(vec3 at) { return 0.65 * texture(noise, at).r + 0.35 * texture(noise, 3.7 * at + 0.31).r; }

// Pale dermis below the skin, fat, then muscle with its fibres: what is seen on the wall of a cut, by depth.
vec3 wall_tissue(float grain) {
  float depth = place.w + 0.006 * (grain - 0.5);
  float fibre = texture(noise, place.xyz * vec3(0.6, 4.0, 4.0)).r;
  vec3 dermis = to_linear(vec3(0.90, 0.66, 0.60)), fat = to_linear(vec3(0.90, 0.68, 0.36) + 0.10 * (grain - 0.5));
  vec3 muscle = to_linear(vec3(0.60, 0.11, 0.11) + vec3(0.16, 0.06, 0.05) * (fibre - 0.5));
  vec3 c = mix(dermis, fat, smoothstep(0.007, 0.010, depth));
  return mix(c, muscle, smoothstep(0.022, 0.030, depth));
}

// Organs are alike all through; their outside is a thin capsule.
vec3 organ(bool is_wall, float grain) {
  vec3 outside = vec3(0.50, 0.20, 0.17), inside = vec3(0.45, 0.13, 0.11), spread = vec3(0.12, 0.07, 0.06);
  if (tissue_look == 2) {
    outside = vec3(0.80, 0.52, 0.50);
    inside = vec3(0.86, 0.62, 0.56);
  }
  if (tissue_look == 3) {
    outside = vec3(0.90, 0.85, 0.72);
    inside = vec3(0.80, 0.60, 0.46);
    float pore = texture(noise, place.xyz * 9.0).r;  // spongy: marrow between trabeculae
    spread = vec3(0.30, 0.36, 0.36);
    if (is_wall) return to_linear(inside + spread * (smoothstep(0.35, 0.65, pore) - 0.5));
    spread = vec3(0.08);
  }
  return to_linear((is_wall ? inside : outside) + spread * (grain - 0.5));
}

vec3 tissue(uint flags, float grain) {
  if ((flags & kInside) != 0u) return to_linear(vec3(0.66, 0.67, 0.69));
  if (tissue_look > 0) return organ((flags & kWall) != 0u, grain);
  if ((flags & kWall) == 0u) return to_linear(mix(vec3(0.94, 0.75, 0.66), vec3(0.87, 0.63, 0.56), grain));
  vec3 wet = wall_tissue(grain);
  if (shows_newest && (flags & kNewest) != 0u) wet = mix(wet, to_linear(vec3(0.96, 0.66, 0.12)), 0.05);
  return wet;
}

// Tilts a normal as a height over the surface, in units of the view, would.
vec3 bumped(vec3 n, float height) {
  vec3 x = dFdx(view_position), y = dFdy(view_position);
  vec3 across_x = cross(y, n), across_y = cross(n, x);
  float area = dot(x, across_x);
  vec3 slope = sign(area) * (dFdx(height) * across_x + dFdy(height) * across_y);
  vec3 tilted = abs(area) * n - slope;
  float size = length(tilted);
  return size > 0.0 ? tilted / size : n;
}

vec3 base_color(uvec4 look, float grain) {
  bool is_wall = (look.r & kWall) != 0u;
  if (color_by == kQuality) return to_linear(texelFetch(palette, ivec2(int(look.a), 1), 0).rgb);
  if (color_by == kDefects && (look.r & kSmall) != 0u) return to_linear(vec3(0.98, 0.83, 0.10));
  if (color_by == kDefects && look.a >= red_from) return to_linear(vec3(0.86, 0.10, 0.10));
  if (color_by == kDefects) return to_linear(vec3(0.78, 0.79, 0.81));
  if (color_by == kRegion) return label(look.b) * (is_wall ? 0.55 : 1.0);
  if (color_by == kTissue) return tissue(look.r, grain);
  return is_wall ? label(look.g) : to_linear(vec3(0.70, 0.71, 0.73));
}

// Whether the inside of the skin is seen, and not the skin's own outline: there, samples of a pixel are of the side that
// is turned away as well, by a hair's breadth. Through translucent skin all of the inside is seen.
bool shows_back(vec3 to_eye) { return !gl_FrontFacing && (opacity < 1.0 || dot(view_normal, to_eye) < -0.2); }

// Towards the eye, unit.
vec3 facing_normal(bool is_flat, vec3 to_eye) {
  vec3 flat_normal = normalize(cross(dFdx(view_position), dFdy(view_position)));  // of either side
  bool has_none = is_flat || dot(view_normal, view_normal) < 0.05;
  vec3 n = has_none ? flat_normal : normalize(view_normal) * (shows_back(to_eye) ? -1.0 : 1.0);
  // Normals averaged on coarse meshes lean away from the eye at outlines; no light would then fit.
  return normalize(n + max(0.0, 0.05 - dot(n, to_eye)) * to_eye);
}

float wrapped(vec3 n, vec3 light, float wrap) { return max(0.0, (dot(n, light) + wrap) / (1.0 + wrap)); }

const vec3 kKey = normalize(vec3(-0.45, 0.65, 0.70)), kFill = normalize(vec3(0.85, 0.05, 0.45));

vec3 lit(vec3 base, vec3 n, vec3 to_eye, float gloss, float shown) {
  float sky = 0.5 + 0.5 * n.y;
  vec3 light = mix(vec3(0.10, 0.09, 0.09), vec3(0.19, 0.20, 0.22), sky);
  light += shown * vec3(0.78, 0.76, 0.72) * wrapped(n, kKey, 0.25) + vec3(0.21, 0.22, 0.25) * wrapped(n, kFill, 0.4);
  float edge = 1.0 - max(0.0, dot(n, to_eye));
  edge *= edge;
  vec3 c = base * light + vec3(0.75, 0.85, 1.0) * (rim * 0.35 * edge * edge * sky);
  float shine = max(0.0, dot(n, normalize(kKey + to_eye)));
  shine *= shine;
  shine *= shine;
  shine *= shine;
  return c + shown * vec3(1.0, 0.97, 0.94) * gloss * (gloss > 0.1 ? shine * shine * shine * shine : shine * shine);
}

// For colours that tell a number: bright enough everywhere to be read.
vec3 flatly_lit(vec3 base, vec3 n, vec3 to_eye) { return base * (0.48 + 0.52 * wrapped(n, kKey, 0.6)); }

void main() {
  uvec4 look = texelFetch(looks, gl_PrimitiveID);
  bool is_wall = (look.r & kWall) != 0u, is_inside = (look.r & kInside) != 0u;
#ifdef ONLY_SOME
  if ((only == 2) != (look.r == 0u)) discard;
#endif
  bool is_tissue = color_by == kTissue && !is_inside;
  float grain = is_tissue ? rough(place.xyz * (is_wall ? 4.0 : 3.0)) : 0.5;
  vec3 base = base_color(look, grain);
#ifdef WIRE
  float lightness = dot(base, vec3(0.21, 0.72, 0.07));
  vec3 line = lightness > 0.2 ? to_screen(base * 0.22) : to_screen(mix(base, vec3(0.9), 0.11));
  color = vec4(lone_wire.r < 0.0 ? line : lone_wire, opacity);
#else
  vec3 to_eye = normalize(-view_position);
  vec3 n = facing_normal(is_inside, to_eye);
  if (is_tissue) n = bumped(n, (is_wall ? 0.0025 : 0.0010) * extent * grain);
  if (look.r == 0u && shows_back(to_eye)) base *= vec3(0.38, 0.30, 0.30);
  float gloss = is_inside ? 0.0 : is_wall ? 0.30 : 0.07;
  if (is_tissue && tissue_look > 0) gloss = tissue_look == 3 ? 0.06 : 0.34;  // capsules are wet
#ifdef SHADOWS
  float shown = shade();
#else
  const float shown = 1.0;
#endif
  vec3 c = is_flat_light ? flatly_lit(base, n, to_eye) : lit(base, n, to_eye, gloss, shown);
  color = vec4(to_screen(c), opacity);
#endif
}
)";

}  // namespace render
}  // namespace v0
}  // namespace incise
