// SPDX-License-Identifier: Apache-2.0
// The border of a strip is what an odd number of its triangles use, and that of the sheet the borders of all strips
// without what two share. Nearest places are looked for group by group, latest first (docs/internals.md, 3.1).
#include "cut/strip.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {

namespace {

using Keys = std::array<std::uint64_t, 2>;

Keys keys_of(const SosPoint& a, const SosPoint& b) {
  return {std::min(a.key, b.key), std::max(a.key, b.key)};
}

/// The edges that an odd number of triangles use, without `inner`; ascending by keys.
std::vector<Strip::Segment> border_of(const SweptSurface& surface, const std::vector<Keys>& inner) {
  std::vector<Strip::Segment> edges;
  for (const SweptTriangle& triangle : surface.triangles) {
    for (unsigned k = 0; k < 3; ++k) {
      const SosPoint& a = surface.points[triangle.points[k]];
      const SosPoint& b = surface.points[triangle.points[(k + 1) % 3]];
      edges.push_back(a.key < b.key ? Strip::Segment{a, b} : Strip::Segment{b, a});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const auto& x, const auto& y) { return keys_of(x[0], x[1]) < keys_of(y[0], y[1]); });
  std::vector<Strip::Segment> border;
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    const Keys keys = keys_of(edges[i][0], edges[i][1]);
    while (j < edges.size() && keys_of(edges[j][0], edges[j][1]) == keys) ++j;
    if ((j - i) % 2 == 1 && std::find(inner.begin(), inner.end(), keys) == inner.end()) {
      border.push_back(edges[i]);
    }
  }
  return border;
}

}  // namespace

Strip::Strip(SweptSurface swept, const std::vector<Keys>& shared)
    : surface(std::move(swept)), sheet(surface), border(border_of(surface, shared)), inner(shared) {}

void OwnSheet::clear() {
  strips_.clear();
  groups_.clear();
  border_.clear();
}

const Strip& OwnSheet::add(std::unique_ptr<Strip> strip) {
  const auto is_inner = [&](const Strip::Segment& segment) {
    const Keys keys = keys_of(segment[0], segment[1]);
    return std::find(strip->inner.begin(), strip->inner.end(), keys) != strip->inner.end();
  };
  if (!strip->inner.empty()) std::erase_if(border_, is_inner);
  border_.insert(border_.end(), strip->border.begin(), strip->border.end());
  strip->travel = travel() + travel_of(strip->surface);
  if (strips_.size() % kGroup == 0) groups_.emplace_back();
  groups_.back().extend(strip->sheet.bounds());
  strips_.push_back(std::move(strip));
  return *strips_.back();
}

SheetPlace OwnSheet::closest(const Vec3& point, double max_distance, double travelled) const {
  SheetPlace best;
  double reach = max_distance;
  for (std::size_t i = strips_.size(); i-- > 0;) {
    if (groups_[i / kGroup].distance2(point) > reach * reach) {
      i -= i % kGroup;
      continue;
    }
    const Sheet& sheet = strips_[i]->sheet;
    if (strips_[i]->travel > travelled || sheet.bounds().distance2(point) > reach * reach) continue;
    const auto hit = sheet.tree().closest(point, reach);
    if (hit.is_valid() && hit.distance2 < best.distance2) {
      best = {hit.point, sheet.normal(hit.triangle).normalized(), hit.distance2};
      reach = std::sqrt(hit.distance2);
    }
  }
  return best;
}

}  // namespace v0
}  // namespace incise
