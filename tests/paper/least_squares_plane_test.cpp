// SPDX-License-Identifier: Apache-2.0
#include "paper/least_squares_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/random.h"

namespace incise::test::least_squares_plane_test {
namespace {

using paper::fit_plane;
using paper::FittedPlane;

double squared_distances(const std::vector<Vec3>& points, const Vec3& centre, const Vec3& normal) {
  double sum = 0;
  for (const Vec3& p : points) sum += std::pow((p - centre).dot(normal), 2);
  return sum;
}

TEST(FitPlane, finds_the_plane_that_points_lie_in_at_any_scale) {
  Random random(1);
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const Vec3 normal = random.point(-1, 1).normalized();
    const Vec3 u = normal.cross(Vec3(1, 2, 3)).normalized(), v = normal.cross(u);
    std::vector<Vec3> points;
    for (unsigned i = 0; i < 7; ++i) points.emplace_back(scale * (random.real(-1, 1) * u + random.real(-1, 1) * v));
    const FittedPlane plane = fit_plane(points);
    EXPECT_NEAR(std::abs(plane.normal.dot(normal)), 1.0, 1e-14);
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-15);
  }
}

TEST(FitPlane, leaves_less_than_any_plane_beside_it) {
  Random random(2);
  for (unsigned run = 0; run < 50; ++run) {
    std::vector<Vec3> points;
    for (unsigned i = 0; i < 8; ++i) points.push_back(random.point(-1, 1).cwiseProduct(Vec3(1, 0.7, 0.2)));
    const FittedPlane plane = fit_plane(points);
    const double least = squared_distances(points, plane.centre, plane.normal);
    for (unsigned i = 0; i < 50; ++i) {
      const Vec3 other = (plane.normal + 0.3 * random.point(-1, 1)).normalized();
      EXPECT_LE(least, squared_distances(points, plane.centre + 0.1 * random.point(-1, 1), other) + 1e-15);
    }
  }
}

TEST(FitPlane, of_points_that_fix_none_has_a_unit_normal_all_the_same) {
  for (const std::vector<Vec3>& points :
       {std::vector<Vec3>{Vec3(1, 2, 3)}, {Vec3(0, 0, 0), Vec3(1, 1, 1)}, {Vec3(5, 5, 5), Vec3(5, 5, 5)}}) {
    EXPECT_NEAR(fit_plane(points).normal.norm(), 1.0, 1e-15);
  }
}

}  // namespace
}  // namespace incise::test::least_squares_plane_test
