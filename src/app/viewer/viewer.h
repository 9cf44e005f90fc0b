// SPDX-License-Identifier: Apache-2.0
// What a window does, without the window: keys and pointer events go in, a picture and requests come out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/hands/tools.h"
#include "app/session/session_thread.h"
#include "app/view/picture.h"
#include "app/viewer/hud.h"
#include "app/viewer/key_bindings.h"

namespace incise {
inline namespace v0 {
namespace app {

/// How much is shown beside the picture; `kFigures` for research alone.
enum class Panels : std::uint8_t { kAll, kFigures, kNone };

/// What the pointer looks like: it tells what a press would do.
enum class Cursor : std::uint8_t {
  kArrow,
  kCross,   ///< on tissue, with a tool
  kHand,    ///< turns or moves the view
  kBarred,  ///< nothing can be done here
};

struct ViewerOptions {
  std::filesystem::path folder = ".";  ///< of screenshots, recordings and meshes that are written
  ViewOptions view;
  bool keeps_view = false;     ///< `view` stands, whatever a scene says
  bool shades_hollows = true;  ///< at first; it costs a renderer without a graphics processor much
  bool has_shadows = true;     ///< at first
  bool mouse_is_hand = true;   ///< false: no tool but the probe takes the mouse, whose left drags turn the view
  bool keeps_tool = false;     ///< whatever a scene puts into the hand: a device has the blade
};

/// What the person sees beside the body; a front end draws it and may change it.
struct ViewerState {
  ViewOptions options;
  Panels panels = Panels::kAll;
  bool is_research = false;  ///< all figures are shown; else little more than the body and the tools
  bool shows_help = false;
  bool is_clipped = false;
  double clip_depth = 0.5;  ///< share of the body, seen along the clip plane's normal, that is cut away; in [0, 1]
  bool shows_worst = false;
  bool shows_ideal = false;  ///< of an exercise
  bool is_full_screen = false;
  double text_scale = 1;  ///< in [0.6, 3]
  bool wants_quit = false;
  bool saves_sequence = false;
  std::string notice;  ///< empty: none; goes after a few seconds
};

/// Ties tools, camera and session together. One thread; a clock is handed in.
class Viewer {
 public:
  Viewer(SessionThread& session, const ViewerOptions& options = {});
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer();

  void handle(const PointerEvent& event, const Viewport& viewport);
  void act(Action action, const Viewport& viewport);
  /// Moves the clip plane, where there is one: the share of the body that is cut away, in [0, 1].
  void set_clip_depth(double depth);
  /// How many pixels of the picture's width, around its middle, panels leave free: bodies are framed there from then
  /// on, while panels are shown, but never in less than two fifths of the picture.
  void leave_free(double width);
  /// A file was dropped, or named.
  void open(const std::filesystem::path& path);
  void open(StartingBody body);
  void open(StartingExercise exercise);
  /// Says something to the person for a few seconds, at `now` s.
  void notify(const std::string& text);

  /// Takes what happened since, and makes the picture. `now` in s, never falling. Returns whether it differs from the
  /// one before: where it does not, nothing needs to be drawn.
  bool update(const Viewport& viewport, double now);
  /// A picture was drawn; the time in milliseconds.
  void drawn(double now, double draw_ms);

  [[nodiscard]] const Picture& picture() const;
  [[nodiscard]] const SessionView& view() const;
  [[nodiscard]] const ViewerState& state() const;
  [[nodiscard]] ViewerState& state();
  [[nodiscard]] const Hud& hud() const;
  /// What to do next, for a person who does this for the first time; empty: they know.
  [[nodiscard]] std::string_view next_step() const;
  /// Whether a demonstration runs that the next press or key ends.
  [[nodiscard]] bool is_demonstrating() const;
  [[nodiscard]] Cursor cursor() const;
  [[nodiscard]] SessionThread& session();
  [[nodiscard]] Camera& camera();
  [[nodiscard]] ToolMachine& tools();

  /// A picture to save now: a screenshot that was asked for, or the next of a sequence where the session went on.
  [[nodiscard]] std::optional<std::filesystem::path> take_screenshot();
  /// Where the report of an attempt goes that was just scored, once for each score; see `exercise_page`.
  [[nodiscard]] std::optional<std::filesystem::path> take_page();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
