// SPDX-License-Identifier: Apache-2.0
// The command `incise cut`.
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "app/jobs/cut_job.h"
#include "app/scene/blade_file.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "incise/lab/method.h"
#include "incise/mesh/bounds.h"
#include "input_kind.h"
#include "job_output.h"
#include "picture.h"

namespace incise_cli {
namespace {

namespace fs = std::filesystem;
using namespace incise;

struct CutArguments {
  std::string mesh, blade, plane, report, record, picture;
  MeshOutput output;
  bool as_json = false;
  std::string profile = "incise";
  double snap = 0.2;
  bool has_snap = false;
  bool no_merge = false, no_improve = false, no_smooth_boundary = false;
  std::uint64_t budget_us = 0;  // 0: none
  std::uint64_t seed = 0;
  unsigned threads = 1;
};

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

/// The method that the paper cites, where one was asked for.
std::optional<LabMethod> method_of(const CutArguments& a) {
  return find_lab_method(a.profile);
}

/// What is wrong with the arguments, or nothing.
std::string usage_problem(const CutArguments& a) {
  if (a.blade.empty() == a.plane.empty()) return "give either --blade B.json or --plane nx,ny,nz,d";
  if (!a.plane.empty() && !parse_plane(a.plane)) {
    return "--plane " + a.plane + ": four finite numbers nx,ny,nz,d are needed, the first three not all zero";
  }
  if (!std::isfinite(a.snap) || a.snap < 0 || a.snap > 0.4) return "--snap must lie between 0 and 0.4";
  if (a.mesh == "-" && a.blade == "-") return "mesh and blade cannot both come from stdin; name one of them";
  if (method_of(a) && !a.record.empty()) {
    return "--record does not go with --profile " + a.profile + ", which a replay does not know; leave one out";
  }
  if (a.mesh == "-" && !a.record.empty()) return "--record needs the mesh as a file, which a replay can read again";
  if (a.record == "-" || a.picture == "-") return "recordings and pictures do not go to stdout; name a file";
  if (takes_a_place(a)) return "--record " + a.record + " is another file of this command; give it a name of its own";
  if (draws_over(a)) return "--picture " + a.picture + " is another file of this command; give it a name of its own";
  if (!a.picture.empty() && fs::path(a.picture).extension() != ".png") {
    return "--picture " + a.picture + ": unknown extension; pictures are .png";
  }
  return {};
}

/// Of a method that neither snaps split points nor maintains.
void note_idle_beside_method(const CutArguments& a, const Terminal& terminal) {
  const auto note = [&](bool is_given, const std::string& flag) {
    if (is_given) terminal.note(flag + " has no effect with --profile " + a.profile + ", which cuts and does no more");
  };
  note(a.has_snap, "--snap");
  note(a.no_merge, "--no-merge");
  note(a.no_improve, "--no-improve");
  note(a.no_smooth_boundary, "--no-smooth-boundary");
  note(a.budget_us > 0, "--budget-us");
}

/// Says which of the flags change nothing beside the others.
void note_idle_flags(const CutArguments& a, const Terminal& terminal) {
  if (method_of(a)) return note_idle_beside_method(a, terminal);
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
  job.method = method_of(a);
  job.engine.cut.profile = profile_of(a.profile);
  job.engine.cut.snap = a.snap;
  job.engine.maintain.merge = !a.no_merge && !job.method;
  job.engine.maintain.improve = !a.no_improve && !job.method;
  job.engine.maintain.smooth_boundary = !a.no_smooth_boundary;
  job.engine.threads = a.threads;
  job.engine.log = terminal.log_sink();
  job.budget_us = job.method ? 0 : a.budget_us;
  job.options.seed = a.seed;
  job.options.blade = a.blade;
  job.options.plane = a.plane;
  job.progress = [&bar](std::size_t done, std::size_t total) { bar.show(done, total); };
  return job;
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

}  // namespace

namespace {

void add_cut_profile(CLI::App& command, std::string& profile) {
  std::vector<std::string> names = {"incise", "paper"};
  names.insert(names.end(), kLabMethodNames.begin(), kLabMethodNames.end());
  command
      .add_option("--profile", profile,
                  "incise (default); paper: the published method; or a method that it cites, which is not maintained")
      ->check(CLI::IsMember(names));
}

}  // namespace

Command add_cut(CLI::App& root) {
  const auto arguments = std::make_shared<CutArguments>();
  CLI::App* cut = add_command(root, "cut", "Cut a mesh along a blade's path or a plane",
                              "  incise cut cube.mesh --plane 1,0,0,0.5 -o halves.vtu\n"
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json -o cut.vtu --report cut.json\n"
                              "  incise cut bunny.node --plane=-1,0,2,0.3 --profile paper --report -\n"
                              "  incise cut bunny.node --plane=-1,0,2,0.3 --profile removal --report -\n"
                              "  incise cut cube.mesh --plane 1,0,0,0.5 --no-merge --no-improve -o raw.vtu\n"
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json --budget-us 2000 -o cut.vtu\n"
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json --record cut.jsonl\n"
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json --picture cut.png");
  cut->add_option("MESH", arguments->mesh, kMeshHelp)->required();
  cut->add_option("--blade", arguments->blade, "Blade file: JSON of format incise-blade; - for stdin");
  cut->add_option("--plane", arguments->plane, "nx,ny,nz,d: cut through everything along n.x = d, n of any length");
  add_output(*cut, arguments->output);
  add_cut_profile(*cut, arguments->profile);
  cut->add_option("--snap", arguments->snap,
                  "Snapping distance as a fraction of the mean incident edge, 0 to 0.4 (default 0.2)");
  cut->add_flag("--no-merge", arguments->no_merge, "Do not merge short edges after a stroke");
  cut->add_flag("--no-improve", arguments->no_improve, "Do not improve the mesh around a cut after a stroke");
  cut->add_flag("--no-smooth-boundary", arguments->no_smooth_boundary,
                "Of --profile paper: leave its Boundary Laplacian out (the paper's Figure 10)");
  add_report(*cut, arguments->report, arguments->as_json);
  cut->add_option("--seed", arguments->seed, "Seed, repeated in the report");
  add_threads(*cut, arguments->threads);
  cut->add_option("--record", arguments->record, "Record every step as JSON lines, for incise replay");
  cut->add_option("--picture", arguments->picture, "Draw the result to this PNG; needs OpenGL, but no display");
  add_budget(
      *cut, arguments->budget_us,
      "Microseconds for maintenance per stroke, 1 to 3600000000; what is left over may be spent later, what is not "
      "done waits for the next stroke. The cut itself is never left undone");
  return {cut, [arguments, cut](const Terminal& terminal) {
            arguments->has_snap = cut->count("--snap") > 0;
            return run_cut(*arguments, terminal);
          }};
}

}  // namespace incise_cli
