// SPDX-License-Identifier: Apache-2.0
// One linear equation in the vertex's step for each region and surface; elimination by the greatest gradient tells
// which directions are held and which step gives everything back.
#include "improve/region_volumes.h"

#include <cmath>

#include "geom/constants.h"
#include "improve/constants.h"

namespace incise {
inline namespace v0 {

RegionVolumes::Row& RegionVolumes::at(std::int32_t region) {
  const auto row = std::find_if(rows_.begin(), rows_.end(),
                                [&](const Row& known) { return !known.is_surface && known.region == region; });
  return row != rows_.end() ? *row : rows_.emplace_back(Row{region, false});
}

void RegionVolumes::add_to(Row& row, const Vec3& gradient) {
  row.gradient += gradient;
  scale_ += gradient.norm();
}

void RegionVolumes::add_surface(const Vec3& area2, double lost6) {
  Row& row = rows_.emplace_back(Row{0, true});
  add_to(row, area2);
  row.lost6 = lost6;
}

/// Takes the direction of the greatest gradient out of all of them, until none is left.
RegionVolumes::Held RegionVolumes::held() const {
  Held held;
  std::vector<Row> rows = rows_;
  while (held.count < 3 && !rows.empty()) {
    const Row greatest = *std::max_element(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
      return a.gradient.squaredNorm() < b.gradient.squaredNorm();
    });
    const double length = greatest.gradient.norm();
    if (!(length > kOnePlane * scale_)) break;
    const Vec3 direction = greatest.gradient / length;
    const double step = greatest.lost6 / length;
    for (Row& row : rows) {
      const double part = direction.dot(row.gradient);
      row.gradient -= part * direction;
      row.lost6 -= part * step;
    }
    held.directions[held.count] = direction;
    held.steps[held.count] = step;
    ++held.count;
  }
  return held;
}

bool RegionVolumes::find_step(Vec3& step) const {
  const Held found = held();
  step = Vec3::Zero();
  for (unsigned i = 0; i < found.count; ++i) step += found.steps[i] * found.directions[i];
  const double rounding = kNoVolume * scale_ * std::sqrt(scale_);
  return std::all_of(rows_.begin(), rows_.end(),
                     [&](const Row& row) { return std::abs(row.gradient.dot(step) - row.lost6) <= rounding; });
}

}  // namespace v0
}  // namespace incise
