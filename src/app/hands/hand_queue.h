// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "app/hands/tools.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Brings what hands do at the pace of a pointer to frames at the pace of a simulation.
///
/// No gesture is lost, however slow the simulation is. The frames see where each stroke began, every turn of its way,
/// where it ended, and that it ended; two strokes are never joined. Of the way between, places that lie on a straight
/// line with those that stay (each point of the edge within a twentieth of the edge's length) are left out. So a
/// simulation that is slower than the hand lags behind it by a few frames per stroke where the stroke is straight, and
/// follows all of it where it is curved.
class HandQueue {
 public:
  /// The hands are now like this. Cost: O(its size), and where a stroke goes straight on O(places left out).
  void push(const HandState& hands);
  /// What the next frame gets: where nothing new was pushed, the same again.
  [[nodiscard]] HandState pop();
  /// The same for a frame in which something else has the blade: the hand's waits.
  [[nodiscard]] HandState pop_hooks() const { return {std::nullopt, cuts_with_, hooks_}; }
  /// Hands off.
  void clear();
  /// Whether every place of the blade has been popped.
  [[nodiscard]] bool is_empty() const { return blades_.empty(); }
  /// A moment to wait for: what was pushed up to now has been popped once `has_passed` says so.
  [[nodiscard]] std::uint64_t now() const { return popped_ + blades_.size(); }
  [[nodiscard]] bool has_passed(std::uint64_t moment) const { return popped_ >= moment; }

 private:
  [[nodiscard]] bool is_turn(const BladePose& next) const;

  std::deque<std::optional<BladePose>> blades_;  // to come
  std::optional<BladePose> blade_;               // of the last frame
  ToolKind cuts_with_ = ToolKind::kScalpel;      // the tool of the latest
  std::vector<BladePose> passed_;                // left out between the last place but one and the last one
  std::vector<Hook> hooks_;
  std::uint64_t popped_ = 0;  // places of the blade, those that were cleared included
};

}  // namespace app
}  // namespace v0
}  // namespace incise
