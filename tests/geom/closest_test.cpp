// SPDX-License-Identifier: Apache-2.0
#include "incise/geom/closest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random.h"

namespace incise::closest_test {
namespace {

const Vec3 kA(0, 0, 0), kB(4, 0, 0), kC(0, 4, 0);

struct Case {
  Vec3 from;
  Vec3 expected;
  TriangleFeature feature;
};

TEST(ClosestOnTriangle, FindsEveryFeature) {
  for (const Case& c :
       {Case{{1, 1, 2}, {1, 1, 0}, TriangleFeature::kFace}, Case{{2, -1, 1}, {2, 0, 0}, TriangleFeature::kEdgeAb},
        Case{{4, 4, 0}, {2, 2, 0}, TriangleFeature::kEdgeBc}, Case{{-1, 3, 1}, {0, 3, 0}, TriangleFeature::kEdgeCa},
        Case{{-1, -1, 5}, kA, TriangleFeature::kVertexA}, Case{{6, -1, 0}, kB, TriangleFeature::kVertexB},
        Case{{-1, 6, 0}, kC, TriangleFeature::kVertexC}, Case{{0, 0, 0}, kA, TriangleFeature::kVertexA}}) {
    const ClosestPoint found = closest_on_triangle(c.from, kA, kB, kC);
    EXPECT_EQ(found.feature, c.feature);
    EXPECT_LT((found.point - c.expected).norm(), 1e-15);
    EXPECT_NEAR(found.distance2, (c.from - c.expected).squaredNorm(), 1e-14);
  }
}

void expect_sound(const ClosestPoint& found, const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto& w = found.weights;
  for (const double weight : w) {
    EXPECT_GE(weight, 0.0);
    EXPECT_LE(weight, 1.0);
  }
  EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-15);
  const double size = 1.0 + a.norm() + b.norm() + c.norm();
  EXPECT_LT((w[0] * a + w[1] * b + w[2] * c - found.point).norm(), 1e-14 * size);
  EXPECT_EQ((p - found.point).squaredNorm(), found.distance2);
}

// The least distance over a fine sample of the triangle: no less than the true one.
double sampled_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr int kSteps = 24;
  double best = (p - a).norm();
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = double(i) / kSteps, v = double(j) / kSteps;
      best = std::min(best, (p - (a + u * (b - a) + v * (c - a))).norm());
    }
  }
  return best;
}

TEST(ClosestOnTriangle, IsNeverFurtherThanASampleOfTheTriangle) {
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random.point(-2, 2), a = random.point(-1, 1), b = random.point(-1, 1), c = random.point(-1, 1);
    const ClosestPoint found = closest_on_triangle(p, a, b, c);
    expect_sound(found, p, a, b, c);
    const double distance = std::sqrt(found.distance2), sampled = sampled_distance(p, a, b, c);
    EXPECT_LE(distance, sampled + 1e-14);
    EXPECT_GE(distance, sampled - 0.1);
  }
}

TEST(ClosestOnTriangle, FlatTrianglesAreSegmentsAndPoints) {
  test::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.grid_point(-3, 3), a = random.grid_point(-2, 2), b = random.grid_point(-2, 2);
    const Vec3 c = i % 4 == 0 ? a : (i % 4 == 1 ? b : (i % 4 == 2 ? Vec3(2 * b - a) : Vec3(0.1 * a + 0.9 * b)));
    const ClosestPoint found = closest_on_triangle(p, a, b, c);
    expect_sound(found, p, a, b, c);
    EXPECT_LE(std::sqrt(found.distance2), sampled_distance(p, a, b, c) + 1e-14);
  }
  const ClosestPoint point = closest_on_triangle(Vec3(1, 0, 0), kA, kA, kA);
  EXPECT_EQ(point.distance2, 1.0);
  EXPECT_EQ(point.feature, TriangleFeature::kVertexA);
}

TEST(ClosestOnTriangle, NeedlesOfAnyThicknessAreSafe) {
  test::Random random(3);
  for (int exponent = -60; exponent < 0; ++exponent) {
    const double thickness = std::ldexp(1.0, exponent);
    for (int i = 0; i < 50; ++i) {
      const Vec3 a = random.point(-1, 1), b = random.point(-1, 1), p = random.point(-2, 2);
      const Vec3 c = a + random.real(-0.5, 1.5) * (b - a) + thickness * random.point(-1, 1);
      const ClosestPoint found = closest_on_triangle(p, a, b, c);
      expect_sound(found, p, a, b, c);
      EXPECT_LE(std::sqrt(found.distance2), sampled_distance(p, a, b, c) + 1e-9);
    }
  }
}

}  // namespace
}  // namespace incise::closest_test
