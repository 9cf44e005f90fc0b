// SPDX-License-Identifier: Apache-2.0
#include "incise/geom/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "incise/geom/closest.h"
#include "support/random.h"

namespace incise::triangle_tree_test {
namespace {

struct Soup {
  std::vector<Vec3> points;
  std::vector<TriangleTree::Triangle> triangles;

  [[nodiscard]] Box box_of(std::uint32_t t) const {
    Box box;
    for (const std::uint32_t v : triangles[t]) box.extend(points[v]);
    return box;
  }
};

Soup random_soup(std::uint32_t count, double size, std::uint64_t seed) {
  test::Random random(seed);
  Soup soup;
  for (std::uint32_t t = 0; t < count; ++t) {
    const Vec3 centre = random.point(0, 1);
    for (unsigned k = 0; k < 3; ++k) soup.points.push_back(centre + size * random.point(-1, 1));
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return soup;
}

// A square [0, 1]² in z = 0 of n × n cells of two triangles each: many equal boxes and shared corners.
Soup square(std::uint32_t n) {
  Soup soup;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) soup.points.emplace_back(double(i) / n, double(j) / n, 0.0);
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = i + j * (n + 1), b = a + 1, c = a + n + 1, d = c + 1;
      soup.triangles.push_back({a, b, d});
      soup.triangles.push_back({a, d, c});
    }
  }
  return soup;
}

TriangleTree::Hit closest_by_scan(const Soup& soup, const Vec3& p) {
  TriangleTree::Hit best;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& v = soup.triangles[t];
    const ClosestPoint c = closest_on_triangle(p, soup.points[v[0]], soup.points[v[1]], soup.points[v[2]]);
    if (c.distance2 < best.distance2) best = {t, c.point, c.distance2};
  }
  return best;
}

void expect_same_as_scan(const Soup& soup, double low, double high, std::uint64_t seed) {
  const TriangleTree tree(soup.points, soup.triangles);
  EXPECT_EQ(tree.size(), soup.triangles.size());
  test::Random random(seed);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = i % 3 == 0 ? Vec3(0.25 * random.grid_point(-1, 5)) : random.point(low, high);
    const auto expected = closest_by_scan(soup, p), found = tree.closest(p);
    EXPECT_EQ(found.triangle, expected.triangle);
    EXPECT_EQ(found.distance2, expected.distance2);
    EXPECT_EQ(found.point, expected.point);
    const double distance = std::sqrt(expected.distance2);
    EXPECT_EQ(tree.closest(p, 1.001 * distance + 1e-9).triangle, expected.triangle);
    EXPECT_FALSE(distance > 1e-9 && tree.closest(p, 0.999 * distance).is_valid());

    Box box;
    box.extend(p);
    box.extend(Vec3(p + random.point(0, 0.3)));
    std::vector<std::uint32_t> reported, overlapping;
    tree.for_each_overlap(box, [&](std::uint32_t t) { reported.push_back(t); });
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
      if (soup.box_of(t).overlaps(box)) overlapping.push_back(t);
    }
    std::sort(reported.begin(), reported.end());
    EXPECT_EQ(reported, overlapping);
  }
}

TEST(TriangleTree, AgreesWithAScan) {
  for (const std::uint32_t count : {1U, 2U, 4U, 5U, 9U, 100U, 3000U}) {
    expect_same_as_scan(random_soup(count, 0.1, count), -0.5, 1.5, count);
  }
}

TEST(TriangleTree, AgreesWithAScanOnSharedCornersAndTies) {
  expect_same_as_scan(square(1), -0.5, 1.5, 1);
  expect_same_as_scan(square(4), -0.5, 1.5, 2);
  expect_same_as_scan(square(16), -0.5, 1.5, 3);
}

TEST(TriangleTree, AgreesWithAScanOnCoincidentAndFlatTriangles) {
  Soup soup = random_soup(40, 0.2, 5);
  for (std::uint32_t t = 0; t < 40; ++t) {
    soup.triangles.push_back(soup.triangles[0]);
    soup.triangles.push_back({3 * t, 3 * t, 3 * t + 1});
  }
  expect_same_as_scan(soup, 0, 1, 6);
}

TEST(TriangleTree, LowestTriangleWinsATie) {
  const Soup soup = square(8);
  const TriangleTree tree(soup.points, soup.triangles);
  // Above an inner vertex, which six triangles share.
  const auto hit = tree.closest(Vec3(0.5, 0.5, 0.25));
  EXPECT_EQ(hit.triangle, 2 * (3 + 3 * 8U));
  EXPECT_EQ(hit.distance2, 0.0625);
}

TEST(TriangleTree, WithoutTrianglesFindsNothing) {
  const TriangleTree tree;
  EXPECT_FALSE(tree.closest(Vec3::Zero()).is_valid());
  EXPECT_TRUE(tree.bounds().is_empty());
  bool is_called = false;
  tree.for_each_overlap({Vec3(-1, -1, -1), Vec3(1, 1, 1)}, [&](std::uint32_t) { is_called = true; });
  EXPECT_FALSE(is_called);
  EXPECT_FALSE(TriangleTree({}, {}).closest(Vec3::Zero(), 1.0).is_valid());
}

TEST(TriangleTree, MaximalDistanceCounts) {
  const Soup soup = square(1);
  const TriangleTree tree(soup.points, soup.triangles);
  EXPECT_TRUE(tree.closest(Vec3(0.5, 0.5, 0.25), 0.25).is_valid());
  EXPECT_FALSE(tree.closest(Vec3(0.5, 0.5, 0.25), 0.2499).is_valid());
  EXPECT_TRUE(tree.closest(Vec3(0.5, 0.25, 0), 0.0).is_valid());
  EXPECT_FALSE(tree.closest(Vec3(0.5, 0.25, 0), -1.0).is_valid());
}

TEST(TriangleTree, ReportsInTheSameOrderEveryTime) {
  const Soup soup = random_soup(500, 0.05, 9);
  const TriangleTree first(soup.points, soup.triangles), second(soup.points, soup.triangles);
  std::vector<std::uint32_t> a, b;
  first.for_each_overlap({Vec3(0.2, 0.2, 0.2), Vec3(0.8, 0.8, 0.8)}, [&](std::uint32_t t) { a.push_back(t); });
  second.for_each_overlap({Vec3(0.2, 0.2, 0.2), Vec3(0.8, 0.8, 0.8)}, [&](std::uint32_t t) { b.push_back(t); });
  EXPECT_EQ(a, b);
  EXPECT_GT(a.size(), 50U);
}

TEST(Box, TouchingBoxesOverlap) {
  const Box box{Vec3(0, 0, 0), Vec3(1, 1, 1)};
  EXPECT_TRUE(box.overlaps({Vec3(1, 1, 1), Vec3(2, 2, 2)}));
  EXPECT_FALSE(box.overlaps({Vec3(1.001, 0, 0), Vec3(2, 1, 1)}));
  EXPECT_FALSE(box.overlaps(Box()));
  EXPECT_EQ(box.distance2(Vec3(2, 3, 0.5)), 5.0);
  EXPECT_EQ(box.distance2(Vec3(0.5, 0.5, 0.5)), 0.0);
}

}  // namespace
}  // namespace incise::triangle_tree_test
