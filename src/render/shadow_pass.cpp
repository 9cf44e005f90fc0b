// SPDX-License-Identifier: Apache-2.0
// An orthographic picture of depths from the light, which moves with the eye; the hardware compares on look-up.
#include "render/shadow_pass.h"

#include <epoxy/gl.h>

#include <Eigen/Geometry>

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr int kSide = 1024;                             // texels; the lookup's reach goes by it
constexpr float kLiftTexels = 1.5F;                     // along the normal, against shadows of a surface on itself
const Eigen::Vector3f kKeyLight(-0.45F, 0.65F, 0.70F);  // as in the shaders: towards the light, as the eye sees it

constexpr const char* kVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 to_light;
void main() { gl_Position = vec4(2.0 * (to_light * vec4(position, 1)).xyz - 1.0, 1); }
)";
constexpr const char* kShadowFragment = R"(
void main() {}
)";

GlObject make_map() {
  GlObject map = make_texture();
  glBindTexture(GL_TEXTURE_2D, map.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, kSide, kSide, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return map;
}

/// World to the unit cube around a ball, seen along the light.
Eigen::Matrix4f to_light(const ViewMatrices& view, const Eigen::Vector3f& centre, float radius) {
  const Eigen::Vector3f towards = (view.to_view.topLeftCorner<3, 3>().transpose() * kKeyLight).normalized();
  const Eigen::Vector3f x = towards.unitOrthogonal(), y = towards.cross(x);
  Eigen::Matrix4f m = Eigen::Matrix4f::Identity();
  const Eigen::Vector3f* axes[] = {&x, &y, &towards};
  for (int i = 0; i < 3; ++i) {
    // The depth's range is three times as far: what hangs over the body throws its shadow, too.
    const float scale = (i == 2 ? -1.0F / 3 : 1.0F) / (2 * radius);
    m.block<1, 3>(i, 0) = scale * axes[i]->transpose();
    m(i, 3) = 0.5F - scale * axes[i]->dot(centre);
  }
  return m;
}

}  // namespace

Result<ShadowPass> ShadowPass::create() {
  auto program = make_program("shadows", "", kVertex, kShadowFragment);
  if (!program.ok()) return program.error();
  ShadowPass pass;
  pass.program_ = std::move(program).value();
  return pass;
}

Status ShadowPass::begin(const ViewMatrices& view, const Eigen::Vector3f& centre, float radius) {
  if (map_.id() == 0) {
    map_ = make_map();
    target_ = make_framebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, target_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map_.id(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, target_.id());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return Error{ErrorCode::kInternal, "the context cannot draw shadows; switch them off", {}};
  }
  lookup_ = {to_light(view, centre, radius), kLiftTexels * 2 * radius / kSide};
  glViewport(0, 0, kSide, kSide);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2, 4);
  glClear(GL_DEPTH_BUFFER_BIT);
  glUseProgram(program_.id());
  glUniformMatrix4fv(location(program_, "to_light"), 1, GL_FALSE, lookup_.to_light.data());
  return {};
}

void ShadowPass::end() const {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_CLAMP);
}

void ShadowPass::bind(const GlObject& program, int unit) const {
  glUniform1i(location(program, "shadows"), unit);
  glUniformMatrix4fv(location(program, "to_light"), 1, GL_FALSE, lookup_.to_light.data());
  glUniform1f(location(program, "shadow_lift"), lookup_.lift);
  glActiveTexture(GL_TEXTURE0 + static_cast<unsigned>(unit));
  glBindTexture(GL_TEXTURE_2D, map_.id());
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace render
}  // namespace v0
}  // namespace incise
