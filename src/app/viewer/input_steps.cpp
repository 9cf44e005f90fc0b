// SPDX-License-Identifier: Apache-2.0
// Ways of the pointer may be taken together; whatever else happens ends a step.
#include "app/viewer/input_steps.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

bool is_way(const InputEvent& event) {
  const auto* pointer = std::get_if<PointerEvent>(&event);
  return pointer != nullptr && pointer->kind == PointerEvent::Kind::kMove;
}

}  // namespace

std::size_t step_length(std::span<const InputEvent> events) {
  const auto last = std::find_if_not(events.begin(), events.end(), is_way);
  return static_cast<std::size_t>(last - events.begin()) + (last == events.end() ? 0 : 1);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
