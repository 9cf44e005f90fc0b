// SPDX-License-Identifier: Apache-2.0
// `incise simulate`: arguments override the scene, the job runs it, and what is written over time or at the end hangs
// on the job's callbacks.
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/jobs/simulate_job.h"
#include "app/model/fine_file.h"
#include "app/scene/exercise_page.h"
#include "app/scene/scene_simulation.h"
#include "app/text/text_file.h"
#include "app/view/scene_fine_view.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "fine_output.h"
#include "input_kind.h"
#include "job_output.h"
#include "shared/device_arguments.h"

namespace incise_cli {
namespace {

using namespace incise;

struct SimulateArguments {
  std::string scene, output, report, record;
  std::string page;                   // of an exercise
  std::string profile;                // empty: the scene's
  std::uint64_t frames = 0;           // 0: the scene's
  std::uint64_t every = 0;            // 0: as `SimulateJob`
  std::uint64_t budget_us = 0;        // 0: the scene's work units
  std::optional<std::uint64_t> seed;  // unset: the scene's
  unsigned threads = 1;
  std::string device;  // empty: the scene's strokes
  incise_apps::DeviceArguments haptic;
  bool as_json = false;
  FineArguments fine;
  bool is_ideal = false;  // the exercise's ideal strokes instead of the scene's
};

constexpr std::size_t kMostSceneBytes = std::size_t{64} << 20U;

/// What is wrong with the arguments, or nothing.
std::string usage_problem(const SimulateArguments& a) {
  if (!a.output.empty() && std::filesystem::path(a.output).extension() != ".pvd") {
    return a.output + ": unknown extension; a simulation is written as .pvd, with a folder of .vtu files beside";
  }
  if (a.record == "-") return "--record needs a file, not stdout";
  if (a.page == "-") return "--page needs a file, not stdout";
  if (!a.device.empty() && !incise_apps::is_haply(a.device)) {
    return "--device " + a.device + ": haply or haply=HOST:PORT is needed; in the window there are others";
  }
  if (!a.device.empty() && a.is_ideal) return "--ideal and --device both move the blade; give one";
  if (const Status status = check_device(a.device, a.haptic); !status.ok()) return status.error().message;
  if (a.every > 0 && a.output.empty() && a.fine.drawn.empty()) {
    return "--every is about the files of -o OUT.pvd or the moments of --drawn OUT.glb; give one of them";
  }
  return {};
}

/// The scene that is asked for. One from stdin names its files from the folder that the command runs in.
Result<app::Scene> read_scene(const SimulateArguments& a) {
  if (is_stdin(a.scene)) {
    const Result<std::string> text = app::read_text_file(input_of(a.scene), kMostSceneBytes);
    if (!text.ok()) return text.error();
    return app::parse_scene(*text, name_of_input(a.scene), std::filesystem::current_path());
  }
  Result<app::Scene> scene = app::read_scene(a.scene);
  if (!scene.ok()) return explain_kind(scene.error(), a.scene, FileKind::kScene);
  return scene;
}

/// The scene with what the arguments ask for instead.
app::Scene overridden(app::Scene scene, const SimulateArguments& a) {
  if (a.is_ideal) scene = app::with_ideal(scene);
  if (!a.fine.surface.empty()) scene.model.surface = std::filesystem::absolute(a.fine.surface).string();
  EngineOptions& engine = scene.options.engine;
  if (a.frames > 0) scene.frames = a.frames;
  if (a.seed) scene.seed = *a.seed;
  if (!a.profile.empty()) engine.cut.profile = profile_of(a.profile);
  if (a.budget_us > 0) engine.maintain.work_units = app::kWorkUnitsPerUs * a.budget_us;
  return scene;
}

app::SimulateJob job_of(const SimulateArguments& a, const Terminal& terminal, ProgressBar& bar) {
  app::SimulateJob job;
  job.scene_file = name_of_input(a.scene);
  job.run.threads = a.threads;
  job.run.log = terminal.log_sink();
  job.run.record = a.record;
  job.output = a.output;
  job.every = a.every;
  job.budget_us = a.budget_us;
  job.progress = [&bar](std::size_t done, std::size_t total) { bar.show(done, total); };
  job.should_stop = interrupt_waits;
  return job;
}

Status write_report(const SimulateArguments& a, const app::SimulationReport& report, const Terminal& terminal) {
  if (!a.report.empty() && a.report != "-") {
    if (Status status = app::write_text_file(a.report, app::to_json(report)); !status.ok()) return status;
    terminal.wrote(a.report, "report");
  }
  if (a.as_json || a.report == "-") return terminal.data(app::to_json(report));
  terminal.summary(app::to_text(report), false);
  return {};
}

/// The fine surface of a scene over time. Which points are drawn is known at the end alone, so that the mesh is kept as
/// it was at each moment.
class FineFilm {
 public:
  FineFilm(const app::Scene& scene, const SimulateArguments& arguments)
      : scene_(scene),
        file_(arguments.fine.drawn),
        every_(arguments.every > 0 ? arguments.every : (scene.frames + kMoments - 1) / kMoments) {}

  /// Has the job tell it what it needs, and write the surface at the end. To outlive the job.
  void join(app::SimulateJob& job) {
    job.watch = [this](std::size_t done, const Simulation& body) { return watch(done, body); };
    job.look = [this](const Simulation& end) { status_ = write(end); };
  }
  /// How writing went.
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  static constexpr std::uint64_t kMoments = 24;  // about as many where nobody says otherwise

  Status watch(std::size_t done, const Simulation& body) {
    if (done == 0) {  // what is wrong with the surface is said at once
      const auto fine = app::fine_view_of(scene_, body.mesh(), body.engine().journal());
      if (!fine.ok()) return fine.error();
    }
    if (done % every_ == 0 || done == scene_.frames) {
      moments_.emplace_back(static_cast<double>(done) * scene_.options.frame_seconds, body.mesh());
    }
    return {};
  }

  Status write(const Simulation& end) {
    Result<std::optional<app::FineView>> fine = app::fine_view_of(scene_, end.mesh(), end.engine().journal());
    if (!fine.ok()) return fine.error();
    Result<app::GltfBody> body = body_of(**fine, end.mesh(), end.engine().journal(), scene_.options.body.length_unit);
    if (!body.ok()) return body.error();
    if (std::filesystem::path(file_).extension() == ".glb") {
      for (const auto& [seconds, mesh] : moments_) {
        body->moments.push_back({seconds, earlier_places(body->surface, mesh)});
      }
    }
    return app::write_drawn(file_, *body);
  }

  const app::Scene& scene_;
  std::string file_;
  std::uint64_t every_;
  std::vector<std::pair<double, TetMesh>> moments_;
  Status status_;
};

/// The report of an exercise for people, where it is asked for.
Status write_page(const SimulateArguments& a, const app::Scene& scene, const app::SimulationReport& report,
                  const Terminal& terminal) {
  if (a.page.empty()) return {};
  if (Status status = app::write_text_file(a.page, app::exercise_page(scene, *report.exercise, {})); !status.ok()) {
    return status;
  }
  terminal.wrote(a.page, "page about the attempt");
  return {};
}

int finish_run(const SimulateArguments& a, const app::SimulationReport& report, const Terminal& terminal) {
  print_notes(report.job.notes, report.job.input, terminal);
  if (report.job.cut.incision_faces <= 0) warn_of_misses(name_of_input(a.scene), report.job.missed, {}, terminal);
  if (!a.output.empty() && report.job.change.ok) {
    const std::string folder = std::filesystem::path(a.output).stem().string() + "_frames";
    terminal.wrote(a.output, "series, with the folder " + folder);
  }
  if (!a.record.empty()) terminal.wrote(a.record, "recording");
  if (const Status status = write_report(a, report, terminal); !status.ok()) {
    return fail(terminal, status.error(), kFailure);
  }
  if (report.job.change.ok) return kDone;
  return fail(terminal,
              "the simulation broke the validity contract, so no series was written; see `validity` in the report "
              "(--report)",
              kCheckFailed);
}

/// Says why outputs cannot be written, as far as their names tell; nothing where they can.
std::string output_problem(const SimulateArguments& a) {
  for (const std::string& file : {a.output, a.report, a.record, a.fine.drawn, a.page}) {
    if (!has_folder(file)) return file + ": its folder does not exist; create it first";
  }
  return {};
}

int run_simulate(const SimulateArguments& arguments, const Terminal& terminal) {
  if (const std::string problem = usage_problem(arguments); !problem.empty()) return fail(terminal, problem, kUsage);
  if (const std::string problem = output_problem(arguments); !problem.empty()) return fail(terminal, problem, kFailure);
  Result<app::Scene> read = read_scene(arguments);
  if (!read.ok()) return fail(terminal, read.error(), kBadInput);
  if (arguments.is_ideal && (!read->exercise || read->exercise->ideal.empty())) {
    return fail(
        terminal,
        name_of_input(arguments.scene) + ": --ideal shows how an exercise is done; this scene has no exercise.ideal",
        kBadInput);
  }
  if (!arguments.page.empty() && !read->exercise) {
    return fail(terminal,
                name_of_input(arguments.scene) + ": --page tells how an exercise went; this scene has no exercise",
                kBadInput);
  }
  const app::Scene scene = overridden(std::move(read).value(), arguments);
  if (arguments.budget_us > 0 && scene.options.engine.cut.profile == Profile::kPaper) terminal.note(kNoBudgetAsPaper);
  if (const std::string problem = fine_problem(arguments.fine, !scene.model.surface.empty()); !problem.empty()) {
    return fail(terminal, problem, kUsage);
  }
  const Result<std::filesystem::path> model = app::find_model(scene);
  if (!scene.model.file.empty() && !model.ok()) return fail(terminal, model.error(), kBadInput);
  const std::string clash = clash_of({{"--report", arguments.report},
                                      {"--record", arguments.record},
                                      {"--page", arguments.page},
                                      {"--drawn", arguments.fine.drawn}},
                                     {arguments.scene, arguments.output, model.ok() ? model->string() : ""});
  if (!clash.empty()) return fail(terminal, clash, kUsage);
  std::unique_ptr<app::DeviceHand> hand;
  if (!arguments.device.empty()) {
    Result<std::unique_ptr<app::DeviceHand>> opened = incise_apps::open_device(arguments.device, arguments.haptic);
    if (!opened.ok()) return fail(terminal, opened.error(), kFailure);
    hand = std::move(opened).value();
  }
  const WritingZone zone;  // an interrupt ends the run between two frames, and leaves no part of a series
  std::optional<ProgressBar> bar(std::in_place, terminal, "frames");
  bar->show_stage("reading", 0);
  app::SimulateJob job = job_of(arguments, terminal, *bar);
  job.hand = hand.get();
  FineFilm film(scene, arguments);
  if (!arguments.fine.drawn.empty()) film.join(job);
  const Result<app::SimulateResult> result = app::run_simulate(scene, job);
  bar.reset();
  if (!result.ok()) {
    const bool is_bad = result.error().code == ErrorCode::kBadArgument;
    return fail(terminal, result.error(), is_bad ? kBadInput : exit_of(result.error()));
  }
  if (result->was_stopped) return kInterrupted;
  if (!film.status().ok()) return fail(terminal, film.status().error(), exit_of(film.status().error()));
  if (!arguments.fine.drawn.empty()) terminal.wrote(arguments.fine.drawn, "surface");
  if (const Status status = write_page(arguments, scene, result->report, terminal); !status.ok()) {
    return fail(terminal, status.error(), kFailure);
  }
  return finish_run(arguments, result->report, terminal);
}

}  // namespace

Command add_simulate(CLI::App& root) {
  const auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* simulate = add_command(
      root, "simulate", "Run a scene: a soft body that is held, pulled and cut while it deforms (docs/scenes.md)",
      "  incise simulate scenes/sim_cube.json\n"
      "  incise simulate scenes/sim_cube.json -o cube.pvd --report cube.json\n"
      "  incise simulate scenes/sim_skin.json --frames 60 --report -\n"
      "  incise simulate scenes/sim_cube.json --surface cube.obj --drawn cube.glb\n"
      "  incise simulate scenes/train_fat.json --ideal --page ideal.html\n"
      "  incise simulate scenes/sim_cube.json --profile paper --threads 2\n"
      "  incise simulate scenes/sim_cube.json --record cube.jsonl && incise replay cube.jsonl --verify");
  SimulateArguments& s = *arguments;
  simulate->add_option("SCENE", s.scene, "Scene file: JSON of format incise-scene; - for stdin")->required();
  simulate->add_option("--frames", s.frames, "Frames to run, instead of the scene's")
      ->check(CLI::Range(std::uint64_t{1}, incise::app::kMaxSceneFrames));
  simulate->add_option("-o,--output", s.output, "Write the body over time: NAME.pvd with the folder NAME_frames")
      ->transform(names_a_result());
  simulate
      ->add_option("--every", s.every,
                   "Frames between two files of -o, or moments of --drawn (default: about 100, or 24)")
      ->check(CLI::Range(std::uint64_t{1}, incise::app::kMaxSceneFrames));
  add_fine(*simulate, s.fine);
  add_report(*simulate, s.report, s.as_json);
  simulate->add_option("--record", s.record, "Record every frame as JSON lines, for incise replay")
      ->transform(names_a_result());
  simulate->add_option("--profile", s.profile, "incise, or paper: the published method; instead of the scene's")
      ->check(CLI::IsMember({"incise", "paper"}));
  add_budget(*simulate, s.budget_us,
             "Microseconds for maintenance per frame, 1 to 3600000000, taken as 10 work units each: no clock is read");
  add_seed(*simulate, s.seed, "Seed, instead of the scene's");
  simulate->add_flag("--ideal", s.is_ideal, "Show and score an exercise's ideal strokes, instead of the scene's");
  simulate->add_option("--page", s.page, "Write how an exercise went as one HTML page with drawings")
      ->transform(names_a_result());
  simulate->add_option("--device", s.device,
                       "Who has the blade instead of the scene: haply or haply=HOST:PORT, a hand at a haptic device; "
                       "frames then keep the pace of the clock");
  incise_apps::add_device(*simulate, s.haptic);
  add_threads(*simulate, s.threads);
  return {simulate, [arguments](const Terminal& terminal) { return run_simulate(*arguments, terminal); }};
}

}  // namespace incise_cli
