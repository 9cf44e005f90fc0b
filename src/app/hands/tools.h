// SPDX-License-Identifier: Apache-2.0
// The tools of a person who cuts, as a state machine: pointer events go in, what the hands do comes out. It knows no
// window and no clock.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "app/view/camera.h"
#include "app/view/picking.h"
#include "app/view/picture.h"
#include "app/view/surface_view.h"
#include "incise/cut/stroke.h"
#include "incise/engine/simulation.h"

namespace incise {
inline namespace v0 {
namespace app {

enum class ToolKind : std::uint8_t {
  kOrbit,     ///< a drag turns the view
  kScalpel,   ///< a drag draws a cut of some depth along the surface
  kPlaneCut,  ///< a drag is a line across the picture: the plane through it and the eye cuts the whole body
  kGrasp,     ///< a drag pulls at the tissue
  kPin,       ///< a click holds tissue where it is, or lets it go
  kProbe,     ///< a click asks what is there
  kCount
};
/// For people: "Orbit", "Scalpel", …
[[nodiscard]] const char* name_of(ToolKind tool);

/// What a mouse or a pen does.
struct PointerEvent {
  enum class Kind : std::uint8_t { kMove, kPress, kRelease, kWheel };
  enum class Button : std::uint8_t { kLeft, kRight, kMiddle };
  Kind kind = Kind::kMove;
  Vec2 pixel = Vec2::Zero();      ///< of the viewport
  Button button = Button::kLeft;  ///< of press and release
  bool shift = false, control = false, alt = false;
  double wheel = 0;     ///< notches of kWheel, positive away from the person
  double pressure = 1;  ///< of a pen, in [0, 1]: how much of the depth a scalpel goes in
};

/// What tools are set to. Lengths in the mesh's unit.
struct ToolSettings {
  double depth = 0;            ///< of the scalpel's tip below the surface, whatever its angle; above 0
  double angle = 0;            ///< of the scalpel to the left of upright, seen along the cut; rad, within ±1.2
  double grasp_radius = 0;     ///< above 0
  double grasp_stiffness = 0;  ///< N/m per vertex, above 0
  double pin_radius = 0;       ///< above 0
  double pin_stiffness = 0;    ///< N/m per vertex, above 0
};

/// Settings that suit a body: a depth of an eighth of its shortest side, a grasp of a tenth of its longest, and springs
/// as stiff as its tissue. `young` in Pa; `length_unit` in m.
[[nodiscard]] ToolSettings settings_for(const Box& body, double young, double length_unit);

/// What a tool sees when an event comes.
struct ToolContext {
  Viewport viewport;
  const SurfaceFrame* surface = nullptr;  ///< as it is drawn; may be null or without topology: nothing is hit
  Box body;                               ///< around it, to keep zooming within bounds and planes large enough
};

/// What the hands want of the simulation until they want something else.
struct HandState {
  std::optional<BladePose> blade;  ///< of the scalpel while it cuts
  std::vector<Hook> hooks;         ///< what is grasped, and every pin
};

/// The tools. Left drags go to the chosen tool; right or middle drags, and left ones with Alt, turn the view, with
/// Shift beside move it; left drags with Shift grasp whatever the tool; the wheel zooms, with Control it changes the
/// scalpel's depth, with Shift its angle; while something is grasped it pulls it nearer or pushes it away. One drag at
/// a time: what other buttons do meanwhile is ignored, and so are events out of order or with numbers that are not
/// finite.
///
/// The scalpel's edge has the same number of points always. Where it is pressed on the body it stands just above, and
/// goes in with the first move. A drag that begins beside the body cuts in from its rim: the blade is first seen off
/// the rim, at the event that comes onto the body. Whoever feeds a simulation has to take `hands` after each event, and
/// let no two strokes become one. Cost of an event: one `pick`. Not thread-safe.
class ToolMachine {
 public:
  /// The scalpel is chosen. Settings out of range are brought into it.
  explicit ToolMachine(const ToolSettings& settings);
  ToolMachine(ToolMachine&&) noexcept;
  ToolMachine& operator=(ToolMachine&&) noexcept;
  ~ToolMachine();

  [[nodiscard]] ToolKind tool() const;
  /// Chooses a tool. What is under way ends as if it were released.
  void choose(ToolKind tool);
  [[nodiscard]] const ToolSettings& settings() const;
  /// Takes settings, each brought into its range; what is not finite, or not above 0 where it has to be, stays as it
  /// was.
  void set(const ToolSettings& settings);

  /// Does what an event asks, to the camera as well.
  void handle(const PointerEvent& event, const ToolContext& context, Camera& camera);
  /// Gives up what is under way: a stroke ends where it is, a preview goes, what is grasped is let go.
  /// Returns whether there was anything.
  bool cancel();
  /// Lets go of everything, pins included: the body is another one.
  void reset(const ToolSettings& settings);

  [[nodiscard]] bool is_busy() const;  ///< a drag is under way
  [[nodiscard]] const HandState& hands() const;
  /// A plane cut that was let go, as a stroke of one second that starts outside the body and ends outside it.
  [[nodiscard]] std::optional<Stroke> take_plane_cut();
  /// What a click of the probe was on.
  [[nodiscard]] std::optional<SurfaceHit> take_probe();

  /// Adds the marks of what is under way and of what is held: blade, preview, hooks, pins, and where the pointer is on
  /// the surface.
  void draw(const ToolContext& context, const Camera& camera, Marks& marks) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
