// SPDX-License-Identifier: Apache-2.0
// What a picture costs the thread that draws it, and what the rasteriser takes, told apart.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "render/headless_context.h"
#include "render/offscreen_target.h"
#include "render/renderer.h"
#include "report.h"

namespace incise::bench {

namespace {

constexpr std::uint32_t kMeridians = 224, kParallels = 224;  // about 100 000 triangles at 50 000 points
constexpr std::uint32_t kFewParallels = 50;                  // about 22 000 triangles
constexpr app::Viewport kScreen{1280, 720};
constexpr double kMostMs = 1;  // of the calling thread beside the rasteriser

enum class Moves { kAll, kOne, kNone };

struct Case {
  std::string name;
  std::uint32_t rows;
  app::Viewport viewport;
  Moves moves;
  bool has_occlusion;
  unsigned samples;
};

/// Of the middle frame, in ms.
struct Cost {
  std::size_t triangles = 0, points = 0, bytes = 0;
  double compare = 0, normals = 0, upload = 0, submit = 0, frame = 0;
  [[nodiscard]] double prepared() const { return compare + normals + upload; }
};

Eigen::Vector3f on_sphere(std::uint32_t i, std::uint32_t j, std::uint32_t rows, double phase) {
  const double u = 2 * std::numbers::pi * i / kMeridians, v = std::numbers::pi * (j + 0.5) / rows;
  const double r = 1 + 0.02 * std::sin(9 * u + phase) * std::sin(7 * v);
  return Vec3(r * std::sin(v) * std::cos(u), r * std::sin(v) * std::sin(u), r * std::cos(v)).cast<float>();
}

std::vector<Eigen::Vector3f> positions_of(std::uint32_t rows, double phase) {
  std::vector<Eigen::Vector3f> positions;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i < kMeridians; ++i) positions.push_back(on_sphere(i, j, rows, phase));
  }
  return positions;
}

app::Picture sphere(std::uint32_t rows) {
  app::Picture picture;
  picture.surface.positions = positions_of(rows, 0);
  auto topology = std::make_shared<app::SurfaceTopology>();
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < kMeridians; ++i) {
      const std::uint32_t a = j * kMeridians + i, b = j * kMeridians + (i + 1) % kMeridians;
      topology->triangles.push_back({a, a + kMeridians, b + kMeridians});
      topology->triangles.push_back({a, b + kMeridians, b});
    }
  }
  topology->looks.assign(topology->triangles.size(), {0, 0, 0, 0});
  topology->sides.resize(topology->triangles.size());
  topology->vertices.resize(picture.surface.positions.size());
  topology->used = topology->triangles.size();
  picture.surface.topology = topology;
  app::frame_all(picture.camera, kScreen, app::bounds_of(picture.surface));
  return picture;
}

double middle(const std::vector<Cost>& frames, double Cost::*what) {
  std::vector<double> values;
  for (const Cost& frame : frames) values.push_back(frame.*what);
  return median(values);
}

Cost middle_of(const std::vector<Cost>& frames) {
  Cost cost = frames.back();
  for (double Cost::*what : {&Cost::compare, &Cost::normals, &Cost::upload, &Cost::submit, &Cost::frame}) {
    cost.*what = middle(frames, what);
  }
  return cost;
}

double wall_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Draws, and waits until it is done.
Result<Cost> draw_one(render::Renderer& renderer, const render::OffscreenTarget& target, const app::Picture& picture) {
  const double before = wall_ms();
  const Status status = renderer.draw(picture, target.viewport(), target.framebuffer());
  if (!status.ok()) return status.error();
  // Reading one pixel waits as glFinish does.
  const auto pixel = render::read_framebuffer(target.framebuffer(), {1, 1});
  if (!pixel.ok()) return pixel.error();
  const render::DrawStatistics& s = renderer.statistics();
  return Cost{s.triangles,  s.points,    s.bytes_uploaded, s.compare_ms,
              s.normals_ms, s.upload_ms, s.submit_ms,      wall_ms() - before};
}

Result<Cost> measure(const Case& one, int frames) {
  auto renderer = render::Renderer::create(one.samples);
  if (!renderer.ok()) return renderer.error();
  const auto target = render::OffscreenTarget::create(one.viewport);
  if (!target.ok()) return target.error();
  app::Picture picture = sphere(one.rows);
  picture.options.shows_occlusion = one.has_occlusion;
  const std::vector<std::vector<Eigen::Vector3f>> poses = {positions_of(one.rows, 0), positions_of(one.rows, 0.4)};
  std::vector<Cost> costs;
  constexpr int kWarmUp = 3;
  for (int i = 0; i < frames + kWarmUp; ++i) {
    if (one.moves == Moves::kAll) picture.surface.positions = poses[static_cast<std::size_t>(i % 2)];
    if (one.moves == Moves::kOne) picture.surface.positions[picture.surface.positions.size() / 2] *= 1.001F;
    const Result<Cost> cost = draw_one(*renderer, *target, picture);
    if (!cost.ok()) return cost;
    if (i >= kWarmUp) costs.push_back(*cost);
  }
  return middle_of(costs);
}

std::vector<std::string> row(const std::string& name, const Cost& c) {
  const auto ms = [](double value) { return fmt::format("{:.3f}", value); };
  return {name,
          std::to_string(c.triangles),
          std::to_string(c.points),
          std::to_string(c.bytes),
          ms(c.compare),
          ms(c.normals),
          ms(c.upload),
          ms(c.submit),
          ms(c.frame)};
}

// What is drawn into one pixel costs the rasteriser next to nothing, but a software renderer still transforms each
// point in the calling thread. A sphere of one row gives the same commands without that.
std::vector<Case> cases() {
  const app::Viewport pixel{1, 1};
  return {{"all points move, 1 pixel", kParallels, pixel, Moves::kAll, true, 0},
          {"the commands alone", 1, pixel, Moves::kAll, true, 0},
          {"one point moves, 1 pixel", kParallels, pixel, Moves::kOne, true, 0},
          {"nothing moves, 1 pixel", kParallels, pixel, Moves::kNone, true, 0},
          {"1280 x 720, no samples, no occlusion", kParallels, kScreen, Moves::kAll, false, 0},
          {"1280 x 720, no samples", kParallels, kScreen, Moves::kAll, true, 0},
          {"1280 x 720, 4 samples, no occlusion", kParallels, kScreen, Moves::kAll, false, 4},
          {"1280 x 720, 4 samples", kParallels, kScreen, Moves::kAll, true, 4},
          {"1280 x 720, no samples, no occlusion", kFewParallels, kScreen, Moves::kAll, false, 0},
          {"1280 x 720, 4 samples", kFewParallels, kScreen, Moves::kAll, true, 4}};
}

int run(const std::filesystem::path& folder, int frames) {
  const auto context = render::HeadlessContext::create();
  if (!context.ok()) {
    std::fprintf(stderr, "bench_drawing: %s\n", context.error().message.c_str());
    return EXIT_FAILURE;
  }
  Table table(
      "drawing",
      "Drawing with " + context->renderer_name() + ", middle frame: ms of the calling thread; frame: by the clock",
      {"case", "triangles", "points", "bytes", "compare", "normals", "upload", "submit", "frame"});
  std::vector<Cost> costs;
  for (const Case& one : cases()) {
    const Result<Cost> cost = measure(one, frames);
    if (!cost.ok()) {
      std::fprintf(stderr, "bench_drawing: %s\n", cost.error().message.c_str());
      return EXIT_FAILURE;
    }
    costs.push_back(*cost);
    table.add(row(one.name, *cost));
  }
  table.print();
  table.write_csv(folder);
  const double own = costs[0].prepared() + costs[1].submit;
  report_acceptance("drawing",
                    {{"the calling thread's ms per picture of 100 000 triangles that all move, beside the rasteriser",
                      fmt::format("≤ {:.0f}", kMostMs), "-", fmt::format("{:.2f}", own), own <= kMostMs}},
                    folder);
  return EXIT_SUCCESS;
}

constexpr const char* kUsage = "usage: bench_drawing [--out FOLDER] [--quick]\n";

int parse_and_run(int argc, char** argv) {
  std::filesystem::path folder = ".";
  int frames = 40;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--out" && i + 1 < argc) {
      folder = argv[++i];
    } else if (argument == "--quick") {
      frames = 10;
    } else {
      const bool is_help = argument == "-h" || argument == "--help";
      std::fputs(kUsage, is_help ? stdout : stderr);
      return is_help ? 0 : 2;
    }
  }
  return run(folder, frames);
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::parse_and_run(argc, argv);
}
