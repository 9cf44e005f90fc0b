// SPDX-License-Identifier: Apache-2.0
// The engine's `improve` finds the tets and spends its own units; where a clock decides, `Upkeep` goes on from there.
#include "app/jobs/improve_job.h"

#include <utility>

#include "app/jobs/job_internal.h"
#include "incise/io/mesh_export.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// A stage of the work, and percent of the time that the ones before it take of a million tets.
struct Stage {
  const char* name;
  unsigned percent;
};
constexpr Stage kMeasure = {"measuring", 0}, kFind = {"finding bad tets", 35}, kImprove = {"improving", 36},
                kMeasureAgain = {"measuring the result", 67};

void tell(const ImproveJob& job, const Stage& stage) {
  if (job.stage) job.stage(stage.name, stage.percent);
}

Status improve(RecordedEngine& engine, const ImproveJob& job, JobReport& report) {
  tell(job, kFind);
  std::function<void()> tick;
  if (job.stage) tick = [&job] { tell(job, kImprove); };
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
  tell(job, kMeasure);
  detail::measure_before(loaded.mesh, result.report);
  Result<RecordedEngine> engine = RecordedEngine::create(std::move(loaded.mesh), detail::without_upkeep(job.engine));
  if (!engine.ok()) return engine.error();
  if (const Status status = improve(*engine, job, result.report); !status.ok()) return status.error();
  tell(job, kMeasureAgain);
  const Components pieces = detail::measure_end(engine->engine(), result.report);
  if (wants_mesh) result.mesh = io::to_mesh_data(engine->mesh(), pieces, loaded.file_vertex);
  result.mesh.region_names = loaded.region_names;
  return result;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
