// SPDX-License-Identifier: Apache-2.0
// The latest of a few remembered ends at which all points of a blade stand (docs/internals.md, 3.12).
#include "paper/ended_strokes.h"

#include <algorithm>
#include <utility>

#include "paper/constants.h"

namespace incise {
inline namespace v0 {

void EndedStrokes::add(EndedStroke stroke) {
  ended_.push_back(std::move(stroke));
  if (ended_.size() <= kEndsKept) return;
  const auto is_open = [](const EndedStroke& ended) { return !ended.row.empty() && !ended.is_gone_on_from; };
  const auto dispensable = std::find_if_not(ended_.begin(), ended_.end() - 1, is_open);
  ended_.erase(dispensable == ended_.end() - 1 ? ended_.begin() : dispensable);
}

void EndedStrokes::go_on_from(const EndedStroke& stroke) {
  const auto at = std::find_if(ended_.begin(), ended_.end(), [&](const EndedStroke& e) { return &e == &stroke; });
  if (at != ended_.end()) at->is_gone_on_from = true;
}

const EndedStroke* EndedStrokes::find(std::span<const Vec3> given, double within) const {
  const auto stands_at = [&](const EndedStroke& ended) {
    if (ended.is_gone_on_from || given.size() != ended.edge.points()) return false;
    const std::vector<Vec3> row = ended.edge.divided(given);
    return std::equal(row.begin(), row.end(), ended.row.begin(), ended.row.end(),
                      [&](const Vec3& a, const Vec3& b) { return (a - b).norm() <= within; });
  };
  const auto at = std::find_if(ended_.rbegin(), ended_.rend(), stands_at);
  return at == ended_.rend() ? nullptr : &*at;
}

const EndedStroke* EndedStrokes::find_at(std::span<const std::shared_ptr<const Strip>> strips) const {
  const auto at = std::find_if(ended_.begin(), ended_.end(), [&](const EndedStroke& ended) {
    return !strips.empty() && !ended.strips.empty() && ended.strips.back() == strips.back();
  });
  return at == ended_.end() ? nullptr : &*at;
}

}  // namespace v0
}  // namespace incise
