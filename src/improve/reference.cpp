// SPDX-License-Identifier: Apache-2.0
#include "improve/reference.h"

#include <algorithm>
#include <limits>

#include "incise/geom/closest.h"

namespace incise::inline v0 {

namespace {

/// Calls `visit` with sample points of a facet.
template <class Visit>
void for_each_sample(const Facet& f, Visit&& visit) {
  for (unsigned k = 0; k < 3; ++k) {
    visit(f[k]);
    visit(0.5 * (f[k] + f[(k + 1) % 3]));
  }
  visit((f[0] + f[1] + f[2]) / 3.0);
}

/// The greatest squared distance of samples of facets from whatever `distance2` measures.
template <class Distance2>
double farthest2(const std::vector<Facet>& facets, Distance2&& distance2) {
  double farthest = 0;
  for (const Facet& facet : facets) {
    for_each_sample(facet, [&](const Vec3& p) { farthest = std::max(farthest, distance2(p)); });
  }
  return farthest;
}

double distance2_to(const std::vector<Facet>& facets, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Facet& f : facets) {
    nearest = std::min(nearest, closest_on_triangle(p, f[0], f[1], f[2]).distance2);
  }
  return nearest;
}

}  // namespace

bool References::allows(std::uint32_t tag, const std::vector<Facet>& before, const std::vector<Facet>& after,
                        double tolerance) const {
  const auto sweep = sweeps_.find(tag);
  if (sweep == sweeps_.end()) {
    const auto off = [](const std::vector<Facet>& to) { return [&to](const Vec3& p) { return distance2_to(to, p); }; };
    return std::max(farthest2(after, off(before)), farthest2(before, off(after))) <= tolerance * tolerance;
  }
  const auto off_sweep = [&](const Vec3& p) { return sweep->second.closest(p).distance2; };
  const double limit2 = std::max(tolerance * tolerance, farthest2(before, off_sweep));
  return farthest2(after, off_sweep) <= limit2;
}

}  // namespace incise::inline v0
