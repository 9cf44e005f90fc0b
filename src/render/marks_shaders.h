// SPDX-License-Identifier: Apache-2.0
// Text of the shaders that draw lines, rims of wounds, balls and translucent triangles.
#pragma once

namespace incise {
inline namespace v0 {
namespace render {

/// Before each of them. The numbers of patterns are those of ink_style.h.
inline constexpr const char* kMarksPrelude = R"(
uniform mat4 to_view, to_clip;
uniform vec2 pixels;        // of the picture
uniform float pixel_scale;  // length per pixel at depth 1
uniform vec3 inks[18], casings[18];
uniform ivec3 shapes[18];   // of lines, balls, fills
const float kCasing = 1.5;  // pixels around an ink
const int kRimStyle = 17;
const float kRimHalfWidth = 1.5;  // pixels
)";

inline constexpr const char* kLineVertex = R"(
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in float width;
layout(location = 3) in uvec3 traits;  // style, depth (1: on top, 2: only behind a surface), dashed
uniform bool is_behind;
noperspective out vec2 place;  // pixels along the line from its start, and across
flat out vec2 sizes;           // length and half width in pixels
flat out uvec2 look;           // style, dashed
// Lines on a surface come before it, by a share of the way to the eye: whatever lies between the nearest and the
// furthest of the scene.
const float kNearer = 5e-4;

void main() {
  gl_Position = vec4(2, 2, 2, 1);  // seen by nobody
  if (is_behind ? traits.y == 0u : traits.y == 2u) return;
  vec4 a = to_clip * (to_view * vec4(from, 1)), b = to_clip * (to_view * vec4(to, 1));
  float da = a.z + a.w, db = b.z + b.w;  // below 0: nearer than the near plane
  if (da < 0.0 && db < 0.0) return;
  vec4 whole = a;
  if (da < 0.0) a = mix(a, b, da / (da - db) + 1e-5);
  if (db < 0.0) b = mix(b, whole, db / (db - da) + 1e-5);
  vec2 pa = 0.5 * pixels * a.xy / a.w, pb = 0.5 * pixels * b.xy / b.w;
  float size = distance(pa, pb), reach = 0.5 * width + kCasing + 1.0;
  vec2 along = size > 1e-3 ? (pb - pa) / size : vec2(1, 0), across = vec2(-along.y, along.x);
  float end = float(gl_VertexID & 1), side = float(gl_VertexID >> 1) * 2.0 - 1.0;
  vec4 at = end > 0.5 ? b : a;
  vec2 p = mix(pa, pb, end) + ((2.0 * end - 1.0) * along + side * across) * reach;
  place = vec2(end * size + (2.0 * end - 1.0) * reach, side * reach);
  if (size > 1.0) at.z = at.w * mix(a.z / a.w, b.z / b.w, place.x / size);  // beyond its ends it goes on as steeply
  sizes = vec2(size, 0.5 * width);
  look = traits.xz;
  float nearer = is_behind ? 0.0 : kNearer;
  gl_Position = vec4(p / (0.5 * pixels) * at.w, at.z + nearer * to_clip[3][2], at.w);
}
)";

inline constexpr const char* kLineFragment = R"(
noperspective in vec2 place;
flat in vec2 sizes;
flat in uvec2 look;
uniform bool is_behind, is_core;
out vec4 color;

// Pixels along the line to the nearest stretch of ink; the patterns' measures are in widths.
float off_ink(float x, int pattern, float width) {
  if (pattern == 0 || pattern == 4) return 0.0;
  float period = pattern == 1 ? 6.5 : pattern == 2 ? 3.4 : pattern == 3 ? 9.0 : 12.0;
  float t = mod(x / width, period), ink = pattern == 2 ? 0.4 : pattern == 5 ? 8.5 : 3.0;
  float off = min(max(t - ink, 0.0), period - t);
  if (pattern == 3 && t > ink) off = min(off, abs(t - 6.0) - 0.2);
  return max(off, 0.0) * width;
}

void main() {
  int style = int(look.x), pattern = shapes[style].x;
  bool is_hollow = pattern == 4 && sizes.y >= 1.4;
  if (look.y != 0u && (pattern == 0 || pattern == 4)) pattern = 1;
  if (is_behind && (place.x < 0.0 || place.x > sizes.x)) discard;  // caps that overlap would show
  float beyond = max(max(-place.x, place.x - sizes.x), 0.0);
  float inked = clamp(place.x, 0.0, sizes.x);
  float away = length(vec2(max(beyond, off_ink(inked, pattern, max(2.0 * sizes.y, 2.0))), place.y)) - sizes.y;
  float ink = clamp(0.5 - (is_hollow ? max(away, -away - 0.62 * sizes.y) : away), 0.0, 1.0);
  float casing = 0.75 * clamp(0.5 + kCasing - away, 0.0, 1.0);
  float opacity = max(ink, casing);
  if (opacity < 0.03 || (is_core && ink < 1.0)) discard;
  color = vec4(mix(casings[style], inks[style], ink), is_behind ? 0.32 * ink : opacity);
}
)";

/// A rim is one strip of one ink. Its stretches lie over each other at their joints, and each draws there: the core of
/// the strip is opaque, so that it does not matter how often, and its soft border is drawn by the stretch that is
/// nearer alone.
inline constexpr const char* kRimVertex = R"(
layout(location = 0) in vec3 before;
layout(location = 1) in vec3 from;
layout(location = 2) in vec3 to;
layout(location = 3) in vec3 after;
out vec2 place;        // pixels along the stretch from its start, and across
flat out float size;   // its length in pixels
flat out vec4 joints;  // at its start and its end: the way on, halfway between both stretches; 0 where there is none
const float kMuchNearer = 4e-3;  // before the surface, by a share of the way to the eye: lips may overlap
const float kLeastPixels = 0.05, kSharpest = 0.2;  // of a stretch, and of the sum of two directions, that tell a way

vec4 seen(vec3 at) { return to_clip * (to_view * vec4(at, 1)); }
vec2 pixel_of(vec4 p) { return 0.5 * pixels * p.xy / p.w; }

// From one pixel to another, unit.
vec2 way(vec2 a, vec2 b) {
  float far = distance(a, b);
  return far > kLeastPixels ? (b - a) / far : vec2(0);
}

vec2 halfway(vec2 a, vec2 b) {
  float size_of = length(a + b);
  bool is_told = dot(a, a) > 0.0 && dot(b, b) > 0.0 && size_of > kSharpest;
  return is_told ? (a + b) / size_of : vec2(0);
}

void main() {
  gl_Position = vec4(2, 2, 2, 1);  // seen by nobody
  vec4 a = seen(from), b = seen(to), c = seen(before), d = seen(after);
  float da = a.z + a.w, db = b.z + b.w;  // below 0: nearer than the near plane
  if (da < 0.0 && db < 0.0) return;
  vec4 whole = a;
  if (da < 0.0) a = mix(a, b, da / (da - db) + 1e-5);
  if (db < 0.0) b = mix(b, whole, db / (db - da) + 1e-5);
  vec2 pa = pixel_of(a), pb = pixel_of(b), ahead = way(pa, pb);
  bool has_start = da > 0.0 && c.z + c.w > 0.0, has_end = db > 0.0 && d.z + d.w > 0.0;
  joints.xy = has_start ? halfway(way(pixel_of(c), pa), ahead) : vec2(0);
  joints.zw = has_end ? halfway(ahead, way(pb, pixel_of(d))) : vec2(0);
  vec2 along = dot(ahead, ahead) > 0.0 ? ahead : vec2(1, 0), across = vec2(-along.y, along.x);
  joints = vec4(dot(joints.xy, along), dot(joints.xy, across), dot(joints.zw, along), dot(joints.zw, across));
  size = distance(pa, pb);
  float end = float(gl_VertexID & 1), side = float(gl_VertexID >> 1) * 2.0 - 1.0, reach = kRimHalfWidth + 1.0;
  place = vec2(end * size + (2.0 * end - 1.0) * reach, side * reach);
  vec2 p = pa + place.x * along + place.y * across;
  float za = (a.z + kMuchNearer * to_clip[3][2]) / a.w, zb = (b.z + kMuchNearer * to_clip[3][2]) / b.w;
  float z = mix(za, zb, size > 1.0 ? place.x / size : end);  // beyond its ends it goes on as steeply
  gl_Position = vec4(p / (0.5 * pixels), z, 1);
}
)";

inline constexpr const char* kRimFragment = R"(
in vec2 place;
flat in float size;
flat in vec4 joints;
uniform bool is_core;
out vec4 color;
const float kShared = 0.02;  // pixels at a joint that both of its stretches draw: no border is left out by rounding

void main() {
  float beyond = max(max(-place.x, place.x - size), 0.0);
  float ink = clamp(0.5 + kRimHalfWidth - length(vec2(beyond, place.y)), 0.0, 1.0);
  bool is_others = dot(place, joints.xy) < -kShared || dot(place - vec2(size, 0), joints.zw) > kShared;
  if (ink < (is_core || is_others ? 1.0 : 0.03)) discard;
  color = vec4(inks[kRimStyle], ink);
}
)";

inline constexpr const char* kBallVertex = R"(
layout(location = 0) in vec3 centre;
layout(location = 1) in float radius;
layout(location = 2) in uvec2 traits;  // style, in pixels
flat out vec4 ball;                    // centre as the eye sees it, radius
flat out uvec2 look;
out vec3 view_position;
out vec2 place;  // pixels from the centre, of a ball in pixels

void main() {
  gl_Position = vec4(2, 2, 2, 1);  // seen by nobody
  vec3 c = (to_view * vec4(centre, 1)).xyz;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  look = traits;
  float pixel = pixel_scale * -c.z, r = traits.y != 0u ? radius * pixel : radius, far = length(c);
  if (c.z >= 0.0 || far <= 1.02 * r) return;
  ball = vec4(c, r);
  if (traits.y != 0u) {
    place = corner * (radius + kCasing + 1.0);
    view_position = c + vec3(place * pixel, 0);
    gl_Position = to_clip * vec4(view_position, 1);
    vec4 front = to_clip * vec4(c + vec3(0, 0, 3.0 * r), 1);  // no part of it sinks into the surface, however steep
    gl_Position.z = max(front.z / front.w, -0.999) * gl_Position.w;
    return;
  }
  vec3 ahead = c / far, side = normalize(cross(ahead, vec3(0, 1, 0.01))), up = cross(side, ahead);
  float reach = 1.03 * r * far / sqrt(far * far - r * r);
  view_position = c + (corner.x * side + corner.y * up) * reach;
  gl_Position = to_clip * vec4(view_position, 1);
}
)";

inline constexpr const char* kBallFragment = R"(
flat in vec4 ball;
flat in uvec2 look;
in vec3 view_position;
in vec2 place;
out vec4 color;

// Below 0: ink. Pixels, for a glyph that fits a circle of radius r.
float glyph(vec2 p, float r, int shape) {
  float away = length(p), thick = max(0.26 * r, 1.2);
  if (shape == 1) return abs(away - r + 0.6 * thick) - 0.6 * thick;
  if (shape == 2) return min(abs(away - r + 0.7 * thick) - 0.7 * thick, away - 0.42 * r);
  if (shape == 3) {
    vec2 q = abs(vec2(p.x + p.y, p.x - p.y)) * 0.7071;
    return max(min(q.x, q.y) - 1.1 * thick, max(q.x, q.y) - r);
  }
  if (shape == 4) return max(away - r, 0.36 * r - away);
  return away - r;
}

void draw_glyph() {
  int style = int(look.x);
  float r = ball.w / (pixel_scale * -ball.z);
  float away = glyph(place, r, shapes[style].y);
  float ink = clamp(0.5 - away, 0.0, 1.0), casing = 0.8 * clamp(0.5 + kCasing - away, 0.0, 1.0);
  float opacity = max(ink, casing);
  if (opacity < 0.03) discard;
  float light = 0.86 + 0.14 * clamp(dot(place, vec2(-0.5, 0.8)) / r, -1.0, 1.0);
  color = vec4(mix(casings[style], inks[style] * light, ink), opacity);
  gl_FragDepth = gl_FragCoord.z;
}

void draw_sphere() {
  vec3 ray = normalize(view_position);
  float along = dot(ray, ball.xyz), inside = ball.w * ball.w - dot(ball.xyz, ball.xyz) + along * along;
  float opacity = clamp(0.5 + inside / max(fwidth(inside), 1e-20), 0.0, 1.0);
  if (opacity <= 0.0) discard;
  vec3 at = ray * (along - sqrt(max(inside, 0.0))), n = (at - ball.xyz) / ball.w;
  float key = max(0.0, (dot(n, normalize(vec3(-0.45, 0.65, 0.70))) + 0.3) / 1.3);
  vec3 base = inks[int(look.x)] * inks[int(look.x)];
  vec3 lit = base * (0.16 + 0.80 * key) + 0.20 * pow(max(0.0, dot(n, normalize(vec3(-0.25, 0.36, 0.9)))), 40.0);
  color = vec4(sqrt(clamp(lit, 0.0, 1.0)), opacity);
  vec4 clip = to_clip * vec4(at, 1);
  gl_FragDepth = clamp(0.5 + 0.5 * clip.z / clip.w, 0.0, 1.0);
}

void main() {
  if (look.y != 0u) draw_glyph(); else draw_sphere();
}
)";

inline constexpr const char* kFillVertex = R"(
layout(location = 0) in vec3 at;
layout(location = 1) in float opacity;
layout(location = 2) in uint style;
flat out uint look;
flat out float strength;
out vec3 view_position;
void main() {
  vec4 p = to_view * vec4(at, 1);
  view_position = p.xyz;
  look = style;
  strength = opacity;
  gl_Position = to_clip * p;
  gl_Position.z -= 4e-4 * gl_Position.w;
}
)";

inline constexpr const char* kFillFragment = R"(
flat in uint look;
flat in float strength;
in vec3 view_position;
out vec4 color;

// 1 on the pattern's ink, 0 between; in pixels of the screen.
float on_pattern(int pattern) {
  vec2 p = gl_FragCoord.xy;
  float rising = step(mod(p.x - p.y, 9.0), 2.5), falling = step(mod(p.x + p.y, 9.0), 2.5);
  if (pattern == 1) return rising;
  if (pattern == 2) return falling;
  if (pattern == 3) return step(length(mod(p, 7.0) - 3.5), 1.7);
  if (pattern == 4) return max(rising, falling);
  if (pattern == 5) return step(mod(p.y, 6.0), 2.0);
  return 0.5;
}

void main() {
  int style = int(look);
  vec3 n = normalize(cross(dFdx(view_position), dFdy(view_position)));
  float light = 0.72 + 0.28 * abs(dot(n, normalize(view_position)));
  float opacity = strength * mix(0.75, 1.35, on_pattern(shapes[style].z));
  color = vec4(inks[style] * light, min(opacity, 1.0));
}
)";

}  // namespace render
}  // namespace v0
}  // namespace incise
