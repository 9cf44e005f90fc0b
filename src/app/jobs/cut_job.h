// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "app/jobs/report.h"
#include "incise/engine/engine.h"
#include "incise/io/mesh_data.h"
#include "incise/io/mesh_loader.h"
#include "incise/lab/method.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The greatest budget of time for maintenance, in microseconds: an hour.
inline constexpr std::uint64_t kMaxBudgetUs = 3'600'000'000;

/// What is told of a job in stages: the name of the one that it is at, and what percent of the job's time the ones
/// before it take of a large mesh.
using StageSink = std::function<void(std::string_view name, unsigned percent)>;

struct CutJob {
  std::vector<Stroke> strokes;
  /// The blade goes from time to time, each pair of times one step of the engine, instead of cutting once a stroke is
  /// complete. The profile paper always does the latter.
  bool by_steps = false;
  /// A method that the paper cites cuts instead of the engine: each stroke as a whole, nothing is maintained, and
  /// `budget_us` and `record` play no part. Of `engine` it takes the threads.
  std::optional<LabMethod> method = {};
  EngineOptions engine;
  /// Microseconds for the maintenance that follows each stroke, at most `kMaxBudgetUs`; what one stroke leaves over the
  /// next may spend. 0: no clock, `engine.maintain.work_units` are the budget of each stroke. Cutting is never bounded,
  /// nor is the paper's maintenance.
  std::uint64_t budget_us = 0;
  ReportOptions options;         ///< repeated in the report; what `engine` and `budget_us` say is taken from them
  std::filesystem::path record;  ///< where the session is recorded, see `RecordedEngine`; empty: nowhere
  /// Called once with the mesh at the end, after its maintenance; as it was last valid, where a stroke broke it. May be
  /// empty.
  std::function<void(const Engine& engine)> look;
  /// Called before each step of the blade and after the last: steps done, steps in all. A stroke that is cut as a whole
  /// is one step. May be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
  /// Where strokes are cut as a whole by the engine, called as each stage begins, and between two operations of
  /// maintenance. May be empty.
  StageSink stage;
};

/// What a job on a mesh gives back.
struct JobResult {
  JobReport report;   ///< of all that was done
  io::MeshData mesh;  ///< what `-o` writes, see `JobReport::broken`; empty where not asked for
};

/// By how much a job may change the total volume, relative: part of the validity contract.
///
/// 1e-12 where the mesh is not maintained. Maintenance of the profile incise moves vertices of walls and skin so that
/// the volume is kept, up to the rounding of very many moves: 1e-9. The paper's moves them freely on the surface: 1e-2.
[[nodiscard]] double volume_tolerance(const EngineOptions& options);

/// Cuts a loaded mesh along all strokes, in order, and measures it before, after the last cut and after its
/// maintenance.
///
/// Where the mesh is not valid at the end, strokes are taken back, the last first, until it is; a recording has that,
/// too. Measuring counts in no time of the report. With `budget_us` the result depends on the clock; the report has the
/// work that was done after each stroke.
/// @param wants_mesh  whether `JobResult::mesh` is filled.
/// Errors: as `Engine::create` and `Engine::cut`, or `cut_by`, naming the stroke, and before anything is cut where a
/// blade is too far from the body (`check_reach`); kIo where the recording fails. Cost: the cuts, plus about 3 µs per
/// tet.
[[nodiscard]] Result<JobResult> run_cut(io::LoadedMesh loaded, const CutJob& job, bool wants_mesh);

}  // namespace app
}  // namespace v0
}  // namespace incise
