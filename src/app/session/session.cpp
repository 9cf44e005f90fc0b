// SPDX-License-Identifier: Apache-2.0
// A frame is made of what the scene does and what the hands do, with one blade at most; figures and the log follow
// from its report. A reset starts the scene anew.
#include "app/session/session.h"

#include <algorithm>
#include <utility>

#include "app/hands/grip.h"
#include "app/session/session_state.h"
#include "app/text/formatted.h"
#include "app/text/json_write.h"
#include "app/view/exercise_marks.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/components.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kPauses = 3;                        // frames between two strokes that the blade follows
constexpr std::uint32_t kFirstHandHook = 1U << 16U;  // those of scenes come before

Eigen::Vector3f to_float(const Vec3& point) {
  return point.cast<float>();
}

void draw_line(const std::vector<Vec3>& points, Ink ink, Marks& marks) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    marks.lines.push_back({to_float(points[i - 1]), to_float(points[i]), ink, 4, true, false});
  }
}

/// A scalpel, where an edge is one: straight, upright, and not longer than a blade.
void draw_scalpel(const BladePose& blade, const Vec3& way_of_blade, const Scene& scene, bool is_ghost, Marks& marks) {
  constexpr double kUpright = 0.5, kLongestEdge = 60;  // cosine; mm
  if (blade.edge.size() < 2) return;
  const Vec3 gravity = scene.options.body.gravity;
  const Vec3 up = gravity.isZero(0) ? Vec3(Vec3::UnitZ()) : Vec3(-gravity.stableNormalized());
  Vec3 way = blade.edge.front() - blade.edge.back(), tip = blade.edge.back();
  if (way.dot(up) < 0) {
    way = -way;
    tip = blade.edge.front();
  }
  Instrument scalpel;
  scalpel.millimetre = instrument_millimetre(scene.options.body.length_unit, 0);
  const double length = way.norm();
  if (!(length > 0) || way.dot(up) < kUpright * length || length > kLongestEdge * scalpel.millimetre) return;
  scalpel.tip = tip;
  scalpel.up = way / length;
  scalpel.ahead = way_of_blade;
  scalpel.is_ghost = is_ghost;
  marks.instruments.push_back(scalpel);
}

/// Of a demonstration: the hook stands on the skin and leans to where it pulls.
void draw_hook(const Hook& hook, const Scene& scene, Marks& marks) {
  if (hook.id >= scene.hooks.size()) return;
  const Vec3 gravity = scene.options.body.gravity;
  const Vec3 up = gravity.isZero(0) ? Vec3(Vec3::UnitZ()) : Vec3(-gravity.stableNormalized());
  HeldBy by{InstrumentKind::kHook, up, instrument_millimetre(scene.options.body.length_unit, 0)};
  Instrument made = instrument_at(hook, scene.hooks[hook.id].positions.front(), by, Camera());
  made.is_ghost = true;
  marks.instruments.push_back(made);
}

void draw_tool(const Tool& tool, Marks& marks) {
  const ToolOutline outline = outline_of(tool);
  for (const ToolOutline::Ball& ball : outline.balls) {
    marks.balls.push_back({to_float(ball.centre), Ink::kTool, static_cast<float>(ball.radius), false});
  }
  for (const auto& [a, b, c] : outline.triangles) {
    marks.triangles.push_back({{to_float(a), to_float(b), to_float(c)}, Ink::kBlade, 0.5F});
  }
}

}  // namespace

// --- one frame

namespace {

/// Regions that a tool under a hand is held outside of.
std::vector<std::int32_t> spared_by(const Scene& scene, ToolKind tool) {
  std::vector<std::int32_t> regions;
  for (const SpareRule& rule : scene.spare) {
    if (row_of(tool).cuts && rule.tool.value_or(tool) == tool) {
      regions.insert(regions.end(), rule.stop_at.begin(), rule.stop_at.end());
    }
  }
  return regions;
}

}  // namespace

Status Session::frame(const HandState& hands) {
  State& s = *state_;
  if (s.is_replay) return s.next_call < s.call_count() ? s.play_call() : Status();
  const FrameInput input = s.input_of(hands);
  return s.run(input);
}

FrameInput Session::State::input_of(const HandState& hands) {
  FrameInput input = scene_input(scene, figures.frames);
  if (!plays_script) input.blade.reset();
  if (!plays_hooks) input.hooks.clear();
  if (hands.blade) {
    plays_script = false;  // from now on the person has the blade
    followed.reset();
  }
  choose_blade(hands, input);
  for (Hook hook : hands.hooks) {
    hook.id += kFirstHandHook;
    input.hooks.push_back(hook);
  }
  return input;
}

/// One blade at a time; between two of them a frame without, so that no stroke leads from one to the other.
void Session::State::choose_blade(const HandState& hands, FrameInput& input) {
  BladeSource source = input.blade ? BladeSource::kScript : BladeSource::kNone;
  stop_at = scene_stops(scene, figures.frames);
  if (followed) {
    const FrameInput at_frame = scene_input(*followed, followed_frame);
    if (at_frame.blade) stop_at = scene_stops(*followed, followed_frame);
    if (++followed_frame > followed->frames) followed.reset();
    if (at_frame.blade) {
      source = BladeSource::kFollowed;
      input.blade = at_frame.blade;
    }
  }
  if (hands.blade) {
    source = BladeSource::kHand;
    input.blade = hands.blade;
    stop_at = spared_by(scene, hands.cuts_with);
  }
  const bool changes_hands =
      source != blade_source && source != BladeSource::kNone && blade_source != BladeSource::kNone;
  if (changes_hands) {
    if (source == BladeSource::kFollowed) --followed_frame;  // it begins a frame later
    input.blade.reset();
    source = BladeSource::kNone;
  }
  blade_source = source;
}

/// A hand's blade that would begin in what it spares is held in the air until it is out of there.
Result<FrameReport> Session::State::frame(const FrameInput& input) {
  if (is_replay) return simulation->frame(input);
  Result<FrameReport> report = simulation->frame(input, stop_at);
  const bool is_by_hand = blade_source == BladeSource::kHand || blade_source == BladeSource::kFollowed;
  const bool is_refused =
      is_by_hand && !stop_at.empty() && input.blade && !report.ok() && report.error().code == ErrorCode::kBadArgument;
  if (is_refused && !std::exchange(is_blade_refused, true)) note(Operation::Kind::kNotice, report.error().message);
  if (!is_refused) is_blade_refused = false;
  if (!is_refused) return report;
  FrameInput without = input;
  without.blade.reset();
  return simulation->frame(without);
}

Status Session::State::run(const FrameInput& input) {
  Result<FrameReport> report = frame(input);
  if (input.blade && last_input.blade && input.blade->edge.size() == last_input.blade->edge.size()) {
    const Vec3 way = input.blade->edge.front() - last_input.blade->edge.front();
    if (!way.isZero(0)) blade_way = way;
  }
  last_input = input;
  if (!report.ok()) {
    if (report.error().code == ErrorCode::kIo) {  // the frame was done all the same
      simulation->stop_recording();
      end_frame();
    }
    note(Operation::Kind::kNotice, report.error().message);
    return report.error();
  }
  if (input.blade && !attempt_began) attempt_began = figures.frames;
  if (scorer) scorer->add(input, *report, simulation->simulation());
  add(*report);
  return {};
}

void Session::State::end_frame() {
  ++figures.frames;
  figures.seconds = static_cast<double>(figures.frames) * scene.options.frame_seconds;
  figures.frame_ms = simulation->last_ms();
  figures.busy_ms += figures.frame_ms;
  count();
}

void Session::State::add(const FrameReport& report) {
  end_frame();
  figures.times += report.times;
  figures.cut += report.cut;
  figures.maintain += report.maintain;
  figures.blade = report.blade;
  add_force(report.blade.force.norm());
  follow_stroke(report);
}

void Session::State::add_force(double force) {
  std::vector<ForceSample>& samples = figures.force;
  if (samples.size() >= SessionFigures::kForceSamples) samples.erase(samples.begin());
  samples.push_back({static_cast<float>(figures.seconds), static_cast<float>(force)});
  figures.peak_force = std::max(figures.peak_force, force);
  stroke_peak = std::max(stroke_peak, force);
}

void Session::State::count() {
  figures.tets = mesh().tet_count();
  figures.vertices = mesh().vertex_count();
  figures.strokes = engine_now().stroke_count();
}

/// Tells of a stroke once it has ended.
void Session::State::follow_stroke(const FrameReport& report) {
  stroke_cut += report.cut;
  if (report.stroke == 0 && stroke_under_way > 0) {
    std::string text = formatted("Stroke {}: {} tets cut", stroke_under_way, stroke_cut.cut_tets);
    if (stroke_peak > 0) text += formatted(", at most {:.2g} N", stroke_peak);
    note(Operation::Kind::kStroke, std::move(text));
  }
  if (report.stroke > 0 && report.stroke != stroke_under_way) {
    unpicked.clear();
    forgets_undone = false;
  }
  if (report.stroke == 0 || report.stroke != stroke_under_way) {
    stroke_cut = report.stroke == 0 ? CutStatistics() : report.cut;
    stroke_peak = report.stroke == 0 ? 0 : report.blade.force.norm();
  }
  stroke_under_way = report.stroke;
}

void Session::State::note(Operation::Kind kind, std::string text) {
  log.add({kind, figures.seconds, std::move(text)});
}

// --- what a person asks for

void Session::follow(const Stroke& stroke, std::optional<ToolKind> tool) {
  State& s = *state_;
  if (s.is_replay || !check(stroke).ok()) return;
  s.plays_script = false;
  if (!s.followed) {
    s.followed.emplace();
    s.followed->options.frame_seconds = s.scene.options.frame_seconds;
    s.followed_frame = 0;
  }
  const double frame = s.scene.options.frame_seconds;
  const double begin =
      s.followed->strokes.empty() ? 0 : s.followed->strokes.back().stroke.times.back() + kPauses * frame;
  SceneStroke& added = s.followed->strokes.emplace_back(SceneStroke{stroke, Vec3::Zero()});
  if (tool) added.stop_at = spared_by(s.scene, *tool);
  if (tool) added.slicing = row_of(*tool).slicing;
  for (double& time : added.stroke.times) time += begin - stroke.times.front();
  s.followed->frames = static_cast<std::uint64_t>(added.stroke.times.back() / frame) + 2;
}

void Session::end_script() {
  state_->plays_script = false;
  state_->plays_hooks = false;
}

bool Session::is_following() const {
  return state_->followed.has_value();
}

Result<bool> Session::undo() {
  State& s = *state_;
  if (s.is_replay) return false;
  s.followed.reset();
  if (Result<bool> done = s.unpick(); !done.ok() || *done) return done;
  Result<bool> done = s.simulation->undo();
  if (!done.ok()) s.simulation->stop_recording();
  s.count();
  s.stroke_under_way = 0;
  if (done.ok() && *done) s.note(Operation::Kind::kUndo, "Stroke taken back");
  return done;
}

Result<bool> Session::redo() {
  State& s = *state_;
  if (s.is_replay) return false;
  if (Result<bool> done = s.sew_again(); !done.ok() || *done) return done;
  if (s.forgets_undone) return false;
  Result<bool> done = s.simulation->redo();
  if (!done.ok()) s.simulation->stop_recording();
  s.count();
  if (done.ok() && *done) s.note(Operation::Kind::kRedo, "Stroke made again");
  return done;
}

Status Session::reset() {
  State& s = *state_;
  const bool was_recording = is_recording();
  if (Status status = s.start(); !status.ok()) return status;
  s.note(Operation::Kind::kReset, "Back to the start");
  return was_recording ? s.record(s.next_recording_name()) : Status();
}

Status Session::start_recording(const std::filesystem::path& path) {
  if (Status status = state_->record(path); !status.ok()) return status;
  state_->first_recording = path;
  return {};
}

Status Session::State::record(const std::filesystem::path& path) {
  if (!simulation) return Error{ErrorCode::kBadArgument, "a recording of `incise cut` is there already: copy it", {}};
  if (Status status = simulation->start_recording(path); !status.ok()) return status;
  recording = path;
  note(Operation::Kind::kRecording, "Recording to " + path.string());
  return {};
}

Status Session::save_recording(const std::filesystem::path& path) const {
  if (state_->simulation) return state_->simulation->save_recording(path);
  return Error{ErrorCode::kBadArgument, "a recording of `incise cut` is there already: copy it", {}};
}

void Session::stop_recording() {
  if (!is_recording()) return;
  state_->simulation->stop_recording();
  state_->note(Operation::Kind::kRecording, "Recorded: " + state_->recording.string());
}

bool Session::is_recording() const {
  return state_->simulation && state_->simulation->is_recording();
}

Status Session::export_mesh(const std::filesystem::path& path) const {
  io::MeshData data = io::to_mesh_data(mesh(), find_components(mesh()), state_->file_vertex);
  data.region_names = state_->region_names;
  return io::write_mesh(path, data);
}

// --- what there is

const Scene& Session::scene() const {
  return state_->scene;
}
const std::string& Session::title() const {
  return state_->title;
}
const Engine& Session::engine() const {
  return state_->engine_now();
}
const Simulation* Session::simulation() const {
  return state_->simulation ? &state_->simulation->simulation() : nullptr;
}
const SessionFigures& Session::figures() const {
  return state_->figures;
}
const OperationLog& Session::log() const {
  return state_->log;
}
OperationLog& Session::log() {
  return state_->log;
}

std::optional<ExerciseScore> Session::score() const {
  const State& s = *state_;
  if (!s.scorer) return std::nullopt;
  return s.scorer->score(s.simulation->simulation());
}

std::optional<ExerciseGauges> Session::gauges() const {
  if (!state_->scorer) return std::nullopt;
  return state_->scorer->gauges();
}

static void draw_sutures(const Simulation& simulation, Marks& marks) {
  for (const SutureState& suture : simulation.sutures()) {
    if (suture.status != SutureStatus::kHolds) continue;
    const Eigen::Vector3f from = to_float(suture.places[0]), to = to_float(suture.places[1]);
    marks.lines.push_back({from, to, Ink::kPin, 3, true, false});
    for (const Eigen::Vector3f& end : {from, to}) marks.balls.push_back({end, Ink::kPin, 4, true});
  }
}

void Session::draw(Marks& marks, bool shows_ideal) const {
  const State& s = *state_;
  if (s.scene.exercise) {
    draw_line(s.scene.exercise->target, Ink::kTarget, marks);
    mark_removal(*s.scene.exercise, mesh(), marks);
  }
  if (shows_ideal) {
    const std::uint64_t frame = s.attempt_began ? s.figures.frames - *s.attempt_began : 0;
    for (const BladePose& blade : ideal_poses(s.scene, frame)) draw_line(blade.edge, Ink::kIdeal, marks);
  }
  if (s.last_input.blade && s.blade_source != State::BladeSource::kHand) {
    draw_line(s.last_input.blade->edge, Ink::kBlade, marks);
    const bool is_shown = s.is_replay || s.blade_source == State::BladeSource::kScript;
    const bool is_ghost = !s.is_replay && s.scene.view && s.scene.view->is_demonstration;
    if (is_shown) draw_scalpel(*s.last_input.blade, s.blade_way, s.scene, is_ghost, marks);
  }
  const bool is_demonstration = !s.is_replay && s.scene.view && s.scene.view->is_demonstration;
  for (const Hook& hook : s.last_input.hooks) {
    if (is_demonstration && hook.id < kFirstHandHook) {
      draw_hook(hook, s.scene, marks);
      continue;
    }
    if (hook.id < kFirstHandHook || s.is_replay) marks.balls.push_back({to_float(hook.position), Ink::kHook, 7, true});
  }
  for (const Tool& tool : s.last_input.tools) draw_tool(tool, marks);
  if (simulation() != nullptr) draw_sutures(*simulation(), marks);
}

Session::Session(std::unique_ptr<State> state) : state_(std::move(state)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

}  // namespace app
}  // namespace v0
}  // namespace incise
