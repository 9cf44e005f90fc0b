// SPDX-License-Identifier: Apache-2.0
// The methods of the lab cut the bare mesh with a journal that nobody follows; an engine is made only at the end, for
// whoever looks.
#include "app/jobs/lab_cut.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "app/jobs/job_internal.h"
#include "incise/io/mesh_export.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace detail {
namespace {

/// Walls of the strokes to come get the tags above it.
std::uint32_t highest_tag(const TetMesh& mesh) {
  std::uint32_t highest = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (const Link link : mesh.links(tet)) highest = std::max(highest, link.is_boundary() ? link.tag() : 0U);
  });
  return highest;
}

double volume_tolerance(LabMethod method) {
  return keeps_volume(method) ? 1e-12 : std::numeric_limits<double>::infinity();
}

/// Methods divide, move and snap anew where a stroke goes over an earlier one, though nothing opens.
bool missed(LabMethod method, const CutStatistics& cut) {
  return method == LabMethod::kRemoval ? cut.cut_tets == 0 : opened_nothing(cut);
}

Status cut_all(TetMesh& mesh, const CutJob& job, JobReport& report) {
  const std::uint32_t earlier = highest_tag(mesh);
  Journal journal;
  if (job.progress) job.progress(0, job.strokes.size());
  for (std::size_t i = 0; i < job.strokes.size(); ++i) {
    const auto tag = static_cast<std::uint32_t>(earlier + 1 + i);
    const Stopwatch watch;
    const Result<CutStatistics> cut = cut_by(*job.method, mesh, journal, job.strokes[i], tag, job.engine.threads);
    if (!cut.ok()) return in_stroke(cut.error(), job, i);
    StepSamples samples;
    samples.add(watch.ms(), {});
    if (missed(*job.method, *cut)) report.missed.push_back(i);
    report.cut += *cut;
    add_operation({}, samples, report);
    if (job.progress) job.progress(i + 1, job.strokes.size());
  }
  measure_cut(mesh, report);
  return {};
}

}  // namespace

Result<JobResult> run_lab_cut(io::LoadedMesh loaded, const CutJob& job, bool wants_mesh, JobReport report) {
  JobResult result{std::move(report), {}};
  TetMesh& mesh = loaded.mesh;
  measure_before(mesh, result.report);
  if (const Status status = cut_all(mesh, job, result.report); !status.ok()) return status.error();
  const Components pieces = find_components(mesh);
  measure_after(mesh, pieces, volume_tolerance(*job.method), result.report);
  if (wants_mesh) result.mesh = io::to_mesh_data(mesh, pieces, loaded.file_vertex);
  result.mesh.region_names = loaded.region_names;
  if (job.look) {
    const Result<Engine> engine = Engine::create(std::move(mesh), job.engine);
    if (!engine.ok()) return engine.error();
    job.look(*engine);
  }
  return result;
}

}  // namespace detail
}  // namespace app
}  // namespace v0
}  // namespace incise
