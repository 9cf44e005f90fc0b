// SPDX-License-Identifier: Apache-2.0
#include "image/octree.h"

#include <gtest/gtest.h>

#include "incise/geom/quality.h"
#include "incise/mesh/defects.h"

namespace incise::octree_test {
namespace {

using image::LatticeTets;
using image::Octree;

TetSoup soup_of(const LatticeTets& tets) {
  return {tets.points, tets.tets, {}};
}

double volume_of(const LatticeTets& t) {
  double sum = 0;
  for (const auto& c : t.tets) sum += signed_volume(t.points[c[0]], t.points[c[1]], t.points[c[2]], t.points[c[3]]);
  return sum;
}

/// The volume of a box of roots, less the pyramids at its outermost faces, which stay empty.
double filled_volume(const Octree& tree, const Vec3& low, const Vec3& high) {
  double sum = 0;
  for (std::size_t n = 0; n < tree.nodes(); ++n) {
    if (!tree.is_leaf(n)) continue;
    const double s = tree.edge(n);
    sum += s * s * s;
    for (Eigen::Index a = 0; a < 3; ++a) {
      if (tree.low(n)[a] == low[a]) sum -= s * s * s / 6;
      if (tree.low(n)[a] + s == high[a]) sum -= s * s * s / 6;
    }
  }
  return sum;
}

void expect_fills(const Octree& tree, const Vec3& low, const Vec3& high) {
  const LatticeTets tets = tree.fill([](std::size_t) { return false; });
  const Defects defects = find_defects(soup_of(tets));
  EXPECT_EQ(defects.inverted + defects.zero_volume + defects.duplicate_tets + defects.duplicate_vertices, 0U);
  EXPECT_EQ(defects.overshared_faces, 0U);
  EXPECT_NEAR(volume_of(tets), filled_volume(tree, low, high), 1e-9);
  double least = 180, most = 0;
  for (const auto& c : tets.tets) {
    const auto d = dihedral_extremes_deg(tets.points[c[0]], tets.points[c[1]], tets.points[c[2]], tets.points[c[3]]);
    least = std::min(least, d.least);
    most = std::max(most, d.greatest);
  }
  EXPECT_GT(least, 44.9);
  EXPECT_LT(most, 120.1);
}

TEST(Octree, one_level_is_the_body_centred_cubic_lattice) {
  const Octree tree(Vec3(1, 2, 3), 2, {4, 3, 2}, 0);
  EXPECT_EQ(tree.nodes(), 24U);
  expect_fills(tree, Vec3(1, 2, 3), Vec3(9, 8, 7));
  // Four tets at each face between two cubes.
  EXPECT_EQ(tree.fill([](std::size_t) { return false; }).tets.size(), 4U * (3 * 3 * 2 + 4 * 2 * 2 + 4 * 3 * 1));
}

TEST(Octree, graded_lattices_conform) {
  Octree tree(Vec3(0, 0, 0), 8, {3, 3, 3}, 3);
  std::uint32_t random = 1;
  for (std::size_t n = 0; n < tree.nodes(); ++n) {
    random = random * 1664525U + 1013904223U;
    if (tree.is_leaf(n) && tree.level(n) < 3 && (random >> 24U) < 40) tree.split(n);
  }
  tree.balance();
  expect_fills(tree, Vec3(0, 0, 0), Vec3(24, 24, 24));
}

TEST(Octree, a_single_fine_leaf_is_graded_outwards) {
  Octree tree(Vec3(0, 0, 0), 1, {5, 5, 5}, 4);
  std::size_t n = 62;  // in the middle
  for (int level = 0; level < 4; ++level) {
    tree.split(n);
    n = tree.nodes() - 8;
  }
  tree.balance();
  expect_fills(tree, Vec3(0, 0, 0), Vec3(5, 5, 5));
}

TEST(Octree, nothing_is_filled_between_void_leaves) {
  const Octree tree(Vec3(0, 0, 0), 1, {3, 1, 1}, 0);
  EXPECT_EQ(tree.fill([](std::size_t n) { return n > 0; }).tets.size(), 4U);
  EXPECT_TRUE(tree.fill([](std::size_t) { return true; }).tets.empty());
}

}  // namespace
}  // namespace incise::octree_test
