// SPDX-License-Identifier: Apache-2.0
// Actions go to those who know them: tools, time, files, the window's own state. A picture is made from the newest
// view when it is asked for; the first input of a person ends a demonstration.
#include "app/viewer/viewer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <system_error>
#include <utility>

#include "app/hands/scene_hand_tools.h"
#include "app/scene/view_names.h"
#include "app/text/formatted.h"
#include "app/view/drapes.h"
#include "app/view/scene_camera.h"
#include "app/viewer/first_steps.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr double kNoticeSeconds = 5;
constexpr double kDepthFactor = 1.1;
constexpr double kTilt = 5 * std::numbers::pi / 180;
constexpr double kZoomFactor = 0.9;
constexpr double kTurnShare = 1.0 / 24;  // of the picture's height, per press of a key
constexpr double kClipStep = 0.05;
constexpr double kLeastFree = 0.4;  // of the picture's width: a body is not made smaller for panels
constexpr double kSeeThrough = 0.35;
constexpr double kTextFactor = 1.15, kSmallestText = 0.6, kLargestText = 3;
constexpr std::size_t kWorstTets = 10;
constexpr std::uint64_t kMostFiles = 1'000'000;

/// The first name of a row of names that no file has.
fs::path free_name(const fs::path& folder, const std::string& stem, const std::string& extension) {
  std::error_code code;
  for (std::uint64_t i = 1; i < kMostFiles; ++i) {
    fs::path path = folder / formatted("{}-{:04}{}", stem, i, extension);
    if (!fs::exists(path, code)) return path;
  }
  return folder / (stem + extension);
}

}  // namespace

struct Viewer::State {
  State(SessionThread& chosen_session, const ViewerOptions& chosen) : session(chosen_session), options(chosen) {
    shown.options = chosen.view;
  }

  SessionThread& session;
  ViewerOptions options;
  ViewerState shown;
  Picture picture;
  Hud hud;
  ToolMachine tools{ToolSettings{1, 0, 1, 1, 1, 1}};
  std::uint64_t session_seen = 0, notices_seen = 0;
  std::optional<std::pair<std::string, std::uint64_t>> scene_seen;  // its title and its tets at the start
  bool is_changed = true;
  double now = 0, notice_until = 0;
  bool wants_screenshot = false;
  std::array<std::uint64_t, 3> sequence_frame{};  // that was saved last: session, frame, call
  std::uint64_t sequence_number = 0;
  fs::path sequence_folder;
  fs::path attempt;  // the recording of what was scored last
  std::uint64_t scores_seen = 0;
  Vec3 clip_normal = Vec3::UnitX();
  std::optional<Theme> chosen_theme;  // by the person, for all bodies
  FirstSteps first_steps;
  bool is_demonstrating = false;
  Cursor cursor = Cursor::kArrow;
  double free_width = std::numeric_limits<double>::infinity();  // pixels

  [[nodiscard]] ToolContext context(const Viewport& viewport) const {
    return {viewport, &session.view().surface, session.view().body};
  }
  [[nodiscard]] Viewport free_part(const Viewport& viewport) const;
  [[nodiscard]] FirstSteps::Hold hold() const;
  void begin_session(const Viewport& viewport);
  void end_demonstration();
  void choose_cursor(const PointerEvent& event);
  void say(const std::string& text);
  void hand_over();
  void change_settings(double depth_factor, double tilt);
  void clip(bool is_on);
  void clip_as(const HalfSpace& hidden);
  void show_surface();
  void score();
  void show_ideal();
  void toggle_recording();
  void toggle_sequence();
  bool act_on_tools(Action action);
  bool act_on_time(Action action);
  bool act_on_files(Action action);
  bool act_on_camera(Action action, const Viewport& viewport);
  bool act_on_view(Action action);
  void act_on_window(Action action);
  void cancel();
};

Viewer::Viewer(SessionThread& session, const ViewerOptions& options)
    : state_(std::make_unique<State>(session, options)) {}
Viewer::~Viewer() = default;

// --- what comes in

void Viewer::handle(const PointerEvent& event, const Viewport& viewport) {
  State& s = *state_;
  if (event.kind != PointerEvent::Kind::kMove && event.kind != PointerEvent::Kind::kRelease) s.end_demonstration();
  PointerEvent seen = event;
  const bool is_press = event.kind == PointerEvent::Kind::kPress && event.button == PointerEvent::Button::kLeft;
  const bool is_looking = row_of(s.tools.tool()).only_looks;
  const bool only_looks = event.alt || (is_looking && !event.shift);  // with Shift every tool grasps
  const bool is_watched = !s.options.mouse_is_hand || s.session.view().is_replay;
  if (is_press && is_watched && !only_looks) {
    seen.alt = true;  // turns the view instead
    seen.shift = false;
  }
  if (is_press && s.session.view().is_replay && !only_looks) {
    s.say("A recording is played: " + key_of(Action::kTakeOver) + " goes on by hand from here");
  } else if (is_press && s.session.view().is_paused && !is_watched && !only_looks) {
    s.say("Paused: " + key_of(Action::kPause) + " goes on");
  }
  s.tools.handle(seen, s.context(viewport), s.picture.camera);
  s.choose_cursor(seen);
  s.hand_over();
}

/// The first input: from now on it is the person who cuts.
void Viewer::State::end_demonstration() {
  if (!std::exchange(is_demonstrating, false)) return;
  session.end_script();
  first_steps.take_over();
  is_changed = true;
}

/// A release changes nothing about what the next press would do.
void Viewer::State::choose_cursor(const PointerEvent& event) {
  if (event.kind == PointerEvent::Kind::kRelease) return;
  const bool is_watched = !options.mouse_is_hand || session.view().is_replay;
  const bool only_looks = row_of(tools.tool()).make == nullptr;
  if (event.alt || only_looks || is_watched) {
    cursor = Cursor::kHand;
  } else if (tools.is_busy() || tools.is_on_tissue()) {
    cursor = session.view().is_paused ? Cursor::kBarred : Cursor::kCross;
  } else {
    cursor = Cursor::kArrow;  // beside the body a drag may still begin
  }
}

void Viewer::State::hand_over() {
  session.set_hands(tools.hands());
  if (const std::optional<Stroke> stroke = tools.take_stroke()) session.follow(*stroke, tools.tool());
  if (const std::optional<Stitch> stitch = tools.take_stitch()) session.add_suture(stitch->rest_places, stitch->suture);
  if (const std::optional<SurfaceHit> hit = tools.take_probe()) session.probe(hit->side);
  if (const std::string why = tools.take_refusal(); !why.empty()) say(why);
  is_changed = true;
}

void Viewer::act(Action action, const Viewport& viewport) {
  State& s = *state_;
  s.is_changed = true;
  s.end_demonstration();
  if (s.act_on_tools(action) || s.act_on_time(action) || s.act_on_files(action)) return;
  if (s.act_on_camera(action, viewport) || s.act_on_view(action)) return;
  s.act_on_window(action);
}

void Viewer::set_clip_depth(double depth) {
  state_->shown.clip_depth = depth;
  state_->show_surface();
  state_->is_changed = true;
}

void Viewer::leave_free(double width) {
  state_->free_width = width;
}

void Viewer::open(const fs::path& path) {
  state_->session.open(path);
}

void Viewer::open(StartingBody body) {
  state_->session.open(body);
}

void Viewer::open(StartingExercise exercise) {
  state_->session.open(exercise);
}

void Viewer::notify(const std::string& text) {
  state_->say(text);
}

bool Viewer::State::act_on_tools(Action action) {
  if (action <= Action::kLastTool) {
    tools.choose(static_cast<ToolKind>(action));
    return true;
  }
  switch (action) {
    case Action::kDeeper:
      change_settings(kDepthFactor, 0);
      break;
    case Action::kShallower:
      change_settings(1 / kDepthFactor, 0);
      break;
    case Action::kTiltLeft:
      change_settings(1, kTilt);
      break;
    case Action::kTiltRight:
      change_settings(1, -kTilt);
      break;
    case Action::kCancel:
      cancel();
      break;
    default:
      return false;
  }
  hand_over();
  return true;
}

void Viewer::State::change_settings(double depth_factor, double tilt) {
  ToolSettings settings = tools.settings();
  settings.depth *= depth_factor;
  settings.angle += tilt;
  tools.set(settings);
}

/// Closes one thing at a time, what is nearest first.
void Viewer::State::cancel() {
  if (tools.cancel()) return;
  shown.shows_help = false;
}

bool Viewer::State::act_on_time(Action action) {
  switch (action) {
    case Action::kUndo:
      session.undo();
      return true;
    case Action::kRedo:
      session.redo();
      return true;
    case Action::kPause:
      session.pause_or_go_on();
      return true;
    case Action::kStep:
      session.step();
      return true;
    case Action::kReset:
      session.reset();
      return true;
    case Action::kNextStep:
      session.seek_next_step();
      return true;
    case Action::kTakeOver:
      session.take_over();
      return true;
    default:
      return false;
  }
}

bool Viewer::State::act_on_files(Action action) {
  switch (action) {
    case Action::kRecord:
      toggle_recording();
      return true;
    case Action::kScreenshot:
      wants_screenshot = true;
      return true;
    case Action::kImageSequence:
      toggle_sequence();
      return true;
    case Action::kScore:
      score();
      return true;
    case Action::kIdeal:
      show_ideal();
      return true;
    case Action::kExportMesh:
      session.export_mesh(free_name(options.folder, "incise-mesh", ".vtu"));
      return true;
    default:
      return false;
  }
}

/// Of a recording that is played there is no other recording.
void Viewer::State::score() {
  const fs::path recording = free_name(options.folder, "incise-attempt", ".jsonl");
  attempt = session.view().is_replay ? fs::path() : recording;
  session.score(free_name(options.folder, "incise-score", ".json"), recording);
}

/// Beside the attempt that was scored, where there is one; else beside the blade from now on.
void Viewer::State::show_ideal() {
  const SessionView& view = session.view();
  if (!view.scene || !view.scene->exercise) return say("This scene is no exercise");
  shown.shows_ideal = view.score.has_value() || !shown.shows_ideal;
  session.show_ideal(shown.shows_ideal);
  if (!view.score || view.is_replay || attempt.empty()) return;
  session.open(attempt);
  session.pause(false);
}

void Viewer::State::toggle_recording() {
  session.start_or_stop_recording(free_name(options.folder, "incise-recording", ".jsonl"));
}

void Viewer::State::toggle_sequence() {
  shown.saves_sequence = !shown.saves_sequence;
  if (!shown.saves_sequence) return say("Saved pictures in " + sequence_folder.string());
  sequence_folder = free_name(options.folder, "incise-pictures", "");
  sequence_number = 0;
  sequence_frame = {};
  say("Saving pictures in " + sequence_folder.string());
}

bool Viewer::State::act_on_camera(Action action, const Viewport& viewport) {
  Camera& camera = picture.camera;
  const double turn = kTurnShare * viewport.height;
  switch (action) {
    case Action::kFrameAll:
      frame_all(camera, free_part(viewport), session.view().body);
      return true;
    case Action::kTurnLeft:
      orbit(camera, viewport, Vec2(turn, 0));
      return true;
    case Action::kTurnRight:
      orbit(camera, viewport, Vec2(-turn, 0));
      return true;
    case Action::kTurnUp:
      orbit(camera, viewport, Vec2(0, turn));
      return true;
    case Action::kTurnDown:
      orbit(camera, viewport, Vec2(0, -turn));
      return true;
    case Action::kZoomIn:
      zoom(camera, kZoomFactor, session.view().body);
      return true;
    case Action::kZoomOut:
      zoom(camera, 1 / kZoomFactor, session.view().body);
      return true;
    default:
      return false;
  }
}

bool Viewer::State::act_on_view(Action action) {
  ViewOptions& view = shown.options;
  switch (action) {
    case Action::kWireframe:
      view.shows_wireframe = !view.shows_wireframe;
      return true;
    case Action::kClipPlane:
      clip(!shown.is_clipped);
      return true;
    case Action::kClipDeeper:
    case Action::kClipShallower:
      shown.clip_depth += action == Action::kClipDeeper ? kClipStep : -kClipStep;
      show_surface();
      return true;
    case Action::kColor:
      view.color = static_cast<ColorBy>((static_cast<unsigned>(view.color) + 1) % kColorNames.size());
      return true;
    case Action::kWorstTets:
      shown.shows_worst = !shown.shows_worst;
      show_surface();
      return true;
    case Action::kTransparency:
      view.skin_opacity = view.skin_opacity < 1 ? 1 : kSeeThrough;
      return true;
    case Action::kOcclusion:
      view.shows_occlusion = !view.shows_occlusion;
      return true;
    case Action::kTheme:
      view.theme = view.theme == Theme::kDark ? Theme::kLight : Theme::kDark;
      chosen_theme = view.theme;
      return true;
    default:
      return false;
  }
}

void Viewer::State::clip(bool is_on) {
  shown.is_clipped = is_on;
  if (is_on) {
    clip_normal = -picture.camera.backward();  // what is nearer than the plane goes
    shown.clip_depth = 0.5;
  }
  show_surface();
}

/// The clip plane of a scene.
void Viewer::State::clip_as(const HalfSpace& hidden) {
  const Box& body = session.view().body;
  const double middle = hidden.normal.dot(0.5 * (body.lo + body.hi));
  const double reach = hidden.normal.cwiseAbs().dot(0.5 * (body.hi - body.lo));
  shown.is_clipped = reach > 0;
  clip_normal = hidden.normal;
  if (shown.is_clipped) shown.clip_depth = 0.5 + 0.5 * (hidden.offset - middle) / reach;
}

void Viewer::State::show_surface() {
  shown.clip_depth = std::clamp(shown.clip_depth, 0.0, 1.0);
  SurfaceOptions surface;
  const Box& body = session.view().body;
  if (shown.is_clipped && !body.is_empty()) {
    const double middle = clip_normal.dot(0.5 * (body.lo + body.hi));
    const double reach = clip_normal.cwiseAbs().dot(0.5 * (body.hi - body.lo));
    surface.clip = HalfSpace{clip_normal, middle + (2 * shown.clip_depth - 1) * reach};
  }
  session.show(surface, shown.shows_worst ? kWorstTets : 0);
}

void Viewer::State::act_on_window(Action action) {
  switch (action) {
    case Action::kPanels:
      shown.panels = static_cast<Panels>((static_cast<unsigned>(shown.panels) + 1) % 3);
      if (!shown.is_research && shown.panels == Panels::kFigures) shown.panels = Panels::kNone;
      break;
    case Action::kResearch:
      shown.is_research = !shown.is_research;
      shown.panels = Panels::kAll;
      break;
    case Action::kLarger:
    case Action::kSmaller:
      shown.text_scale *= action == Action::kLarger ? kTextFactor : 1 / kTextFactor;
      shown.text_scale = std::clamp(shown.text_scale, kSmallestText, kLargestText);
      break;
    case Action::kFullScreen:
      shown.is_full_screen = !shown.is_full_screen;
      break;
    case Action::kHelp:
      shown.shows_help = !shown.shows_help;
      break;
    case Action::kQuit:
      shown.wants_quit = true;
      break;
    default:
      break;
  }
}

void Viewer::State::say(const std::string& text) {
  shown.notice = text;
  notice_until = now + kNoticeSeconds;
  is_changed = true;
}

// --- what comes out

bool Viewer::update(const Viewport& viewport, double now) {
  State& s = *state_;
  s.now = now;
  if (s.session.take()) {
    const SessionView& view = s.session.view();
    if (s.session_seen != view.session) s.begin_session(viewport);
    s.session_seen = view.session;
    if (s.notices_seen != view.notices) s.say(view.notice);
    s.notices_seen = view.notices;
    s.first_steps.see(view.figures.strokes, s.hold(), s.is_demonstrating);
    s.is_changed = true;
  }
  if (!s.shown.notice.empty() && now > s.notice_until) {
    s.shown.notice.clear();
    s.is_changed = true;
  }
  if (!std::exchange(s.is_changed, false)) return false;
  s.picture.surface = s.session.view().surface;
  s.picture.options = s.shown.options;
  s.picture.marks = s.session.view().marks;
  s.tools.draw(s.context(viewport), s.picture.camera, s.picture.marks);
  return true;
}

FirstSteps::Hold Viewer::State::hold() const {
  if (!tools.is_pulling()) return FirstSteps::Hold::kNone;
  return tools.is_busy() ? FirstSteps::Hold::kDrag : FirstSteps::Hold::kStays;
}

/// What panels leave free, beside each other: bodies have the whole height.
Viewport Viewer::State::free_part(const Viewport& viewport) const {
  if (shown.panels != Panels::kAll) return viewport;
  const double width = std::clamp(free_width, kLeastFree * viewport.width, 1.0 * viewport.width);
  return {std::max(1, static_cast<int>(width)), viewport.height};
}

void Viewer::State::begin_session(const Viewport& viewport) {
  const SessionView& view = session.view();
  const Scene& scene = *view.scene;
  const std::pair scene_now(view.title, view.figures.tets_at_start);
  const bool is_same = scene_seen == scene_now;  // from its start: it keeps the person's view, tool and settings
  is_demonstrating = scene.view && scene.view->is_demonstration && !view.is_replay;
  tools.reset(is_same ? tools.settings() : settings_for(scene, view.body));
  // What a demonstration tells a person to do is told of its tool, also where it begins again.
  const std::optional<ToolKind> tool = is_same && !is_demonstrating ? std::nullopt : tool_for(scene);
  if (tool && !options.keeps_tool) tools.choose(*tool);
  if (!is_same) {
    picture.camera = camera_of(scene, view.body, free_part(viewport));
    const ViewOptions asked = view_options_of(scene);
    if (!options.keeps_view) shown.options = asked;
    shown.options.look = asked.look;  // the body's, whatever is kept
    shown.options.theme = chosen_theme.value_or(shown.options.theme);
    shown.options.shows_occlusion = options.shades_hollows;
    shown.options.shows_shadows = options.has_shadows;
    shown.is_clipped = false;
    if (scene.view && scene.view->clip && !options.keeps_view) clip_as(*scene.view->clip);
  }
  scene_seen = scene_now;
  const bool has_drapes = scene.view && scene.view->has_drapes;
  picture.ground.reset();
  if (has_drapes) {
    picture.ground = std::make_shared<const std::vector<SolidCorner>>(drapes_around(view.body, picture.camera.up));
  }
  first_steps.begin(is_demonstrating);
  show_surface();
  session.set_hands(tools.hands());
}

void Viewer::drawn(double now, double draw_ms) {
  const SessionView& view = state_->session.view();
  state_->hud.add(now, draw_ms, view.session, view.figures);
}

const Picture& Viewer::picture() const {
  return state_->picture;
}
const SessionView& Viewer::view() const {
  return state_->session.view();
}
const ViewerState& Viewer::state() const {
  return state_->shown;
}
ViewerState& Viewer::state() {
  state_->is_changed = true;
  return state_->shown;
}
const Hud& Viewer::hud() const {
  return state_->hud;
}
std::string_view Viewer::next_step() const {
  return state_->first_steps.text(state_->tools.tool());
}
bool Viewer::is_demonstrating() const {
  return state_->is_demonstrating;
}
Cursor Viewer::cursor() const {
  return state_->cursor;
}
SessionThread& Viewer::session() {
  return state_->session;
}
Camera& Viewer::camera() {
  state_->is_changed = true;
  return state_->picture.camera;
}
ToolMachine& Viewer::tools() {
  state_->is_changed = true;
  return state_->tools;
}

std::optional<fs::path> Viewer::take_page() {
  State& s = *state_;
  const SessionView& view = s.session.view();
  if (!view.score || std::exchange(s.scores_seen, view.scores) == view.scores) return std::nullopt;
  return free_name(s.options.folder, "incise-report", ".html");
}

std::optional<fs::path> Viewer::take_screenshot() {
  State& s = *state_;
  if (std::exchange(s.wants_screenshot, false)) return free_name(s.options.folder, "incise", ".png");
  const SessionView& view = s.session.view();
  const std::array<std::uint64_t, 3> frame = {view.session, view.figures.frames, view.place.call};
  if (!s.shown.saves_sequence || s.sequence_frame == frame) return std::nullopt;
  s.sequence_frame = frame;
  return s.sequence_folder / formatted("{:06}.png", ++s.sequence_number);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
