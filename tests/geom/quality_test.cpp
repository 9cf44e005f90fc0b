// SPDX-License-Identifier: Apache-2.0
#include "incise/geom/quality.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/random.h"

namespace incise::quality_test {
namespace {

using Tet = std::array<Vec3, 4>;

const Tet kRegular = {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)};
const Tet kCorner = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
const Tet kFlat = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};

template <class Measure>
auto of(Measure measure, const Tet& t) {
  return measure(t[0], t[1], t[2], t[3]);
}
Tet inverted(const Tet& t) {
  return {t[1], t[0], t[2], t[3]};
}

TEST(Quality, RegularTet) {
  EXPECT_NEAR(of(longest_edge_over_inradius, kRegular), 2 * std::sqrt(6.0), 1e-14);
  EXPECT_NEAR(of(signed_volume, kRegular), 8.0 / 3.0, 1e-15);
  EXPECT_NEAR(of(mean_ratio, kRegular), 1.0, 1e-15);
  const DihedralExtremes angles = of(dihedral_extremes_deg, kRegular);
  EXPECT_NEAR(angles.least, 70.528779365509308, 1e-12);
  EXPECT_NEAR(angles.greatest, 70.528779365509308, 1e-12);
}

TEST(Quality, CornerOfACube) {
  // r = 3 V / area = (1/2) / (3/2 + √3/2)
  EXPECT_NEAR(of(longest_edge_over_inradius, kCorner), std::sqrt(2.0) * (3 + std::sqrt(3.0)), 1e-14);
  EXPECT_NEAR(of(signed_volume, kCorner), 1.0 / 6.0, 1e-16);
  const DihedralExtremes angles = of(dihedral_extremes_deg, kCorner);
  EXPECT_NEAR(angles.least, 54.735610317245346, 1e-12);
  EXPECT_NEAR(angles.greatest, 90.0, 1e-12);
  EXPECT_NEAR(of(mean_ratio, kCorner), 12 * std::cbrt(0.25) / 9, 1e-15);
}

TEST(Quality, KuhnTetHasThePapersValueOfTheCube) {
  EXPECT_NEAR(longest_edge_over_inradius(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)),
              std::sqrt(3.0) * (2 + 2 * std::sqrt(2.0)), 1e-13);
}

TEST(Quality, FlatAndInvertedTetsAreWorst) {
  EXPECT_EQ(of(longest_edge_over_inradius, kFlat), std::numeric_limits<double>::infinity());
  EXPECT_EQ(of(longest_edge_over_inradius, inverted(kRegular)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(of(signed_volume, kFlat), 0.0);
  EXPECT_LT(of(signed_volume, inverted(kRegular)), 0.0);
  EXPECT_EQ(of(mean_ratio, kFlat), 0.0);
  EXPECT_NEAR(of(mean_ratio, inverted(kRegular)), -1.0, 1e-15);
  const DihedralCosines cosines = of(dihedral_cosines, Tet{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 0, 1)});
  EXPECT_EQ(cosines.of_least, 1.0);
  EXPECT_EQ(cosines.of_greatest, -1.0);
  const Tet point = {Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)};
  EXPECT_EQ(of(mean_ratio, point), 0.0);
}

TEST(Quality, DoesNotDependOnScalePlaceOrNumbering) {
  test::Random random(1);
  for (int i = 0; i < 500; ++i) {
    Tet t = {random.point(0, 1), random.point(0, 1), random.point(0, 1), random.point(0, 1)};
    if (of(signed_volume, t) < 0) t = inverted(t);
    if (of(signed_volume, t) < 1e-3) continue;
    const Vec3 shift = random.point(-1, 1);
    const double scale = std::ldexp(1.0, static_cast<int>(random.integer(-100, 100)));
    Tet u;
    for (std::size_t k = 0; k < 4; ++k) u[k] = scale * (t[k] + shift);
    const Tet turned = {u[1], u[2], u[0], u[3]};
    EXPECT_NEAR(of(longest_edge_over_inradius, turned) / of(longest_edge_over_inradius, t), 1.0, 1e-10);
    EXPECT_NEAR(of(mean_ratio_cubed, turned) / of(mean_ratio_cubed, t), 1.0, 1e-10);
    EXPECT_NEAR(of(dihedral_cosines, turned).of_least, of(dihedral_cosines, t).of_least, 1e-10);
    EXPECT_GE(of(longest_edge_over_inradius, t), 4.898979485566356);
    EXPECT_LE(of(mean_ratio, t), 1.0);
  }
}

TEST(Quality, DihedralAnglesOfAWedgeAreThoseItWasBuiltWith) {
  // Faces through the z axis at a known angle.
  for (const double angle : {5.0, 30.0, 89.0, 120.0, 175.0}) {
    const double a = angle * std::acos(-1.0) / 180.0;
    const DihedralExtremes found = of(
        dihedral_extremes_deg, Tet{Vec3(0, 0, 0), Vec3(1, 0, 0.5), Vec3(std::cos(a), std::sin(a), 0.5), Vec3(0, 0, 1)});
    EXPECT_LE(found.least, angle + 1e-9);
    EXPECT_GE(found.greatest, angle - 1e-9);
    if (angle > 100) {
      EXPECT_NEAR(found.greatest, angle, 1e-9);
    }
    if (angle < 20) {
      EXPECT_NEAR(found.least, angle, 1e-9);
    }
  }
}

}  // namespace
}  // namespace incise::quality_test
