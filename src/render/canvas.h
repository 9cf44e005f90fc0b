// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/camera.h"
#include "render/gl_object.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Where a picture is drawn before it is shown: colour and depth with several samples per pixel, and one of each.
class Canvas {
 public:
  /// Makes it fit. Errors: kOutOfMemory, kInternal. Fewer samples where the context has fewer.
  Status fit(const app::Viewport& viewport, unsigned samples);

  /// Draws go to all samples.
  void bind() const;
  /// One depth per pixel, in `depth`. Leaves the samples bound.
  void resolve_depth() const;
  /// Copies the colours to a framebuffer's lower left, and leaves that bound.
  void show(unsigned framebuffer) const;

  [[nodiscard]] const GlObject& depth() const { return depth_; }
  [[nodiscard]] unsigned samples() const { return samples_; }

 private:
  [[nodiscard]] Status build(const app::Viewport& viewport, unsigned samples);
  void build_sampled();
  void build_plain();
  void build_depth();
  [[nodiscard]] unsigned drawn() const { return samples_ > 0 ? sampled_.id() : plain_.id(); }
  void copy(unsigned from, unsigned to, unsigned what) const;

  app::Viewport viewport_{0, 0};
  unsigned samples_ = 0;
  GlObject sampled_, sampled_color_, sampled_depth_;  // none without samples
  GlObject plain_, color_, plain_depth_;
  GlObject depth_copy_, depth_;  // apart: what is drawn into cannot be looked up meanwhile
};

}  // namespace render
}  // namespace v0
}  // namespace incise
