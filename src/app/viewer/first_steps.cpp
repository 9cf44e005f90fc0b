// SPDX-License-Identifier: Apache-2.0
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

void FirstSteps::see(std::uint64_t strokes, bool holds, bool is_demonstrating) {
  // A demonstration that is taken over ends its stroke first: what it has cut is not the person's.
  if (is_demonstrating || step_ == Step::kDone || step_ == Step::kWatch) return;
  if (!is_counted_) {
    strokes_ = strokes;
    is_counted_ = true;
  }
  if (step_ == Step::kCut && strokes > strokes_) step_ = Step::kOpen;
  if (step_ == Step::kOpen && holds) {
    step_ = Step::kUndo;
    strokes_ = strokes;
  }
  if (step_ == Step::kUndo && strokes < strokes_) step_ = Step::kDone;
}

std::string_view FirstSteps::text() const {
  constexpr std::array<std::string_view, 5> kTexts = {
      "Press on the skin and drag: you hold the scalpel",
      "Press on the skin and drag: you hold the scalpel",
      "Now open it: hold Shift, take a lip and drag it aside. A hook (7) stays where you let go",
      "Ctrl+Z, or the arrow below, takes the cut back",
      "",
  };
  return kTexts[static_cast<std::size_t>(step_)];
}

}  // namespace app
}  // namespace v0
}  // namespace incise
