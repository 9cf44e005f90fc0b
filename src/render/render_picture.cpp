// SPDX-License-Identifier: Apache-2.0
// Context, renderer and target for one picture, in the order in which they must be destroyed.
#include "render/render_picture.h"

#include "render/headless_context.h"
#include "render/offscreen_target.h"
#include "render/renderer.h"

namespace incise {
inline namespace v0 {
namespace render {

Result<Image> render_picture(const app::Picture& picture, const app::Viewport& viewport, unsigned samples) {
  const Result<HeadlessContext> context = HeadlessContext::create();
  if (!context.ok()) return context.error();
  Result<Renderer> renderer = Renderer::create(samples);
  if (!renderer.ok()) return renderer.error();
  const Result<OffscreenTarget> target = OffscreenTarget::create(viewport);
  if (!target.ok()) return target.error();
  const Status drawn = renderer->draw(picture, viewport, target->framebuffer());
  if (!drawn.ok()) return drawn.error();
  return target->read();
}

}  // namespace render
}  // namespace v0
}  // namespace incise
