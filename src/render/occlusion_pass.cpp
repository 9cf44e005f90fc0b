// SPDX-License-Identifier: Apache-2.0
// Three steps over the whole picture: estimate from depths, blur, darken. Normals come from differences of depth
// towards the nearer side.
#include "render/occlusion_pass.h"

#include <epoxy/gl.h>

#include "render/full_screen.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr float kRadius = 0.09F;  // of the hollows that are found, per scene size

// What all three need: where a pixel of the depth buffer is, as the eye sees it.
constexpr const char* kPrelude = R"(
uniform sampler2D depths, source;
uniform mat4 to_clip;
uniform vec2 pixels;  // of the whole picture
uniform float radius, pixel_scale;

float view_depth(float stored) { return to_clip[3][2] / (2.0 * stored - 1.0 + to_clip[2][2]); }
float depth_at(ivec2 at) { return texelFetch(depths, clamp(at, ivec2(0), ivec2(pixels) - 1), 0).r; }
vec3 position_at(ivec2 at, float depth) {
  vec2 p = 2.0 * (vec2(at) + 0.5) / pixels - 1.0;
  return vec3(p.x / to_clip[0][0], p.y / to_clip[1][1], -1.0) * depth;
}
)";

constexpr const char* kEstimate = R"(
out vec2 result;  // how much of the sky is seen, and the depth
const int kTaps = 10;

vec3 step_to(ivec2 at, ivec2 by, vec3 here) {
  vec3 ahead = position_at(at + by, view_depth(depth_at(at + by))) - here;
  vec3 behind = here - position_at(at - by, view_depth(depth_at(at - by)));
  return abs(ahead.z) < abs(behind.z) ? ahead : behind;
}

void main() {
  ivec2 at = 2 * ivec2(gl_FragCoord.xy);
  float stored = depth_at(at);
  result = vec2(1, 1e30);
  if (stored >= 1.0) return;
  float depth = view_depth(stored);
  vec3 here = position_at(at, depth);
  vec3 normal = normalize(cross(step_to(at, ivec2(2, 0), here), step_to(at, ivec2(0, 2), here)));
  float reach = clamp(radius / (pixel_scale * depth), 4.0, 160.0);
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  float turn = 6.2832 * float((cell.x * 5 + cell.y * 11) & 15) / 16.0;
  float hidden = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    float share = (float(i) + 0.5) / float(kTaps), angle = turn + share * 6.2832 * 3.0;
    ivec2 tap = at + ivec2(share * reach * vec2(cos(angle), sin(angle)));
    float there = depth_at(tap);
    if (there >= 1.0) continue;
    vec3 v = position_at(tap, view_depth(there)) - here;
    float vv = dot(v, v), vn = dot(v, normal) - 0.03 * radius;
    float fall = max(radius * radius - vv, 0.0) / (radius * radius);
    hidden += fall * max(vn, 0.0) * inversesqrt(vv + 1e-4 * radius * radius);
  }
  result = vec2(max(0.0, 1.0 - 4.5 * hidden / float(kTaps)), depth);
}
)";

constexpr const char* kBlur = R"(
out vec2 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), most = textureSize(source, 0) - 1;
  vec2 here = texelFetch(source, at, 0).rg;
  float sum = 0.0, weights = 0.0;
  for (int y = -2; y < 2; ++y) {
    for (int x = -2; x < 2; ++x) {
      vec2 there = texelFetch(source, clamp(at + ivec2(x, y), ivec2(0), most), 0).rg;
      float weight = abs(there.g - here.g) < 0.35 * radius ? 1.0 : 0.0;
      sum += weight * there.r;
      weights += weight;
    }
  }
  result = vec2(weights > 0.0 ? sum / weights : here.r, here.g);
}
)";

constexpr const char* kApply = R"(
uniform vec3 shadow;
out vec4 color;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), low = (at - 1) / 2, most = textureSize(source, 0) - 1;
  float depth = view_depth(depth_at(at)), sum = 0.0, weights = 1e-4;
  for (int i = 0; i < 4; ++i) {
    ivec2 tap = clamp(low + ivec2(i & 1, i >> 1), ivec2(0), most);
    vec2 there = texelFetch(source, tap, 0).rg;
    vec2 apart = abs(2.0 * vec2(tap) + 0.5 - vec2(at));
    float weight = max(0.05, 2.0 - apart.x) * max(0.05, 2.0 - apart.y) / (1e-3 + abs(there.g - depth) / radius);
    sum += weight * there.r;
    weights += weight;
  }
  float seen = clamp((sum + 1e-4) / weights, 0.0, 1.0);
  color = vec4(mix(shadow, vec3(1), seen), 1);
}
)";

GlObject make_map(const app::Viewport& size) {
  GlObject map = make_texture();
  glBindTexture(GL_TEXTURE_2D, map.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, size.width, size.height, 0, GL_RG, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return map;
}

GlObject make_target(const GlObject& map) {
  GlObject target = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, target.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map.id(), 0);
  return target;
}

}  // namespace

Result<OcclusionPass> OcclusionPass::create() {
  OcclusionPass pass;
  auto estimate = make_program("occlusion", kPrelude, kFullScreenVertex, kEstimate);
  if (!estimate.ok()) return estimate.error();
  auto blur = make_program("occlusion's blur", kPrelude, kFullScreenVertex, kBlur);
  if (!blur.ok()) return blur.error();
  auto apply = make_program("occlusion's shadow", kPrelude, kFullScreenVertex, kApply);
  if (!apply.ok()) return apply.error();
  pass.estimate_ = std::move(estimate).value();
  pass.blur_ = std::move(blur).value();
  pass.apply_ = std::move(apply).value();
  pass.array_ = make_vertex_array();
  return pass;
}

Status OcclusionPass::fit(const app::Viewport& viewport) {
  const app::Viewport half{(viewport.width + 1) / 2, (viewport.height + 1) / 2};
  if (half.width == half_.width && half.height == half_.height) return {};
  estimated_ = make_map(half);
  blurred_ = make_map(half);
  estimated_target_ = make_target(estimated_);
  blurred_target_ = make_target(blurred_);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return Error{ErrorCode::kInternal, "the context cannot draw occlusion; switch it off", {}};
  }
  half_ = half;
  return check_gl("making the memory of occlusion");
}

void OcclusionPass::use(const GlObject& program, const Canvas& canvas, const ViewMatrices& view,
                        const GlObject* source) const {
  glUseProgram(program.id());
  glUniform1i(location(program, "depths"), 0);
  glUniform1i(location(program, "source"), 1);
  glUniformMatrix4fv(location(program, "to_clip"), 1, GL_FALSE, view.to_clip.data());
  glUniform2f(location(program, "pixels"), static_cast<float>(view.viewport.width),
              static_cast<float>(view.viewport.height));
  glUniform1f(location(program, "radius"), kRadius * view.scene_size);
  glUniform1f(location(program, "pixel_scale"), view.pixel_scale);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, source == nullptr ? 0 : source->id());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, canvas.depth().id());
}

Status OcclusionPass::draw(const Canvas& canvas, const ViewMatrices& view, bool is_tissue) {
  if (const Status status = fit(view.viewport); !status.ok()) return status;
  canvas.resolve_depth();
  glBindVertexArray(array_.id());
  glDisable(GL_DEPTH_TEST);
  glViewport(0, 0, half_.width, half_.height);
  glBindFramebuffer(GL_FRAMEBUFFER, estimated_target_.id());
  use(estimate_, canvas, view, nullptr);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindFramebuffer(GL_FRAMEBUFFER, blurred_target_.id());
  use(blur_, canvas, view, &estimated_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  canvas.bind();
  use(apply_, canvas, view, &blurred_);
  glUniform3f(location(apply_, "shadow"), is_tissue ? 0.22F : 0.25F, is_tissue ? 0.07F : 0.25F,
              is_tissue ? 0.07F : 0.25F);
  // The triangle lies furthest back: samples of the background fail the test, so that no halo is drawn around.
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  return {};
}

}  // namespace render
}  // namespace v0
}  // namespace incise
