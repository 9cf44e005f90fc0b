// SPDX-License-Identifier: Apache-2.0
// What the jobs on a mesh share: figures before and after, and maintenance against a clock.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "app/jobs/cut_job.h"
#include "app/recording/recorded_engine.h"
#include "app/recording/stopwatch.h"
#include "incise/mesh/components.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace detail {

/// Maintains a mesh after each stroke, within a budget.
///
/// The engine counts work, not time: where there is a budget of time, the clock stops it between two operations. The
/// units spent say later what was done, whatever the clock was.
class Upkeep {
 public:
  /// `wanted` is what the job asks for; the engine itself may do a part of it, or nothing: see `without_upkeep`.
  Upkeep(const EngineOptions& wanted, std::uint64_t budget_us);

  /// Maintains until nothing waits or the budget is spent, and adds what was done to `sum`. Returns its milliseconds.
  /// Errors: kIo where the recording fails.
  /// `tick` is called between two operations where it is given; the result is the same.
  Result<double> run(RecordedEngine& engine, MaintainReport& sum, const std::function<void()>& tick = {});

 private:
  bool is_on_, has_clock_;
  std::uint64_t work_units_;
  double budget_us_;
  double left_us_ = 0;  // over from earlier strokes; below 0 where the last operation took longer
};

/// The same options for an engine that only cuts, so that the mesh can be measured before its maintenance.
[[nodiscard]] EngineOptions without_upkeep(EngineOptions options);

/// The fields of a report that say what was loaded and what was asked for.
void describe_job(const io::LoadedMesh& loaded, const EngineOptions& engine, std::uint64_t budget_us,
                  JobReport& report);

[[nodiscard]] MeshCounts counts_of(const TetMesh& mesh, const Components& pieces);

void measure_before(const TetMesh& mesh, JobReport& report);
/// `quality.cut`: between the last cut and its maintenance.
void measure_cut(const TetMesh& mesh, JobReport& report);
void measure_after(const TetMesh& mesh, const Components& pieces, double volume_tolerance, JobReport& report);

/// What one operation took, step by step.
struct StepSamples {
  std::vector<double> ms;
  std::vector<StageTimes> stages;

  void add(double step_ms, const StageTimes& times);
  /// Adds to the last step, or to a first one where there is none.
  void extend(double more_ms, const StageTimes& times);
};

/// Says in which stroke of a job an error came up.
[[nodiscard]] Error in_stroke(Error error, const CutJob& job, std::size_t index);

/// Whether a stroke, or frames of one, left every face of the mesh closed: it met nothing, pressed, or went along an
/// older cut.
[[nodiscard]] bool opened_nothing(const CutStatistics& cut);

/// Adds one operation, a stroke or an improvement.
void add_operation(const MaintainStatistics& maintained, const StepSamples& samples, JobReport& report);

/// Measures what an engine ends with. Returns its pieces.
Components measure_end(const Engine& engine, JobReport& report);

/// Whether a mesh is as good as what the job began with: the validity contract. Cost: as `validate`.
[[nodiscard]] bool keeps_contract(const TetMesh& mesh, double volume_tolerance, const JobReport& report);

/// How large a file is; 0 where that cannot be told.
[[nodiscard]] std::size_t kilobytes_of(const std::filesystem::path& file);

/// Takes strokes back, the last one in any case, until `is_valid` says so or there are none. Returns how many are left.
/// Errors: kIo where the recording fails. Cost: their edits, and one question each.
Result<std::uint32_t> take_back_until(RecordedEngine& engine, const std::function<bool(const TetMesh&)>& is_valid);

}  // namespace detail
}  // namespace app
}  // namespace v0
}  // namespace incise
