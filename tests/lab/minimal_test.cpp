// SPDX-License-Identifier: Apache-2.0
#include "lab/lab_support.h"

namespace incise::test::minimal_test {
namespace {

TEST(Minimal, makes_four_children_of_a_tet_with_a_corner_cut_off_and_six_of_one_cut_in_half) {
  const TetSoup tet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
  const LabCut corner = cut_by(LabMethod::kMinimal, tet, plane_through({1, 1, 1}, 0.3));
  EXPECT_EQ(corner.mesh.tet_count(), 4U);
  const LabCut half = cut_by(LabMethod::kMinimal, tet, plane_through({1, 1, 0}, 0.4));
  EXPECT_EQ(half.mesh.tet_count(), 6U);
}

TEST(Minimal, cuts_the_cube_into_1300_tets_without_losing_volume) {
  const LabCut body = cut_by(LabMethod::kMinimal, kuhn_cube(5), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(body.mesh.tet_count(), 1300U);
  expect_pieces(body.mesh, {0.5, 0.5}, 1e-12);
  EXPECT_LT(greatest_wall_distance(body.mesh, {1, 0, 0}, 0.5), 1e-12);
  expect_sound(body.mesh);
}

}  // namespace
}  // namespace incise::test::minimal_test
