// SPDX-License-Identifier: Apache-2.0
#include "lab/lab_support.h"

namespace incise::test::removal_test {
namespace {

TEST(Removal, takes_the_layer_of_elements_that_the_plane_passes_through) {
  const LabCut body = cut_by(LabMethod::kRemoval, kuhn_cube(5), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(body.mesh.tet_count(), 750U - 150U);
  EXPECT_EQ(body.statistics.cut_tets, 150U);
  EXPECT_NEAR(volume_of(body.mesh), 0.8, 1e-12);
  expect_pieces(body.mesh, {0.4, 0.4}, 1e-12);
  EXPECT_NEAR(wall_area(body.mesh, 1), 1.0, 1e-12);  // of one lip
  expect_sound(body.mesh);
}

TEST(Removal, leaves_no_vertex_without_tets) {
  const LabCut body = cut_by(LabMethod::kRemoval, kuhn_cube(1), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(body.mesh.tet_count(), 0U);
  EXPECT_EQ(body.mesh.vertex_count(), 0U);
}

TEST(Removal, parts_what_hangs_at_vertices_and_edges_alone) {
  LabCut body{build(kuhn_cube(4)), {}, {}};
  cut_on(body, LabMethod::kRemoval, plane_through({1, 1, 1}, 1.4), 1);
  cut_on(body, LabMethod::kRemoval, plane_through({1, -1, 0.3}, 0.1), 2);
  expect_sound(body.mesh);
}

}  // namespace
}  // namespace incise::test::removal_test
