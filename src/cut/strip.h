// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "cut/sweep.h"

namespace incise::inline v0 {

/// What a blade swept in one step, in the rest shape: a small sheet with its free border.
struct Strip {
  using Segment = std::array<SosPoint, 2>;

  /// `surface` in time order. `inner` are border segments that an earlier strip shares: they are no border of the
  /// whole.
  Strip(SweptSurface surface, const std::vector<std::array<std::uint64_t, 2>>& inner);
  Strip(const Strip&) = delete;
  Strip& operator=(const Strip&) = delete;

  SweptSurface surface;
  Sheet sheet;
  std::vector<Segment> border;  ///< where the cut ends, as far as this strip tells
  std::vector<std::array<std::uint64_t, 2>> inner;
  std::vector<SosPoint> row;  ///< where the blade's front lies after it; empty for a sheet cut at once
};

/// The place of a sheet nearest to a point.
struct SheetPlace {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit
  double distance2 = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_valid() const { return distance2 < std::numeric_limits<double>::infinity(); }
};

/// The strips that a stroke has swept, oldest first: its own sheet. Those far behind may be dropped.
class OwnSheet {
 public:
  void clear();
  const Strip& add(std::unique_ptr<Strip> strip);
  /// The border of all strips together: where the cut ends.
  [[nodiscard]] const std::vector<Strip::Segment>& border() const { return border_; }
  [[nodiscard]] const std::deque<std::unique_ptr<Strip>>& strips() const { return strips_; }
  [[nodiscard]] std::deque<std::unique_ptr<Strip>>& strips() { return strips_; }
  /// The nearest place within `max_distance`; the latest strip wins ties. Cost: O(strips) boxes, then their trees.
  [[nodiscard]] SheetPlace closest(const Vec3& point, double max_distance) const;

 private:
  std::deque<std::unique_ptr<Strip>> strips_;
  std::vector<Strip::Segment> border_;
};

}  // namespace incise::inline v0
