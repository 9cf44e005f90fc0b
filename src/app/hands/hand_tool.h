// SPDX-License-Identifier: Apache-2.0
// What a tool in a person's hand is to the machine of tools: pointer events go in, what the hands do comes out.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/tool_table.h"
#include "app/view/camera.h"
#include "app/view/picking.h"
#include "app/view/picture.h"
#include "app/view/surface_view.h"
#include "incise/cut/stroke.h"
#include "incise/engine/simulation.h"

namespace incise {
inline namespace v0 {
namespace app {

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
  double depth = 0;            ///< of a blade's tip below the surface, whatever its angle; above 0
  double angle = 0;            ///< of the scalpel to the left of upright, seen along the cut; rad, within ±1.2
  double grasp_radius = 0;     ///< above 0
  double grasp_stiffness = 0;  ///< N/m per vertex, above 0
  double pin_radius = 0;       ///< above 0
  double pin_stiffness = 0;    ///< N/m per vertex, above 0
  double punch_radius = 0.1;   ///< above 0
  double metres = 1;           ///< per length unit, above 0
};

/// Of the instruments; see `Instrument`.
[[nodiscard]] inline double millimetre_of(const ToolSettings& settings) {
  return instrument_millimetre(settings.metres, settings.depth);
}

/// What a tool sees when an event comes.
struct ToolContext {
  Viewport viewport;
  const SurfaceFrame* surface = nullptr;  ///< as it is drawn; may be null or without topology: nothing is hit
  Box body;                               ///< around it, to keep zooming within bounds and planes large enough
};

/// What the hands want of the simulation until they want something else.
struct HandState {
  std::optional<BladePose> blade;           ///< while a tool cuts
  ToolKind cuts_with = ToolKind::kScalpel;  ///< the tool whose the blade is
  std::vector<Hook> hooks;                  ///< what is grasped, and every pin
};

/// Where the pointer is at one moment of a drag.
struct PointerPlace {
  Vec2 pixel = Vec2::Zero();
  Ray ray;
  std::optional<SurfaceHit> hit;
  bool is_wall = false;  ///< the hit is on the wall of a cut, or inside the body
  double pressure = 1;   ///< of a pen, in [0, 1]
};
/// Cost: one `pick`.
[[nodiscard]] PointerPlace place_of(const PointerEvent& event, const ToolContext& context, const Camera& camera);

/// A suture or a staple that a hand sets.
struct Stitch {
  std::array<Vec3, 2> rest_places;  ///< of the rest shape, length unit
  Suture suture;
};

/// What comes of a drag.
struct DragResults {
  std::optional<Stroke> stroke;  ///< that the blade shall make by itself: a plane cut, a punch
  std::optional<Stitch> stitch;
  std::optional<SurfaceHit> probed;  ///< what is asked about
  std::string refusal;               ///< why nothing came of it, a sentence for the person; empty: something did
};

/// One moment of a drag.
struct DragMoment {
  const PointerEvent& event;
  const ToolContext& context;
  const Camera& camera;
  const ToolSettings& settings;
  Vec2 pressed;              ///< where it began, pixels of the viewport
  std::uint32_t& next_hook;  ///< for a new hook, which takes it: numbers are never used again
  DragResults& results;

  [[nodiscard]] PointerPlace place() const { return place_of(event, context, camera); }
  /// The same on another surface than the one that is drawn.
  [[nodiscard]] PointerPlace place_on(const SurfaceFrame& surface) const {
    return place_of(event, {context.viewport, &surface, context.body}, camera);
  }
};

/// A tool. One drag at a time: `press`, then any number of `move` and `push`, then `release` or nothing, then `stop`.
class HandTool {
 public:
  virtual ~HandTool() = default;

  virtual void press(const DragMoment& /*moment*/) {}
  virtual void move(const DragMoment& /*moment*/) {}
  /// The wheel turns meanwhile. Returns whether the tool took it.
  virtual bool push(double /*notches*/, const Camera& /*camera*/) { return false; }
  /// The drag has done what it was for. `is_click`: it went nowhere.
  virtual void release(bool /*is_click*/, const ToolSettings& /*settings*/, std::uint32_t& /*next_hook*/,
                       DragResults& /*results*/) {}
  /// Nothing is under way any more; what holds tissue beyond its drag stays.
  virtual void stop() {}
  /// Adds what it does to the tissue, under way or for good.
  virtual void add_to(HandState& /*hands*/) const {}
  /// Adds its marks.
  virtual void draw(const Camera& /*camera*/, Marks& /*marks*/) const {}
  /// Adds what it would do where the pointer is, while it is chosen and nothing is under way.
  virtual void draw_hover(const SurfaceHit& /*hit*/, const ToolSettings& /*settings*/, const Camera& /*camera*/,
                          Marks& /*marks*/) const {}
};

}  // namespace app
}  // namespace v0
}  // namespace incise
