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
#include "app/model/fine_file.h"
#include "app/scene/blade_file.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "fine_output.h"
#include "incise/cut/region_guard.h"
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
  FineArguments fine;
  bool as_json = false;
  bool at_once = false;  // each stroke of a blade as one sheet, as a plane is cut
  std::string profile = "incise";
  std::vector<std::string> stop_at;
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
  if (is_stdin(a.mesh) && is_stdin(a.blade)) return "mesh and blade cannot both come from stdin; name one of them";
  if (!a.stop_at.empty() && a.blade.empty()) return "--stop-at holds a blade back; give it by --blade";
  if (method_of(a) && !a.record.empty()) {
    return "--record does not go with --profile " + a.profile + ", which a replay does not know; leave one out";
  }
  if (is_stdin(a.mesh) && !a.record.empty()) return "--record needs the mesh as a file, which a replay can read again";
  if (a.record == "-" || a.picture == "-") return "recordings and pictures do not go to stdout; name a file";
  const std::string clash =
      clash_of({{"--report", a.report}, {"--record", a.record}, {"--picture", a.picture}, {"--drawn", a.fine.drawn}},
               {a.mesh, a.blade, a.output.file});
  if (!clash.empty()) return clash;
  if (const std::string problem = fine_problem(a.fine); !problem.empty()) return problem;
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
  note(a.at_once, "--at-once");
  note(a.budget_us > 0, "--budget-us");
}

/// Says which of the flags change nothing beside the others.
void note_idle_flags(const CutArguments& a, const Terminal& terminal) {
  if (method_of(a)) return note_idle_beside_method(a, terminal);
  const bool is_paper = a.profile == "paper";
  if (a.at_once && !a.plane.empty()) terminal.note("--at-once has no effect with --plane, which is one sheet anyway");
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

/// The strokes of the blade file, all of which stop at --stop-at as well, by name or number.
Result<std::vector<app::BladeStroke>> blade_of(const CutArguments& a) {
  Result<std::vector<app::BladeStroke>> blade = app::read_blade_file(input_of(a.blade));
  if (!blade.ok()) return explain_kind(blade.error(), a.blade, FileKind::kBlade);
  for (const std::string& stop : a.stop_at) {
    std::int32_t number = 0;
    const bool is_number = CLI::detail::lexical_cast(stop, number);
    for (app::BladeStroke& stroke : *blade) {
      if (is_number) stroke.stop_at.push_back(number);
      if (!is_number) stroke.stop_names.push_back(stop);
    }
  }
  return blade;
}

/// The strokes as the blade may go.
Result<std::vector<Stroke>> held_strokes_of(const CutArguments& a, const io::LoadedMesh& loaded) {
  if (!a.blade.empty()) {
    const Result<std::vector<app::BladeStroke>> blade = blade_of(a);
    if (!blade.ok()) return blade.error();
    Result<std::vector<Stroke>> held = app::held_strokes(*blade, loaded.mesh, loaded.region_names);
    if (!held.ok())
      return Error{held.error().code, name_of_input(a.blade) + ": " + held.error().message, held.error().ids};
    return held;
  }
  const Plane plane = *parse_plane(a.plane);
  Result<Stroke> stroke = plane_stroke(rest_bounds(loaded.mesh), plane.normal, plane.offset);
  if (!stroke.ok()) return stroke.error();
  return std::vector<Stroke>{std::move(stroke).value()};
}

app::CutJob job_of(const CutArguments& a, std::vector<Stroke> strokes, const Terminal& terminal, ProgressBar& bar) {
  app::CutJob job;
  job.strokes = std::move(strokes);
  job.by_steps = !a.blade.empty() && !a.at_once;
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
  if (job.by_steps || job.method) {
    job.progress = [&bar](std::size_t done, std::size_t total) { bar.show(done, total); };
  } else {
    job.stage = [&bar](std::string_view name, unsigned percent) { bar.show_stage(name, percent); };
  }
  return job;
}

/// A number as people write it.
std::string shown(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

Box box_of(const Stroke& stroke) {
  Box box;
  for (const std::vector<Vec3>& edge : stroke.edges) {
    for (const Vec3& point : edge) box.extend(point);
  }
  return box;
}

/// Says which strokes met nothing, and where a plane would have.
void warn_of_closed(const CutArguments& a, const app::CutJob& job, const app::JobReport& report, const Box& body,
                    const Terminal& terminal) {
  if (report.missed.empty()) return;
  if (a.blade.empty()) {
    const Vec3 normal = parse_plane(a.plane)->normal;
    const Vec3 middle = (body.lo + body.hi) / 2, half = (body.hi - body.lo) / 2;
    const double at = normal.dot(middle), reach = normal.cwiseAbs().dot(half);
    if (std::abs(parse_plane(a.plane)->offset - at) < reach) {
      const bool is_across = report.cut.cut_tets > 0 || report.cut.snapped_vertices > 0;
      return terminal.warning("the plane " + a.plane +
                              " cut nothing: " + (is_across ? "no face came open" : "no tet lies across it"));
    }
    const bool touches = std::abs(parse_plane(a.plane)->offset - at) <= reach;
    return terminal.warning(
        "the plane " + a.plane +
        (touches ? " only touches the mesh: no face came open" : " misses the mesh: nothing was cut") +
        "; d has to lie between " + shown(at - reach) + " and " + shown(at + reach) +
        ", where the mesh's box ends along that normal");
  }
  std::vector<std::uint64_t> missed = report.missed;
  if (report.cut.incision_faces > 0) {  // others may go on within a tet that is open already
    std::erase_if(missed, [&](std::uint64_t i) { return box_of(job.strokes[i]).overlaps(body); });
  }
  std::vector<std::string> names;
  for (const Stroke& stroke : job.strokes) names.push_back(stroke.name);
  warn_of_misses(name_of_input(a.blade), missed, names, terminal);
}

/// The picture and the surface that were asked for.
Status draw_end(const CutArguments& a, const Engine& end, app::FineView* fine) {
  if (!a.picture.empty()) {
    if (Status status = draw_cut(end, fine, a.picture); !status.ok()) return status;
  }
  if (a.fine.drawn.empty()) return {};
  const Result<app::GltfBody> body = body_of(*fine, end.mesh(), end.journal(), 1);
  return body.ok() ? app::write_drawn(a.fine.drawn, *body) : Status(body.error());
}

int run_cut(const CutArguments& arguments, const Terminal& terminal) {
  const ReportOutput report{arguments.report, arguments.as_json};
  if (const std::string problem = usage_problem(arguments); !problem.empty()) return fail(terminal, problem, kUsage);
  if (const auto code =
          refuse_outputs(arguments.output, report.is_on_stdout(),
                         {arguments.report, arguments.record, arguments.picture, arguments.fine.drawn}, terminal)) {
    return *code;
  }
  if (!arguments.picture.empty()) {  // before anything is written
    if (const Status status = check_drawing(); !status.ok()) return fail(terminal, status.error(), kNoDisplay);
  }
  note_idle_flags(arguments, terminal);
  Result<io::LoadedMesh> loaded = load(arguments.mesh, terminal);
  if (!loaded.ok()) return fail(terminal, loaded.error(), kBadInput);
  Result<std::vector<Stroke>> strokes = held_strokes_of(arguments, *loaded);
  if (!strokes.ok()) return fail(terminal, strokes.error(), kBadInput);
  Result<std::optional<app::FineView>> fine = bind_fine(arguments.fine, loaded->mesh);
  if (!fine.ok()) return fail(terminal, fine.error(), kBadInput);
  const Box body = rest_bounds(loaded->mesh);
  std::optional<ProgressBar> bar(std::in_place, terminal,
                                 arguments.blade.empty() || arguments.at_once ? "cuts" : "steps");
  bar->show_stage("measuring", 0);
  app::CutJob job = job_of(arguments, std::move(strokes).value(), terminal, *bar);
  Status drawn;
  job.look = [&](const Engine& end) { drawn = draw_end(arguments, end, *fine ? &**fine : nullptr); };
  const Result<app::JobResult> result = app::run_cut(std::move(loaded).value(), job, arguments.output.is_wanted());
  bar.reset();
  if (!drawn.ok()) return fail(terminal, drawn.error(), kFailure);
  if (!result.ok()) {
    return fail(terminal, result.error(), result.error().code == ErrorCode::kBadArgument ? kBadInput : kFailure);
  }
  warn_of_closed(arguments, job, result->report, body, terminal);
  if (!arguments.picture.empty()) terminal.wrote(arguments.picture, "picture");
  if (!arguments.fine.drawn.empty()) terminal.wrote(arguments.fine.drawn, "surface");
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
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json --picture cut.png\n"
                              "  incise cut organ.mesh --plane 1,0,0,40 --surface scan.obj --drawn cut.glb");
  cut->add_option("MESH", arguments->mesh, kMeshHelp)->required();
  cut->add_option("--blade", arguments->blade, "Blade file: JSON of format incise-blade; - for stdin");
  cut->add_option("--stop-at", arguments->stop_at,
                  "Regions that the blade's edge is held outside of, by number or name: muscle,3")
      ->delimiter(',');
  cut->add_flag("--at-once", arguments->at_once,
                "Cut each stroke of the blade as one sheet, not pose by pose: faster, and no wound in between");
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
  add_seed(*cut, arguments->seed, "Seed, repeated in the report");
  add_threads(*cut, arguments->threads);
  cut->add_option("--record", arguments->record, "Record every step as JSON lines, for incise replay")
      ->transform(names_a_result());
  add_fine(*cut, arguments->fine);
  cut->add_option("--picture", arguments->picture, "Draw the result to this PNG; needs OpenGL, but no display")
      ->transform(names_a_result());
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
