// SPDX-License-Identifier: Apache-2.0
#include "tables_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>

#include "incise/geom/quality.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/components.h"
#include "maintenance_measure.h"
#include "report.h"

namespace incise::bench {

namespace {

EngineOptions options_of(Way way) {
  EngineOptions options;
  options.cut.profile = way < Way::kInciseCut ? Profile::kPaper : Profile::kIncise;
  options.maintain.merge =
      way == Way::kPaperMerged || way == Way::kPaper || way == Way::kInciseMerged || way == Way::kIncise;
  options.maintain.improve = way == Way::kPaperImproved || way == Way::kPaper || way == Way::kIncise;
  options.maintain.work_units = 0;  // it follows each stroke in a call of its own
  return options;
}

double ratio_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  const Vec3 &a = mesh.rest(v[0]), &b = mesh.rest(v[1]), &c = mesh.rest(v[2]), &d = mesh.rest(v[3]);
  return is_flat(a, b, c, d) ? std::numeric_limits<double>::infinity() : longest_edge_over_inradius(a, b, c, d);
}

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  mesh.for_each_tet([&](TetId tet) { sum += mesh.rest_volume(tet); });
  return sum;
}

/// All strokes, each with its maintenance.
bool cut_once(Engine& engine, const std::vector<Stroke>& strokes, CutResult& out) {
  for (const Stroke& stroke : strokes) {
    const double start = thread_ms();
    const Result<StrokeReport> report = engine.cut(stroke);
    const double middle = thread_ms();
    if (!report) {
      std::fprintf(stderr, "the cut failed: %s\n", report.error().message.c_str());
      return false;
    }
    out.stages += report->times;
    out.stages += engine.maintain()->times;
    out.cut += report->cut;
    out.cut_ms += middle - start;
    out.maintain_ms += thread_ms() - middle;
  }
  const double start = thread_ms();
  out.stages += engine.maintain()->times;  // the paper's incision is complete: what its front has held
  out.maintain_ms += thread_ms() - start;
  return true;
}

StageTimes least(StageTimes a, const StageTimes& b) {
  for (std::size_t i = 0; i < a.ms.size(); ++i) {
    a.ms[i] = std::min(a.ms[i], b.ms[i]);
  }
  return a;
}

/// Scales stages that took longer by the clock than the processor worked: the machine had other things to do.
void cap(StageTimes& times, std::initializer_list<Stage> stages, double processor_ms) {
  double sum = 0;
  for (const Stage stage : stages) {
    sum += times[stage];
  }
  for (const Stage stage : stages) {
    times[stage] *= sum > processor_ms ? processor_ms / sum : 1;
  }
}

void write_mesh(const TetMesh& mesh, const std::filesystem::path& file) {
  if (const Status status = io::write_mesh(file, io::to_mesh_data(mesh, find_components(mesh))); !status.ok()) {
    std::fprintf(stderr, "%s\n", status.error().message.c_str());
  }
}

void measure_result(const TableCase& of, const TetMesh& mesh, CutResult& out) {
  out.mesh = measure(mesh);
  const double volume = volume_of(of.mesh);
  out.volume_error = std::abs(volume_of(mesh) - volume) / volume;
  out.defects = new_defects(validate(of.mesh, ValidateLevel::kGeometry), mesh);
  out.is_ok = true;
}

CutResult make_cut(const TableCase& of, Way way, unsigned runs, const std::filesystem::path& mesh_file) {
  CutResult best;
  Result<Engine> engine = Engine::create(of.mesh, options_of(way));
  for (unsigned run = 0; run < runs; ++run) {
    while (engine->undo()) {
    }
    CutResult out;
    if (!cut_once(*engine, of.strokes, out)) {
      return best;
    }
    const StageTimes stages = run == 0 ? out.stages : least(best.stages, out.stages);
    if (run == 0 || out.total_ms() < best.total_ms()) {
      best = out;
    }
    best.stages = stages;
  }
  cap(best.stages, {Stage::kCollision, Stage::kSubdivide, Stage::kSeparate}, best.cut_ms);
  cap(best.stages, {Stage::kMerge, Stage::kImprove}, best.maintain_ms);
  measure_result(of, engine->mesh(), best);
  if (!mesh_file.empty()) {
    write_mesh(engine->mesh(), mesh_file);
  }
  return best;
}

}  // namespace

MeshFigures measure(const TetMesh& mesh) {
  MeshFigures out;
  out.all = measure_quality(mesh);
  out.wall = measure_quality(mesh, [&](TetId tet) { return touches_cut(mesh, tet); });
  mesh.for_each_tet([&](TetId tet) { out.ratios.push_back(ratio_of(mesh, tet)); });
  return out;
}

double CaseResults::growth(Way way) const {
  return static_cast<double>((*this)[way].tets()) / static_cast<double>(original.all.tets);
}

double CaseResults::mean_ratio(Way way) const {
  return (*this)[way].mesh.all.lr_mean / original.all.lr_mean;
}

CaseResults run_case(const TableCase& of, unsigned runs, const std::filesystem::path& mesh_folder) {
  CaseResults results;
  results.of = &of;
  results.original = measure(of.mesh);
  if (!mesh_folder.empty()) {
    write_mesh(of.mesh, mesh_folder / (of.id + "_original.mesh"));
  }
  for (std::size_t i = 0; i < kWays; ++i) {
    const Way way = static_cast<Way>(i);
    const bool is_written = way == Way::kPaperCut && !mesh_folder.empty();
    results.cuts[i] = make_cut(of, way, runs, is_written ? mesh_folder / (of.id + "_cut.mesh") : "");
  }
  return results;
}

}  // namespace incise::bench
