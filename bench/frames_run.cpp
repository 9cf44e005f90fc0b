// SPDX-License-Identifier: Apache-2.0
#include "frames_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

#include "app/scene/scene_simulation.h"

namespace incise::bench {

namespace {

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool counts(const FrameTime& frame, Which which) {
  return which == Which::kBlade ? frame.has_blade : frame.works;
}

double time_of(const FrameTime& frame, Clock clock) {
  return clock == Clock::kCpu ? frame.cpu : frame.wall;
}

}  // namespace

FrameTime time_frame(Simulation& simulation, const FrameInput& input) {
  FrameTime time;
  const double cpu = thread_ms(), wall = wall_ms();
  const Result<FrameReport> report = simulation.frame(input);
  time.wall = wall_ms() - wall;
  time.cpu = thread_ms() - cpu;
  if (!report) {
    std::fprintf(stderr, "a frame failed: %s\n", report.error().message.c_str());
    return {};
  }
  time.stages = report->times;
  time.follow = report->follow_ms;
  time.has_blade = input.blade.has_value();
  time.works = time.has_blade || report->maintain.work_units > 0;
  time.cut_tets = report->cut.cut_tets;
  time.awake = report->relax.active_vertices;
  return time;
}

SceneRun run_scene(const app::Scene& scene, TetMesh mesh, unsigned threads) {
  SceneRun run;
  run.tets_before = mesh.tet_count();
  Result<Simulation> simulation = app::make_simulation(scene, std::move(mesh), threads);
  const Result<unsigned> settled = simulation.ok() ? simulation->settle(scene.settle.frames, scene.settle.speed)
                                                   : Result<unsigned>(simulation.error());
  if (!settled) {
    std::fprintf(stderr, "%s: %s\n", scene.name.c_str(), settled.error().message.c_str());
    return run;
  }
  run.settle_frames = *settled;
  for (std::uint64_t i = 0; i < scene.frames; ++i) {
    run.frames.push_back(time_frame(*simulation, app::scene_input(scene, i)));
  }
  run.tets_after = simulation->mesh().tet_count();
  run.vertices_after = simulation->mesh().vertex_count();
  run.hash = simulation->hash();
  return run;
}

std::vector<double> times_of(const SceneRun& run, Clock clock, Which which) {
  std::vector<double> times;
  for (const FrameTime& frame : run.frames) {
    if (counts(frame, which)) {
      times.push_back(time_of(frame, clock));
    }
  }
  return times;
}

std::vector<double> least_of(const std::vector<SceneRun>& runs, Clock clock, Which which) {
  std::vector<double> least;
  for (const SceneRun& run : runs) {
    const std::vector<double> times = times_of(run, clock, which);
    if (least.empty()) {
      least = times;
    }
    for (std::size_t i = 0; i < std::min(least.size(), times.size()); ++i) {
      least[i] = std::min(least[i], times[i]);
    }
  }
  return least;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()) - 1e-9);
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> pooled(const std::vector<SceneRun>& runs, Clock clock) {
  std::vector<double> all;
  for (const SceneRun& run : runs) {
    const std::vector<double> times = times_of(run, clock);
    all.insert(all.end(), times.begin(), times.end());
  }
  return all;
}

Shares shares_of(const SceneRun& run) {
  StageTimes stages;
  double follow = 0, wall = 0;
  for (const FrameTime& frame : run.frames) {
    if (frame.has_blade) {
      stages += frame.stages;
      follow += frame.follow;
      wall += frame.wall;
    }
  }
  if (wall <= 0) {
    return {};
  }
  Shares ms;
  ms.whole = mean(times_of(run, Clock::kCpu));
  const double scale = ms.whole / wall;
  const double modify = stages.total() - stages[Stage::kRelax] - stages[Stage::kCollision];
  ms.collision = scale * stages[Stage::kCollision];
  ms.relax = scale * (stages[Stage::kRelax] - follow);
  ms.follow = scale * follow;
  ms.modify = scale * modify;
  ms.rest = scale * (wall - stages.total());
  return ms;
}

void write_frames(const std::vector<SceneRun>& runs, const std::string& name, const std::filesystem::path& folder) {
  Table table("frames_of_" + name, "",
              {"frame", "blade", "cut tets", "awake", "cpu", "wall", "CD", "subdivide", "separate", "merge", "improve",
               "RLX", "follow"});
  for (std::size_t i = 0; i < runs.front().frames.size(); ++i) {
    const FrameTime& first = runs.front().frames[i];
    const auto least = [&](const auto& part) {
      double value = part(first);
      for (const SceneRun& run : runs) {
        value = std::min(value, part(run.frames[i]));
      }
      return number(value, 4);
    };
    std::vector<std::string> row = {std::to_string(i),
                                    first.has_blade ? "1" : "0",
                                    std::to_string(first.cut_tets),
                                    std::to_string(first.awake),
                                    least([](const FrameTime& f) { return f.cpu; }),
                                    least([](const FrameTime& f) { return f.wall; })};
    for (std::size_t stage = 0; stage < first.stages.ms.size(); ++stage) {
      row.push_back(least([&](const FrameTime& f) { return f.stages.ms[stage]; }));
    }
    row.push_back(least([](const FrameTime& f) { return f.follow; }));
    table.add(row);
  }
  table.write_csv(folder);
}

std::string number(double value, int digits) {
  return fmt::format("{:.{}f}", value, digits);
}

}  // namespace incise::bench
