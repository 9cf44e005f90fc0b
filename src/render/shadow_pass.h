// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "incise/core/result.h"
#include "render/gl_object.h"
#include "render/shadow_shaders.h"
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

}  // namespace render
}  // namespace v0
}  // namespace incise
