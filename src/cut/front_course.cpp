// SPDX-License-Identifier: Apache-2.0
// Ropes that drag behind the points of the front: where a rope's end lies is where the point came from, whatever the
// steps were (docs/internals.md, 3.1).
#include "cut/front_course.h"

#include <algorithm>

#include "cut/blade_constants.h"
#include "cut/twist.h"

namespace incise {
inline namespace v0 {

void FrontCourse::begin(std::span<const Vec3> row, double spacing) {
  length_ = kComeLength * spacing;
  towed_.assign(row.begin(), row.end());
}

void FrontCourse::follow(std::span<const SosPoint> front) {
  for (std::size_t c = 0; c < front.size(); ++c) {
    const Vec3 behind = towed_[c] - front[c].position;
    const double distance = behind.norm();
    if (distance > length_) towed_[c] = front[c].position + (length_ / distance) * behind;
  }
}

void FrontCourse::refine(const std::vector<std::vector<double>>& shares) {
  towed_ = divided(towed_, shares);
}

FrontCourse::Progress FrontCourse::progress(std::span<const SosPoint> front, std::span<const Vec3> row,
                                            std::span<const std::size_t> points) const {
  Progress sum;
  for (const std::size_t c : points) {
    const Vec3& at = front[c].position;
    const Vec3 edge =
        (front[std::min(c + 1, front.size() - 1)].position - front[c > 0 ? c - 1 : 0].position).normalized();
    const auto across = [&](const Vec3& v) -> Vec3 { return v - v.dot(edge) * edge; };
    const Vec3 way = across(row[c] - at), come = across(at - towed_[c]);
    sum.all += way.norm();
    if (come.norm() <= 0.5 * length_) continue;
    sum.on += way.dot(come.normalized());
    sum.is_known = true;
  }
  return sum;
}

}  // namespace v0
}  // namespace incise
