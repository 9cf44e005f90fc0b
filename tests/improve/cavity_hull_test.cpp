// SPDX-License-Identifier: Apache-2.0
// Hulls made by hand: spheres and discs, and what is neither.
#include "improve/cavity_hull.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace incise::test::cavity_hull_test {
namespace {

using Corners = std::array<std::uint32_t, 3>;

CavityHull hull_of(const std::vector<Corners>& facets) {
  CavityHull hull;
  for (const auto& [a, b, c] : facets) hull.add({VertexId(a), VertexId(b), VertexId(c)});
  return hull;
}

/// The four faces of a tet.
std::vector<Corners> tet(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return {{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}};
}

std::vector<Corners> operator+(std::vector<Corners> first, const std::vector<Corners>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TEST(CavityHull, is_simple_where_it_is_a_sphere) {
  EXPECT_TRUE(hull_of(tet(0, 1, 2, 3)).is_simple(false));
  const std::vector<Corners> two_tets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {4, 1, 2}, {4, 3, 1}, {4, 2, 3}};
  EXPECT_TRUE(hull_of(two_tets).is_simple(false));
}

TEST(CavityHull, is_simple_at_the_surface_where_it_is_a_disc) {
  const std::vector<Corners> disc = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_TRUE(hull_of(disc).is_simple(true));
  EXPECT_FALSE(hull_of(disc).is_simple(false));
  EXPECT_FALSE(hull_of(tet(0, 1, 2, 3)).is_simple(true));
}

TEST(CavityHull, is_not_simple_where_it_touches_itself_at_a_vertex) {
  EXPECT_FALSE(hull_of(tet(0, 1, 2, 3) + tet(0, 4, 5, 6)).is_simple(false));
  const std::vector<Corners> disc = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_FALSE(hull_of(disc + tet(1, 5, 6, 7)).is_simple(true));
}

TEST(CavityHull, is_not_simple_where_three_facets_meet_at_an_edge_or_there_are_two_spheres) {
  EXPECT_FALSE(hull_of(tet(0, 1, 2, 3) + tet(0, 1, 5, 6)).is_simple(false));
  EXPECT_FALSE(hull_of(tet(0, 1, 2, 3) + tet(4, 5, 6, 7)).is_simple(false));
}

}  // namespace
}  // namespace incise::test::cavity_hull_test
