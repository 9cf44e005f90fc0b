// SPDX-License-Identifier: Apache-2.0
#include "lab/lab_support.h"

namespace incise::test::moving_test {
namespace {

TEST(Moving, moves_a_near_layer_onto_the_plane_and_divides_nothing) {
  const LabCut body = cut_by(LabMethod::kMoving, kuhn_cube(5), plane_through({1, 0, 0}, 0.45));
  EXPECT_EQ(body.mesh.tet_count(), 750U);
  EXPECT_EQ(body.statistics.snapped_vertices, 36U);
  expect_pieces(body.mesh, {0.45, 0.55}, 1e-12);
  expect_sound(body.mesh);
}

TEST(Moving, divides_what_is_crossed_far_from_all_vertices) {
  const LabCut body = cut_by(LabMethod::kMoving, kuhn_cube(5), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(body.mesh.tet_count(), 1300U);
  EXPECT_EQ(body.statistics.snapped_vertices, 0U);
  expect_pieces(body.mesh, {0.5, 0.5}, 1e-12);
}

TEST(Moving, adds_fewer_tets_than_division_alone_and_has_walls_on_the_sheet) {
  const Vec3 normal = Vec3(1, 2, 0.5).normalized();
  const Stroke plane = plane_through(normal, 0.8);
  const LabCut moved = cut_by(LabMethod::kMoving, kuhn_cube(5), plane);
  const LabCut divided = cut_by(LabMethod::kMinimal, kuhn_cube(5), plane);
  EXPECT_LT(moved.mesh.tet_count(), divided.mesh.tet_count());
  EXPECT_GT(moved.mesh.tet_count(), 750U);
  EXPECT_LT(greatest_wall_distance(moved.mesh, normal, 0.8), 1e-6);
  EXPECT_EQ(find_components(moved.mesh).count(), 2U);
  expect_sound(moved.mesh);
}

}  // namespace
}  // namespace incise::test::moving_test
