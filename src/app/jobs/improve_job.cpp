// SPDX-License-Identifier: Apache-2.0
// The engine's `improve` finds the tets and spends its own units; where a clock decides, `Upkeep` goes on from there.
#include "app/jobs/improve_job.h"

#include <array>
#include <cstdint>
#include <utility>

#include "app/jobs/job_internal.h"
#include "incise/io/mesh_export.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// The stages of the work.
enum class Stage : std::uint8_t { kMeasure, kFind, kImprove, kMeasureAgain };

void tell(const ImproveJob& job, Stage stage) {
  constexpr std::array<const char*, 4> kNames = {"measuring", "finding bad tets", "improving", "measuring the result"};
  const auto done = static_cast<std::size_t>(stage);
  if (job.stage) job.stage(kNames[done], done, kNames.size());
}

Status improve(RecordedEngine& engine, const ImproveJob& job, JobReport& report) {
  tell(job, Stage::kFind);
  std::function<void()> tick;
  if (job.stage) tick = [&job] { tell(job, Stage::kImprove); };
  detail::Upkeep upkeep(job.engine, job.budget_us);
  const Result<MaintainReport> begun = engine.improve();
  if (!begun.ok()) return begun.error();
  MaintainReport maintained = *begun;
  const double begin_ms = engine.last_ms();
  const Result<double> upkeep_ms = upkeep.run(engine, maintained, tick);
  if (!upkeep_ms.ok()) return upkeep_ms.error();
  detail::StepSamples samples;
  samples.add(begin_ms + *upkeep_ms, maintained.times);
  detail::add_operation(maintained.maintain, samples, report);
  return {};
}

}  // namespace

Result<JobResult> run_improve(io::LoadedMesh loaded, const ImproveJob& job, bool wants_mesh) {
  JobResult result;
  detail::describe_job(loaded, job.engine, job.budget_us, result.report);
  tell(job, Stage::kMeasure);
  detail::measure_before(loaded.mesh, result.report);
  Result<RecordedEngine> engine = RecordedEngine::create(std::move(loaded.mesh), detail::without_upkeep(job.engine));
  if (!engine.ok()) return engine.error();
  if (const Status status = improve(*engine, job, result.report); !status.ok()) return status.error();
  tell(job, Stage::kMeasureAgain);
  const Components pieces = detail::measure_end(engine->engine(), result.report);
  if (wants_mesh) result.mesh = io::to_mesh_data(engine->mesh(), pieces, loaded.file_vertex);
  result.mesh.region_names = loaded.region_names;
  return result;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
