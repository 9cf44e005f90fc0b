// SPDX-License-Identifier: Apache-2.0
// A frame: take what happened, step by step, draw the panels, draw the picture, wait. What is saved is drawn once more
// without panels.
#include "interactive.h"

#include <imgui.h>

#include <bitset>
#include <chrono>
#include <cstdio>
#include <span>
#include <system_error>
#include <utility>

#include "app/scene/exercise_page.h"
#include "app/session/session_thread.h"
#include "app/text/text_file.h"
#include "app/view/exercise_marks.h"
#include "app/viewer/viewer.h"
#include "exit_code.h"
#include "interface.h"
#include "panels.h"
#include "render/headless_context.h"
#include "render/image.h"
#include "render/offscreen_target.h"
#include "render/renderer.h"
#include "window.h"

namespace incise_view {
namespace {

using namespace incise;

constexpr double kLongestWait = 1.0 / 60;  // s: the simulation may have a new frame
constexpr int kSettlingFrames = 3;         // after something happened, until panels have found their sizes
constexpr int kUnseenFrames = 3;           // of panels, before the first picture
constexpr unsigned kWindowSamples = 4;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A processor that draws has no time for what only makes the picture nicer.
app::ViewerOptions options_of(const Arguments& arguments, bool is_software) {
  app::ViewerOptions options;
  options.view = arguments.view;
  options.keeps_view = arguments.has_view;
  options.shades_hollows = options.has_shadows = !is_software;
  options.mouse_is_hand = arguments.device == "mouse" || incise_apps::is_haply(arguments.device);
  options.keeps_tool = incise_apps::is_haply(arguments.device);
  return options;
}

/// The window with everything in it, frame by frame.
class Application {
 public:
  Application(const Arguments& arguments, Window& window, render::Renderer renderer, app::SessionThread& session)
      : window_(window),
        renderer_(std::move(renderer)),
        interface_(window),
        panels_{{}, window.renderer_name(), render::is_software_renderer(window.renderer_name())},
        viewer_(session, options_of(arguments, panels_.is_software)) {
    // The blade is the device's: the mouse is the other hand.
    if (incise_apps::is_haply(arguments.device)) viewer_.tools().choose(app::ToolKind::kGrasp);
  }

  ExitCode run();

 private:
  [[nodiscard]] bool ends();
  void frame();
  void take_events();
  void settle_panels();
  void take_step(std::span<const app::InputEvent> step);
  void handle(const app::InputEvent& event);
  void handle(const app::PointerEvent& event);
  void draw();
  void print_score();
  void save_picture();
  void save_page();
  Result<std::string> photograph(const app::Picture& picture);

  Window& window_;
  render::Renderer renderer_;
  Interface interface_;
  PanelContext panels_;
  Panels drawn_panels_;
  app::Viewer viewer_;
  int frames_to_draw_ = kSettlingFrames;
  int unseen_frames_ = kUnseenFrames;
  std::bitset<3> dragging_;   // buttons that went down in the picture, wherever the pointer is meanwhile
  bool has_printed_ = false;  // the score
  std::string complaint_;     // the last one about drawing
  std::string title_;
};

ExitCode Application::run() {
  while (!ends()) {
    window_.wait(kLongestWait);
    frame();
    if (window_.is_lost()) {
      return static_cast<ExitCode>(
          fail(kNoDisplay, "the graphics context was lost; a recording under way is kept. Start again to go on"));
    }
  }
  return kDone;
}

bool Application::ends() {
  return window_.should_close() || std::as_const(viewer_).state().wants_quit;
}

void Application::frame() {
  panels_.viewport = window_.viewport();
  const app::ViewerState& state = std::as_const(viewer_).state();
  settle_panels();
  take_events();
  const bool has_changed = viewer_.update(panels_.viewport, seconds_now());
  frames_to_draw_ = has_changed ? kSettlingFrames : frames_to_draw_ - 1;
  if (frames_to_draw_ > 0) {
    draw();
  } else {
    interface_.skip();
  }
  window_.set_full_screen(state.is_full_screen);
  window_.show_cursor(interface_.wants_pointer() ? app::Cursor::kArrow : viewer_.cursor());
  print_score();
  if (title_ != viewer_.view().title) {
    title_ = viewer_.view().title;
    window_.show_title(title_.empty() ? "Incise" : title_ + " - Incise");
  }
}

/// A panel that has never been laid out has no size, and is left out of its first picture: that is not to be one that
/// is seen.
void Application::settle_panels() {
  for (; unseen_frames_ > 0; --unseen_frames_) {
    take_step({});
    interface_.skip();
    viewer_.update(panels_.viewport, seconds_now());
  }
}

/// Panels follow one step a frame; of the frames of a picture the last one is drawn. So nothing is lost to them,
/// however slow pictures are.
void Application::take_events() {
  const std::vector<app::InputEvent> events = window_.take_events();
  if (!events.empty()) frames_to_draw_ = kSettlingFrames + 1;
  std::span<const app::InputEvent> left(events);
  while (true) {
    const std::span<const app::InputEvent> step = left.first(app::step_length(left));
    left = left.subspan(step.size());
    take_step(step);
    if (left.empty()) return;
    interface_.skip();
  }
}

void Application::take_step(std::span<const app::InputEvent> step) {
  const app::ViewerState& state = std::as_const(viewer_).state();
  interface_.begin(state.options.theme, state.text_scale, step);
  for (const app::InputEvent& event : step) handle(event);
  drawn_panels_.draw(viewer_, panels_);
}

void Application::handle(const app::InputEvent& event) {
  if (const auto* pointer = std::get_if<app::PointerEvent>(&event)) handle(*pointer);
  if (const auto* dropped = std::get_if<app::DroppedFile>(&event)) viewer_.open(dropped->path);
  const auto* key = std::get_if<app::KeyChange>(&event);
  if (key == nullptr || !key->press || interface_.wants_keys()) return;
  if (const std::optional<app::Action> action = app::action_of(*key->press)) viewer_.act(*action, panels_.viewport);
}

/// A drag that began in the picture stays the picture's; one that began on a panel stays the panel's.
void Application::handle(const app::PointerEvent& event) {
  using Kind = app::PointerEvent::Kind;
  if (dragging_.none() && interface_.wants_pointer()) return;
  const auto button = static_cast<std::size_t>(event.button);
  if (event.kind == Kind::kPress) dragging_.set(button);
  if (event.kind == Kind::kRelease) dragging_.reset(button);
  viewer_.handle(event, panels_.viewport);
}

void Application::draw() {
  const double begin = seconds_now();
  if (const Status status = renderer_.draw(viewer_.picture(), panels_.viewport, 0); !status.ok()) {
    viewer_.notify(status.error().message);
    if (std::exchange(complaint_, status.error().message) != status.error().message) fail(kFailure, complaint_);
  }
  save_picture();
  save_page();
  interface_.draw();
  viewer_.drawn(seconds_now(), 1e3 * (seconds_now() - begin));
  window_.swap();
}

/// Each score once, on stdout.
void Application::print_score() {
  const std::optional<app::ExerciseScore>& score = viewer_.view().score;
  if (score && !has_printed_) std::fputs(app::to_text(*score).c_str(), stdout);
  has_printed_ = score.has_value();
}

/// Without the panels.
void Application::save_picture() {
  const std::optional<std::filesystem::path> file = viewer_.take_screenshot();
  if (!file) return;
  std::error_code code;
  if (file->has_parent_path()) std::filesystem::create_directories(file->parent_path(), code);
  const Result<render::Image> image = render::read_framebuffer(0, panels_.viewport);
  const Status status = image.ok() ? write_png(*image, *file) : Status(image.error());
  if (!status.ok()) return viewer_.notify(status.error().message);
  if (!std::as_const(viewer_).state().saves_sequence) viewer_.notify("Saved " + file->string());
}

/// The bytes of a PNG of a picture, without the panels.
Result<std::string> Application::photograph(const app::Picture& picture) {
  if (const Status status = renderer_.draw(picture, panels_.viewport, 0); !status.ok()) return status.error();
  const Result<render::Image> image = render::read_framebuffer(0, panels_.viewport);
  return image.ok() ? render::png_bytes(*image) : image.error();
}

/// What was done, as the person sees it and from straight above the line. The person's view is drawn last: it stays.
void Application::save_page() {
  const std::optional<std::filesystem::path> file = viewer_.take_page();
  if (!file) return;
  const app::SessionView& view = viewer_.view();
  app::Picture above = viewer_.picture();
  app::look_at_line(*view.score, panels_.viewport, above.camera);
  const Result<std::string> from_above = photograph(above), as_seen = photograph(viewer_.picture());
  std::vector<app::PagePicture> pictures;
  if (as_seen.ok()) pictures.push_back({"The attempt, with how far off it is beside the line", *as_seen});
  if (from_above.ok()) pictures.push_back({"The same from above", *from_above});
  const Status status = app::write_text_file(*file, app::exercise_page(*view.scene, *view.score, pictures));
  viewer_.notify(status.ok() ? "Report in " + file->string() : status.error().message);
}

/// Software renderers smooth edges at a price that is better spent on pictures.
unsigned samples_of(const Arguments& arguments, const Window& window) {
  return arguments.samples.value_or(render::is_software_renderer(window.renderer_name()) ? 0 : kWindowSamples);
}

}  // namespace

int run_window(const Arguments& arguments) {
  Result<app::Session> opened = open_session(arguments);
  if (!opened.ok()) return fail(kBadInput, opened.error().message);
  const Result<std::vector<Stroke>> strokes = device_strokes(arguments);
  if (!strokes.ok()) return fail(kBadInput, strokes.error().message);
  Result<Window> window = Window::open("Incise", arguments.size, 0);
  if (!window.ok()) return fail(kNoDisplay, window.error().message);
  Result<render::Renderer> renderer = render::Renderer::create(samples_of(arguments, *window));
  if (!renderer.ok()) return fail(kNoDisplay, renderer.error().message);
  app::SessionThreadOptions options;
  options.session = arguments.session_options();
  options.session.record.clear();  // of the first file alone
  options.is_paused = arguments.is_paused;
  options.speed = arguments.speed;
  if (incise_apps::is_haply(arguments.device)) {
    Result<std::unique_ptr<app::DeviceHand>> hand = incise_apps::open_device(arguments.device, arguments.haptic);
    if (!hand.ok()) return fail(exit_of(hand.error()), hand.error().message);
    options.device = std::move(hand).value();
  }
  app::SessionThread session(std::move(opened).value(), options);
  for (const Stroke& stroke : *strokes) session.follow(stroke);
  Application application(arguments, *window, std::move(renderer).value(), session);
  return application.run();
}

}  // namespace incise_view
