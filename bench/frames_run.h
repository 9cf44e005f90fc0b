// SPDX-License-Identifier: Apache-2.0
// Frames of simulated scenes, measured one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/scene/scene.h"
#include "report.h"

namespace incise::bench {

/// One frame, in ms. Stages are by the clock.
struct FrameTime {
  double cpu = 0;   ///< processor time of the thread that works
  double wall = 0;  ///< by the clock
  StageTimes stages;
  double follow = 0;  ///< of the stage relax: the solver's following of the mesh
  bool has_blade = false;
  bool works = false;  ///< has a blade, or maintains
  std::size_t cut_tets = 0, awake = 0;
};

/// A scene from its first frame to its last.
struct SceneRun {
  std::vector<FrameTime> frames;
  std::size_t tets_before = 0, tets_after = 0, vertices_after = 0;
  unsigned settle_frames = 0;
  std::uint64_t hash = 0;
};

enum class Clock { kCpu, kWall };
enum class Which { kBlade, kBladeAndMaintenance };

/// Runs a scene in `mesh`. Says on stderr where it cannot, and has no frames then.
SceneRun run_scene(const app::Scene& scene, TetMesh mesh, unsigned threads);

/// One frame of a simulation. Errors are said on stderr; the frame then counts for nothing.
FrameTime time_frame(Simulation& simulation, const FrameInput& input);

/// What the frames that count took.
std::vector<double> times_of(const SceneRun& run, Clock clock, Which which = Which::kBlade);

/// Frame by frame the least of all runs: what a machine without neighbours would take, for runs do the same work.
std::vector<double> least_of(const std::vector<SceneRun>& runs, Clock clock, Which which = Which::kBlade);

/// The smallest value that at least `share` of the values do not exceed; 0 where there is none.
double quantile(std::vector<double> values, double share);
double mean(const std::vector<double>& values);

/// Frames of all runs in one row.
std::vector<double> pooled(const std::vector<SceneRun>& runs, Clock clock);

/// The median over the runs of what `figure` says of each.
template <class Figure>
double median_of(const std::vector<SceneRun>& runs, const Figure& figure) {
  std::vector<double> values;
  for (const SceneRun& run : runs) {
    values.push_back(figure(run));
  }
  return median(values);
}

/// Mean ms per frame with a blade, by what took them: the stages by the clock, scaled to the processor time.
struct Shares {
  double collision = 0, relax = 0, follow = 0, modify = 0, rest = 0, whole = 0;
};
Shares shares_of(const SceneRun& run);

std::string number(double value, int digits = 2);

/// Every frame of the first run as a row of `folder`/frames_of_NAME.csv, its times the least of all runs.
void write_frames(const std::vector<SceneRun>& runs, const std::string& name, const std::filesystem::path& folder);

}  // namespace incise::bench
