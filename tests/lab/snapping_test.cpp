// SPDX-License-Identifier: Apache-2.0
#include "lab/lab_support.h"

namespace incise::test::snapping_test {
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
  Random random(4);
  std::uint64_t bent = 0;
  double distance = 0;
  for (unsigned k = 0; k < 6; ++k) {
    const Vec3 normal = random_direction(random);
    const double offset = normal.dot(Vec3(0.5, 0.55, 0.47));
    const LabCut body = cut_by(LabMethod::kSnapping, kuhn_cube(5), plane_through(normal, offset));
    expect_sound(body.mesh);
    bent += body.statistics.bent_vertices;
    distance = std::max(distance, greatest_wall_distance(body.mesh, normal, offset));
  }
  EXPECT_GT(bent, 0U);
  EXPECT_GT(distance, 0.01);
}

}  // namespace
}  // namespace incise::test::snapping_test
