// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/picture.h"
#include "incise/core/result.h"
#include "render/image.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Draws one picture without a window, in a context of its own; whoever draws many keeps a `HeadlessContext`, a
/// `Renderer` and an `OffscreenTarget` instead.
///
/// Errors: as `HeadlessContext::create`, `Renderer::create` and `Renderer::draw`. No context is current afterwards.
/// Cost: tens of ms beside the drawing.
[[nodiscard]] Result<Image> render_picture(const app::Picture& picture, const app::Viewport& viewport,
                                           unsigned samples = 4);

}  // namespace render
}  // namespace v0
}  // namespace incise
