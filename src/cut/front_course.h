// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/strip.h"

namespace incise {
inline namespace v0 {

/// The way that a blade's front has come: where a place stands that each of its points draws along on a rope.
///
/// A rope is half a spacing long, so that the way is that of the last half spacing, however short the steps.
class FrontCourse {
 public:
  /// A front that has not moved yet.
  void begin(std::span<const Vec3> row, double spacing);
  /// The front has moved to a row.
  void follow(std::span<const SosPoint> front);
  /// The segments of the front are divided at shares of their lengths.
  void refine(const std::vector<std::vector<double>>& shares);

  /// How far some points of a blade would get on from the front, all together. What a point slides along the blade's
  /// own edge does not count.
  struct Progress {
    double on = 0;          ///< along the way that the front has come
    double all = 0;         ///< in any direction
    bool is_known = false;  ///< whether the front has come far enough to tell a way
  };
  [[nodiscard]] Progress progress(std::span<const SosPoint> front, std::span<const Vec3> row,
                                  std::span<const std::size_t> points) const;

 private:
  double length_ = 0.5;
  std::vector<Vec3> towed_;  // by point
};

}  // namespace v0
}  // namespace incise
