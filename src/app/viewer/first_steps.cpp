// SPDX-License-Identifier: Apache-2.0
// A state machine whose steps are left by what is seen in the body, not by which keys were pressed.
#include "app/viewer/first_steps.h"

#include <array>

namespace incise {
inline namespace v0 {
namespace app {

void FirstSteps::begin(bool is_demonstrated) {
  *this = {};
  step_ = is_demonstrated ? Step::kWatch : Step::kDone;
}

void FirstSteps::take_over() {
  if (step_ == Step::kWatch) step_ = Step::kCut;
  is_counted_ = false;
}

void FirstSteps::see(std::uint64_t strokes, Hold hold, bool is_demonstrating) {
  // A demonstration that is taken over ends its stroke first: what it has cut is not the person's.
  if (is_demonstrating || step_ == Step::kDone || step_ == Step::kWatch) return;
  if (!is_counted_) {
    strokes_ = strokes;
    is_counted_ = true;
  }
  if (step_ == Step::kCut && strokes > strokes_) step_ = Step::kOpen;
  if (step_ == Step::kOpen || step_ == Step::kOpenAgain) {
    if (step_ == Step::kOpen && was_dragged_ && hold == Hold::kNone) step_ = Step::kOpenAgain;
    was_dragged_ = hold == Hold::kDrag;
    strokes_ = strokes;
    if (hold == Hold::kStays) step_ = Step::kUndo;
  }
  if (step_ == Step::kUndo && strokes < strokes_) step_ = Step::kLetGo;
  if (step_ == Step::kLetGo && hold == Hold::kNone) step_ = Step::kDone;
}

/// Whoever cut holds the scalpel still when the hook is told of.
bool FirstSteps::speaks_of(ToolKind tool) const {
  switch (step_) {
    case Step::kCut:
      return tool == ToolKind::kScalpel;
    case Step::kOpen:
    case Step::kOpenAgain:
      return tool == ToolKind::kScalpel || row_of(tool).pulls;
    default:
      return true;
  }
}

std::string_view FirstSteps::text(ToolKind in_hand) const {
  if (!speaks_of(in_hand)) return row_of(in_hand).text;
  constexpr std::array<std::string_view, 7> kTexts = {
      "Press on the skin and drag: you hold the scalpel",
      "Press on the skin and drag: you hold the scalpel",
      "Now open it: take the hook (7), press on a lip and drag it aside",
      "It closes when you let go. The hook (7) stays: press on a lip and drag it aside",
      "It stays open. Ctrl+Z, or the arrow below, takes the cut back",
      "A click on a hook lets it go",
      "",
  };
  return kTexts[static_cast<std::size_t>(step_)];
}

}  // namespace app
}  // namespace v0
}  // namespace incise
