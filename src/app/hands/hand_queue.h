// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "app/hands/tools.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Brings what hands do at the pace of a pointer to frames at the pace of a simulation.
///
/// A stroke that begins and ends between two frames is not lost: the frames after see where it began, where it ended,
/// and that it ended. Two strokes are never joined. Of what lies between, only the newest place counts, so that a
/// simulation that is slower than the hand does not lag behind it by more than a few frames per stroke.
class HandQueue {
 public:
  /// The hands are now like this. Cost: O(its size).
  void push(const HandState& hands);
  /// What the next frame gets: where nothing new was pushed, the same again.
  [[nodiscard]] HandState pop();
  /// Hands off.
  void clear();

 private:
  std::deque<std::optional<BladePose>> blades_;  // to come
  std::optional<BladePose> blade_;               // of the last frame
  std::vector<Hook> hooks_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
