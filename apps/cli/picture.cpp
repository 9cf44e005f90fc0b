// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include "app/view/cut_picture.h"
#include "render/headless_context.h"
#include "render/image.h"
#include "render/render_picture.h"

namespace incise_cli {

using namespace incise;

Status check_drawing() {
  const Result<render::HeadlessContext> context = render::HeadlessContext::create();
  return context.ok() ? Status() : Status(context.error());
}

Status draw_cut(const Engine& engine, const std::filesystem::path& file) {
  const app::Viewport viewport;
  const app::Picture picture = app::picture_of_cut(engine.mesh(), engine.journal(), viewport);
  const Result<render::Image> image = render::render_picture(picture, viewport);
  return image.ok() ? write_png(*image, file) : Status(image.error());
}

}  // namespace incise_cli
