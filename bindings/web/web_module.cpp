// SPDX-License-Identifier: Apache-2.0
// What JavaScript sees of the module; bindings/web/index.mjs wraps it.
#include <emscripten/bind.h>

#include "app/hands/tool_table.h"
#include "app/view/color_map.h"
#include "incise/version.h"
#include "render/ink_style.h"
#include "render/surface_shaders.h"
#include "web_engine.h"
#include "web_session.h"

namespace incise_web {
namespace {

val to_css(const std::array<float, 3>& color) {
  val numbers = val::array();
  for (const float channel : color) numbers.call<void>("push", channel);
  return numbers;
}

/// The names of the tools, in the order of their numbers.
val tools() {
  val names = val::array();
  for (const incise::app::ToolRow& row : incise::app::kTools) names.call<void>("push", std::string(row.name));
  return names;
}

/// How the window draws: shaders, colours of labels and of quality, inks and grounds of a theme.
val look(bool is_dark) {
  const auto theme = is_dark ? incise::app::Theme::kDark : incise::app::Theme::kLight;
  std::vector<std::uint8_t> palette;
  for (unsigned i = 0; i < 256; ++i) {
    for (const std::uint8_t channel : incise::app::label_color(i)) palette.push_back(channel);
    palette.push_back(255);
  }
  for (unsigned i = 0; i < 256; ++i) {
    for (const std::uint8_t channel : incise::app::quality_color(static_cast<std::uint8_t>(i)))
      palette.push_back(channel);
    palette.push_back(255);
  }
  val inks = val::array();
  for (const incise::render::InkStyle& style : incise::render::ink_styles(theme)) {
    inks.call<void>("push", to_css(style.color));
  }
  const incise::render::Grounds grounds = incise::render::grounds_of(theme);
  val value = val::object();
  value.set("vertexShader", std::string(incise::render::kSurfaceVertex));
  value.set("fragmentShader", std::string(incise::render::kSurfaceFragment));
  value.set("palette", copy_of("Uint8Array", palette));
  value.set("inks", inks);
  value.set("top", to_css(grounds.top));
  value.set("bottom", to_css(grounds.bottom));
  value.set("rim", grounds.rim);
  return value;
}

}  // namespace
}  // namespace incise_web

EMSCRIPTEN_BINDINGS(incise) {
  using incise_web::WebEngine;
  using incise_web::WebSession;
  emscripten::constant("version", std::string(INCISE_VERSION));
  emscripten::function("tools", &incise_web::tools);
  emscripten::function("look", &incise_web::look);
  emscripten::class_<WebEngine>("Engine")
      .smart_ptr<std::shared_ptr<WebEngine>>("EnginePointer")
      .class_function("open", &WebEngine::open)
      .function("cut", &WebEngine::cut)
      .function("cutPlane", &WebEngine::cut_plane)
      .function("improve", &WebEngine::improve)
      .function("undo", &WebEngine::undo)
      .function("redo", &WebEngine::redo)
      .function("write", &WebEngine::write)
      .function("points", &WebEngine::points)
      .function("tets", &WebEngine::tets)
      .function("quality", &WebEngine::quality)
      .property("tetCount", &WebEngine::tet_count)
      .property("vertexCount", &WebEngine::vertex_count)
      .property("pieces", &WebEngine::pieces)
      .property("hash", &WebEngine::hash);
  emscripten::class_<WebSession>("Session")
      .smart_ptr<std::shared_ptr<WebSession>>("SessionPointer")
      .class_function("open", &WebSession::open)
      .function("resize", &WebSession::resize)
      .function("pointer", &WebSession::pointer)
      .function("choose", &WebSession::choose)
      .function("cancel", &WebSession::cancel)
      .function("setDepth", &WebSession::set_depth)
      .function("frameBody", &WebSession::frame_body)
      .function("frame", &WebSession::frame)
      .function("undo", &WebSession::undo)
      .function("redo", &WebSession::redo)
      .function("reset", &WebSession::reset)
      .function("place", &WebSession::place)
      .function("seek", &WebSession::seek)
      .function("takeOver", &WebSession::take_over)
      .function("refresh", &WebSession::refresh)
      .function("surface", &WebSession::surface)
      .function("camera", &WebSession::camera)
      .function("marks", &WebSession::marks)
      .function("figures", &WebSession::figures)
      .function("quality", &WebSession::quality)
      .function("log", &WebSession::log)
      .function("recording", &WebSession::recording)
      .function("write", &WebSession::write)
      .property("tool", &WebSession::tool)
      .property("depth", &WebSession::depth)
      .property("isBusy", &WebSession::is_busy)
      .property("isReplay", &WebSession::is_replay)
      .property("pieces", &WebSession::pieces)
      .property("title", &WebSession::title)
      .property("hash", &WebSession::hash)
      .property("meshHash", &WebSession::mesh_hash);
}
