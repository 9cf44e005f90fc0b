// SPDX-License-Identifier: Apache-2.0
#include "incise/app/cut_job.h"

#include <chrono>
#include <utility>

#include "incise/app/mesh_export.h"
#include "incise/mesh/components.h"

namespace incise::inline v0 {
namespace app {
namespace {

using Clock = std::chrono::steady_clock;

MeshCounts counts_of(const TetMesh& mesh, const Components& pieces) {
  return {mesh.vertex_count(), mesh.tet_count(), pieces.count()};
}

void measure_before(const TetMesh& mesh, CutReport& report) {
  report.before = counts_of(mesh, find_components(mesh));
  report.quality_before = measure_quality(mesh);
  report.validity_before = validate(mesh, ValidateLevel::kGeometry);
  report.volume_before = report.validity_before.volume;
}

void measure_after(const TetMesh& mesh, const Components& pieces, CutReport& report) {
  report.after = counts_of(mesh, pieces);
  for (std::size_t i = 0; i < pieces.count(); ++i) report.pieces.push_back({pieces.tet_count[i], pieces.volume[i]});
  report.quality_cut = report.quality_after = measure_quality(mesh);  // until there is a stage that maintains it
  report.quality_incision = measure_quality(mesh, [&](TetId tet) { return touches_cut(mesh, tet); });
  ValidateOptions options;
  options.expected_volume = report.volume_before;
  report.validity_after = validate(mesh, ValidateLevel::kGeometry, options);
  report.volume_after = report.validity_after.volume;
  report.change = compare_with_input(report.validity_before, report.validity_after);
  report.hash = mesh.hash();
}

void add_stroke(const StrokeReport& stroke, CutReport& report) {
  report.cut += stroke.cut;
  report.times += stroke.times;
  report.step_ms.insert(report.step_ms.end(), stroke.step_ms.begin(), stroke.step_ms.end());
  report.stage_ms.push_back(stroke.times);
}

Error in_stroke(Error error, const CutJob& job, std::size_t index) {
  const std::string& name = job.strokes[index].name;
  error.message = "stroke " + std::to_string(index) + (name.empty() ? "" : " \"" + name + "\"") + ": " + error.message;
  return error;
}

Status cut_all(Engine& engine, const CutJob& job, CutReport& report) {
  for (std::size_t i = 0; i < job.strokes.size(); ++i) {
    if (job.progress) job.progress(i, job.strokes.size());
    const Clock::time_point start = Clock::now();
    const Result<StrokeReport> stroke = engine.cut(job.strokes[i]);
    report.total_ms += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    if (!stroke.ok()) return in_stroke(stroke.error(), job, i);
    add_stroke(*stroke, report);
  }
  if (job.progress) job.progress(job.strokes.size(), job.strokes.size());
  return {};
}

}  // namespace

Result<CutResult> run_cut(LoadedMesh loaded, const CutJob& job, bool wants_mesh) {
  CutResult result;
  CutReport& report = result.report;
  report.input = loaded.source.file;
  report.input_format = loaded.source.format;
  report.notes = loaded.source.notes;
  report.options = job.options;
  report.options.profile = job.engine.cut.profile;
  report.options.snap = job.engine.cut.snap;
  report.options.threads = job.engine.threads;
  report.strokes = job.strokes.size();
  measure_before(loaded.mesh, report);
  Result<Engine> engine = Engine::create(std::move(loaded.mesh), job.engine);
  if (!engine.ok()) return engine.error();
  if (const Status status = cut_all(*engine, job, report); !status.ok()) return status.error();
  const Components pieces = find_components(engine->mesh());
  measure_after(engine->mesh(), pieces, report);
  if (wants_mesh) result.mesh = to_mesh_data(engine->mesh(), pieces, loaded.file_vertex);
  return result;
}

}  // namespace app
}  // namespace incise::inline v0
