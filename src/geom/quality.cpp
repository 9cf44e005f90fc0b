// SPDX-License-Identifier: Apache-2.0
// All measures from the four outward normals and the six edge lengths; cosines instead of angles wherever results are
// compared.
#include "incise/geom/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geom/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// Outward normals of the faces opposite to a, b, c, d; their lengths are twice the areas.
struct FaceNormals {
  FaceNormals(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
      : of{(c - b).cross(d - b), (d - a).cross(c - a), (b - a).cross(d - a), (c - a).cross(b - a)} {}
  std::array<Vec3, 4> of;
};

struct EdgeLengths {
  double longest2;
  double sum2;
};

EdgeLengths edge_lengths(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::array<double, 6> squared = {(b - a).squaredNorm(), (c - a).squaredNorm(), (d - a).squaredNorm(),
                                         (c - b).squaredNorm(), (d - b).squaredNorm(), (d - c).squaredNorm()};
  EdgeLengths lengths{0.0, 0.0};
  for (const double s : squared) {
    lengths.longest2 = std::max(lengths.longest2, s);
    lengths.sum2 += s;
  }
  return lengths;
}

double degrees_of(double cosine) {
  return kDegreesPerRadian * std::acos(cosine);
}

}  // namespace

double longest_edge_over_inradius(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double volume6 = signed_volume6(a, b, c, d);
  if (!(volume6 > 0.0)) {
    return std::numeric_limits<double>::infinity();
  }
  const FaceNormals normals(a, b, c, d);
  // r = 3 V / area, and the normals sum to twice the area: L / r = L · Σ|n| / (6 V).
  const double area2 = (normals.of[0].norm() + normals.of[1].norm()) + (normals.of[2].norm() + normals.of[3].norm());
  return std::sqrt(edge_lengths(a, b, c, d).longest2) * area2 / volume6;
}

DihedralCosines dihedral_cosines(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const FaceNormals normals(a, b, c, d);
  std::array<double, 4> length = {};
  for (std::size_t i = 0; i < 4; ++i) {
    length[i] = normals.of[i].norm();
    if (!(length[i] > 0.0)) {
      return {1.0, -1.0};
    }
  }
  DihedralCosines extremes{-1.0, 1.0};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double cosine = -(normals.of[i] / length[i]).dot(normals.of[j] / length[j]);
      extremes.of_least = std::max(extremes.of_least, cosine);
      extremes.of_greatest = std::min(extremes.of_greatest, cosine);
    }
  }
  return {std::min(extremes.of_least, 1.0), std::max(extremes.of_greatest, -1.0)};
}

DihedralExtremes dihedral_extremes_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const DihedralCosines cosines = dihedral_cosines(a, b, c, d);
  return {degrees_of(cosines.of_least), degrees_of(cosines.of_greatest)};
}

double mean_ratio_cubed(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double sum2 = edge_lengths(a, b, c, d).sum2;
  if (!(sum2 > 0.0)) {
    return 0.0;
  }
  // 12³ (3V)² / (Σ l²)³ with 3V = volume6 / 2.
  const double volume6 = signed_volume6(a, b, c, d);
  return 432.0 * volume6 * std::abs(volume6) / (sum2 * sum2 * sum2);
}

double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return std::cbrt(mean_ratio_cubed(a, b, c, d));
}

}  // namespace v0
}  // namespace incise
