// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

#include "app/jobs/cut_job.h"
#include "app/jobs/improve_job.h"
#include "app/jobs/replay_job.h"
#include "app/model/convert.h"
#include "app/model/mesh_info.h"
#include "app/scene/blade_file.h"
#include "app/text/text_file.h"
#include "command_support.h"
#include "incise/mesh/bounds.h"
#include "picture.h"

namespace incise_cli {
namespace {

namespace fs = std::filesystem;
using namespace incise;

constexpr const char* kNoBudgetAsPaper =
    "--budget-us has no effect with --profile paper, which maintains the mesh in one go";

struct Plane {
  Vec3 normal;
  double offset = 0;
};

/// "nx,ny,nz,d": four finite numbers, the first three not all zero.
std::optional<Plane> parse_plane(const std::string& text) {
  std::array<double, 4> numbers{};
  const char* at = text.c_str();
  for (std::size_t i = 0; i < 4; ++i) {
    char* end = nullptr;
    numbers[i] = std::strtod(at, &end);
    if (end == at || !std::isfinite(numbers[i]) || *end != (i < 3 ? ',' : '\0')) return std::nullopt;
    at = end + 1;
  }
  const Vec3 normal(numbers[0], numbers[1], numbers[2]);
  if (normal.isZero(0)) return std::nullopt;
  return Plane{normal, numbers[3]};
}

/// Whether the recording would take the place of something else that the command reads or writes.
bool takes_a_place(const CutArguments& a) {
  for (const std::string& other : {a.mesh, a.blade, a.output, a.report, a.picture}) {
    if (!a.record.empty() && !other.empty() && is_same_file(a.record, other)) return true;
  }
  return false;
}

/// Likewise for the picture.
bool draws_over(const CutArguments& a) {
  for (const std::string& other : {a.mesh, a.blade, a.output, a.report}) {
    if (!a.picture.empty() && !other.empty() && is_same_file(a.picture, other)) return true;
  }
  return false;
}

/// What is wrong with the arguments, or nothing.
std::string usage_problem(const CutArguments& a) {
  if (a.blade.empty() == a.plane.empty()) return "give either --blade B.json or --plane nx,ny,nz,d";
  if (!a.plane.empty() && !parse_plane(a.plane)) {
    return "--plane " + a.plane + ": four finite numbers nx,ny,nz,d are needed, the first three not all zero";
  }
  if (!std::isfinite(a.snap) || a.snap < 0 || a.snap > 0.4) return "--snap must lie between 0 and 0.4";
  if (takes_a_place(a)) return "--record " + a.record + " is another file of this command; give it a name of its own";
  if (draws_over(a)) return "--picture " + a.picture + " is another file of this command; give it a name of its own";
  if (!a.picture.empty() && fs::path(a.picture).extension() != ".png") {
    return "--picture " + a.picture + ": unknown extension; pictures are .png";
  }
  return {};
}

/// Whether outputs can be written, as far as their names tell; else says why and gives the exit code.
std::optional<ExitCode> refuse_outputs(const std::string& mesh, const std::vector<std::string>& others,
                                       const Terminal& terminal) {
  if (!mesh.empty() && !app::is_mesh_extension(mesh)) {
    terminal.error(mesh + ": unknown extension; use " + app::kMeshExtensions);
    return kUsage;
  }
  std::vector<std::string> files = others;
  files.push_back(mesh);
  for (const std::string& file : files) {
    if (has_folder(file)) continue;
    terminal.error(file + ": its folder does not exist; create it first");
    return kFailure;
  }
  return std::nullopt;
}

/// Says which of the flags change nothing beside the others.
void note_idle_flags(const CutArguments& a, const Terminal& terminal) {
  const bool is_paper = a.profile == "paper";
  if (is_paper && a.has_snap) terminal.note("--snap has no effect with --profile paper, which never snaps");
  if (a.no_smooth_boundary && (!is_paper || a.no_improve)) {
    terminal.note("--no-smooth-boundary has no effect but on how --profile paper improves");
  }
  if (a.budget_us == 0) return;
  if (a.no_merge && a.no_improve) {
    terminal.note("--budget-us has no effect with --no-merge and --no-improve, which leave nothing to bound");
  } else if (is_paper) {
    terminal.note(kNoBudgetAsPaper);
  }
}

Result<std::vector<Stroke>> strokes_of(const CutArguments& a, const TetMesh& mesh) {
  if (!a.blade.empty()) return app::read_blade(a.blade);
  const Plane plane = *parse_plane(a.plane);
  Result<Stroke> stroke = plane_stroke(rest_bounds(mesh), plane.normal, plane.offset);
  if (!stroke.ok()) return stroke.error();
  return std::vector<Stroke>{std::move(stroke).value()};
}

app::CutJob job_of(const CutArguments& a, std::vector<Stroke> strokes, const Terminal& terminal) {
  app::CutJob job;
  job.strokes = std::move(strokes);
  job.by_steps = !a.blade.empty();
  job.record = a.record;
  job.engine.cut.profile = profile_of(a.profile);
  job.engine.cut.snap = a.snap;
  job.engine.maintain.merge = !a.no_merge;
  job.engine.maintain.improve = !a.no_improve;
  job.engine.maintain.smooth_boundary = !a.no_smooth_boundary;
  job.engine.threads = a.threads;
  job.engine.log = terminal.log_sink();
  job.budget_us = a.budget_us;
  job.options.seed = a.seed;
  job.options.blade = a.blade;
  job.options.plane = a.plane;
  job.progress = [&terminal](std::size_t done, std::size_t total) { terminal.progress(done, total, "strokes"); };
  return job;
}

Status write_results(const std::string& output, const std::string& report, const app::JobResult& result,
                     const Terminal& terminal) {
  const WritingZone zone;
  if (!output.empty() && (result.report.change.ok || result.report.broken)) {
    if (const Status status = io::write_mesh(output, result.mesh); !status.ok()) return status;
  }
  if (report == "-") {
    terminal.data(app::to_json(result.report));
  } else if (!report.empty()) {
    return app::write_text_file(report, app::to_json(result.report));
  }
  return {};
}

/// What became of a mesh that a job left invalid; `work` names the job.
std::string broken_text(const std::string& output, const std::string& work, const app::JobReport& report) {
  if (!report.broken) {
    return "the " + work +
           " broke the validity contract, so no mesh was written; see `validity` in the report (--report)";
  }
  const app::BrokenStroke& broken = *report.broken;
  const std::string name = broken.name.empty() ? "" : " \"" + broken.name + "\"";
  const std::string later = broken.index + 1 < report.strokes ? ", with those after it" : "";
  const std::string left = output.empty() ? "" : "; " + output + " has the mesh as it was before";
  return "stroke " + std::to_string(broken.index) + name + " broke the validity contract and was taken back" + later +
         left + "; see `validity` in the report (--report)";
}

/// Writes what a job gave and says how it went; `work` names it in messages.
int finish_job(const std::string& output, const std::string& report, const std::string& work,
               const app::JobResult& result, const Terminal& terminal) {
  if (const Status status = write_results(output, report, result, terminal); !status.ok()) {
    return fail(terminal, status.error(), status.error().code == ErrorCode::kBadArgument ? kUsage : kFailure);
  }
  if (report != "-" && !terminal.is_quiet) terminal.data(app::to_text(result.report));
  if (result.report.change.ok) return kDone;
  return fail(terminal, broken_text(output, work, result.report), kCheckFailed);
}

}  // namespace

int run_info(const InfoArguments& arguments, const Terminal& terminal) {
  const Result<io::MeshFile> file = io::read_mesh(arguments.mesh);
  if (!file.ok()) return fail(terminal, file.error(), kBadInput);
  const app::MeshInfo info = app::inspect(*file, arguments.mesh);
  terminal.data(arguments.as_json ? app::to_json(info) : app::to_text(info));
  return kDone;
}

int run_check(const InfoArguments& arguments, const Terminal& terminal) {
  Result<io::MeshFile> file = io::read_mesh(arguments.mesh);
  if (!file.ok()) return fail(terminal, file.error(), kBadInput);
  const Result<app::MeshCheck> check = app::check_mesh(std::move(file).value(), arguments.mesh);
  if (!check.ok()) return fail(terminal, check.error(), kBadInput);
  terminal.data(arguments.as_json ? app::to_json(*check) : app::to_text(*check));
  return check->ok ? kDone : kCheckFailed;
}

int run_cut(const CutArguments& arguments, const Terminal& terminal) {
  if (const std::string problem = usage_problem(arguments); !problem.empty()) return fail(terminal, problem, kUsage);
  if (const auto code =
          refuse_outputs(arguments.output, {arguments.report, arguments.record, arguments.picture}, terminal)) {
    return *code;
  }
  if (!arguments.picture.empty()) {  // before anything is written
    if (const Status status = check_drawing(); !status.ok()) return fail(terminal, status.error(), kNoDisplay);
  }
  note_idle_flags(arguments, terminal);
  Result<io::LoadedMesh> loaded = io::load_mesh(arguments.mesh);
  if (!loaded.ok()) return fail(terminal, loaded.error(), kBadInput);
  print_notes(loaded->source.notes, arguments.mesh, terminal);
  Result<std::vector<Stroke>> strokes = strokes_of(arguments, loaded->mesh);
  if (!strokes.ok()) return fail(terminal, strokes.error(), kBadInput);
  app::CutJob job = job_of(arguments, std::move(strokes).value(), terminal);
  Status drawn;
  if (!arguments.picture.empty()) job.look = [&](const Engine& end) { drawn = draw_cut(end, arguments.picture); };
  const Result<app::JobResult> result = app::run_cut(std::move(loaded).value(), job, !arguments.output.empty());
  if (!drawn.ok()) return fail(terminal, drawn.error(), kFailure);
  if (result.ok()) return finish_job(arguments.output, arguments.report, "cut", *result, terminal);
  return fail(terminal, result.error(), result.error().code == ErrorCode::kBadArgument ? kBadInput : kFailure);
}

int run_improve(const ImproveArguments& arguments, const Terminal& terminal) {
  if (const auto code = refuse_outputs(arguments.output, {arguments.report}, terminal)) return *code;
  if (arguments.profile == "paper" && arguments.budget_us > 0) terminal.note(kNoBudgetAsPaper);
  Result<io::LoadedMesh> loaded = io::load_mesh(arguments.mesh);
  if (!loaded.ok()) return fail(terminal, loaded.error(), kBadInput);
  print_notes(loaded->source.notes, arguments.mesh, terminal);
  app::ImproveJob job;
  job.engine.cut.profile = profile_of(arguments.profile);
  job.engine.log = terminal.log_sink();
  job.budget_us = arguments.budget_us;
  const Result<app::JobResult> result = app::run_improve(std::move(loaded).value(), job, !arguments.output.empty());
  if (!result.ok()) return fail(terminal, result.error(), kFailure);
  return finish_job(arguments.output, arguments.report, "improvement", *result, terminal);
}

namespace {

/// Says where a replay ended, if not where it should.
void note_end(const app::ReplayResult& result, const std::string& recording, const Terminal& terminal) {
  const std::string after = recording + ": after " + std::to_string(result.calls) + " calls ";
  if (result.is_cut_off) terminal.note(after + "the recording is cut off; what was whole has been replayed");
  if (result.is_in_stroke) terminal.note(after + "a stroke is still under way; the mesh is as its last step left it");
}

int report_difference(const app::ReplayDifference& d, const std::string& recording, const Terminal& terminal) {
  return fail(terminal,
              recording + ":" + std::to_string(d.line) + ": the call \"" + d.call +
                  "\" came out differently: expected " + d.expected + ", found " + d.found +
                  "; no mesh was written. Was it another version that recorded?",
              kCheckFailed);
}

}  // namespace

int run_replay(const ReplayArguments& arguments, const Terminal& terminal) {
  if (const auto code = refuse_outputs(arguments.output, {}, terminal)) return *code;
  const app::ReplayJob job{arguments.recording, arguments.verify, !arguments.output.empty(), terminal.log_sink()};
  const Result<app::ReplayResult> result = app::run_replay(job);
  if (!result.ok()) return fail(terminal, result.error(), exit_of(result.error()));
  note_end(*result, arguments.recording, terminal);
  if (result->difference) return report_difference(*result->difference, arguments.recording, terminal);
  const WritingZone zone;
  if (!arguments.output.empty()) {
    const Status status = io::write_mesh(arguments.output, result->mesh);
    if (!status.ok()) return fail(terminal, status.error(), kFailure);
  }
  if (!terminal.is_quiet) terminal.data(app::to_text(*result));
  return kDone;
}

int run_convert(const ConvertArguments& arguments, const Terminal& terminal) {
  if (!has_folder(arguments.out)) {
    return fail(terminal, arguments.out + ": its folder does not exist; create it first", kFailure);
  }
  const WritingZone zone;
  const Result<app::Conversion> done = app::convert(arguments.in, arguments.out);
  if (!done.ok()) return fail(terminal, done.error(), exit_of(done.error()));
  print_notes(done->notes, arguments.in, terminal);
  return kDone;
}

}  // namespace incise_cli
