// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "app/scene/tool_table.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What the window tells a person who meets it for the first time: one line at a time, each gone once it was done.
class FirstSteps {
 public:
  /// A body was opened. Without a demonstration nothing is told: the person has chosen it.
  void begin(bool is_demonstrated);
  /// The first input: the demonstration is over.
  void take_over();
  /// How a hand holds tissue.
  enum class Hold : std::uint8_t {
    kNone,
    kDrag,   ///< while the button is down
    kStays,  ///< by hooks and retractors that were let go
  };
  /// What there is now: strokes in the body, and how a hand holds tissue.
  void see(std::uint64_t strokes, Hold hold, bool is_demonstrating);

  /// Of another tool than the one that the step is done with: what a drag or a click does with the tool in hand.
  [[nodiscard]] std::string_view text(ToolKind in_hand) const;

 private:
  enum class Step : std::uint8_t { kWatch, kCut, kOpen, kOpenAgain, kUndo, kLetGo, kDone };

  [[nodiscard]] bool speaks_of(ToolKind tool) const;

  Step step_ = Step::kDone;
  std::uint64_t strokes_ = 0;  // at the beginning of the step
  bool is_counted_ = false;
  bool was_dragged_ = false;  // tissue, in this step
};

}  // namespace app
}  // namespace v0
}  // namespace incise
