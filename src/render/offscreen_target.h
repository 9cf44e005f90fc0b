// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "app/view/camera.h"
#include "incise/core/result.h"
#include "render/image.h"

namespace incise {
inline namespace v0 {
namespace render {

/// A framebuffer of RGBA8 pixels that is no window: for headless runs, and for a window that saves what it shows.
///
/// Lives in the context that was current when it was created, and must be destroyed while that is current.
class OffscreenTarget {
 public:
  /// Errors: kBadArgument for a size below 1 or above what the context can draw; kOutOfMemory.
  static Result<OffscreenTarget> create(const app::Viewport& viewport);

  OffscreenTarget(OffscreenTarget&&) noexcept;
  OffscreenTarget& operator=(OffscreenTarget&&) noexcept;
  ~OffscreenTarget();

  /// OpenGL's name of the framebuffer, for `Renderer::draw`.
  [[nodiscard]] unsigned framebuffer() const;
  [[nodiscard]] const app::Viewport& viewport() const;
  /// What was drawn into it. Waits until it is finished. Errors: kInternal where OpenGL refuses.
  [[nodiscard]] Result<Image> read() const;

 private:
  struct State;
  explicit OffscreenTarget(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The pixels of any framebuffer of the current context, 0 for the window's. Errors: as `OffscreenTarget::read`.
[[nodiscard]] Result<Image> read_framebuffer(unsigned framebuffer, const app::Viewport& viewport);

}  // namespace render
}  // namespace v0
}  // namespace incise
