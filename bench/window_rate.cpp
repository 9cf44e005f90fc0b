// SPDX-License-Identifier: Apache-2.0
// Whether drawing slows the simulation: steps per second of a body that moves, alone and while its pictures are drawn.
// usage: bench_window_rate [--quick] [--out FOLDER]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "app/session/session_thread.h"
#include "app/view/scene_camera.h"
#include "render/headless_context.h"
#include "render/offscreen_target.h"
#include "render/renderer.h"

namespace {

using namespace incise;
using Clock = std::chrono::steady_clock;

constexpr double kMust = 0.95;

struct Options {
  double seconds = 6;  // per run
  int rounds = 3;
  std::filesystem::path folder = "bench-results";
};

/// A block that a hook keeps swinging, so that all of it moves all the time.
app::Scene swinging_block() {
  app::Scene scene;
  scene.model.box.cells = {16, 16, 16};
  scene.options.body.length_unit = 0.1;
  scene.options.materials.fallback.young = 5e3;
  scene.attachments.push_back({app::HalfSpace{Vec3::UnitZ(), 0.001}});
  app::SceneHook hook;
  hook.radius = 0.3;
  for (int i = 0; i < 4000; ++i) {
    hook.times.push_back(0.25 * i);
    hook.positions.emplace_back(i % 2 == 0 ? 0.3 : 0.7, 0.5, 1);
  }
  scene.hooks.push_back(hook);
  scene.frames = app::kMaxSceneFrames;
  return scene;
}

/// What draws while the simulation runs.
struct Drawing {
  render::HeadlessContext context;
  render::Renderer renderer;
  render::OffscreenTarget target;
  app::Viewport viewport;
};

Result<Drawing> make_drawing(const app::Viewport& viewport) {
  Result<render::HeadlessContext> context = render::HeadlessContext::create();
  if (!context.ok()) return context.error();
  Result<render::Renderer> renderer = render::Renderer::create(0);
  if (!renderer.ok()) return renderer.error();
  Result<render::OffscreenTarget> target = render::OffscreenTarget::create(viewport);
  if (!target.ok()) return target.error();
  return Drawing{std::move(context).value(), std::move(renderer).value(), std::move(target).value(), viewport};
}

struct Rate {
  double steps = 0, pictures = 0;  // per second
};

/// Draws each new view, at most 60 a second as a window does; nothing without a drawing.
Rate run(Drawing* drawing, double seconds) {
  app::SessionThreadOptions options;
  options.speed = 0;
  app::SessionThread session(app::Session::open(swinging_block()).value(), options);
  const auto begin = Clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::optional<std::uint64_t> first;
  double since = 0;
  std::uint64_t pictures = 0;
  app::Picture picture;
  while (passed() < seconds) {
    std::this_thread::sleep_for(std::chrono::microseconds(16'667));
    if (!session.take()) continue;
    if (!first) {
      first = session.view().figures.frames;
      since = passed();
      picture.camera = camera_of(*session.view().scene, session.view().body, {1280, 720});
      picture.options.shows_occlusion = false;
    }
    if (drawing == nullptr) continue;
    picture.surface = session.view().surface;
    if (!drawing->renderer.draw(picture, drawing->viewport, drawing->target.framebuffer()).ok()) break;
    if (drawing->viewport.width > 16 && !drawing->target.read().ok()) break;  // waits for the rasteriser
    ++pictures;
  }
  const double time = passed() - since;
  return {static_cast<double>(session.view().figures.frames - first.value_or(0)) / time,
          static_cast<double>(pictures) / time};
}

void report(const char* what, const Rate& alone, const Rate& rate, std::ofstream& table) {
  std::printf("%-34s %8.1f steps/s %8.1f pictures/s   ratio %.3f\n", what, rate.steps, rate.pictures,
              rate.steps / alone.steps);
  table << what << ',' << rate.steps << ',' << rate.pictures << ',' << rate.steps / alone.steps << '\n';
}

Rate best(const Rate& a, const Rate& b) {
  return a.steps > b.steps ? a : b;
}

}  // namespace

int main(int argc, char** argv) {
  setenv("LP_NUM_THREADS", "1", 0);  // as the window does
  Options options;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) options.seconds = 3, options.rounds = 1;
    if (std::strcmp(argv[i], "--out") == 0 && i + 1 < argc) options.folder = argv[++i];
  }
  Rate alone, handed, drawn;
  for (int round = 0; round < options.rounds; ++round) {  // in turns, so that all have the same machine
    alone = best(alone, run(nullptr, options.seconds));
    for (const bool is_whole : {false, true}) {
      Result<Drawing> drawing = make_drawing(is_whole ? app::Viewport{1280, 720} : app::Viewport{8, 8});
      if (!drawing.ok()) {
        std::printf("skipped: %s\n", drawing.error().message.c_str());
        return 0;
      }
      Rate& rate = is_whole ? drawn : handed;
      rate = best(rate, run(&*drawing, options.seconds));
    }
  }
  std::filesystem::create_directories(options.folder);
  std::ofstream table(options.folder / "window_rate.csv");
  table << "what,steps_per_s,pictures_per_s,ratio\n";
  report("alone", alone, alone, table);
  report("drawn at 8 x 8: without rasteriser", alone, handed, table);
  report("drawn at 1280 x 720", alone, drawn, table);
  std::printf("must: %.2f without the rasteriser: %s\n", kMust, handed.steps >= kMust * alone.steps ? "met" : "NO");
  return 0;
}
