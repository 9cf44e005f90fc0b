// SPDX-License-Identifier: Apache-2.0
#include "lab/lab_support.h"

namespace incise::test::bielser_test {
namespace {

const TetSoup kTet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
const Vec3 kCorner(1, 1, 1), kHalf(1, 1, 0);

TEST(Seventeen, makes_17_parts_of_a_tet_whether_a_corner_is_cut_off_or_a_half) {
  const LabCut corner = cut_by(LabMethod::kSeventeen, kTet, plane_through(kCorner, 0.3));
  EXPECT_EQ(corner.mesh.tet_count(), 17U);
  EXPECT_EQ(find_components(corner.mesh).count(), 2U);
  const LabCut half = cut_by(LabMethod::kSeventeen, kTet, plane_through(kHalf, 0.4));
  EXPECT_EQ(half.mesh.tet_count(), 17U);
  EXPECT_EQ(find_components(half.mesh).count(), 2U);
  expect_sound(half.mesh);
}

TEST(Seventeen, has_walls_a_tenth_of_an_edge_beside_the_sheet_at_most) {
  const LabCut body = cut_by(LabMethod::kSeventeen, kuhn_cube(5), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(find_components(body.mesh).count(), 2U);
  EXPECT_GT(greatest_wall_distance(body.mesh, {1, 0, 0}, 0.5), 1e-3);
  EXPECT_LT(greatest_wall_distance(body.mesh, {1, 0, 0}, 0.5), 0.1 * 0.2);
  expect_sound(body.mesh);
}

TEST(Seventeen, adds_16_tets_for_each_that_is_crossed_and_more_beside_them) {
  const LabCut body = cut_by(LabMethod::kSeventeen, kuhn_cube(5), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(body.statistics.cut_tets, 150U);
  EXPECT_GT(body.mesh.tet_count(), 750U + 16U * 150U);
}

TEST(Adaptive, makes_11_parts_of_a_tet_with_a_corner_cut_off_and_15_of_one_cut_in_half) {
  const LabCut corner = cut_by(LabMethod::kAdaptive, kTet, plane_through(kCorner, 0.3));
  EXPECT_EQ(corner.mesh.tet_count(), 11U);
  expect_pieces(corner.mesh, {0.3 * 0.3 * 0.3 / 6, (1 - 0.3 * 0.3 * 0.3) / 6}, 1e-12);
  const LabCut half = cut_by(LabMethod::kAdaptive, kTet, plane_through(kHalf, 0.4));
  EXPECT_EQ(half.mesh.tet_count(), 15U);
  EXPECT_EQ(find_components(half.mesh).count(), 2U);
  expect_sound(half.mesh);
}

TEST(Adaptive, leaves_tets_beside_the_cut_as_they_are_and_walls_on_the_sheet) {
  const LabCut body = cut_by(LabMethod::kAdaptive, kuhn_cube(5), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(body.statistics.cut_tets, 150U);
  EXPECT_EQ(body.mesh.tet_count(), 600U + 100U * 11U + 50U * 15U);
  EXPECT_LT(greatest_wall_distance(body.mesh, {1, 0, 0}, 0.5), 1e-12);
  expect_pieces(body.mesh, {0.5, 0.5}, 1e-12);
  expect_sound(body.mesh);
}

TEST(Adaptive, leaves_tets_that_the_blade_ends_in_whole_and_divides_what_shares_points_with_its_neighbours) {
  const Stroke stroke = quad_stroke({-0.1, 0.43, -0.1}, {0.57, 0.43, -0.1}, {0.57, 0.43, 1.1}, {-0.1, 0.43, 1.1});
  const LabCut body = cut_by(LabMethod::kAdaptive, kuhn_cube(5), stroke);
  EXPECT_EQ(find_components(body.mesh).count(), 1U);
  EXPECT_GT(wall_area(body.mesh, 1), 0.3);
  EXPECT_NEAR(volume_of(body.mesh), 1.0, 1e-12);
  expect_sound(body.mesh);
}

}  // namespace
}  // namespace incise::test::bielser_test
