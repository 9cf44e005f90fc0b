// SPDX-License-Identifier: Apache-2.0
#include "incise/app/improve_job.h"

#include <utility>

#include "app/job_internal.h"

namespace incise::inline v0 {
namespace app {
namespace {

void improve(Engine& engine, const ImproveJob& job, JobReport& report) {
  detail::Upkeep upkeep(job.engine, job.budget_us);
  const detail::Stopwatch watch;
  MaintainReport maintained = engine.improve();
  upkeep.run(engine, maintained);
  detail::add_operation(maintained, watch.ms(), report);
}

}  // namespace

Result<JobResult> run_improve(LoadedMesh loaded, const ImproveJob& job, bool wants_mesh) {
  JobResult result;
  detail::describe_job(loaded, job.engine, job.budget_us, result.report);
  detail::measure_before(loaded.mesh, result.report);
  Result<Engine> engine = Engine::create(std::move(loaded.mesh), detail::without_upkeep(job.engine));
  if (!engine.ok()) return engine.error();
  improve(*engine, job, result.report);
  detail::finish(*engine, loaded, wants_mesh, result);
  return result;
}

}  // namespace app
}  // namespace incise::inline v0
