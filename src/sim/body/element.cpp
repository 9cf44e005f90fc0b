// SPDX-License-Identifier: Apache-2.0
#include "sim/body/element.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

/// The least altitude by the longest edge, against what is allowed.
double softening(const std::array<Vec3, 4>& p, const std::array<Vec3, 4>& slope, double volume6, double thinnest) {
  double widest2 = 0, longest2 = 0;
  for (const Vec3& n : slope) widest2 = std::max(widest2, n.squaredNorm());
  for (const auto& [a, b] : kEdgeCorners) longest2 = std::max(longest2, (p[a] - p[b]).squaredNorm());
  const double thickness2 = volume6 * volume6 / widest2, wanted2 = thinnest * thinnest * longest2;
  return thickness2 < wanted2 ? std::sqrt(thickness2 / wanted2) : 1.0;
}

}  // namespace

Element slopes_of(const std::array<Vec3, 4>& p, double lambda, double mu, double thinnest, double crumb,
                  double shared) {
  std::array<Vec3, 4> slope;
  for (unsigned i = 0; i < 4; ++i) slope[i] = volume_slope(p, i);
  const double volume6 = six_volumes(p);
  const double scale = softening(p, slope, volume6, thinnest);
  Element element;
  for (unsigned e = 0; e < 6; ++e) {
    const auto& [a, b] = kEdgeCorners[e];
    element.laplacian[e] = scale * mu / (6 * volume6) * slope[a].dot(slope[b]);
  }
  if (volume6 < crumb) return element;
  element.bulk = scale * lambda / (6 * volume6);
  element.pressure = scale * (lambda + mu) / 6;
  if (shared > 0) element.give = volume6 / (scale * shared);
  return element;
}

Element element_of(const std::array<Vec3, 4>& p, double lambda, double mu, double thinnest, double crumb,
                   double shared) {
  Element element = slopes_of(p, lambda, mu, thinnest, crumb, shared);
  element.offset = energy_of(element, p);
  return element;
}

double energy_of(const Element& element, const std::array<Vec3, 4>& p) {
  double stretch = 0;  // the rows of the Laplacian add up to zero: differences alone count
  for (unsigned e = 0; e < 6; ++e) {
    const auto& [a, b] = kEdgeCorners[e];
    stretch -= element.laplacian[e] * (p[a] - p[b]).squaredNorm();
  }
  const double volume6 = six_volumes(p);
  return 0.5 * stretch + (0.5 * element.bulk * volume6 - element.pressure) * volume6 - element.offset;
}

Vec3 slope_of(const Element& element, const std::array<Vec3, 4>& p, unsigned i) {
  Vec3 slope = (element.bulk * six_volumes(p) - element.pressure) * volume_slope(p, i);
  for (unsigned j = 0; j < 4; ++j) {
    if (j != i) slope += element.laplacian[kEdgeOfCorners[i][j]] * (p[j] - p[i]);
  }
  return slope;
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
