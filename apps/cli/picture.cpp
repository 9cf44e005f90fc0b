// SPDX-License-Identifier: Apache-2.0
// Where drawing was built in: a picture of `app` drawn by `render`, without a window.
#include "picture.h"

#include "app/view/cut_picture.h"
#include "app/view/label_picture.h"
#include "render/headless_context.h"
#include "render/image.h"
#include "render/render_picture.h"

namespace incise_cli {

using namespace incise;

Status check_drawing() {
  const Result<render::HeadlessContext> context = render::HeadlessContext::create();
  return context.ok() ? Status() : Status(context.error());
}

namespace {

Status draw(const app::Picture& picture, const app::Viewport& viewport, const std::filesystem::path& file) {
  const Result<render::Image> image = render::render_picture(picture, viewport);
  return image.ok() ? write_png(*image, file) : Status(image.error());
}

}  // namespace

Status draw_cut(const Engine& engine, app::FineView* fine, const std::filesystem::path& file) {
  const app::Viewport viewport;
  const Result<app::Picture> picture = app::picture_of_cut(engine.mesh(), engine.journal(), viewport, fine);
  return picture.ok() ? draw(*picture, viewport, file) : Status(picture.error());
}

Status draw_labels(const Engine& engine, const std::filesystem::path& file) {
  const app::Viewport viewport;
  return draw(app::picture_of_labels(engine.mesh(), engine.journal(), viewport), viewport, file);
}

}  // namespace incise_cli
