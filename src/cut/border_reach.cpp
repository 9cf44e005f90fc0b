// SPDX-License-Identifier: Apache-2.0
// Where a sheet ends at an older cut it goes on into that cut, so that nothing stays joined between the two.
#include "cut/border_reach.h"

#include <algorithm>
#include <cmath>

namespace incise::inline v0 {

namespace {

/// A border is asked about at places so many spacings apart, but at so many at most.
constexpr double kSampleShare = 0.2, kMostSamples = 4096.0;

Vec3 between(const Vec3& a, const Vec3& b, std::size_t part, std::size_t parts) {
  return a + (static_cast<double>(part) / static_cast<double>(parts)) * (b - a);
}

Vec3 outwards_at(const BorderPlace& from, const BorderPlace& to, std::size_t part, std::size_t parts) {
  return between(from.outwards, to.outwards, part, parts).normalized();
}

}  // namespace

void add_reaching_triangle(SweptSurface& surface, const SosPoint& a, const SosPoint& b, const SosPoint& c,
                           std::uint32_t column) {
  if (a.key == b.key || b.key == c.key || c.key == a.key) return;
  SweptSurface one;
  one.points = {a, b, c};
  one.triangles.push_back({{0, 1, 2}, 0, column, true});
  append(surface, one);
}

/// At which of the places along a border it reaches on: those at an older cut, and the first outside the body beside
/// them.
std::vector<bool> BorderReach::find_open(const BorderPlace& from, const BorderPlace& to, std::size_t parts) {
  const Vec3 &a = from.at.position, &b = to.at.position;
  std::vector<bool> is_in_cut(parts + 1);
  reach_ = 0;
  for (std::size_t i = 0; i <= parts; ++i) {
    const Vec3 outwards = outwards_at(from, to, i, parts);
    const double reach = around_.reach(between(a, b, i, parts), outwards, (b - a).cross(outwards));
    is_in_cut[i] = reach > 0;
    reach_ = std::max(reach_, reach);
  }
  if (!(reach_ > 0)) return is_in_cut;
  std::vector<bool> is_open = is_in_cut;
  for (std::size_t i = 0; i <= parts; ++i) {
    const bool is_beside = (i > 0 && is_in_cut[i - 1]) || (i < parts && is_in_cut[i + 1]);
    if (!is_in_cut[i] && is_beside) is_open[i] = around_.is_outside(between(a, b, i, parts));
  }
  return is_open;
}

SweptSurface BorderReach::from_row(const BorderPlace& from, const BorderPlace& to, std::uint32_t column) {
  SweptSurface surface;
  const Vec3 &a = from.at.position, &b = to.at.position;
  const auto parts =
      static_cast<std::size_t>(std::clamp(std::ceil((b - a).norm() / (kSampleShare * spacing_)), 1.0, kMostSamples));
  const std::vector<bool> is_open = find_open(from, to, parts);
  const auto on_border = [&](std::size_t i) -> SosPoint {
    return i == 0 ? from.at : (i == parts ? to.at : SosPoint{between(a, b, i, parts), next_key_++});
  };
  const auto beyond = [&](std::size_t i) -> SosPoint {
    return {between(a, b, i, parts) + reach_ * outwards_at(from, to, i, parts), next_key_++};
  };
  std::vector<SosPoint> rim = {from.at};
  for (std::size_t i = 0; reach_ > 0 && i <= parts; ++i) {
    if (!is_open[i]) continue;
    std::size_t last = i;
    while (last < parts && is_open[last + 1]) ++last;
    if (last > i) {
      const SosPoint p = on_border(i), q = on_border(last), r = beyond(last), s = beyond(i);
      add_reaching_triangle(surface, p, q, r, column);
      add_reaching_triangle(surface, p, r, s, column);
      rim.insert(rim.end(), {p, q});
    }
    i = last;
  }
  if (surface.triangles.empty()) return surface;
  rim.push_back(to.at);
  for (std::size_t k = 1; k + 1 < rim.size(); ++k) {
    add_reaching_triangle(surface, from.at, rim[k], rim[k + 1], column);
  }
  return surface;
}

}  // namespace incise::inline v0
