// SPDX-License-Identifier: Apache-2.0
#include "image/surface_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace incise::surface_cells_test {
namespace {

using image::find_cells;
using image::SurfaceCells;
using Triangles = std::vector<SurfaceCells::Triangle>;

/// Points of a lattice of 4³, one apart.
std::vector<Vec3> lattice() {
  std::vector<Vec3> points;
  for (int v = 0; v < 64; ++v) points.emplace_back(v % 4, v / 4 % 4, v / 16);
  return points;
}

std::uint32_t number(int x, int y, int z) {
  return static_cast<std::uint32_t>(x + 4 * y + 16 * z);
}

/// The cube of edge 1 whose lowest corner is (x, y, z), turned outwards, without the sides named (0: low x, 1: high x
/// …).
Triangles cube(int x, int y, int z, std::initializer_list<int> without = {}) {
  const auto at = [&](int corner) { return number(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)); };
  constexpr int kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Triangles out;
  for (int s = 0; s < 6; ++s) {
    if (std::find(without.begin(), without.end(), s) != without.end()) continue;
    out.push_back({at(kSides[s][0]), at(kSides[s][1]), at(kSides[s][2])});
    out.push_back({at(kSides[s][0]), at(kSides[s][2]), at(kSides[s][3])});
  }
  return out;
}

Triangles operator+(Triangles a, const Triangles& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void expect_cells(const Triangles& triangles, std::size_t cells, std::size_t open) {
  const SurfaceCells found = find_cells(lattice(), triangles);
  EXPECT_EQ(found.open.size(), open);
  ASSERT_EQ(found.closed.size(), cells);
  for (const SurfaceCells::Cell& cell : found.closed) {
    EXPECT_EQ(cell.triangles.size(), 12U);
    EXPECT_NEAR(cell.volume, 1, 1e-12);
  }
}

TEST(SurfaceCells, a_cube_turned_any_way) {
  expect_cells(cube(0, 0, 0), 1, 0);
  Triangles turned = cube(0, 0, 0);
  for (std::size_t t = 0; t < turned.size(); t += 3) std::swap(turned[t][0], turned[t][1]);
  expect_cells(turned, 1, 0);
}

TEST(SurfaceCells, cubes_that_share_a_face_an_edge_or_a_point_are_told_apart) {
  expect_cells(cube(0, 0, 0) + cube(1, 0, 0, {0}), 2, 0);
  expect_cells(cube(0, 0, 0) + cube(1, 1, 0), 2, 0);
  expect_cells(cube(0, 0, 0) + cube(1, 1, 1), 2, 0);
  expect_cells(cube(0, 0, 0) + cube(1, 0, 0, {0}) + cube(0, 1, 0, {2}) + cube(1, 1, 0, {0, 2}), 4, 0);
}

TEST(SurfaceCells, fins_and_parts_with_holes_are_open) {
  const Triangles fin = {{number(1, 0, 0), number(1, 1, 0), number(3, 0, 0)}};
  expect_cells(cube(0, 0, 0) + fin, 1, 1);
  const SurfaceCells holed = find_cells(lattice(), cube(0, 0, 0, {1}));
  EXPECT_TRUE(holed.closed.empty());
  EXPECT_EQ(holed.open.size(), 10U);
  EXPECT_EQ(holed.open_edges, 4U);
  expect_cells(cube(2, 2, 2) + cube(0, 0, 0, {1}), 1, 10);
}

}  // namespace
}  // namespace incise::surface_cells_test
