// SPDX-License-Identifier: Apache-2.0
// The tools of a person who cuts, as a state machine: pointer events go in, what the hands do comes out. It knows no
// window and no clock.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/hands/hand_tool.h"
#include "app/scene/tool_table.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Settings that suit a body: a depth of an eighth of its shortest side, a grasp of a tenth of its longest, and springs
/// as stiff as its tissue. `young` in Pa; `length_unit` in m.
[[nodiscard]] ToolSettings settings_for(const Box& body, double young, double length_unit);

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

  [[nodiscard]] bool is_busy() const;       ///< a drag is under way
  [[nodiscard]] bool is_on_tissue() const;  ///< the pointer is, and nothing is under way
  [[nodiscard]] const HandState& hands() const;
  /// Whether something pulls at tissue, see `ToolRow::pulls`; pins hold it where it is.
  [[nodiscard]] bool is_pulling() const;
  /// A stroke that a tool wants made by itself: a plane cut that was let go (one second from outside the body to
  /// outside), or a punch.
  [[nodiscard]] std::optional<Stroke> take_stroke();
  /// A suture or a staple that was set.
  [[nodiscard]] std::optional<Stitch> take_stitch();
  /// What a click of the probe was on.
  [[nodiscard]] std::optional<SurfaceHit> take_probe();
  /// Why the last press or release did nothing; empty where it did.
  [[nodiscard]] std::string take_refusal();

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
