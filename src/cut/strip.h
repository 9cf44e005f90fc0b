// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "cut/sweep.h"

namespace incise {
inline namespace v0 {

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
  double travel = 0;          ///< of the blade, from the sheet's beginning up to its end; set by `OwnSheet::add`
};

/// The place of a sheet nearest to a point.
struct SheetPlace {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit
  double distance2 = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_valid() const { return distance2 < std::numeric_limits<double>::infinity(); }
};

/// The strips that a stroke has swept, oldest first: its own sheet. Searches skip them by the box of several.
class OwnSheet {
 public:
  void clear();
  const Strip& add(std::unique_ptr<Strip> strip);
  /// The border of all strips together: where the cut ends.
  [[nodiscard]] const std::vector<Strip::Segment>& border() const { return border_; }
  [[nodiscard]] const std::deque<std::shared_ptr<const Strip>>& strips() const { return strips_; }
  /// The nearest place within `max_distance`; the latest strip wins ties. Cost: one box for 16 strips, then those near.
  /// `travelled`: strips that the blade laid later than that far from the sheet's beginning do not count.
  [[nodiscard]] SheetPlace closest(const Vec3& point, double max_distance,
                                   double travelled = std::numeric_limits<double>::infinity()) const;
  /// How far the blade has travelled.
  [[nodiscard]] double travel() const { return strips_.empty() ? 0.0 : strips_.back()->travel; }
  /// Whether some strip has a property, of those whose boxes are near a box: the latest first. Cost: as `closest`.
  template <class Has>
  [[nodiscard]] bool any_near(const Box& box, Has&& has) const {
    for (std::size_t i = strips_.size(); i-- > 0;) {
      if (!groups_[i / kGroup].overlaps(box)) {
        i -= i % kGroup;
      } else if (strips_[i]->sheet.bounds().overlaps(box) && has(*strips_[i])) {
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t kGroup = 16;

  std::deque<std::shared_ptr<const Strip>> strips_;  // shared with copies
  std::vector<Box> groups_;                          // of as many strips each
  std::vector<Strip::Segment> border_;
};

}  // namespace v0
}  // namespace incise
