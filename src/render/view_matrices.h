// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "app/view/camera.h"

namespace incise {
inline namespace v0 {
namespace render {

/// A camera as shaders take it.
struct ViewMatrices {
  Eigen::Matrix4f to_view, to_clip;
  app::Viewport viewport;
  float pixel_scale = 0;  ///< length units per pixel at depth 1
  float scene_size = 1;   ///< diagonal of the scene's box, length units
};

}  // namespace render
}  // namespace v0
}  // namespace incise
