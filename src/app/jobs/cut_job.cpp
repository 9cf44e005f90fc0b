// SPDX-License-Identifier: Apache-2.0
// Stroke after stroke through a recorded engine that only cuts; maintenance is called from here, so that the mesh can
// be measured between the two. A stroke that breaks the validity contract is undone at the end.
#include "app/jobs/cut_job.h"

#include <utility>

#include "app/jobs/job_internal.h"
#include "app/jobs/lab_cut.h"
#include "app/recording/recorded_engine.h"
#include "incise/io/mesh_export.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

using detail::in_stroke;

/// What a stroke took beyond its steps.
StageTimes rest_of(const StageTimes& whole, const std::vector<StageTimes>& steps) {
  StageTimes rest = whole;
  for (const StageTimes& step : steps) rest -= step;
  return rest;
}

/// Tells how far a job is.
class StepCount {
 public:
  explicit StepCount(const CutJob& job);

  void step() {
    if (job_.progress) job_.progress(++done_, total_);
  }

 private:
  const CutJob& job_;
  std::size_t done_ = 0, total_ = 0;
};

/// Tells what is under way where strokes are cut as a whole: measuring, cutting and maintaining for each of them, and
/// measuring the result.
class Stages {
 public:
  explicit Stages(const CutJob& job) : job_(job) {}

  void measuring() const { tell("measuring", 0); }
  void cutting(std::size_t stroke) const { tell("cutting", percent_before(2 * stroke)); }
  void maintaining(std::size_t stroke) const { tell("improving the mesh at the cut", percent_before(2 * stroke + 1)); }
  /// What maintenance calls between two operations.
  [[nodiscard]] std::function<void()> tick(std::size_t stroke) const {
    if (!is_on()) return {};
    return [this, stroke] { maintaining(stroke); };
  }
  void ending() const { tell("measuring the result", kCut); }

 private:
  /// Percent of the time of a plane's cut through a million tets that has gone by when it is measured, and when it is
  /// cut and maintained.
  static constexpr unsigned kMeasured = 40, kCut = 50;

  [[nodiscard]] unsigned percent_before(std::size_t half_stroke) const {
    return kMeasured + static_cast<unsigned>((kCut - kMeasured) * half_stroke / (2 * job_.strokes.size()));
  }
  [[nodiscard]] bool is_on() const { return job_.stage && !job_.by_steps; }
  void tell(const char* name, unsigned percent) const {
    if (is_on()) job_.stage(name, percent);
  }

  const CutJob& job_;
};

bool is_paper(const CutJob& job) {
  return job.engine.cut.profile == Profile::kPaper;
}

/// Moves the blade from time to time; the last step's sample has the stroke's beginning and end as well.
Result<StrokeReport> cut_by_steps(RecordedEngine& engine, const Stroke& stroke, detail::StepSamples& samples,
                                  StepCount& count) {
  const Result<std::uint32_t> begun = engine.begin_stroke({stroke.edges.front()});
  if (!begun.ok()) return begun.error();
  double ends_ms = engine.last_ms();
  for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
    const Result<StepReport> step = engine.step({stroke.edges[i]});
    if (!step.ok()) return step.error();
    samples.add(engine.last_ms(), step->times);
    count.step();
  }
  Result<StrokeReport> report = engine.end_stroke();
  ends_ms += engine.last_ms();
  if (report.ok()) samples.extend(ends_ms, rest_of(report->times, samples.stages));
  return report;
}

Result<StrokeReport> cut_whole(RecordedEngine& engine, const Stroke& stroke, detail::StepSamples& samples,
                               StepCount& count) {
  Result<StrokeReport> report = engine.cut(stroke);
  if (report.ok()) samples.add(engine.last_ms(), report->times);
  count.step();
  return report;
}

StepCount::StepCount(const CutJob& job) : job_(job) {
  for (const Stroke& stroke : job.strokes) total_ += job.by_steps ? stroke.edges.size() - 1 : 1;
  if (job.progress) job.progress(0, total_);
}

/// Cuts along one stroke and maintains what its steps have not; the last cut is measured in between, off the clock.
/// In the paper's profile an incision may go on until the last stroke, which completes it: a second call of
/// maintenance.
Status cut_one(RecordedEngine& engine, const CutJob& job, std::size_t index, StepCount& count, detail::Upkeep& upkeep,
               JobReport& report) {
  const Stages stages(job);
  stages.cutting(index);
  detail::StepSamples samples;
  const auto cut = job.by_steps ? cut_by_steps : cut_whole;
  const Result<StrokeReport> stroke = cut(engine, job.strokes[index], samples, count);
  if (!stroke.ok()) return in_stroke(stroke.error(), job, index);
  if (detail::opened_nothing(stroke->cut)) report.missed.push_back(index);
  report.cut += stroke->cut;
  if (index + 1 == job.strokes.size()) detail::measure_cut(engine.mesh(), report);
  MaintainReport maintained{stroke->maintain, {}};
  const bool completes = is_paper(job) && index + 1 == job.strokes.size();
  for (unsigned run = 0; run < (completes ? 2 : 1); ++run) {
    const Result<double> upkeep_ms = upkeep.run(engine, maintained, stages.tick(index));
    if (!upkeep_ms.ok()) return upkeep_ms.error();
    samples.extend(*upkeep_ms, maintained.times);
    maintained.times = {};
  }
  detail::add_operation(maintained.maintain, samples, report);
  return {};
}

Status cut_all(RecordedEngine& engine, const CutJob& job, JobReport& report) {
  detail::Upkeep upkeep(job.engine, job.budget_us);
  StepCount count(job);
  for (std::size_t i = 0; i < job.strokes.size(); ++i) {
    if (const Status status = cut_one(engine, job, i, count, upkeep, report); !status.ok()) return status;
  }
  return {};
}

/// Strokes cut step by step are maintained in the blade's wake, but for those against a clock and the paper's, which
/// maintains once a stroke has ended.
EngineOptions engine_options(const CutJob& job) {
  return job.by_steps && job.budget_us == 0 && !is_paper(job) ? job.engine : detail::without_upkeep(job.engine);
}

/// Says of all blades whether they sweep something and keep within reach, before anything is cut.
Status check_blades(const CutJob& job, const Box& body) {
  for (std::size_t i = 0; i < job.strokes.size(); ++i) {
    Stroke stroke = job.strokes[i];
    stroke.name.clear();  // `in_stroke` says it
    if (const Status status = check(stroke); !status.ok()) return in_stroke(status.error(), job, i);
    if (const Status status = check_reach(stroke, body); !status.ok()) return in_stroke(status.error(), job, i);
  }
  return {};
}

/// Takes the stroke that broke the mesh back, with all that came after it.
Status keep_last_valid(RecordedEngine& engine, const CutJob& job, JobReport& report) {
  const double tolerance = volume_tolerance(job.engine);
  const Result<std::uint32_t> kept = detail::take_back_until(
      engine, [&](const TetMesh& mesh) { return detail::keeps_contract(mesh, tolerance, report); });
  if (!kept.ok()) return kept.error();
  report.broken = BrokenStroke{*kept, job.strokes[*kept].name, engine.mesh().hash()};
  return {};
}

}  // namespace

Result<JobResult> run_cut(io::LoadedMesh loaded, const CutJob& job, bool wants_mesh) {
  JobResult result;
  JobReport& report = result.report;
  report.options = job.options;
  report.options.method = job.method;
  detail::describe_job(loaded, job.engine, job.budget_us, report);
  report.strokes = job.strokes.size();
  if (const Status status = check_blades(job, rest_bounds(loaded.mesh)); !status.ok()) return status.error();
  if (job.method) return detail::run_lab_cut(std::move(loaded), job, wants_mesh, std::move(report));
  Stages(job).measuring();
  detail::measure_before(loaded.mesh, report);
  Result<RecordedEngine> engine = RecordedEngine::create(std::move(loaded.mesh), engine_options(job),
                                                         {job.record, loaded.source.file, job.options.seed});
  if (!engine.ok()) return engine.error();
  if (const Status status = cut_all(*engine, job, report); !status.ok()) return status.error();
  Stages(job).ending();
  Components pieces = detail::measure_end(engine->engine(), report);
  if (!report.change.ok && !job.strokes.empty()) {
    if (const Status status = keep_last_valid(*engine, job, report); !status.ok()) return status.error();
    pieces = find_components(engine->mesh());
  }
  if (wants_mesh) result.mesh = io::to_mesh_data(engine->mesh(), pieces, loaded.file_vertex);
  result.mesh.region_names = loaded.region_names;
  if (job.look) job.look(engine->engine());
  return result;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
