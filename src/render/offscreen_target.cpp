// SPDX-License-Identifier: Apache-2.0
// A renderbuffer instead of a window; rows are turned on reading, since OpenGL begins at the bottom.
#include "render/offscreen_target.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "render/gl_object.h"
#include "render/viewport_check.h"

namespace incise {
inline namespace v0 {
namespace render {

struct OffscreenTarget::State {
  app::Viewport viewport;
  GlObject framebuffer, color;
};

OffscreenTarget::OffscreenTarget(std::unique_ptr<State> state) : state_(std::move(state)) {}
OffscreenTarget::OffscreenTarget(OffscreenTarget&&) noexcept = default;
OffscreenTarget& OffscreenTarget::operator=(OffscreenTarget&&) noexcept = default;
OffscreenTarget::~OffscreenTarget() = default;

Result<OffscreenTarget> OffscreenTarget::create(const app::Viewport& viewport) {
  if (const Status status = check_viewport(viewport); !status.ok()) return status.error();
  auto state = std::make_unique<State>();
  state->viewport = viewport;
  state->color = make_renderbuffer();
  state->framebuffer = make_framebuffer();
  glBindRenderbuffer(GL_RENDERBUFFER, state->color.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, viewport.width, viewport.height);
  glBindFramebuffer(GL_FRAMEBUFFER, state->framebuffer.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, state->color.id());
  const bool is_complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (const Status status = check_gl("making an offscreen target"); !status.ok()) return status.error();
  if (!is_complete) return Error{ErrorCode::kInternal, "the context cannot draw offscreen at this size", {}};
  return OffscreenTarget(std::move(state));
}

unsigned OffscreenTarget::framebuffer() const {
  return state_->framebuffer.id();
}

const app::Viewport& OffscreenTarget::viewport() const {
  return state_->viewport;
}

Result<Image> OffscreenTarget::read() const {
  return read_framebuffer(framebuffer(), viewport());
}

Result<Image> read_framebuffer(unsigned framebuffer, const app::Viewport& viewport) {
  if (const Status status = check_viewport(viewport); !status.ok()) return status.error();
  const auto width = static_cast<std::size_t>(viewport.width), height = static_cast<std::size_t>(viewport.height);
  Image image{viewport.width, viewport.height, std::vector<Image::Pixel>(width * height)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, viewport.width, viewport.height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
  if (const Status status = check_gl("reading a picture"); !status.ok()) return status.error();
  // OpenGL's first row is the lowest.
  for (std::size_t y = 0; y < height / 2; ++y) {
    const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y * width);
    const auto other = image.pixels.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * width);
    std::swap_ranges(row, row + static_cast<std::ptrdiff_t>(width), other);
  }
  for (Image::Pixel& pixel : image.pixels) pixel[3] = 255;  // what blending left there means nothing
  return image;
}

}  // namespace render
}  // namespace v0
}  // namespace incise
