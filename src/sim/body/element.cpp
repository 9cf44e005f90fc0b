// SPDX-License-Identifier: Apache-2.0
// Everything that a tet adds to its corners, computed once when it comes: a Laplacian, the slopes of its volume,
// fibres and metrics; thin tets are softened as they are made (docs/internals.md, 4).
#include "sim/body/element.h"

#include <algorithm>
#include <cmath>

#include "sim/body/constants.h"

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

double softening(const std::array<Vec3, 4>& p, double thinnest) {
  std::array<Vec3, 4> slope;
  for (unsigned i = 0; i < 4; ++i) slope[i] = volume_slope(p, i);
  return softening(p, slope, six_volumes(p), thinnest);
}

/// How much longer the fibres are than at rest, as they only pull, and their direction times their stretch.
struct Drawn {
  Vec3 fibre = Vec3::Zero();
  double over = 0;
};
Drawn drawn(const Element& element, const std::array<Vec3, 4>& p) {
  Drawn drawn;
  for (unsigned i = 1; i < 4; ++i) drawn.fibre += element.along[i] * (p[i] - p[0]);
  drawn.over = std::max(0.0, drawn.fibre.norm() - 1);
  return drawn;
}

/// By Newton's method, above 0.
double cube_root(double x) {
  double scale = 1;
  for (; x > 8; x *= 0.125) scale *= 2;
  for (; x < 1; x *= 8) scale *= 0.5;
  double y = 1.5;
  for (unsigned i = 0; i < 6; ++i) y = (2 * y + x / (y * y)) / 3;
  return scale * y;
}

double determinant(const Metric& m) {
  const auto& [xx, xy, xz, yy, yz, zz] = m;
  return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
}

/// The same with determinant 1; the unit one where that is impossible.
Metric normed(const Metric& m) {
  const double size = determinant(m);
  if (!(size > 1e-30 && size < 1e30)) return {1, 0, 0, 1, 0, 1};
  const double by = 1 / cube_root(size);
  Metric one = m;
  for (double& x : one) x *= by;
  return one;
}

}  // namespace

bool is_thinner(const std::array<Vec3, 4>& p, double thinnest) {
  return softening(p, thinnest) < 1;
}

void add_fibres(const std::array<Vec3, 4>& p, const Vec3& direction, double young, double thinnest, Element& element) {
  const double volume6 = six_volumes(p);
  const Vec3 unit = direction.normalized();
  for (unsigned i = 0; i < 4; ++i) element.along[i] = volume_slope(p, i).dot(unit) / volume6;
  element.fibre = softening(p, thinnest) * young * volume6 / 6;
}

void set_metric(const std::array<Vec3, 4>& p, double mu, double thinnest, const Metric& metric, Element& element) {
  const double by = softening(p, thinnest) * mu / (6 * six_volumes(p));
  const auto& [xx, xy, xz, yy, yz, zz] = metric;
  Mat3 off;  // from the unit metric
  off << xx - 1, xy, xz, xy, yy - 1, yz, xz, yz, zz - 1;
  for (unsigned e = 0; e < 6; ++e) {
    const auto& [a, b] = kEdgeCorners[e];
    element.laplacian[e] += by * volume_slope(p, a).dot(off * volume_slope(p, b));
  }
}

Metric relaxed_metric(const std::array<Vec3, 4>& rest, const std::array<Vec3, 4>& now) {
  // F = Σ x_j ∇φj; C⁻¹ is the cofactors of C by its determinant.
  Mat3 f = Mat3::Zero();
  for (unsigned i = 1; i < 4; ++i) f += (now[i] - now[0]) * volume_slope(rest, i).transpose();
  f /= six_volumes(rest);
  if (!(f.determinant() > 1e-6)) return {1, 0, 0, 1, 0, 1};
  const Mat3 c = f.transpose() * f;
  const auto minor = [&](int i, int j, int k, int l) { return c(i, j) * c(k, l) - c(i, l) * c(k, j); };
  return normed({minor(1, 1, 2, 2), -minor(0, 1, 2, 2), minor(0, 1, 1, 2), minor(0, 0, 2, 2), -minor(0, 0, 1, 2),
                 minor(0, 0, 1, 1)});
}

Metric flowed(const Metric& from, const Metric& to, double share) {
  Metric mean;
  for (unsigned i = 0; i < 6; ++i) mean[i] = from[i] + share * (to[i] - from[i]);
  return normed(mean);
}

double decay(double x) {
  unsigned halvings = 0;
  for (; x > 1.0 / 64; x *= 0.5) ++halvings;
  double sum = 1, term = 1;
  for (unsigned i = 1; i < 8; ++i) sum += term *= x / i;
  double y = 1 / sum;
  for (; halvings > 0; --halvings) y *= y;
  return y;
}

Element slopes_of(const std::array<Vec3, 4>& p, double lambda, double mu, double thinnest, double crumb, double shared,
                  double stiffening) {
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
  if (stiffening > 0) {
    element.offset = soft_energy_of(element, p);
    element.stiffening = 1.5 * stiffening / (scale * mu * volume6);
  }
  return element;
}

Element element_of(const std::array<Vec3, 4>& p, double lambda, double mu, double thinnest, double crumb, double shared,
                   double stiffening) {
  Element element = slopes_of(p, lambda, mu, thinnest, crumb, shared, stiffening);
  if (!(element.stiffening > 0)) element.offset = soft_energy_of(element, p);
  return element;
}

Stiffened stiffened(const Element& element, double energy) {
  if (!(element.stiffening > 0)) return {energy, 1, 0};
  const double most = (kStiffest - 1) / element.stiffening, within = std::min(energy, most);
  const double t = element.stiffening * within, base = 1 + t, base2 = base * base, base4 = base2 * base2;
  // base⁸ − 1 by its factors, the first of which is t.
  const double grown = within * (base + 1) * (base2 + 1) * (base4 + 1) / 8;
  const double growth = 7 * element.stiffening * base4 * base2, factor = base4 * base2 * base;
  return {grown + factor * (energy - within), factor, energy < most ? growth : 0.0};
}

double energy_of(const Element& element, const std::array<Vec3, 4>& p) {
  return stiffened(element, soft_energy_of(element, p)).energy;
}

double soft_energy_of(const Element& element, const std::array<Vec3, 4>& p) {
  double stretch = 0;  // the rows of the Laplacian add up to zero: differences alone count
  for (unsigned e = 0; e < 6; ++e) {
    const auto& [a, b] = kEdgeCorners[e];
    stretch -= element.laplacian[e] * (p[a] - p[b]).squaredNorm();
  }
  const double volume6 = six_volumes(p);
  const double soft = 0.5 * stretch + (0.5 * element.bulk * volume6 - element.pressure) * volume6 - element.offset;
  if (!(element.fibre > 0)) return soft;
  const double over = drawn(element, p).over;
  return soft + 0.5 * element.fibre * over * over;
}

Mat3 stiffness_at(const Element& element, const std::array<Vec3, 4>& p, unsigned i) {
  const Vec3 swelling = volume_slope(p, i);
  Mat3 stiffness = element.bulk * swelling * swelling.transpose();
  for (unsigned j = 0; j < 4; ++j) {
    if (j != i) stiffness.diagonal().array() -= element.laplacian[kEdgeOfCorners[i][j]];
  }
  if (const Drawn fibres = drawn(element, p); element.fibre > 0 && fibres.over > 0) {
    const Vec3 n = fibres.fibre / (1 + fibres.over);
    const double k = element.fibre * element.along[i] * element.along[i], across = fibres.over / (1 + fibres.over);
    stiffness += k * (across * Mat3::Identity() + (1 - across) * n * n.transpose());
  }
  if (!(element.stiffening > 0)) return stiffness;
  const Stiffened stiff = stiffened(element, soft_energy_of(element, p));
  const Vec3 slope = slope_of(element, p, i) / stiff.factor;
  return stiff.factor * stiffness + stiff.growth * slope * slope.transpose();
}

Vec3 slope_of(const Element& element, const std::array<Vec3, 4>& p, unsigned i) {
  Vec3 slope = (element.bulk * six_volumes(p) - element.pressure) * volume_slope(p, i);
  for (unsigned j = 0; j < 4; ++j) {
    if (j != i) slope += element.laplacian[kEdgeOfCorners[i][j]] * (p[j] - p[i]);
  }
  if (element.fibre > 0) {
    const Drawn fibres = drawn(element, p);
    slope += element.fibre * element.along[i] * fibres.over / (1 + fibres.over) * fibres.fibre;
  }
  if (element.stiffening > 0) slope *= stiffened(element, soft_energy_of(element, p)).factor;
  return slope;
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
