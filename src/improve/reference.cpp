// SPDX-License-Identifier: Apache-2.0
#include "improve/reference.h"

#include <algorithm>
#include <cmath>

#include "incise/geom/closest.h"

namespace incise::inline v0 {

namespace {

bool is_near(const Vec3& p, const std::vector<Facet>& facets, double tolerance2) {
  return std::any_of(facets.begin(), facets.end(),
                     [&](const Facet& f) { return closest_on_triangle(p, f[0], f[1], f[2]).distance2 <= tolerance2; });
}

bool are_near(const Piece& piece, const Piece& other, double tolerance2) {
  return std::all_of(piece.samples.begin(), piece.samples.end(),
                     [&](const Vec3& p) { return is_near(p, other.facets, tolerance2); });
}

}  // namespace

double References::limit(std::uint32_t tag, const Piece& before, double tolerance) const {
  const auto sweep = sweeps_.find(tag);
  double limit2 = tolerance * tolerance;
  if (sweep != sweeps_.end()) {
    for (const Vec3& p : before.samples) {
      limit2 = std::max(limit2, sweep->second.closest(p).distance2);
    }
  }
  return std::sqrt(limit2);
}

bool References::allows(std::uint32_t tag, const Piece& before, const Piece& after, double limit) const {
  const auto sweep = sweeps_.find(tag);
  if (sweep == sweeps_.end()) {
    return are_near(after, before, limit * limit) && are_near(before, after, limit * limit);
  }
  return std::all_of(after.samples.begin(), after.samples.end(),
                     [&](const Vec3& p) { return sweep->second.closest(p, limit).is_valid(); });
}

}  // namespace incise::inline v0
