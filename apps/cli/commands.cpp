// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
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
#include "input_kind.h"
#include "mesh_output.h"
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
  for (const std::string& other : {a.mesh, a.blade, a.output.file, a.report, a.picture}) {
    if (!a.record.empty() && !other.empty() && is_same_file(a.record, other)) return true;
  }
  return false;
}

/// Likewise for the picture.
bool draws_over(const CutArguments& a) {
  for (const std::string& other : {a.mesh, a.blade, a.output.file, a.report}) {
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
  if (a.mesh == "-" && a.blade == "-") return "mesh and blade cannot both come from stdin; name one of them";
  if (a.mesh == "-" && !a.record.empty()) return "--record needs the mesh as a file, which a replay can read again";
  if (a.record == "-" || a.picture == "-") return "recordings and pictures do not go to stdout; name a file";
  if (takes_a_place(a)) return "--record " + a.record + " is another file of this command; give it a name of its own";
  if (draws_over(a)) return "--picture " + a.picture + " is another file of this command; give it a name of its own";
  if (!a.picture.empty() && fs::path(a.picture).extension() != ".png") {
    return "--picture " + a.picture + ": unknown extension; pictures are .png";
  }
  return {};
}

/// Whether outputs can be written, as far as their names tell; else says why and gives the exit code.
std::optional<ExitCode> refuse_outputs(const MeshOutput& mesh, bool has_json_on_stdout,
                                       const std::vector<std::string>& others, const Terminal& terminal) {
  std::optional<OutputProblem> problem = problem_of(mesh);
  if (!problem && mesh.is_stdout() && has_json_on_stdout) {
    problem =
        OutputProblem{"-o - writes the mesh to stdout, where the figures would go too; give either a file", kUsage};
  }
  for (const std::string& file : others) {
    if (!problem && !has_folder(file)) {
      problem = OutputProblem{file + ": its folder does not exist; create it first", kFailure};
    }
  }
  if (!problem) return std::nullopt;
  terminal.error(problem->text);
  return problem->code;
}

/// Says which of the flags change nothing beside the others.
void note_idle_flags(const CutArguments& a, const Terminal& terminal) {
  const bool is_paper = a.profile == "paper";
  if (is_paper && a.has_snap) terminal.note("--snap has no effect with --profile paper, which never snaps");
  if (a.no_smooth_boundary && (!is_paper || a.no_improve)) {
    terminal.note("--no-smooth-boundary has no effect without --profile paper and its improvement");
  }
  if (a.budget_us == 0) return;
  if (a.no_merge && a.no_improve) {
    terminal.note("--budget-us has no effect with --no-merge and --no-improve, which leave nothing to bound");
  } else if (is_paper) {
    terminal.note(kNoBudgetAsPaper);
  }
}

Result<std::vector<Stroke>> strokes_of(const CutArguments& a, const TetMesh& mesh) {
  if (!a.blade.empty()) {
    Result<std::vector<Stroke>> strokes = app::read_blade(input_of(a.blade));
    if (!strokes.ok()) return explain_kind(strokes.error(), a.blade, FileKind::kBlade);
    return strokes;
  }
  const Plane plane = *parse_plane(a.plane);
  Result<Stroke> stroke = plane_stroke(rest_bounds(mesh), plane.normal, plane.offset);
  if (!stroke.ok()) return stroke.error();
  return std::vector<Stroke>{std::move(stroke).value()};
}

app::CutJob job_of(const CutArguments& a, std::vector<Stroke> strokes, const Terminal& terminal, ProgressBar& bar) {
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
  job.progress = [&bar](std::size_t done, std::size_t total) { bar.show(done, total); };
  return job;
}

/// Where a job's figures go.
struct ReportOutput {
  std::string file;  // "-": stdout; empty: nowhere
  bool as_json = false;

  [[nodiscard]] bool is_on_stdout() const { return as_json || file == "-"; }
};

Status write_report(const ReportOutput& output, const app::JobReport& report, const Terminal& terminal) {
  if (!output.file.empty() && output.file != "-") {
    if (Status status = app::write_text_file(output.file, app::to_json(report)); !status.ok()) return status;
    terminal.wrote(output.file, "report");
  }
  return output.is_on_stdout() ? terminal.data(app::to_json(report)) : Status();
}

Status write_results(const MeshOutput& output, const ReportOutput& report, const app::JobResult& result,
                     const Terminal& terminal) {
  const WritingZone zone;
  if (output.is_wanted() && (result.report.change.ok || result.report.broken)) {
    if (Status status = write_output(output, result.mesh, terminal); !status.ok()) return status;
  }
  return write_report(report, result.report, terminal);
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
int finish_job(const MeshOutput& output, const ReportOutput& report, const std::string& work,
               const app::JobResult& result, const Terminal& terminal) {
  if (const Status status = write_results(output, report, result, terminal); !status.ok()) {
    return fail(terminal, status.error(), status.error().code == ErrorCode::kBadArgument ? kUsage : kFailure);
  }
  if (!report.is_on_stdout()) terminal.summary(app::to_text(result.report), output.is_stdout());
  if (result.report.change.ok) return kDone;
  return fail(terminal, broken_text(output.file, work, result.report), kCheckFailed);
}

/// A number as people write it.
std::string shown(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// Says which strokes met nothing, and where a plane would have.
void warn_of_misses(const CutArguments& a, const app::CutJob& job, const app::JobReport& report, const Box& body,
                    const Terminal& terminal) {
  if (report.missed.empty()) return;
  if (a.blade.empty()) {
    const Vec3 normal = parse_plane(a.plane)->normal;
    const Vec3 middle = (body.lo + body.hi) / 2, half = (body.hi - body.lo) / 2;
    const double at = normal.dot(middle), reach = normal.cwiseAbs().dot(half);
    return terminal.warning("the plane " + a.plane + " misses the mesh: nothing was cut; its box has d from " +
                            shown(at - reach) + " to " + shown(at + reach) + " along that normal");
  }
  const std::size_t first = report.missed.front();
  const std::string& name = job.strokes[first].name;
  const std::string which = "stroke " + std::to_string(first) + (name.empty() ? "" : " \"" + name + "\"");
  const std::size_t more = report.missed.size() - 1;
  terminal.warning(a.blade + ": " + which + (more > 0 ? " and " + std::to_string(more) + " more" : "") +
                   " cut nothing; does the blade meet the mesh? incise info tells its bounds");
}

/// Reads a mesh to work on, and says what was mended on the way.
Result<io::LoadedMesh> load(const std::string& mesh, const Terminal& terminal) {
  Result<io::LoadedMesh> loaded = io::load_mesh(input_of(mesh));
  if (!loaded.ok()) return explain_kind(loaded.error(), mesh, FileKind::kMesh);
  print_notes(loaded->source.notes, mesh, terminal);
  return loaded;
}

}  // namespace

int run_info(const InfoArguments& arguments, const Terminal& terminal) {
  const Result<io::MeshFile> file = io::read_mesh(input_of(arguments.mesh));
  if (!file.ok()) return fail(terminal, explain_kind(file.error(), arguments.mesh, FileKind::kMesh), kBadInput);
  const app::MeshInfo info = app::inspect(*file, arguments.mesh);
  return finish(terminal, terminal.data(arguments.as_json ? app::to_json(info) : app::to_text(info)));
}

int run_check(const InfoArguments& arguments, const Terminal& terminal) {
  Result<io::MeshFile> file = io::read_mesh(input_of(arguments.mesh));
  if (!file.ok()) return fail(terminal, explain_kind(file.error(), arguments.mesh, FileKind::kMesh), kBadInput);
  const Result<app::MeshCheck> check = app::check_mesh(std::move(file).value(), arguments.mesh);
  if (!check.ok()) return fail(terminal, check.error(), kBadInput);
  const int code = finish(terminal, terminal.data(arguments.as_json ? app::to_json(*check) : app::to_text(*check)));
  return code == kDone && !check->ok ? kCheckFailed : code;
}

int run_cut(const CutArguments& arguments, const Terminal& terminal) {
  const ReportOutput report{arguments.report, arguments.as_json};
  if (const std::string problem = usage_problem(arguments); !problem.empty()) return fail(terminal, problem, kUsage);
  if (const auto code = refuse_outputs(arguments.output, report.is_on_stdout(),
                                       {arguments.report, arguments.record, arguments.picture}, terminal)) {
    return *code;
  }
  if (!arguments.picture.empty()) {  // before anything is written
    if (const Status status = check_drawing(); !status.ok()) return fail(terminal, status.error(), kNoDisplay);
  }
  note_idle_flags(arguments, terminal);
  Result<io::LoadedMesh> loaded = load(arguments.mesh, terminal);
  if (!loaded.ok()) return fail(terminal, loaded.error(), kBadInput);
  Result<std::vector<Stroke>> strokes = strokes_of(arguments, loaded->mesh);
  if (!strokes.ok()) return fail(terminal, strokes.error(), kBadInput);
  const Box body = rest_bounds(loaded->mesh);
  std::optional<ProgressBar> bar(std::in_place, terminal, arguments.blade.empty() ? "cuts" : "steps");
  app::CutJob job = job_of(arguments, std::move(strokes).value(), terminal, *bar);
  Status drawn;
  if (!arguments.picture.empty()) job.look = [&](const Engine& end) { drawn = draw_cut(end, arguments.picture); };
  const Result<app::JobResult> result = app::run_cut(std::move(loaded).value(), job, arguments.output.is_wanted());
  bar.reset();
  if (!drawn.ok()) return fail(terminal, drawn.error(), kFailure);
  if (!result.ok()) {
    return fail(terminal, result.error(), result.error().code == ErrorCode::kBadArgument ? kBadInput : kFailure);
  }
  warn_of_misses(arguments, job, result->report, body, terminal);
  if (!arguments.picture.empty()) terminal.wrote(arguments.picture, "picture");
  if (!arguments.record.empty()) terminal.wrote(arguments.record, "recording");
  return finish_job(arguments.output, report, "cut", *result, terminal);
}

int run_improve(const ImproveArguments& arguments, const Terminal& terminal) {
  const ReportOutput report{arguments.report, arguments.as_json};
  if (const auto code = refuse_outputs(arguments.output, report.is_on_stdout(), {arguments.report}, terminal)) {
    return *code;
  }
  if (arguments.profile == "paper" && arguments.budget_us > 0) terminal.note(kNoBudgetAsPaper);
  Result<io::LoadedMesh> loaded = load(arguments.mesh, terminal);
  if (!loaded.ok()) return fail(terminal, loaded.error(), kBadInput);
  std::optional<ProgressBar> bar(std::in_place, terminal, "improving");
  app::ImproveJob job;
  job.engine.cut.profile = profile_of(arguments.profile);
  job.engine.log = terminal.log_sink();
  job.budget_us = arguments.budget_us;
  job.tick = [&bar] { bar->show_time(); };
  const Result<app::JobResult> result = app::run_improve(std::move(loaded).value(), job, arguments.output.is_wanted());
  bar.reset();
  if (!result.ok()) return fail(terminal, result.error(), kFailure);
  return finish_job(arguments.output, report, "improvement", *result, terminal);
}

}  // namespace incise_cli
