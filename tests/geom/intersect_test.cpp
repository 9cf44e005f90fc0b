// SPDX-License-Identifier: Apache-2.0
#include "incise/geom/intersect.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace incise::intersect_test {
namespace {

using Triangle = std::array<SosPoint, 3>;

Triangle triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint64_t first_key) {
  return {SosPoint{a, first_key}, {b, first_key + 1}, {c, first_key + 2}};
}

const Triangle kFloor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 10);

// Straight from the definition: six edges against two triangles.
int count_crossing_edges(const Triangle& s, const Triangle& t) {
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    count += static_cast<int>(segment_crosses_triangle(s[i], s[(i + 1) % 3], t[0], t[1], t[2]));
    count += static_cast<int>(segment_crosses_triangle(t[i], t[(i + 1) % 3], s[0], s[1], s[2]));
  }
  return count;
}

TEST(TrianglesCross, SeesATriangleThatStabsAnother) {
  EXPECT_TRUE(triangles_cross(kFloor, triangle({1, 1, -1}, {1, 1, 1}, {9, 9, 1}, 20)));
  EXPECT_TRUE(triangles_cross(kFloor, triangle({1, 1, 1}, {1, 2, 1}, {1, 1, -1}, 20)));
}

TEST(TrianglesCross, IsFalseForTrianglesApart) {
  EXPECT_FALSE(triangles_cross(kFloor, triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1}, 20)));
  EXPECT_FALSE(triangles_cross(kFloor, triangle({5, 5, -1}, {5, 5, 1}, {9, 9, 1}, 20)));
  EXPECT_FALSE(triangles_cross(kFloor, triangle({3, 3, -1}, {3, 3, 1}, {9, 9, 1}, 20)));
}

TEST(TrianglesCross, BesidesWhereTheyShareACorner) {
  const SosPoint corner{{0, 0, 0}, 1};
  const auto at_corner = [&](const Vec3& a, const Vec3& b, std::uint64_t key) {
    return Triangle{corner, SosPoint{a, key}, SosPoint{b, key + 1}};
  };
  const Triangle floor = at_corner({4, 0, 0}, {0, 4, 0}, 10);
  EXPECT_TRUE(triangles_cross_besides(floor, at_corner({1, 1, -1}, {1, 1, 1}, 20)));
  EXPECT_TRUE(triangles_cross_besides(at_corner({1, 1, -1}, {1, 1, 1}, 20), floor));
  EXPECT_TRUE(triangles_cross_besides(floor, at_corner({9, 9, -1}, {9, 9, 1}, 20)));       // larger: its side is beyond
  EXPECT_FALSE(triangles_cross_besides(floor, at_corner({-1, -1, -1}, {-1, -1, 1}, 20)));  // on the other side
  EXPECT_FALSE(triangles_cross_besides(floor, at_corner({1, 1, 1}, {2, 1, 1}, 20)));
}

TEST(TrianglesCross, AgreesWithItsDefinitionOnDegenerateGrids) {
  test::Random random(1);
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::int64_t extent = 1 + i % 3;
    Triangle s, t;
    std::uint64_t key = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      s[k] = {random.grid_point(0, extent), ++key * 37 % 41};
      t[k] = {random.grid_point(0, extent), ++key * 37 % 41};
    }
    const int edges = count_crossing_edges(s, t);
    // Two triangles in general position meet in a segment whose two ends lie on one edge each.
    ASSERT_TRUE(edges == 0 || edges == 2);
    ASSERT_EQ(triangles_cross(s, t), edges != 0);
    ASSERT_EQ(triangles_cross(t, s), edges != 0);
    crossing += static_cast<int>(edges != 0);
  }
  EXPECT_GT(crossing, 1000);
}

}  // namespace
}  // namespace incise::intersect_test
