// SPDX-License-Identifier: Apache-2.0
#include "app/hands/hand_queue.h"

#include <utility>

namespace incise {
inline namespace v0 {
namespace app {

void HandQueue::push(const HandState& hands) {
  hooks_ = hands.hooks;
  const bool was_down = blades_.empty() ? blade_.has_value() : blades_.back().has_value();
  if (!hands.blade) {
    if (was_down) blades_.emplace_back(std::nullopt);
    return;
  }
  // The first place of a stroke stays; any later one that no frame has seen gives way to a newer one.
  const std::size_t waiting = blades_.size();
  const bool has_before = waiting >= 2 ? blades_[waiting - 2].has_value() : blade_.has_value();
  const bool stays = !was_down || waiting == 0 || !has_before;
  if (stays) {
    blades_.emplace_back(hands.blade);
  } else {
    blades_.back() = hands.blade;
  }
}

HandState HandQueue::pop() {
  if (!blades_.empty()) {
    blade_ = std::move(blades_.front());
    blades_.pop_front();
  }
  return {blade_, hooks_};
}

void HandQueue::clear() {
  *this = {};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
