// SPDX-License-Identifier: Apache-2.0
#include "improve/reference.h"

#include <algorithm>

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

/// The greatest squared distance of a piece's samples and corners from a sweep.
double farthest2(const TriangleTree& sweep, const Piece& piece) {
  double farthest = 0;
  for (const Vec3& p : piece.samples) {
    farthest = std::max(farthest, sweep.closest(p).distance2);
  }
  return farthest;
}

}  // namespace

bool References::allows(std::uint32_t tag, const Piece& before, const Piece& after, double tolerance) const {
  const auto sweep = sweeps_.find(tag);
  if (sweep == sweeps_.end()) {
    const double tolerance2 = tolerance * tolerance;
    return are_near(after, before, tolerance2) && are_near(before, after, tolerance2);
  }
  const auto is_close = [&](const Vec3& p) { return sweep->second.closest(p, tolerance).is_valid(); };
  if (std::all_of(after.samples.begin(), after.samples.end(), is_close)) {
    return true;
  }
  return farthest2(sweep->second, after) <= farthest2(sweep->second, before);
}

}  // namespace incise::inline v0
