// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "app/jobs/live_hand.h"
#include "app/jobs/simulation_report.h"
#include "app/recording/recorded_simulation.h"
#include "app/scene/scene.h"
#include "incise/io/mesh_loader.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Work units that a microsecond of maintenance buys (see `MaintainOptions`): a simulation counts work, and reads no
/// clock, so that a budget of time gives the same result everywhere.
inline constexpr std::uint64_t kWorkUnitsPerUs = 10;

/// About as many files as a series has where nobody says otherwise.
inline constexpr std::uint64_t kSeriesFiles = 100;

struct SimulateJob {
  std::string scene_file;        ///< repeated in the report
  SceneRun run;                  ///< threads, log, recording; `keep_undo` plays no part: the history is of one stroke
  std::filesystem::path output;  ///< NAME.pvd, see `FrameSeries`; empty: none
  std::uint64_t every = 0;       ///< frames between two files; 0: chosen so that there are `kSeriesFiles`
  std::uint64_t budget_us = 0;   ///< repeated in the report
  /// Called before each frame and after the last: frames done, frames in all. May be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
  /// Asked before each frame and while the body settles; true ends the job. May be empty.
  std::function<bool()> should_stop;
  /// Has the blade instead of the scene's strokes, and frames then keep the pace of the clock. May be null; outlives
  /// the job.
  LiveHand* hand = nullptr;
  /// Called before the first frame and after each: frames done. An error ends the job, and is its own. May be empty.
  std::function<Status(std::size_t done, const Simulation& body)> watch;
  /// Called once with the body at the end, where all frames were run. May be empty.
  std::function<void(const Simulation& end)> look;
};

struct SimulateResult {
  SimulationReport report;
  bool was_stopped = false;  ///< by `should_stop`: then the report is empty and no series was written
};

/// Runs a scene from its first frame to its last, and measures the mesh before, after the last cut and at the end.
///
/// Measuring and writing count in no time of the report. The series takes its place only where all frames were run and
/// the validity contract holds (`report.job.change.ok`).
/// Errors: as `load_model`, `make_simulation`, `Simulation::frame` (naming the frame) and `FrameSeries`; kIo where the
/// recording fails.
[[nodiscard]] Result<SimulateResult> run_simulate(const Scene& scene, const SimulateJob& job);
/// The same with the scene's model as `load_model` gave it.
[[nodiscard]] Result<SimulateResult> run_simulate(const Scene& scene, io::LoadedMesh loaded, const SimulateJob& job);

}  // namespace app
}  // namespace v0
}  // namespace incise
