// SPDX-License-Identifier: Apache-2.0
// What JavaScript sees of the module; bindings/web/index.mjs wraps it.
#include <emscripten/bind.h>
#include <emscripten/heap.h>
#include <malloc.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/tool_table.h"
#include "app/scene/view_names.h"
#include "app/view/color_map.h"
#include "incise/version.h"
#include "render/ink_style.h"
#include "render/marks_shaders.h"
#include "render/noise.h"
#include "render/shadow_shaders.h"
#include "render/solid_shaders.h"
#include "render/surface_shaders.h"
#include "web_engine.h"
#include "web_session.h"

namespace incise_web {

namespace render = incise::render;

namespace {

/// Bytes of the module's memory: what objects hold, and what it has taken from the machine, which never shrinks.
val memory() {
  val bytes = val::object();
  bytes.set("used", static_cast<double>(static_cast<unsigned>(mallinfo().uordblks)));
  bytes.set("taken", static_cast<double>(emscripten_get_heap_size()));
  return bytes;
}

template <class Number, std::size_t kCount>
val to_list(const std::array<Number, kCount>& list) {
  val numbers = val::array();
  for (const Number number : list) numbers.call<void>("push", number);
  return numbers;
}

/// The names of the tools, in the order of their numbers.
val tools() {
  val names = val::array();
  for (const incise::app::ToolRow& row : incise::app::kTools) names.call<void>("push", std::string(row.name));
  return names;
}

val names_of_colors() {
  val names = val::array();
  for (const std::string_view name : incise::app::kColorNames) names.call<void>("push", std::string(name));
  return names;
}

val shader(const std::string& vertex, const std::string& fragment) {
  val pair = val::object();
  pair.set("vertex", vertex);
  pair.set("fragment", fragment);
  return pair;
}

/// The window's own shaders. Those of surfaces and solids have shadows where SHADOWS is defined.
val shaders() {
  const std::string marks = render::kMarksPrelude, shade = render::kShadowFunction;
  val all = val::object();
  all.set("surface", shader(render::kSurfaceVertex, shade + render::kSurfaceFragment));
  all.set("solids", shader(render::kSolidVertex, shade + render::kSolidFragment));
  all.set("lines", shader(marks + render::kLineVertex, marks + render::kLineFragment));
  all.set("rims", shader(marks + render::kRimVertex, marks + render::kRimFragment));
  all.set("balls", shader(marks + render::kBallVertex, marks + render::kBallFragment));
  all.set("triangles", shader(marks + render::kFillVertex, marks + render::kFillFragment));
  return all;
}

/// Colours of labels, then of quality; RGBA.
std::vector<std::uint8_t> palette() {
  std::vector<std::uint8_t> bytes;
  const auto add = [&](const incise::app::Color& color) {
    bytes.insert(bytes.end(), color.begin(), color.end());
    bytes.push_back(255);
  };
  for (unsigned i = 0; i < 256; ++i) add(incise::app::label_color(i));
  for (unsigned i = 0; i < 256; ++i) add(incise::app::quality_color(static_cast<std::uint8_t>(i)));
  return bytes;
}

/// How the window draws: shaders, patterns, colours of labels and of quality, inks and grounds of a theme.
val look(bool is_dark) {
  const auto theme = is_dark ? incise::app::Theme::kDark : incise::app::Theme::kLight;
  val inks = val::array();
  for (const render::InkStyle& style : render::ink_styles(theme)) {
    val ink = val::object();
    ink.set("color", to_list(style.color));
    ink.set("casing", to_list(style.casing));
    ink.set("shapes", to_list(std::array{static_cast<int>(style.line), static_cast<int>(style.ball),
                                         static_cast<int>(style.fill)}));
    inks.call<void>("push", ink);
  }
  const render::Grounds grounds = render::grounds_of(theme);
  val value = val::object();
  value.set("shaders", shaders());
  value.set("palette", copy_of("Uint8Array", palette()));
  value.set("noise", copy_of("Uint8Array", render::noise_values()));
  value.set("noiseSide", render::kNoiseSide);
  value.set("redFrom", incise::app::quality_byte(incise::app::kRedRatio));
  value.set("inks", inks);
  value.set("top", to_list(grounds.top));
  value.set("bottom", to_list(grounds.bottom));
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
  emscripten::function("memory", &incise_web::memory);
  emscripten::function("colors", &incise_web::names_of_colors);
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
      .function("chooseColor", &WebSession::choose_color)
      .function("figures", &WebSession::figures)
      .function("quality", &WebSession::quality)
      .function("log", &WebSession::log)
      .function("recording", &WebSession::recording)
      .function("write", &WebSession::write)
      .property("tool", &WebSession::tool)
      .property("color", &WebSession::color)
      .property("depth", &WebSession::depth)
      .property("isBusy", &WebSession::is_busy)
      .property("isReplay", &WebSession::is_replay)
      .property("pieces", &WebSession::pieces)
      .property("title", &WebSession::title)
      .property("hash", &WebSession::hash)
      .property("meshHash", &WebSession::mesh_hash);
}
