// SPDX-License-Identifier: Apache-2.0
#include "image/peel_flat.h"

#include <gtest/gtest.h>

#include "image/octree.h"
#include "incise/geom/quality.h"
#include "incise/mesh/defects.h"

namespace incise::peel_flat_test {
namespace {

using image::LabelledTets;

/// The tets of a lattice with the middle in a ball, their skin pressed onto it.
LabelledTets pressed_ball(std::int32_t n, double radius) {
  const image::Octree tree(Vec3(0, 0, 0), 1, {n, n, n}, 0);
  image::LatticeTets lattice = tree.fill([](std::size_t) { return false; });
  LabelledTets mesh = {std::move(lattice.points), std::move(lattice.tets), {}};
  const Vec3 middle = Vec3::Constant(0.5 * n);
  for (const auto& tet : mesh.tets) {
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t p : tet) sum += 0.25 * mesh.points[p];
    mesh.labels.push_back((sum - middle).norm() < radius ? 1 : 0);
  }
  mesh.drop_background();
  const auto neighbours = image::find_neighbours(mesh);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t s = 0; s < 4; ++s) {
      for (std::size_t i = 0; i < 4 && neighbours[t][s] == image::kNoTet; ++i) {
        Vec3& p = mesh.points[mesh.tets[t][i]];
        if (i != s) p = middle + radius * (p - middle).normalized();
      }
    }
  }
  return mesh;
}

std::size_t count_flat(const LabelledTets& mesh) {
  std::size_t flat = 0;
  for (const auto& c : mesh.tets) {
    const auto d = dihedral_extremes_deg(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]);
    flat += d.greatest > 165 ? 1U : 0U;
  }
  return flat;
}

Defects defects_of(const LabelledTets& mesh) {
  TetSoup soup;
  soup.points = mesh.points;
  soup.tets = mesh.tets;
  return find_defects(soup);
}

TEST(PeelFlat, flat_tets_go_and_the_skin_stays_a_manifold) {
  LabelledTets mesh = pressed_ball(12, 4.4);
  const std::size_t flat = count_flat(mesh), tets = mesh.tets.size();
  ASSERT_GT(flat, 10U);
  ASSERT_EQ(defects_of(mesh).nonmanifold_edges, 0U);
  std::uint64_t peeled = 0;
  for (int pass = 0; pass < 6; ++pass) peeled += image::peel_flat_tets(mesh);
  EXPECT_GT(peeled, 0U);
  EXPECT_LE(mesh.tets.size(), tets - peeled);  // a cap may go with a flat tet
  EXPECT_LT(count_flat(mesh), flat / 2);
  const Defects after = defects_of(mesh);
  EXPECT_EQ(after.nonmanifold_edges + after.singleton_vertices + after.unreferenced_vertices, 0U);
  EXPECT_EQ(after.components, 1U);
}

/// A flat tet over the edge from point 0 to point 1, on two others of its label; under the edge lies one of `below`.
LabelledTets bridge(std::int32_t below) {
  LabelledTets mesh;
  mesh.points = {Vec3(0, -1, 0),    Vec3(0, 1, 0),   Vec3(1, 0, 0.1), Vec3(-1, 0, 0.1), Vec3(0.6, 0, -1),
                 Vec3(-0.6, 0, -1), Vec3(3, -2, -1), Vec3(3, 2, -1),  Vec3(-3, -2, -1), Vec3(-3, 2, -1)};
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 4, 2}, {0, 1, 3, 5}, {0, 1, 5, 4},   // around the edge
               {0, 2, 4, 6}, {1, 4, 2, 7}, {0, 5, 3, 8}, {1, 3, 5, 9}};  // so that those below have no skin
  mesh.labels = {1, 1, 1, static_cast<decltype(mesh.labels)::value_type>(below), 1, 1, 1, 1};
  return mesh;
}

TEST(PeelFlat, a_flat_tet_that_joins_its_label_over_another_one_stays) {
  LabelledTets whole = bridge(1), parted = bridge(2);
  EXPECT_EQ(image::peel_flat_tets(whole), 1U);
  EXPECT_EQ(image::peel_flat_tets(parted), 0U);
}

TEST(PeelFlat, tets_of_good_shape_stay) {
  const image::Octree tree(Vec3(0, 0, 0), 1, {6, 6, 6}, 0);
  image::LatticeTets lattice = tree.fill([](std::size_t) { return false; });
  LabelledTets mesh = {std::move(lattice.points), std::move(lattice.tets), {}};
  mesh.labels.assign(mesh.tets.size(), 1);
  EXPECT_EQ(image::peel_flat_tets(mesh), 0U);
}

}  // namespace
}  // namespace incise::peel_flat_test
