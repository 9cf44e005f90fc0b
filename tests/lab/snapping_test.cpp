// SPDX-License-Identifier: Apache-2.0
#include "lab/lab_support.h"

namespace incise::test {
namespace {

TEST(Snapping, moves_a_layer_of_vertices_onto_the_plane_and_adds_no_tet) {
  const LabCut body = cut_by(LabMethod::kSnapping, kuhn_cube(5), plane_through({1, 0, 0}, 0.45));
  EXPECT_EQ(body.mesh.tet_count(), 750U);
  EXPECT_EQ(body.statistics.snapped_vertices, 36U);
  expect_pieces(body.mesh, {0.45, 0.55}, 1e-12);
  EXPECT_LT(greatest_wall_distance(body.mesh, {1, 0, 0}, 0.45), 1e-12);
  expect_sound(body.mesh);
}

TEST(Snapping, turns_no_tet_over_and_leaves_walls_beside_the_plane_instead) {
  const Vec3 normal = Vec3(3, 2, 1).normalized();
  const LabCut body = cut_by(LabMethod::kSnapping, jittered_cube(5, 3), plane_through(normal, 0.83));
  EXPECT_GT(body.statistics.bent_vertices, 0U);
  EXPECT_GT(greatest_wall_distance(body.mesh, normal, 0.83), 1e-3);
  expect_sound(body.mesh);
}

}  // namespace
}  // namespace incise::test
