// SPDX-License-Identifier: Apache-2.0
// Thins out a way while it waits: the newest place is replaced as long as the straight way to its successor passes all
// places left out before it.
#include "app/hands/hand_queue.h"

#include <algorithm>
#include <utility>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kStraight = 0.05;         // of the edge's length: this near a straight way a place may be left out
constexpr std::size_t kMostLeftOut = 256;  // at once; bounds the cost of a push

double distance_to_segment(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double length2 = way.squaredNorm();
  const double share = length2 > 0 ? std::clamp((point - from).dot(way) / length2, 0.0, 1.0) : 0;
  return (from + share * way - point).norm();
}

/// Whether a blade that goes from one place straight to another passes through a third one.
bool passes(const BladePose& from, const BladePose& to, const BladePose& place) {
  const std::size_t points = place.edge.size();
  if (from.edge.size() != points || to.edge.size() != points) return false;
  double length = 0;
  for (std::size_t i = 1; i < points; ++i) length += (place.edge[i] - place.edge[i - 1]).norm();
  for (std::size_t i = 0; i < points; ++i) {
    if (!(distance_to_segment(place.edge[i], from.edge[i], to.edge[i]) <= kStraight * length)) return false;
  }
  return true;
}

}  // namespace

void HandQueue::push(const HandState& hands) {
  hooks_ = hands.hooks;
  cuts_with_ = hands.cuts_with;
  const bool was_down = blades_.empty() ? blade_.has_value() : blades_.back().has_value();
  if (!hands.blade) {
    if (was_down) blades_.emplace_back(std::nullopt);
    passed_.clear();
    return;
  }
  if (!was_down || blades_.empty() || is_turn(*hands.blade)) {
    passed_.clear();
    blades_.emplace_back(hands.blade);
  } else {
    passed_.push_back(*std::exchange(blades_.back(), hands.blade));
  }
}

/// Whether the newest place has to stay where another one comes after it: a stroke begins there, or turns.
bool HandQueue::is_turn(const BladePose& next) const {
  const std::optional<BladePose>& before = blades_.size() >= 2 ? blades_[blades_.size() - 2] : blade_;
  if (!before || passed_.size() >= kMostLeftOut) return true;
  return !passes(*before, next, *blades_.back()) ||
         !std::all_of(passed_.begin(), passed_.end(),
                      [&](const BladePose& place) { return passes(*before, next, place); });
}

HandState HandQueue::pop() {
  if (!blades_.empty()) {
    blade_ = std::move(blades_.front());
    blades_.pop_front();
    ++popped_;
    if (blades_.empty()) passed_.clear();
  }
  return {blade_, cuts_with_, hooks_};
}

void HandQueue::clear() {
  const std::uint64_t past = now();
  *this = {};
  popped_ = past;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
