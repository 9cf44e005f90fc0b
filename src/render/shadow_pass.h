// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "incise/core/result.h"
#include "render/gl_object.h"
#include "render/view_matrices.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Where a shader finds the shadow map.
struct ShadowLookup {
  Eigen::Matrix4f to_light = Eigen::Matrix4f::Identity();  ///< world to the map: x, y and depth in [0, 1]
  float lift = 0;  ///< length units along the normal from which a surface looks, so that it throws none on itself
};

/// A picture of depths as the key light sees the scene.
class ShadowPass {
 public:
  static Result<ShadowPass> create();

  /// Clears the map and aims the light at a ball. What is drawn until `end` throws shadows: positions in the world at
  /// attribute 0. Errors: kInternal where the context cannot draw depths alone.
  Status begin(const ViewMatrices& view, const Eigen::Vector3f& centre, float radius);
  void end() const;

  [[nodiscard]] const ShadowLookup& lookup() const { return lookup_; }
  /// Tells a program compiled with `SHADOWS` where the map is, at a texture unit.
  void bind(const GlObject& program, int unit) const;

 private:
  GlObject program_, map_, target_;
  ShadowLookup lookup_;
};

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
