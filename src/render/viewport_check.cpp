// SPDX-License-Identifier: Apache-2.0
// Asks the driver for its two limits and takes the smaller one.
#include "render/viewport_check.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <string>

namespace incise {
inline namespace v0 {
namespace render {

Status check_viewport(const app::Viewport& viewport) {
  std::array<GLint, 2> most = {0, 0};
  GLint side = 0;
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, most.data());
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &side);
  const int width = std::min(most[0], side), height = std::min(most[1], side);
  if (viewport.width >= 1 && viewport.height >= 1 && viewport.width <= width && viewport.height <= height) return {};
  return Error{ErrorCode::kBadArgument,
               "a picture of " + std::to_string(viewport.width) + " by " + std::to_string(viewport.height) +
                   " pixels cannot be drawn; choose 1 to " + std::to_string(width) + " by 1 to " +
                   std::to_string(height),
               {}};
}

}  // namespace render
}  // namespace v0
}  // namespace incise
