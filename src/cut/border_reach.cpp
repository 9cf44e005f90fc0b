// SPDX-License-Identifier: Apache-2.0
// Where a sheet ends at an older cut it goes on into that cut, so that nothing stays joined between the two.
#include "cut/border_reach.h"

#include <algorithm>
#include <cmath>

#include "cut/blade_constants.h"

namespace incise {
inline namespace v0 {

namespace {

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

/// How far the places along a border reach on: those at an older cut, and as far as they the first outside the body
/// beside them.
std::vector<double> BorderReach::find_reach(const BorderPlace& from, const BorderPlace& to, std::size_t parts) const {
  const Vec3 &a = from.at.position, &b = to.at.position;
  std::vector<double> in_cut(parts + 1);
  for (std::size_t i = 0; i <= parts; ++i) {
    const Vec3 outwards = outwards_at(from, to, i, parts);
    in_cut[i] = around_.reach(between(a, b, i, parts), outwards, (b - a).cross(outwards));
  }
  std::vector<double> reach = in_cut;
  for (std::size_t i = 0; i <= parts; ++i) {
    const double beside = std::max(i > 0 ? in_cut[i - 1] : 0.0, i < parts ? in_cut[i + 1] : 0.0);
    if (in_cut[i] == 0 && beside > 0 && around_.is_outside(between(a, b, i, parts))) reach[i] = beside;
  }
  return reach;
}

SweptSurface BorderReach::from_row(const BorderPlace& from, const BorderPlace& to, std::uint32_t column) {
  SweptSurface surface;
  const Vec3 &a = from.at.position, &b = to.at.position;
  const auto parts = static_cast<std::size_t>(
      std::clamp(std::ceil((b - a).norm() / (kBorderSample * spacing_)), 1.0, kMostReachSamples));
  const std::vector<double> reach = find_reach(from, to, parts);
  const auto on_border = [&](std::size_t i) -> SosPoint {
    return i == 0 ? from.at : (i == parts ? to.at : SosPoint{between(a, b, i, parts), next_key_++});
  };
  const auto beyond = [&](std::size_t i) -> SosPoint {
    if (i == 0 && from.at.key == last_.row_key) return last_.beyond;
    return {between(a, b, i, parts) + reach[i] * outwards_at(from, to, i, parts), next_key_++};
  };
  RowEnd end;
  std::vector<SosPoint> rim = {from.at};
  for (std::size_t i = 0; i <= parts; ++i) {
    if (!(reach[i] > 0)) continue;
    std::size_t last = i;
    while (last < parts && reach[last + 1] > 0) ++last;
    if (last > i) {
      const SosPoint p = on_border(i), q = on_border(last), r = beyond(last), s = beyond(i);
      if (last == parts) end = {to.at.key, r};
      add_reaching_triangle(surface, p, q, r, column);
      add_reaching_triangle(surface, p, r, s, column);
      rim.insert(rim.end(), {p, q});
    }
    i = last;
  }
  last_ = end;
  if (surface.triangles.empty()) return surface;
  rim.push_back(to.at);
  for (std::size_t k = 1; k + 1 < rim.size(); ++k) {
    add_reaching_triangle(surface, from.at, rim[k], rim[k + 1], column);
  }
  return surface;
}

}  // namespace v0
}  // namespace incise
