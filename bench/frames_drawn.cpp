// SPDX-License-Identifier: Apache-2.0
// The paper's Table 2 whole: frames per second and the four shares of a frame, drawing among them.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "app/scene/scene_simulation.h"
#include "app/view/scene_camera.h"
#include "app/view/surface_view.h"
#include "frames_run.h"
#include "render/headless_context.h"
#include "render/offscreen_target.h"
#include "render/renderer.h"

namespace incise::bench {

namespace {

constexpr app::Viewport kScreen{640, 480};

/// A row of Table 2 as printed: frames per second, and shares of the time in %.
struct PaperRow {
  const char* name;
  const char* file;
  double fps, relax, collision, draw, modify;
};

constexpr std::array<PaperRow, 5> kRows = {{{"CUBE straight", "sim_cube", 152.3, 8.6, 52.8, 30.3, 8.3},
                                            {"CUBE complex", "sim_cube_complex", 91.1, 8.5, 59.6, 22.5, 9.4},
                                            {"MEAT", "sim_meat", 66.5, 8.1, 34.1, 18.9, 38.9},
                                            {"SPINE", "sim_spine", 20.2, 10.8, 36.8, 9.0, 43.4},
                                            {"BUNNY", "sim_bunny", 13.1, 9.6, 40.1, 7.3, 43.0}}};

struct Settings {
  std::filesystem::path folder = "bench-results", root = ".";
  std::string only;
  unsigned repeats = 5;
};

/// Of drawing one frame, in ms of processor time.
struct DrawTime {
  double caller = 0;  ///< of the thread that draws: following the surface, and the commands
  double all = 0;     ///< of all threads until the picture is finished: a software rasteriser's too
};

/// Mean ms of a frame with a blade.
struct Means {
  Shares stages;
  DrawTime draw;
  std::size_t frames = 0, tets_after = 0;
  std::uint64_t hash = 0;
  /// All that changes the mesh or follows its change; the paper has no other place for it.
  [[nodiscard]] double modify() const { return stages.modify + stages.follow + stages.rest; }
};

double process_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Where all pictures go.
struct Screen {
  render::Renderer renderer;
  render::OffscreenTarget target;
  bool is_software = false;
};

/// Draws the frames of one simulation.
class Painter {
 public:
  Painter(const app::Scene& scene, const Simulation& simulation, Screen& screen)
      : screen_(screen), surface_(simulation.mesh(), simulation.engine().journal()) {
    surface_.fill(simulation.mesh(), picture_.surface);
    picture_.camera = app::camera_of(scene, bounds_of(picture_.surface), kScreen);
    picture_.options = app::view_options_of(scene);
    picture_.options.shows_occlusion = !screen.is_software;  // as the window has it
  }

  Result<DrawTime> draw(const Simulation& simulation, const FrameInput& input);

 private:
  void mark(const FrameInput& input);

  Screen& screen_;
  app::SurfaceView surface_;
  app::Picture picture_;
};

void Painter::mark(const FrameInput& input) {
  picture_.marks = {};
  if (!input.blade) return;
  const std::vector<Vec3>& edge = input.blade->edge;
  for (std::size_t i = 1; i < edge.size(); ++i) {
    picture_.marks.lines.push_back(
        {edge[i - 1].cast<float>(), edge[i].cast<float>(), app::Ink::kBlade, 4, true, false});
  }
}

Result<DrawTime> Painter::draw(const Simulation& simulation, const FrameInput& input) {
  const double caller = thread_ms(), all = process_ms();
  surface_.follow(simulation.mesh(), simulation.engine().journal());
  surface_.fill(simulation.mesh(), picture_.surface);
  mark(input);
  if (const Status status = screen_.renderer.draw(picture_, kScreen, screen_.target.framebuffer()); !status.ok()) {
    return status.error();
  }
  DrawTime time;
  time.caller = thread_ms() - caller;
  // Reading one pixel waits as glFinish does.
  const auto pixel = render::read_framebuffer(screen_.target.framebuffer(), {1, 1});
  if (!pixel.ok()) return pixel.error();
  time.all = process_ms() - all;
  return time;
}

Result<Means> run_drawn(const app::Scene& scene, TetMesh mesh, Screen& screen) {
  Result<Simulation> simulation = app::make_simulation(scene, std::move(mesh), 1);
  if (!simulation.ok()) return simulation.error();
  const Result<unsigned> settled = simulation->settle(scene.settle.frames, scene.settle.speed);
  if (!settled.ok()) return settled.error();
  Painter painter(scene, *simulation, screen);
  SceneRun run;
  std::vector<double> caller, all;
  for (std::uint64_t i = 0; i < scene.frames; ++i) {
    const FrameInput input = app::scene_input(scene, i);
    run.frames.push_back(time_frame(*simulation, input));
    const Result<DrawTime> drawn = painter.draw(*simulation, input);
    if (!drawn.ok()) return drawn.error();
    if (!run.frames.back().has_blade) continue;
    caller.push_back(drawn->caller);
    all.push_back(drawn->all);
  }
  return Means{
      shares_of(run), {mean(caller), mean(all)}, caller.size(), simulation->mesh().tet_count(), simulation->hash()};
}

template <class Figure>
double middle(const std::vector<Means>& runs, const Figure& figure) {
  std::vector<double> values;
  for (const Means& run : runs) values.push_back(figure(run));
  return median(values);
}

/// The medians of the runs.
Means middle_of(const std::vector<Means>& runs) {
  Means m = runs.front();
  m.stages = {};
  m.stages.collision = middle(runs, [](const Means& r) { return r.stages.collision; });
  m.stages.relax = middle(runs, [](const Means& r) { return r.stages.relax; });
  m.stages.modify = middle(runs, [](const Means& r) { return r.modify(); });
  m.draw.caller = middle(runs, [](const Means& r) { return r.draw.caller; });
  m.draw.all = middle(runs, [](const Means& r) { return r.draw.all; });
  return m;
}

void add_row(const PaperRow& paper, Profile profile, const std::string& what, const Means& m, double draw,
             Table& table) {
  const double undrawn = m.stages.collision + m.stages.relax + m.modify(), whole = undrawn + draw;
  const auto share = [&](double part) { return number(100 * part / whole, 1); };
  table.add({paper.name, profile == Profile::kPaper ? "paper" : "incise", what, std::to_string(m.frames),
             number(m.stages.collision, 3), number(m.modify(), 3), number(m.stages.relax, 3), number(draw, 3),
             number(1e3 / whole, 0), share(m.stages.collision), share(m.modify()), share(m.stages.relax), share(draw),
             number(paper.fps, 1), number(paper.collision, 1), number(paper.modify, 1), number(paper.relax, 1),
             number(paper.draw, 1)});
}

void measure(const PaperRow& paper, Profile profile, const Settings& settings, Screen& screen, Table& table) {
  Result<app::Scene> scene = app::read_scene(settings.root / "scenes" / (std::string(paper.file) + ".json"));
  const Result<io::LoadedMesh> loaded = scene.ok() ? app::load_model(*scene) : Result<io::LoadedMesh>(scene.error());
  if (!loaded.ok()) {
    std::fprintf(stderr, "%s is left out: %s\n", paper.name, loaded.error().message.c_str());
    return;
  }
  scene->options.engine.cut.profile = profile;
  std::vector<Means> runs;
  for (unsigned i = 0; i < settings.repeats; ++i) {
    const Result<Means> run = run_drawn(*scene, loaded->mesh, screen);
    if (!run.ok()) {
      std::fprintf(stderr, "%s: %s\n", paper.name, run.error().message.c_str());
      return;
    }
    runs.push_back(*run);
    if (run->hash != runs.front().hash) std::fprintf(stderr, "%s: two runs differ\n", paper.name);
  }
  const Means m = middle_of(runs);
  add_row(paper, profile, "draw call", m, m.draw.caller, table);
  add_row(paper, profile, "finished", m, m.draw.all, table);
}

std::string caption(const render::HeadlessContext& context) {
  const char* who = context.is_software() ? "; the processor rasterises" : "";
  return fmt::format(
      "Table 2 with drawing into {} x {} pixels by {}{}. Mean ms and shares of a frame with a blade, processor time, "
      "medians of the runs. RD: of the thread that draws (draw call), and of all threads until the picture is "
      "finished. "
      "GM: with the solver's following of the mesh, and what no stage claims",
      kScreen.width, kScreen.height, context.renderer_name(), who);
}

int report(const Settings& settings) {
  setenv("LP_NUM_THREADS", "1", 0);  // one thread of a software rasteriser, as in the window
  const Result<render::HeadlessContext> context = render::HeadlessContext::create();
  if (!context.ok()) {
    std::printf("\nTable 2 with drawing: skipped, %s\n", context.error().message.c_str());
    return EXIT_SUCCESS;
  }
  Result<render::Renderer> renderer = render::Renderer::create(context->is_software() ? 0 : 4);
  Result<render::OffscreenTarget> target = render::OffscreenTarget::create(kScreen);
  if (!renderer.ok() || !target.ok()) {
    std::fprintf(stderr, "bench_frames_drawn: %s\n",
                 (renderer.ok() ? target.error() : renderer.error()).message.c_str());
    return EXIT_FAILURE;
  }
  Screen screen{std::move(renderer).value(), std::move(target).value(), context->is_software()};
  Table table("table2_with_drawing", caption(*context),
              {"scene", "profile", "RD is", "frames", "CD", "GM", "RLX", "RD", "fps", "CD %", "GM %", "RLX %", "RD %",
               "printed fps", "CD %", "GM %", "RLX %", "RD %"});
  for (const PaperRow& row : kRows) {
    if (!settings.only.empty() && settings.only != row.file) continue;
    for (const Profile profile : {Profile::kPaper, Profile::kIncise}) measure(row, profile, settings, screen, table);
  }
  table.print();
  table.write_csv(settings.folder);
  return EXIT_SUCCESS;
}

constexpr const char* kUsage =
    "usage: bench_frames_drawn [--out FOLDER] [--root FOLDER] [--quick] [--repeats N] [--only SCENE]\n"
    "Measures the frames of the paper's five scenes in ROOT/scenes while the blade cuts, and draws each, in both "
    "profiles.\n";

int parse_and_run(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      settings.repeats = 3;
    } else if (argument == "--out" && i + 1 < argc) {
      settings.folder = argv[++i];
    } else if (argument == "--root" && i + 1 < argc) {
      settings.root = argv[++i];
    } else if (argument == "--only" && i + 1 < argc) {
      settings.only = argv[++i];
    } else if (argument == "--repeats" && i + 1 < argc) {
      settings.repeats = static_cast<unsigned>(std::max(1, std::atoi(argv[++i])));
    } else {
      const bool is_help = argument == "-h" || argument == "--help";
      std::fputs(kUsage, is_help ? stdout : stderr);
      return is_help ? 0 : 2;
    }
  }
  return report(settings);
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::parse_and_run(argc, argv);
}
