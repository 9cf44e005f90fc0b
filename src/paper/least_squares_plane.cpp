// SPDX-License-Identifier: Apache-2.0
// The scatter of the points is turned by Jacobi's rotations until it is diagonal; the axis of its least entry is the
// normal.
#include "paper/least_squares_plane.h"

#include <array>
#include <cmath>

#include "paper/constants.h"

namespace incise {
inline namespace v0 {
namespace paper {

namespace {

using Rows = std::array<Vec3, 3>;

/// A rotation in the plane of axes p and q that makes the scatter's entry (p, q) zero.
struct Rotation {
  double cosine = 1, sine = 0;
};

Rotation rotation_for(const Rows& m, int p, int q) {
  const auto up = static_cast<std::size_t>(p), uq = static_cast<std::size_t>(q);
  if (m[up][q] == 0.0) {
    return {};
  }
  const double theta = (m[uq][q] - m[up][p]) / (2.0 * m[up][q]);
  const double tangent = (theta < 0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0);
  return {cosine, tangent * cosine};
}

void rotate(Rows& m, Rows& axes, int p, int q) {
  const auto up = static_cast<std::size_t>(p), uq = static_cast<std::size_t>(q);
  const Rotation r = rotation_for(m, p, q);
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = m[i][p], b = m[i][q];
    m[i][p] = r.cosine * a - r.sine * b;
    m[i][q] = r.sine * a + r.cosine * b;
  }
  const Vec3 a = m[up], b = m[uq], x = axes[up], y = axes[uq];
  m[up] = r.cosine * a - r.sine * b;
  m[uq] = r.sine * a + r.cosine * b;
  axes[up] = r.cosine * x - r.sine * y;
  axes[uq] = r.sine * x + r.cosine * y;
}

/// Σ (p − centre)(p − centre)ᵀ, scaled to entries of at most about 1.
Rows scatter(std::span<const Vec3> points, const Vec3& centre) {
  double size2 = 0;
  for (const Vec3& p : points) size2 += (p - centre).squaredNorm();
  const double scale = size2 > 0 ? 1.0 / std::sqrt(size2) : 0.0;
  Rows m = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (const Vec3& p : points) {
    const Vec3 d = scale * (p - centre);
    for (int i = 0; i < 3; ++i) m[static_cast<std::size_t>(i)] += d[i] * d;
  }
  return m;
}

}  // namespace

FittedPlane fit_plane(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  const Vec3 centre = sum / static_cast<double>(points.size());
  Rows m = scatter(points, centre), axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (int sweep = 0; sweep < kPlaneSweeps; ++sweep) {
    rotate(m, axes, 0, 1);
    rotate(m, axes, 0, 2);
    rotate(m, axes, 1, 2);
  }
  int least = 0;
  for (const int i : {1, 2}) {
    if (m[static_cast<std::size_t>(i)][i] < m[static_cast<std::size_t>(least)][least]) least = i;
  }
  return {centre, axes[static_cast<std::size_t>(least)].normalized()};
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
