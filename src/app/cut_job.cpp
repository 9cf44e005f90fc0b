// SPDX-License-Identifier: Apache-2.0
#include "incise/app/cut_job.h"

#include <utility>

#include "app/job_internal.h"

namespace incise::inline v0 {
namespace app {
namespace {

Error in_stroke(Error error, const CutJob& job, std::size_t index) {
  const std::string& name = job.strokes[index].name;
  error.message = "stroke " + std::to_string(index) + (name.empty() ? "" : " \"" + name + "\"") + ": " + error.message;
  return error;
}

/// Cuts along one stroke and maintains the mesh; the last cut is measured in between, off the clock.
Status cut_one(Engine& engine, const CutJob& job, std::size_t index, detail::Upkeep& upkeep, JobReport& report) {
  const detail::Stopwatch watch;
  const Result<StrokeReport> stroke = engine.cut(job.strokes[index]);
  const double cut_ms = watch.ms();
  if (!stroke.ok()) return in_stroke(stroke.error(), job, index);
  report.cut += stroke->cut;
  if (index + 1 == job.strokes.size()) detail::measure_cut(engine.mesh(), report);
  MaintainReport maintained{stroke->maintain, stroke->times};
  const double maintain_ms = upkeep.run(engine, maintained);
  detail::add_operation(maintained, cut_ms + maintain_ms, report);
  return {};
}

Status cut_all(Engine& engine, const CutJob& job, JobReport& report) {
  detail::Upkeep upkeep(job.engine, job.budget_us);
  for (std::size_t i = 0; i < job.strokes.size(); ++i) {
    if (job.progress) job.progress(i, job.strokes.size());
    if (const Status status = cut_one(engine, job, i, upkeep, report); !status.ok()) return status;
  }
  if (job.progress) job.progress(job.strokes.size(), job.strokes.size());
  return {};
}

}  // namespace

Result<JobResult> run_cut(LoadedMesh loaded, const CutJob& job, bool wants_mesh) {
  JobResult result;
  JobReport& report = result.report;
  report.options = job.options;
  detail::describe_job(loaded, job.engine, job.budget_us, report);
  report.strokes = job.strokes.size();
  detail::measure_before(loaded.mesh, report);
  Result<Engine> engine = Engine::create(std::move(loaded.mesh), detail::without_upkeep(job.engine));
  if (!engine.ok()) return engine.error();
  if (const Status status = cut_all(*engine, job, report); !status.ok()) return status.error();
  detail::finish(*engine, loaded, wants_mesh, result);
  return result;
}

}  // namespace app
}  // namespace incise::inline v0
