// SPDX-License-Identifier: Apache-2.0
// Commands wait in a queue until a frame has ended; views go the other way through a triple buffer. What was asked for
// after a gesture waits until the simulation has caught up with that gesture.
#include "app/session/session_thread.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "app/jobs/cut_job.h"
#include "app/text/text_file.h"
#include "app/view/exercise_marks.h"
#include "app/view/scene_fine_view.h"
#include "incise/core/triple_buffer.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kRateWindow = 0.5;                          // s between two readings of the rates
constexpr auto kLookAgain = std::chrono::milliseconds(100);  // while it is paused, for the validity light
constexpr auto kProgress = std::chrono::milliseconds(50);    // between two views of a recording that is wound on
constexpr double kLongestFrame = 3600;                       // s by the clock
constexpr double kMostBehind = 0.1;  // s: a simulation that is later than this does not try to catch up

void add_edges(const std::array<Eigen::Vector3f, 4>& corners, Ink ink, Marks& marks) {
  for (const auto& [a, b] : kEdgeCorners) marks.lines.push_back({corners[a], corners[b], ink, 2, true, false});
}

std::array<Eigen::Vector3f, 4> corners_of(const TetMesh& mesh, TetId tet) {
  std::array<Eigen::Vector3f, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.current(mesh.vertices(tet)[i]).cast<float>();
  return corners;
}

}  // namespace

struct SessionThread::State {
  State(Session opened, const SessionThreadOptions& chosen) : options(chosen), session(std::move(opened)) {}

  struct Command {
    std::function<void()> run;
    std::uint64_t after = 0;  // a moment of the hands
  };

  SessionThreadOptions options;

  // Between the threads.
  std::mutex mutex;
  std::condition_variable wakes;
  std::deque<Command> commands;
  HandQueue hands;
  std::atomic<bool> quits{false};
  std::atomic<unsigned> waiting{0};  // commands
  TripleBuffer<SessionView> views;

  // The session's thread's own.
  Session session;
  SurfaceOptions surface_options;
  std::optional<SurfaceView> surface;
  std::optional<FineView> fine;  // where the scene has one, it is shown unless a clip plane looks inside
  std::optional<QualityMonitor> quality;
  std::optional<ValidityMonitor> validity;
  std::vector<TetId> worst;  // tets, as many as are shown
  JournalCursor checked;     // where the journal stood
  SessionView view;
  std::optional<std::pair<Side, std::uint32_t>> probed;  // with the generation of its tet
  std::uint64_t log_seen = 0;
  bool shows_ideal = false;
  bool was_device_live = true;
  unsigned steps_left = 0;  // to be made while it is paused
  Clock::time_point next_frame;
  Clock::time_point rate_since;
  std::uint64_t rate_frames = 0;
  double rate_seconds = 0;
  std::thread thread;

  void post(std::function<void()> command);
  void post_after_gestures(std::function<void()> command);
  [[nodiscard]] bool comes_later(const Command& command) const;
  void run();
  bool run_commands();
  void look_at_session();
  void begin_session();
  void open(const std::filesystem::path& path);
  void open(const Result<Scene>& scene);
  void frame();
  void take_device(HandState& now);
  void feel();
  void pace();
  void wait();
  void publish();
  void check_validity();
  bool has_new_light();
  void find_worst();
  void score(const std::filesystem::path& json, const std::filesystem::path& attempt);
  void start_recording(const std::filesystem::path& path);
  void stop_recording();
  void draw_marks();
  void measure_rates();
  void busy(const std::string& text);
  void tell(const std::string& text);
  void tell(const Status& status) {
    if (!status.ok()) tell(status.error().message);
  }
  [[nodiscard]] bool is_running() const { return !options.is_paused || steps_left > 0; }
  [[nodiscard]] ShouldStop until_next_command();
};

void SessionThread::State::post(std::function<void()> command) {
  {
    const std::lock_guard lock(mutex);
    commands.push_back({std::move(command), 0});
    ++waiting;
  }
  wakes.notify_one();
}

/// Of a simulation that lags behind the hand: what was asked for after a stroke comes after that stroke.
void SessionThread::State::post_after_gestures(std::function<void()> command) {
  {
    const std::lock_guard lock(mutex);
    commands.push_back({std::move(command), hands.now()});
    ++waiting;
  }
  wakes.notify_one();
}

/// A step comes before what was asked for after it, and so does a gesture, while time goes on.
bool SessionThread::State::comes_later(const Command& command) const {
  return steps_left > 0 || (!options.is_paused && !hands.has_passed(command.after));
}

void SessionThread::State::run() {
  look_at_session();
  publish();
  next_frame = Clock::now();
  while (!quits) {
    const bool has_news = run_commands();
    if (is_running()) {
      frame();
      publish();
      pace();
    } else {
      if (has_news || has_new_light()) publish();
      wait();
    }
  }
}

/// Returns whether there were any.
bool SessionThread::State::run_commands() {
  for (bool is_first = true;; is_first = false) {
    Command command;
    {
      const std::lock_guard lock(mutex);
      if (commands.empty() || comes_later(commands.front())) return !is_first;
      command = std::move(commands.front());
      commands.pop_front();
      --waiting;
    }
    command.run();
    view.busy.clear();
  }
}

/// Begins to follow a session that was just opened.
void SessionThread::State::look_at_session() {
  const Engine& engine = session.engine();
  surface.emplace(engine.mesh(), engine.journal());
  surface->set_options(surface_options);
  Result<std::optional<FineView>> made = fine_view_of(session.scene(), engine.mesh(), engine.journal());
  if (!made.ok()) tell(made.error().message);
  fine = made.ok() ? std::move(made).value() : std::nullopt;
  quality.emplace(engine.mesh(), engine.journal());
  validity.emplace(engine.mesh(), volume_tolerance(engine.options()));
  checked.move_to(engine.journal());
  find_worst();
  probed.reset();
  view.score.reset();
  ++view.session;
  view.scene = std::make_shared<const Scene>(session.scene());
  view.title = session.title();
  view.quality_before = quality->before();
  if (options.device) options.device->begin(session.scene(), current_bounds(engine.mesh()));
  log_seen = 0;
  view.log = std::make_shared<const std::vector<Operation>>();
  rate_since = Clock::now();
  rate_frames = 0;
  rate_seconds = 0;
}

/// The hands let go: what they held is another body, or elsewhere.
void SessionThread::State::begin_session() {
  {
    const std::lock_guard lock(mutex);
    hands.clear();
  }
  look_at_session();
}

void SessionThread::State::open(const std::filesystem::path& path) {
  busy("Opening " + path.filename().string());
  Result<Session> opened = Session::open(path, options.session);
  if (!opened.ok()) return tell(opened.error().message);
  session = std::move(opened).value();
  begin_session();
  tell("Opened " + path.filename().string());
}

/// A scene that was made here.
void SessionThread::State::open(const Result<Scene>& scene) {
  if (!scene.ok()) return tell(scene.error().message);
  Result<Session> opened = Session::open(*scene, options.session);
  if (!opened.ok()) return tell(opened.error().message);
  session = std::move(opened).value();
  options.is_paused = false;
  begin_session();
}

void SessionThread::State::frame() {
  HandState now;
  {
    const std::lock_guard lock(mutex);
    now = session.is_following() ? hands.pop_hooks() : hands.pop();
  }
  if (steps_left > 0) --steps_left;
  if (options.device) take_device(now);
  tell(session.frame(now));
  if (options.device) feel();
  const ReplayPlace place = session.place();
  if (session.is_replay() && place.call >= place.calls) options.is_paused = true;
}

/// The device has the blade; the other hand has the mouse.
void SessionThread::State::take_device(HandState& now) {
  now.blade = options.device->blade(current_bounds(session.mesh()));
  const bool is_live = options.device->is_live();
  if (std::exchange(was_device_live, is_live) == is_live) return;
  tell(is_live ? "The haptic device answers: it has the blade" : "The haptic device does not answer: it has no force");
}

/// A recording that is played is another one's work.
void SessionThread::State::feel() {
  const Simulation* simulation = session.is_replay() ? nullptr : session.simulation();
  options.device->feel(simulation == nullptr ? HapticSnapshot() : simulation->haptic_snapshot());
}

/// Waits until the next frame is due.
void SessionThread::State::pace() {
  measure_rates();
  if (options.speed <= 0) return;
  const double length = std::min(session.scene().options.frame_seconds / options.speed, kLongestFrame);
  next_frame += std::chrono::duration_cast<Clock::duration>(Seconds(length));
  const Clock::time_point now = Clock::now();
  if (now > next_frame + std::chrono::duration_cast<Clock::duration>(Seconds(kMostBehind))) next_frame = now;
  while (!quits && is_running() && Clock::now() < next_frame) {
    if (run_commands()) publish();
    std::unique_lock lock(mutex);
    wakes.wait_until(lock, next_frame, [&] { return quits || (!commands.empty() && !comes_later(commands.front())); });
  }
}

/// Waits until there is something to do.
void SessionThread::State::wait() {
  std::unique_lock lock(mutex);
  wakes.wait_for(lock, kLookAgain, [&] { return quits || !commands.empty(); });
  next_frame = rate_since = Clock::now();
  rate_frames = 0;
  rate_seconds = 0;
}

void SessionThread::State::measure_rates() {
  ++rate_frames;
  rate_seconds += session.scene().options.frame_seconds;
  const double passed = Seconds(Clock::now() - rate_since).count();
  if (passed < kRateWindow) return;
  view.steps_per_second = static_cast<double>(rate_frames) / passed;
  view.real_time = rate_seconds / passed;
  rate_since = Clock::now();
  rate_frames = 0;
  rate_seconds = 0;
}

void SessionThread::State::publish() {
  const Engine& engine = session.engine();
  surface->follow(engine.mesh(), engine.journal());
  surface->fill(engine.mesh(), view.surface);
  if (fine && !surface_options.clip) {
    if (const Status shown = fine->show(engine.mesh(), engine.journal(), view.surface); !shown.ok()) {
      tell(shown);
      fine.reset();
    }
  }
  if (quality->follow(engine.mesh(), engine.journal())) find_worst();
  view.quality = quality->now();
  check_validity();
  view.body = surface_options.clip ? current_bounds(engine.mesh()) : bounds_of(view.surface);
  view.figures = session.figures();
  view.place = session.place();
  view.is_replay = session.is_replay();
  view.is_recording = session.is_recording();
  view.is_paused = options.is_paused;
  if (log_seen != session.log().count()) {
    view.log = std::make_shared<const std::vector<Operation>>(session.log().operations());
    log_seen = session.log().count();
  }
  draw_marks();
  ++view.serial;
  views.publish(view);
}

void SessionThread::State::check_validity() {
  const Engine& engine = session.engine();
  const bool has_changed = checked.way_to(engine.journal()) != JournalCursor::Way::kNone;
  if (has_changed && !engine.is_in_stroke() && validity->check(engine.mesh())) checked.move_to(engine.journal());
  view.validity = validity->light();
}

/// While nothing else happens.
bool SessionThread::State::has_new_light() {
  const ValidityLight before = view.validity;
  check_validity();
  return view.validity.state != before.state || view.validity.text != before.text;
}

void SessionThread::State::find_worst() {
  worst.clear();
  if (options.worst_shown > 0) worst = quality->worst(options.worst_shown);
}

void SessionThread::State::score(const std::filesystem::path& json, const std::filesystem::path& attempt) {
  view.score = session.score();
  if (!view.score) return tell("This scene is no exercise");
  ++view.scores;
  options.is_paused = true;
  if (const Status status = write_text_file(json, to_json(*view.score)); !status.ok()) return tell(status);
  if (!session.is_replay()) {
    if (const Status status = session.save_recording(attempt); !status.ok()) return tell(status);
  }
  tell("Score in " + json.string());
}

void SessionThread::State::start_recording(const std::filesystem::path& path) {
  const Status status = session.start_recording(path);
  tell(status.ok() ? "Recording to " + path.string() : status.error().message);
}

void SessionThread::State::stop_recording() {
  if (session.is_recording()) tell("Recording ended");
  session.stop_recording();
}

void SessionThread::State::draw_marks() {
  view.marks = {};
  session.draw(view.marks, shows_ideal);
  view.gauges = session.gauges();
  if (view.score) mark_deviation(*session.scene().exercise, *view.score, view.marks);
  if (options.device) options.device->draw(view.marks);
  const TetMesh& mesh = session.mesh();
  for (const TetId tet : worst) add_edges(corners_of(mesh, tet), Ink::kWorst, view.marks);
  view.probe.reset();
  if (!probed) return;
  const TetId tet = probed->first.tet();
  if (mesh.is_live(tet) && mesh.generation(tet) == probed->second) view.probe = app::probe(mesh, probed->first);
  if (view.probe) add_edges(view.probe->corners, Ink::kPicked, view.marks);
}

void SessionThread::State::busy(const std::string& text) {
  view.busy = text;
  ++view.serial;
  views.publish(view);
}

void SessionThread::State::tell(const std::string& text) {
  view.notice = text;
  ++view.notices;
}

/// Winds a recording on until somebody wants something else; shows how far it is now and then.
ShouldStop SessionThread::State::until_next_command() {
  return [this, shown = Clock::now()]() mutable {
    if (Clock::now() - shown > kProgress) {
      shown = Clock::now();
      publish();
    }
    return quits || waiting > 0;
  };
}

SessionThread::SessionThread(Session session, const SessionThreadOptions& options)
    : state_(std::make_unique<State>(std::move(session), options)) {
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

SessionThread::~SessionThread() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->quits = true;
  }
  state_->wakes.notify_one();
  state_->thread.join();
}

bool SessionThread::take() {
  return state_->views.take();
}
const SessionView& SessionThread::view() const {
  return state_->views.value();
}

void SessionThread::set_hands(const HandState& hands) {
  const std::lock_guard lock(state_->mutex);
  state_->hands.push(hands);
}
void SessionThread::open(const std::filesystem::path& path) {
  state_->post([s = state_.get(), path] { s->open(path); });
}
void SessionThread::open(StartingBody body) {
  state_->post([s = state_.get(), body] {
    s->busy(std::string("Making the ") + kStartingBodies[static_cast<std::size_t>(body)].name);
    s->open(scene_of(body));
  });
}
void SessionThread::open(StartingExercise exercise) {
  state_->post([s = state_.get(), exercise] {
    s->busy(std::string("Opening the exercise ") + kStartingExercises[static_cast<std::size_t>(exercise)].name);
    s->open(scene_of(exercise));
  });
}
void SessionThread::pause(bool is_paused) {
  state_->post([s = state_.get(), is_paused] { s->options.is_paused = is_paused; });
}
void SessionThread::pause_or_go_on() {
  state_->post([s = state_.get()] { s->options.is_paused = !s->options.is_paused; });
}
void SessionThread::step() {
  state_->post([s = state_.get()] {
    s->options.is_paused = true;
    ++s->steps_left;
  });
}
void SessionThread::reset() {
  state_->post([s = state_.get()] {
    s->busy("Going back to the start");
    s->tell(s->session.reset());
    s->begin_session();
  });
}
void SessionThread::undo() {
  state_->post_after_gestures([s = state_.get()] {
    const Result<bool> done = s->session.undo();
    s->tell(done.ok() ? (*done ? s->session.log().operations().back().text : "Nothing to undo") : done.error().message);
  });
}
void SessionThread::redo() {
  state_->post_after_gestures([s = state_.get()] {
    const Result<bool> done = s->session.redo();
    s->tell(done.ok() ? (*done ? s->session.log().operations().back().text : "Nothing to redo") : done.error().message);
  });
}
void SessionThread::follow(const Stroke& stroke, std::optional<ToolKind> tool) {
  state_->post_after_gestures([s = state_.get(), stroke, tool] { s->session.follow(stroke, tool); });
}
void SessionThread::end_script() {
  state_->post([s = state_.get()] { s->session.end_script(); });
}
void SessionThread::add_suture(const std::array<Vec3, 2>& rest_places, const Suture& suture) {
  state_->post_after_gestures(
      [s = state_.get(), rest_places, suture] { s->tell(s->session.add_suture(rest_places, suture)); });
}
void SessionThread::probe(Side side) {
  state_->post([s = state_.get(), side] {
    s->probed.reset();
    if (s->session.mesh().is_live(side.tet())) s->probed = {side, s->session.mesh().generation(side.tet())};
  });
}
void SessionThread::seek(std::uint64_t call) {
  state_->post([s = state_.get(), call] { s->tell(s->session.seek(call, s->until_next_command())); });
}
void SessionThread::seek_next_step() {
  state_->post([s = state_.get()] {
    if (!s->session.is_replay()) return;
    s->options.is_paused = true;
    s->tell(s->session.seek_next_step(s->until_next_command()));
  });
}
void SessionThread::take_over() {
  state_->post([s = state_.get()] {
    if (!s->session.is_replay()) return;
    const bool is_live = s->session.take_over();
    s->tell(is_live ? "Go on by hand from here" : "A recording of `incise cut` can only be watched");
    if (is_live) s->options.is_paused = false;
  });
}
void SessionThread::start_recording(const std::filesystem::path& path) {
  state_->post([s = state_.get(), path] { s->start_recording(path); });
}
void SessionThread::stop_recording() {
  state_->post([s = state_.get()] { s->stop_recording(); });
}
void SessionThread::start_or_stop_recording(const std::filesystem::path& path) {
  state_->post(
      [s = state_.get(), path] { s->session.is_recording() ? s->stop_recording() : s->start_recording(path); });
}
void SessionThread::export_mesh(const std::filesystem::path& path) {
  state_->post([s = state_.get(), path] {
    const Status status = s->session.export_mesh(path);
    s->tell(status.ok() ? "Wrote " + path.string() : status.error().message);
  });
}
void SessionThread::show(const SurfaceOptions& surface, std::size_t worst) {
  state_->post([s = state_.get(), surface, worst] {
    s->surface_options = surface;
    s->surface->set_options(surface);
    s->options.worst_shown = worst;
    s->find_worst();
  });
}
void SessionThread::score(const std::filesystem::path& json, const std::filesystem::path& attempt) {
  state_->post([s = state_.get(), json, attempt] { s->score(json, attempt); });
}
void SessionThread::show_ideal(bool is_shown) {
  state_->post([s = state_.get(), is_shown] { s->shows_ideal = is_shown; });
}
void SessionThread::set_speed(double speed) {
  state_->post([s = state_.get(), speed] {
    s->options.speed = speed;
    s->next_frame = Clock::now();
  });
}

}  // namespace app
}  // namespace v0
}  // namespace incise
