// SPDX-License-Identifier: Apache-2.0
// Halving until a part misses the body, or is as fine as it must be: parts grow with the distance from the body, so
// that a blade of any length costs a logarithm (docs/internals.md, 3.11).
#include "cut/far_blade.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cut/blade_constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// Whether a triangle may meet a box; one that passes close by may count.
bool may_meet(const std::array<Vec3, 3>& p, const Box& box, unsigned depth = 0) {
  const Box own{p[0].cwiseMin(p[1]).cwiseMin(p[2]), p[0].cwiseMax(p[1]).cwiseMax(p[2])};
  if (!own.overlaps(box)) return false;
  if (depth == kMostBoxHalvings || (own.hi - own.lo).maxCoeff() <= 0.25 * (box.hi - box.lo).maxCoeff()) return true;
  unsigned longest = 0;
  for (unsigned k = 1; k < 3; ++k) {
    if ((p[(k + 1) % 3] - p[k]).squaredNorm() > (p[(longest + 1) % 3] - p[longest]).squaredNorm()) longest = k;
  }
  const Vec3 a = p[longest], b = p[(longest + 1) % 3], c = p[(longest + 2) % 3], middle = 0.5 * (a + b);
  return may_meet({a, middle, c}, box, depth + 1) || may_meet({middle, b, c}, box, depth + 1);
}

/// The shares of a segment between which it lies in a box; false where it passes by.
bool clip(const Vec3& from, const Vec3& way, const Box& box, double& first, double& last) {
  first = 0;
  last = 1;
  for (int k = 0; k < 3; ++k) {
    const double lo = box.lo[k] - from[k], hi = box.hi[k] - from[k];
    if (way[k] == 0) {
      if (lo > 0 || hi < 0) return false;
      continue;
    }
    first = std::max(first, std::min(lo / way[k], hi / way[k]));
    last = std::min(last, std::max(lo / way[k], hi / way[k]));
  }
  return first <= last;
}

class StepDivider {
 public:
  StepDivider(std::span<const Vec3> from, std::span<const Vec3> to, double travel, const Box& near)
      : from_(from), to_(to), travel_(travel), near_(near) {
    for (std::size_t c = 0; c < from.size(); ++c) longest_ = std::max(longest_, (to[c] - from[c]).norm());
  }
  void divide(double begin, double end, unsigned depth, std::vector<StepPart>& parts) const {
    if (parts.size() > kMostFarParts) return;
    const bool is_near = meets(begin, end);
    if (is_near && (end - begin) * longest_ > travel_ && depth < kMostDivisions) {
      const double middle = 0.5 * (begin + end);
      divide(begin, middle, depth + 1, parts);
      divide(middle, end, depth + 1, parts);
    } else if (!is_near && !parts.empty() && !parts.back().is_near) {
      parts.back().end = end;
    } else {
      parts.push_back({end, is_near});
    }
  }

 private:
  [[nodiscard]] Vec3 at(std::size_t c, double share) const { return from_[c] + share * (to_[c] - from_[c]); }
  [[nodiscard]] bool meets(double begin, double end) const {
    for (std::size_t c = 0; c + 1 < from_.size(); ++c) {
      const Vec3 a = at(c, begin), b = at(c + 1, begin), d = at(c, end), e = at(c + 1, end);
      // What a segment sweeps is curved where its ends part: both ways to lay two triangles hold it between them.
      if (may_meet({a, b, e}, near_) || may_meet({a, e, d}, near_) || may_meet({a, b, d}, near_) ||
          may_meet({b, e, d}, near_)) {
        return true;
      }
    }
    return false;
  }

  std::span<const Vec3> from_, to_;
  double travel_, longest_ = 0;
  const Box& near_;
};

}  // namespace

Box enlarged(const Box& box, double share) {
  const double margin = share * (box.hi - box.lo).norm();
  Box larger = box;
  larger.lo.array() -= margin;
  larger.hi.array() += margin;
  return larger;
}

std::vector<double> graded_shares(const Vec3& from, const Vec3& to, double spacing, const Box& near) {
  const Vec3 way = to - from;
  const double length = way.norm(), part = spacing / length;
  double first = 0, last = 0;
  if (!(length > spacing) || !clip(from, way, near, first, last)) return {1.0};
  std::vector<double> before, shares;
  const auto step = [&](double beyond) { return std::max(part, kFarGrowth * beyond); };
  for (double at = first; at > 0; at -= step(first - at)) before.push_back(at);
  shares.assign(before.rbegin(), before.rend());
  const double count = std::ceil((last - first) / part);
  for (double k = 1; k <= count; ++k) shares.push_back(first + k / count * (last - first));
  for (double at = last + part; at < 1; at += step(at - last)) shares.push_back(at);
  std::erase_if(shares, [&](double share) { return !(share < 1.0 - 0.5 * part); });
  shares.push_back(1.0);
  return shares;
}

std::vector<StepPart> divide_step(std::span<const Vec3> from, std::span<const Vec3> to, double travel,
                                  const Box& near) {
  std::vector<StepPart> parts;
  for (double greatest = travel;; greatest *= 2.0) {
    StepDivider(from, to, greatest, near).divide(0, 1, 0, parts);
    if (parts.size() <= kMostFarParts) return parts;
    parts.clear();
  }
}

}  // namespace v0
}  // namespace incise
