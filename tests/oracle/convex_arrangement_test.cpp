// SPDX-License-Identifier: Apache-2.0
#include "oracle/convex_arrangement.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random.h"

namespace incise::oracle::convex_arrangement_test {
namespace {

constexpr double kExact = 2e-14;

using CellFilter = bool (*)(std::uint32_t, std::uint32_t, std::uint32_t);

// The chosen cells of an n × n × n grid over the unit cube, six tets each.
Body grid(
    std::uint32_t n, CellFilter is_solid = [](std::uint32_t, std::uint32_t, std::uint32_t) { return true; }) {
  Body body;
  const auto vertex = [n](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return i + (n + 1) * (j + (n + 1) * k);
  };
  for (std::uint32_t k = 0; k <= n; ++k) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) body.points.emplace_back(Vec3(i, j, k) / n);
    }
  }
  for (std::uint32_t k = 0; k < n; ++k) {
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        if (!is_solid(i, j, k)) continue;
        std::array<std::size_t, 3> axes = {0, 1, 2};
        do {
          std::array<std::uint32_t, 3> at = {i, j, k};
          std::array<std::uint32_t, 4> tet = {vertex(i, j, k), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[axes[s]];
            tet[s + 1] = vertex(at[0], at[1], at[2]);
          }
          body.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  return body;
}

void expect_volumes(const Arrangement& found, std::vector<double> expected) {
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(found.volumes.size(), expected.size());
  double total = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found.volumes[i], expected[i], kExact);
    total += expected[i];
  }
  EXPECT_NEAR(found.total, total, kExact);
  EXPECT_LT(found.crumb_volume, kExact);
}

TEST(ConvexArrangement, WithoutPlanesABodyIsOnePiece) {
  for (const std::uint32_t n : {1U, 3U}) expect_volumes(arrange(grid(n), {}), {1.0});
  expect_volumes(arrange(Body(), {}), {});
}

TEST(ConvexArrangement, PlanesBesideTheBodyDoNothing) {
  expect_volumes(arrange(grid(2), {{Vec3(1, 2, 3), 7.0}, {Vec3(1, 0, 0), -1.0}}), {1.0});
  // Planes in its faces, and through a corner only.
  expect_volumes(arrange(grid(2), {{Vec3(1, 0, 0), 0.0}, {Vec3(0, 2, 0), 2.0}, {Vec3(1, 1, 1), 3.0}}), {1.0});
}

TEST(ConvexArrangement, AxisPlanesMakeBoxes) {
  std::vector<double> expected;
  for (const double x : {0.3, 0.7}) {
    for (const double y : {0.45, 0.55}) {
      for (const double z : {0.9, 0.1}) expected.push_back(x * y * z);
    }
  }
  for (const std::uint32_t n : {1U, 2U, 5U}) {
    expect_volumes(arrange(grid(n), {{Vec3(1, 0, 0), 0.3}, {Vec3(0, -2, 0), -0.9}, {Vec3(0, 0, 1), 0.9}}), expected);
  }
}

TEST(ConvexArrangement, PlanesInMeshFacesSeparate) {
  expect_volumes(arrange(grid(5), {{Vec3(1, 0, 0), 0.4}}), {0.4, 0.6});
  expect_volumes(arrange(grid(5), {{Vec3(1, -1, 0), 0.0}}), {0.5, 0.5});
  // One ulp beside: no sliver.
  expect_volumes(arrange(grid(5), {{Vec3(1, 0, 0), std::nextafter(0.4, 1.0)}}), {0.4, 0.6});
}

TEST(ConvexArrangement, ObliquePlanesCutOffCorners) {
  for (const std::uint32_t n : {1U, 3U, 4U, 5U}) {
    expect_volumes(arrange(grid(n), {{Vec3(1, 1, 1), 1.5}}), {0.5, 0.5});
    expect_volumes(arrange(grid(n), {{Vec3(1, 1, 1), 1.0}}), {1.0 / 6, 5.0 / 6});
    expect_volumes(arrange(grid(n), {{Vec3(1, 1, 1), 0.3}}), {0.027 / 6, 1 - 0.027 / 6});
    expect_volumes(arrange(grid(n), {{Vec3(3, 3, 3), 3.0}, {Vec3(-1, -1, -1), -2.0}}), {1.0 / 6, 4.0 / 6, 1.0 / 6});
  }
}

TEST(ConvexArrangement, CrossingPlanesMakeFourPieces) {
  for (const std::uint32_t n : {1U, 2U, 5U}) {
    expect_volumes(arrange(grid(n), {{Vec3(1, -1, 0), 0.0}, {Vec3(1, 1, 0), 1.0}}), {0.25, 0.25, 0.25, 0.25});
    expect_volumes(arrange(grid(n), {{Vec3(1, 0, 0), 0.37}, {Vec3(0, 1, 0), 0.61}}),
                   {0.37 * 0.61, 0.63 * 0.61, 0.37 * 0.39, 0.63 * 0.39});
  }
}

TEST(ConvexArrangement, SixPlanesThroughTheMiddleMakeTwentyFourEqualPieces) {
  // The mirror planes x = ±y, y = ±z, z = ±x of the cube.
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double s : {-1.0, 1.0}) {
      Vec3 normal = Vec3::Zero();
      normal[static_cast<Eigen::Index>(i)] = 1.0;
      normal[static_cast<Eigen::Index>((i + 1) % 3)] = s;
      planes.push_back({normal, 0.5 * (1 + s)});
    }
  }
  for (const std::uint32_t n : {1U, 2U, 3U})
    expect_volumes(arrange(grid(n), planes), std::vector<double>(24, 1.0 / 24));
}

TEST(ConvexArrangement, TheSamePlaneTwiceCutsOnce) {
  const Plane plane{Vec3(1, 2, 3), 2.9};
  const Arrangement once = arrange(grid(3), {plane});
  EXPECT_EQ(once.piece_count(), 2U);
  expect_volumes(arrange(grid(3), {plane, plane, {-2 * plane.normal, -2 * plane.offset}}), once.volumes);
}

TEST(ConvexArrangement, OnePlaneMayMakeThreePiecesOfANonConvexBody) {
  // Two arms on a base: a U of 3 × 3 × 3 cells.
  const Body u = grid(3, [](std::uint32_t i, std::uint32_t j, std::uint32_t) { return j == 0 || i != 1; });
  expect_volumes(arrange(u, {}), {7.0 / 9});
  expect_volumes(arrange(u, {{Vec3(0, 1, 0), 0.5}}), {1.0 / 6, 1.0 / 6, 4.0 / 9});
  // Below the arms nothing but the base is cut.
  expect_volumes(arrange(u, {{Vec3(0, 1, 0), 0.25}}), {0.25, 7.0 / 9 - 0.25});
  // In the plane where the arms begin.
  expect_volumes(arrange(u, {{Vec3(0, 1, 0), 1.0 / 3}}), {2.0 / 9, 2.0 / 9, 1.0 / 3});
}

TEST(ConvexArrangement, ContactAlongAnEdgeOrInAPointDoesNotJoin) {
  const Body edge = grid(2, [](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return k == 0 && i == j; });
  expect_volumes(arrange(edge, {}), {0.125, 0.125});
  const Body corner = grid(2, [](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return i == j && j == k; });
  expect_volumes(arrange(corner, {{Vec3(1, 0, 0), 0.25}}), {0.0625, 0.0625, 0.125});
}

TEST(ConvexArrangement, ScaleAndPlaceDoNotMatter) {
  const Body unit = grid(2);
  for (const double scale : {0.01, 1000.0}) {
    Body body = unit;
    for (Vec3& p : body.points) p = scale * (p + Vec3(1, -2, 3));
    const Vec3 normal(1, 2, -0.5);
    const Arrangement found = arrange(body, {{normal, scale * (0.9 + normal.dot(Vec3(1, -2, 3)))}});
    const Arrangement expected = arrange(unit, {{normal, 0.9}});
    ASSERT_EQ(found.piece_count(), expected.piece_count());
    for (std::size_t i = 0; i < found.volumes.size(); ++i) {
      EXPECT_NEAR(found.volumes[i] / (scale * scale * scale), expected.volumes[i], 1e-13);
    }
  }
}

bool is_in_cube(const Vec3& p) {
  return p.minCoeff() > 0 && p.maxCoeff() < 1;
}

// Whether the line in which two planes meet passes through the open unit cube.
bool line_meets_cube(const Plane& a, const Plane& b) {
  const Vec3 direction = a.normal.cross(b.normal);
  Eigen::Matrix3d m;
  m << a.normal.transpose(), b.normal.transpose(), direction.transpose();
  const Vec3 origin = m.partialPivLu().solve(Vec3(a.offset, b.offset, 0));
  double from = -std::numeric_limits<double>::infinity(), to = -from;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double s = -origin[k] / direction[k], t = (1 - origin[k]) / direction[k];
    from = std::max(from, std::min(s, t));
    to = std::min(to, std::max(s, t));
  }
  return from < to;
}

TEST(ConvexArrangement, RandomPlanesMakeAsManyPiecesAsTheirIntersectionsSay) {
  // In a convex body planes in general position make 1 + planes + lines + points pieces, of those that meet it.
  test::Random random(1);
  for (int run = 0; run < 60; ++run) {
    std::vector<Plane> planes;
    for (int i = 0; i < 1 + run % 6; ++i) {
      const Vec3 normal = random.point(-1, 1);
      planes.push_back({normal, normal.dot(random.point(0.2, 0.8))});
    }
    std::size_t expected = 1 + planes.size();
    for (std::size_t i = 0; i < planes.size(); ++i) {
      for (std::size_t j = i + 1; j < planes.size(); ++j) {
        expected += line_meets_cube(planes[i], planes[j]) ? 1U : 0U;
        for (std::size_t k = j + 1; k < planes.size(); ++k) {
          Eigen::Matrix3d m;
          m << planes[i].normal.transpose(), planes[j].normal.transpose(), planes[k].normal.transpose();
          const Vec3 point = m.partialPivLu().solve(Vec3(planes[i].offset, planes[j].offset, planes[k].offset));
          expected += is_in_cube(point) ? 1U : 0U;
        }
      }
    }
    const Arrangement coarse = arrange(grid(1), planes), fine = arrange(grid(3), planes);
    EXPECT_EQ(coarse.piece_count(), expected);
    expect_volumes(fine, coarse.volumes);
    EXPECT_EQ(fine.crumbs, 0U);
  }
}

}  // namespace
}  // namespace incise::oracle::convex_arrangement_test
