// SPDX-License-Identifier: Apache-2.0
// Maintenance in slices, with the clock asked between them, and the figures that reports of all jobs have in common.
#include "app/jobs/job_internal.h"

#include <system_error>

#include "incise/io/mesh_export.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace detail {
namespace {

bool maintains(const EngineOptions& options) {
  return options.maintain.merge || options.maintain.improve;
}

void add(const MaintainReport& more, MaintainReport& sum) {
  sum.maintain += more.maintain;
  sum.times += more.times;
}

QualityStats measure_incision(const TetMesh& mesh) {
  return measure_quality(mesh, [&](TetId tet) { return touches_cut(mesh, tet); });
}

}  // namespace

Upkeep::Upkeep(const EngineOptions& wanted, std::uint64_t budget_us)
    : is_on_(maintains(wanted)),
      has_clock_(budget_us > 0 && wanted.cut.profile != Profile::kPaper),
      work_units_(wanted.maintain.work_units),
      budget_us_(static_cast<double>(budget_us)) {}

Result<double> Upkeep::run(RecordedEngine& engine, MaintainReport& sum, const std::function<void()>& tick) {
  if (!is_on_) return 0.0;
  const Stopwatch watch;
  left_us_ += budget_us_;
  ShouldStop should_stop;
  if (has_clock_ || tick) {
    should_stop = [&] {
      if (tick) tick();
      return has_clock_ && 1e3 * watch.ms() >= left_us_;
    };
  }
  const Result<MaintainReport> report = engine.maintain(work_units_, should_stop);
  if (!report.ok()) return report.error();
  add(*report, sum);
  left_us_ -= 1e3 * engine.last_ms();
  return engine.last_ms();
}

EngineOptions without_upkeep(EngineOptions options) {
  options.maintain.work_units = 0;
  return options;
}

void describe_job(const io::LoadedMesh& loaded, const EngineOptions& engine, std::uint64_t budget_us,
                  JobReport& report) {
  report.input = loaded.source.file;
  report.input_format = loaded.source.format;
  report.notes = loaded.source.notes;
  report.options.profile = engine.cut.profile;
  report.options.snap = engine.cut.snap;
  report.options.merge = engine.maintain.merge;
  report.options.improve = engine.maintain.improve;
  report.options.budget_us = budget_us;
  report.options.threads = engine.threads;
}

MeshCounts counts_of(const TetMesh& mesh, const Components& pieces) {
  return {mesh.vertex_count(), mesh.tet_count(), pieces.count()};
}

void measure_before(const TetMesh& mesh, JobReport& report) {
  report.before = counts_of(mesh, find_components(mesh));
  report.quality_before = report.quality_cut = measure_quality(mesh);
  report.validity_before = validate(mesh, ValidateLevel::kGeometry);
  report.volume_before = report.validity_before.volume;
}

void measure_cut(const TetMesh& mesh, JobReport& report) {
  report.quality_cut = measure_quality(mesh);
  report.quality_cut_incision = measure_incision(mesh);
}

void measure_after(const TetMesh& mesh, const Components& pieces, double volume_tolerance, JobReport& report) {
  report.after = counts_of(mesh, pieces);
  for (std::size_t i = 0; i < pieces.count(); ++i) report.pieces.push_back({pieces.tet_count[i], pieces.volume[i]});
  report.quality_after = measure_quality(mesh);
  report.quality_incision = measure_incision(mesh);
  ValidateOptions options;
  options.expected_volume = report.volume_before;
  options.volume_tolerance = volume_tolerance;
  report.validity_after = validate(mesh, ValidateLevel::kGeometry, options);
  report.volume_after = report.validity_after.volume;
  report.change = compare_with_input(report.validity_before, report.validity_after);
  report.hash = mesh.hash();
}

void StepSamples::add(double step_ms, const StageTimes& times) {
  ms.push_back(step_ms);
  stages.push_back(times);
}

void StepSamples::extend(double more_ms, const StageTimes& times) {
  if (ms.empty()) add(0, {});
  ms.back() += more_ms;
  stages.back() += times;
}

Error in_stroke(Error error, const CutJob& job, std::size_t index) {
  const std::string& name = job.strokes[index].name;
  error.message = "stroke " + std::to_string(index) + (name.empty() ? "" : " \"" + name + "\"") + ": " + error.message;
  return error;
}

bool opened_nothing(const CutStatistics& cut) {
  return cut.incision_faces <= 0;
}

void add_operation(const MaintainStatistics& maintained, const StepSamples& samples, JobReport& report) {
  report.maintain += maintained;
  report.units_per_stroke.push_back(maintained.work_units);
  for (const double ms : samples.ms) report.total_ms += ms;
  for (const StageTimes& times : samples.stages) report.times += times;
  report.step_ms.insert(report.step_ms.end(), samples.ms.begin(), samples.ms.end());
  report.stage_ms.insert(report.stage_ms.end(), samples.stages.begin(), samples.stages.end());
}

Components measure_end(const Engine& engine, JobReport& report) {
  Components pieces = find_components(engine.mesh());
  measure_after(engine.mesh(), pieces, volume_tolerance(engine.options()), report);
  return pieces;
}

bool keeps_contract(const TetMesh& mesh, double volume_tolerance, const JobReport& report) {
  ValidateOptions options;
  options.expected_volume = report.volume_before;
  options.volume_tolerance = volume_tolerance;
  return compare_with_input(report.validity_before, validate(mesh, ValidateLevel::kGeometry, options)).ok;
}

std::size_t kilobytes_of(const std::filesystem::path& file) {
  std::error_code code;
  const auto bytes = std::filesystem::file_size(file, code);
  return code ? 0 : static_cast<std::size_t>((bytes + 1023) >> 10U);
}

Result<std::uint32_t> take_back_until(RecordedEngine& engine, const std::function<bool(const TetMesh&)>& is_valid) {
  while (engine.engine().stroke_count() > 0) {
    const Result<bool> undone = engine.undo();
    if (!undone.ok()) return undone.error();
    if (is_valid(engine.mesh())) break;
  }
  return engine.engine().stroke_count();
}

}  // namespace detail

double volume_tolerance(const EngineOptions& options) {
  constexpr double kCutting = 1e-12, kMaintaining = 1e-9, kAsPaper = 1e-2;
  if (!detail::maintains(options)) return kCutting;
  return options.cut.profile == Profile::kPaper ? kAsPaper : kMaintaining;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
