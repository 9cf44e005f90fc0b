// SPDX-License-Identifier: Apache-2.0
// Runs the frames of a scene and adds up what they report. The mesh is measured once a stroke has ended and again
// after the last frame, outside of all times.
#include "app/jobs/simulate_job.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "app/jobs/frame_series.h"
#include "app/jobs/job_internal.h"
#include "app/jobs/scene_hand.h"
#include "app/scene/exercise_score.h"
#include "app/scene/scene_simulation.h"
#include "incise/io/mesh_export.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

class SceneRunner {
 public:
  SceneRunner(const Scene& scene, const SimulateJob& job, RecordedSimulation simulation, SimulationReport& report)
      : scene_(scene), job_(job), simulation_(std::move(simulation)), report_(report), hand_(scene) {
    if (scene.exercise) scorer_.emplace(scene, this->simulation().mesh());
  }

  Status settle();
  Status run_frames(FrameSeries* series, const io::LoadedMesh& loaded);
  void measure();

  [[nodiscard]] const Simulation& simulation() const { return simulation_.simulation(); }
  [[nodiscard]] bool was_stopped() const { return was_stopped_; }

 private:
  Status run_frame(std::uint64_t index);
  [[nodiscard]] FrameInput input_of(std::uint64_t index);
  void feel(std::uint64_t index);
  [[nodiscard]] Box bounds() const;
  void add(const FrameReport& frame, const FrameInput& input);
  void add(const BladeState& blade);
  void add_work(const FrameReport& frame);
  void end_stroke();
  bool stops() {
    was_stopped_ = was_stopped_ || (job_.should_stop && job_.should_stop());
    return was_stopped_;
  }

  const Scene& scene_;
  const SimulateJob& job_;
  RecordedSimulation simulation_;
  SimulationReport& report_;
  SceneHand hand_;
  std::optional<ExerciseScorer> scorer_;       // where the scene is an exercise
  std::chrono::steady_clock::time_point due_;  // of the next frame, with a live hand
  bool had_blade_ = false;
  CutStatistics stroke_cut_;  // since the blade came
  bool was_stopped_ = false;
};

Status SceneRunner::settle() {
  if (scene_.settle.frames > 0) {
    const Result<unsigned> done = simulation_.settle(scene_.settle, [this] { return stops(); });
    if (!done.ok()) return done.error();
    report_.settle_frames = *done;
  }
  report_.energy_before = simulation().body().energy();
  return {};
}

Status SceneRunner::run_frames(FrameSeries* series, const io::LoadedMesh& loaded) {
  const std::uint64_t every = job_.every > 0 ? job_.every : (scene_.frames + kSeriesFiles - 1) / kSeriesFiles;
  const auto add_moment = [&](std::uint64_t done) -> Status {
    if (job_.watch) {
      if (Status status = job_.watch(static_cast<std::size_t>(done), simulation()); !status.ok()) return status;
    }
    if (series == nullptr || (done % every != 0 && done != scene_.frames)) return {};
    const TetMesh& mesh = simulation().mesh();
    io::MeshData data = io::to_mesh_data(mesh, find_components(mesh), loaded.file_vertex, io::MeshPose::kAsItStands);
    data.region_names = loaded.region_names;
    return series->add(static_cast<double>(done) * scene_.options.frame_seconds, data);
  };
  const auto frames = static_cast<std::size_t>(scene_.frames);  // at most kMaxSceneFrames
  if (job_.hand != nullptr) job_.hand->begin(scene_, bounds());
  due_ = std::chrono::steady_clock::now();
  if (Status status = add_moment(0); !status.ok()) return status;
  for (std::size_t i = 0; i < frames && !stops(); ++i) {
    if (job_.progress) job_.progress(i, frames);
    if (Status status = run_frame(i); !status.ok()) return status;
    if (Status status = add_moment(i + 1); !status.ok()) return status;
  }
  if (job_.progress) job_.progress(frames, frames);
  return {};
}

/// Of the body as it stands.
Box SceneRunner::bounds() const {
  Box box;
  const TetMesh& mesh = simulation().mesh();
  mesh.for_each_vertex([&](VertexId v) {
    if (mesh.tet_of(v).is_valid()) box.extend(mesh.current(v));
  });
  return box;
}

/// What the scene does in a frame, and with what blade. With a live hand it waits until the frame is due; frames that
/// took too long are not made up for.
FrameInput SceneRunner::input_of(std::uint64_t index) {
  FrameInput input = scene_input(scene_, index);
  if (job_.hand == nullptr) return input;
  using Clock = std::chrono::steady_clock;
  due_ = std::max(due_, Clock::now());
  std::this_thread::sleep_until(due_);
  due_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(scene_.options.frame_seconds));
  input.blade = job_.hand->blade(bounds());
  return input;
}

void SceneRunner::feel(std::uint64_t index) {
  const HapticSnapshot& snapshot = simulation().haptic_snapshot();
  if (job_.hand != nullptr) return job_.hand->feel(snapshot);
  hand_.feel(index, snapshot);
}

Status SceneRunner::run_frame(std::uint64_t index) {
  const FrameInput input = input_of(index);
  if (had_blade_ && !input.blade) detail::measure_cut(simulation().mesh(), report_.job);
  const Result<FrameReport> frame =
      simulation_.frame(input, job_.hand == nullptr ? scene_stops(scene_, index) : std::vector<std::int32_t>());
  if (!frame.ok()) {
    Error error = frame.error();
    error.message = "frame " + std::to_string(index) + ": " + error.message;
    return error;
  }
  add(*frame, input);
  if (had_blade_ && !input.blade) end_stroke();
  if (scorer_) scorer_->add(input, *frame, simulation());
  feel(index);
  had_blade_ = input.blade.has_value();
  return {};
}

void SceneRunner::add(const FrameReport& frame, const FrameInput& input) {
  JobReport& job = report_.job;
  if (input.blade && !had_blade_) {
    ++job.strokes;
    job.units_per_stroke.push_back(0);
    stroke_cut_ = {};
  }
  const double ms = simulation_.last_ms();
  job.total_ms += ms;
  job.times += frame.times;
  job.stage_ms.push_back(frame.times);
  report_.frame_ms.push_back(ms);
  if (input.blade) job.step_ms.push_back(frame.times.total() - frame.times[Stage::kRelax]);
  add_work(frame);
  add(frame.blade);
  ForceFigures& forces = report_.forces;
  for (const Vec3& force : frame.hook_forces) forces.peak_hook_force = std::max(forces.peak_hook_force, force.norm());
  for (const SutureState& suture : simulation().sutures())
    forces.peak_suture_force = std::max(forces.peak_suture_force, std::abs(suture.force));
  forces.torn_sutures += frame.torn_sutures.size();
  forces.contacts = std::max<std::uint64_t>(forces.contacts, frame.contacts);
}

void SceneRunner::add_work(const FrameReport& frame) {
  JobReport& job = report_.job;
  job.cut += frame.cut;
  stroke_cut_ += frame.cut;
  job.maintain += frame.maintain;
  if (!job.units_per_stroke.empty()) job.units_per_stroke.back() += frame.maintain.work_units;
}

/// A frame later than the blade's last, in which the profile `paper` still opens what it had gathered.
void SceneRunner::end_stroke() {
  if (detail::opened_nothing(stroke_cut_)) report_.job.missed.push_back(report_.job.strokes - 1);
}

void SceneRunner::add(const BladeState& blade) {
  ForceFigures& forces = report_.forces;
  forces.peak_force = std::max(forces.peak_force, blade.force.norm());
  forces.engaged_length = std::max(forces.engaged_length, blade.engaged_length);
  forces.fracture_work += blade.fracture_work;
  forces.friction_work += blade.friction_work;
  forces.tool_work += blade.tool_work;
  forces.touching_frames += blade.touches ? 1 : 0;
  forces.yielding_frames += blade.yields ? 1 : 0;
}

void SceneRunner::measure() {
  const Simulation& end = simulation();
  if (had_blade_) {
    detail::measure_cut(end.mesh(), report_.job);
    end_stroke();
  }
  detail::measure_after(end.mesh(), find_components(end.mesh()), volume_tolerance(scene_.options.engine), report_.job);
  report_.energy_after = end.body().energy();
  report_.haptics = job_.hand == nullptr ? hand_.figures() : job_.hand->figures();
  report_.inverted_tets = end.body().count_inverted();
  report_.is_finite = end.body().is_finite();
  report_.state_hash = end.hash();
  if (scorer_) report_.exercise = scorer_->score(end);
}

void describe(const Scene& scene, const SimulateJob& job, const io::LoadedMesh& loaded, SimulationReport& report) {
  EngineOptions engine = scene.options.engine;
  engine.threads = job.run.threads;
  detail::describe_job(loaded, engine, job.budget_us, report.job);
  report.job.options.seed = scene.seed;
  report.scene = job.scene_file;
  report.name = scene.name;
  report.frames = scene.frames;
  report.frame_seconds = scene.options.frame_seconds;
}

}  // namespace

Result<SimulateResult> run_simulate(const Scene& given, const SimulateJob& job) {
  Scene scene = given;
  Result<io::LoadedMesh> loaded = take_model(scene);
  if (!loaded.ok()) return loaded.error();
  return run_simulate(scene, std::move(loaded).value(), job);
}

Result<SimulateResult> run_simulate(const Scene& scene, io::LoadedMesh loaded, const SimulateJob& job) {
  SimulateResult result;
  describe(scene, job, loaded, result.report);
  detail::measure_before(loaded.mesh, result.report.job);
  std::optional<FrameSeries> series;
  if (!job.output.empty()) {
    Result<FrameSeries> begun = FrameSeries::begin(job.output);
    if (!begun.ok()) return begun.error();
    series.emplace(std::move(begun).value());
  }
  SceneRun run = job.run;
  run.keep_undo = 1;  // a scene takes nothing back
  Result<RecordedSimulation> made = RecordedSimulation::create(scene, std::move(loaded.mesh), run);
  if (!made.ok()) return made.error();
  SceneRunner runner(scene, job, std::move(made).value(), result.report);
  if (const Status status = runner.settle(); !status.ok()) return status.error();
  if (const Status status = runner.run_frames(series ? &*series : nullptr, loaded); !status.ok()) return status.error();
  result.was_stopped = runner.was_stopped();
  if (result.was_stopped) return result;
  runner.measure();
  if (job.look) job.look(runner.simulation());
  if (!series || !result.report.job.change.ok) return result;
  if (const Status status = series->finish(); !status.ok()) return status.error();
  return result;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
