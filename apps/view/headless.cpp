// SPDX-License-Identifier: Apache-2.0
// Frame by frame through the session, with pictures at those that are asked for; the camera is aimed once, so that a
// sequence stands still.
#include "headless.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>

#include "app/scene/blade_file.h"
#include "app/text/formatted.h"
#include "app/view/cut_marks.h"
#include "app/view/drapes.h"
#include "app/view/piece_bounds.h"
#include "app/view/scene_camera.h"
#include "app/view/scene_fine_view.h"
#include "app/view/spread_pieces.h"
#include "exit_code.h"
#include "film.h"
#include "render/headless_context.h"
#include "render/image.h"
#include "render/offscreen_target.h"
#include "render/renderer.h"
#include "shared/message_text.h"

namespace incise_view {
namespace {

using namespace incise;

constexpr unsigned kPictureSamples = 4;

/// Draws a session at one moment after another.
class Photographer {
 public:
  Photographer(const Arguments& arguments, const app::Session& session, std::vector<Stroke> trajectory,
               render::Renderer renderer, render::OffscreenTarget target)
      : arguments_(arguments),
        trajectory_(std::move(trajectory)),
        surface_(session.mesh(), session.engine().journal()),
        renderer_(std::move(renderer)),
        target_(std::move(target)) {
    const std::optional<app::SceneView>& view = session.scene().view;
    surface_.set_options({arguments.clip || !view ? arguments.clip : view->clip});
  }

  Status take(const app::Session& session, const std::filesystem::path& file);

 private:
  Status show_fine(const app::Session& session);
  void aim(const app::Session& session);
  void mark(const app::Session& session);

  const Arguments& arguments_;
  std::vector<Stroke> trajectory_;  // that is shown
  app::SurfaceView surface_;
  std::optional<app::FineView> fine_;  // the surface of the scene
  bool has_asked_ = false;
  render::Renderer renderer_;
  render::OffscreenTarget target_;
  app::Picture picture_;
  bool has_aimed_ = false;
};

/// Once: a sequence's camera stands still.
void Photographer::aim(const app::Session& session) {
  if (has_aimed_) return;
  has_aimed_ = true;
  // What has fallen off would leave the rest small in an empty picture; pieces that are spread are all to be seen.
  const Box all = bounds_of(picture_.surface);
  const Box body = arguments_.spread > 0 ? all : app::main_part(all, session.mesh(), find_components(session.mesh()));
  picture_.options = app::view_options_of(session.scene());
  if (arguments_.has_view) picture_.options = arguments_.view;
  picture_.options.look = app::view_options_of(session.scene()).look;
  picture_.options.shows_shadows = !arguments_.has_no_shadows;
  picture_.camera = app::camera_of(session.scene(), body, arguments_.size);
  if (arguments_.from) {
    app::look_along(picture_.camera, -*arguments_.from);
    app::frame_all(picture_.camera, arguments_.size, body);
  }
  if (session.scene().view && session.scene().view->has_drapes) {
    picture_.ground =
        std::make_shared<const std::vector<app::SolidCorner>>(app::drapes_around(body, picture_.camera.up));
  }
  if (arguments_.target) picture_.camera.target = *arguments_.target;
  app::zoom(picture_.camera, 1 / arguments_.zoom, body);
}

void Photographer::mark(const app::Session& session) {
  picture_.marks = {};
  session.draw(picture_.marks);
  app::mark_trajectory(trajectory_, picture_.marks);
  if (arguments_.shows_cut_vertices) app::mark_cut_vertices(session.mesh(), picture_.surface, picture_.marks);
  if (arguments_.shows_incision) app::mark_incision(picture_.surface, picture_.marks);
}

/// The fine surface that the scene names, unless a clip plane looks inside.
Status Photographer::show_fine(const app::Session& session) {
  if (!has_asked_) {
    Result<std::optional<app::FineView>> made =
        app::fine_view_of(session.scene(), session.mesh(), session.engine().journal());
    if (!made.ok()) return made.error();
    fine_ = std::move(made).value();
    has_asked_ = true;
  }
  if (!fine_ || arguments_.clip) return {};
  return fine_->show(session.mesh(), session.engine().journal(), picture_.surface);
}

Status Photographer::take(const app::Session& session, const std::filesystem::path& file) {
  surface_.follow(session.mesh(), session.engine().journal());
  surface_.fill(session.mesh(), picture_.surface);
  if (const Status shown = show_fine(session); !shown.ok()) return shown;
  if (arguments_.spread > 0) {
    app::spread_pieces(session.mesh(), find_components(session.mesh()), arguments_.spread, picture_.surface);
  }
  aim(session);
  mark(session);
  if (Status status = renderer_.draw(picture_, arguments_.size, target_.framebuffer()); !status.ok()) return status;
  const Result<render::Image> image = target_.read();
  return image.ok() ? write_png(*image, file) : Status(image.error());
}

/// The last frame that is asked for.
std::uint64_t last_frame(const Arguments& a, const app::Session& session) {
  if (session.is_replay()) return a.has_frame ? std::min(a.frame, session.place().calls) : session.place().calls;
  return a.frame;
}

void say(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

/// How far the work is, on a terminal's stderr, with the time that is left.
class Progress {
 public:
  explicit Progress(bool is_quiet) : is_on_(!is_quiet && isatty(fileno(stderr)) != 0), began_(Clock::now()) {}
  ~Progress() {
    if (is_on_) std::fputs("\r\033[K", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::uint64_t frame, std::uint64_t last) {
    const auto now = Clock::now();
    if (!is_on_ || last == 0 || now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    const double seconds = std::chrono::duration<double>(now - began_).count();
    say(app::formatted("\r\033[K{}", incise_apps::progress_text({frame, last, "frames", seconds, seconds})));
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool is_on_;
  Clock::time_point began_, drawn_;
};

void say_written(const Arguments& a, std::uint64_t pictures) {
  if (a.is_quiet) return;
  const std::string size = app::formatted("{} x {} pixels", a.size.width, a.size.height);
  if (!a.sequence.empty()) say(app::formatted("incise-view: wrote {} ({} pictures, {})\n", a.sequence, pictures, size));
  if (!a.film.empty()) say(app::formatted("incise-view: wrote {} ({} pictures, {})\n", a.film, pictures, size));
  if (!a.screenshot.empty()) say(app::formatted("incise-view: wrote {} (picture, {})\n", a.screenshot, size));
}

/// @param of_film  where the pictures of a film go.
Status run(const Arguments& a, app::Session& session, Photographer& photographer,
           const std::filesystem::path& of_film) {
  const std::uint64_t last = last_frame(a, session);
  Progress progress(a.is_quiet);
  for (std::uint64_t frame = 0; frame <= last; ++frame) {
    progress.show(frame, last);
    if (frame > 0) {
      if (Status status = session.frame(); !status.ok()) return status;
    }
    if (frame % a.every != 0) continue;
    if (!a.sequence.empty()) {
      const std::filesystem::path file = std::filesystem::path(a.sequence) / app::formatted("{:06}.png", frame);
      if (Status status = photographer.take(session, file); !status.ok()) return status;
    }
    if (!a.film.empty()) {
      const std::filesystem::path file = of_film / app::formatted("{:06}.png", frame / a.every);
      if (Status status = photographer.take(session, file); !status.ok()) return status;
    }
  }
  if (!a.film.empty()) {
    const double rate = 1 / (session.scene().options.frame_seconds * static_cast<double>(a.every));
    if (Status status = make_film(of_film, a.film, rate); !status.ok()) return status;
  }
  return a.screenshot.empty() ? Status() : photographer.take(session, a.screenshot);
}

/// What `--trajectory` names.
Result<std::vector<Stroke>> trajectory_of(const Arguments& a) {
  return a.trajectory.empty() ? std::vector<Stroke>() : app::read_blade(a.trajectory);
}

}  // namespace

int run_headless(const Arguments& arguments) {
  Result<app::Session> session = open_session(arguments);
  if (!session.ok()) return fail(kBadInput, session.error().message);
  const Result<std::vector<Stroke>> strokes = device_strokes(arguments);
  if (!strokes.ok()) return fail(kBadInput, strokes.error().message);
  for (const Stroke& stroke : *strokes) session->follow(stroke);
  Result<std::vector<Stroke>> trajectory = trajectory_of(arguments);
  if (!trajectory.ok()) return fail(kBadInput, trajectory.error().message);
  const Result<render::HeadlessContext> context = render::HeadlessContext::create();
  if (!context.ok()) return fail(kNoDisplay, context.error().message);
  Result<render::Renderer> renderer = render::Renderer::create(arguments.samples.value_or(kPictureSamples));
  if (!renderer.ok()) return fail(kNoDisplay, renderer.error().message);
  Result<render::OffscreenTarget> target = render::OffscreenTarget::create(arguments.size);
  if (!target.ok()) return fail(exit_of(target.error()), target.error().message);
  std::error_code code;
  if (!arguments.sequence.empty()) std::filesystem::create_directories(arguments.sequence, code);
  const TemporaryFolder of_film;
  if (of_film.path().empty()) return fail(kFailure, "there is no folder for temporary files: set TMPDIR");
  Photographer photographer(arguments, *session, std::move(trajectory).value(), std::move(renderer).value(),
                            std::move(target).value());
  if (const Status status = run(arguments, *session, photographer, of_film.path()); !status.ok()) {
    return fail(exit_of(status.error()), status.error().message);
  }
  say_written(arguments, last_frame(arguments, *session) / arguments.every + 1);
  return kDone;
}

}  // namespace incise_view
