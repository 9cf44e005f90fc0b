// SPDX-License-Identifier: Apache-2.0
// What a vertex is part of and how it may move, and the moves that keep the volume.
#include "improve/surfaces.h"

#include "improve/support.h"

namespace incise::test::surfaces_test {
namespace {

VertexSurfaces surfaces_near(const TetMesh& mesh, const Vec3& place) {
  const VertexId v = nearest_vertex(mesh, place);
  EXPECT_LT((mesh.rest(v) - place).norm(), 1e-12);
  return surfaces_at(mesh, v, star_of(mesh, v));
}

/// Whether two directions agree but for their sign.
void expect_along(const Vec3& found, const Vec3& expected) {
  EXPECT_NEAR(std::abs(found.dot(expected)), 1.0, 1e-12);
  EXPECT_NEAR(found.norm(), 1.0, 1e-12);
}

TetMesh cube_with_regions() {
  TetSoup soup = kuhn_cube(4);
  for (const auto& tet : soup.tets) {
    const double x =
        0.25 * (soup.points[tet[0]].x() + soup.points[tet[1]].x() + soup.points[tet[2]].x() + soup.points[tet[3]].x());
    soup.regions.push_back(x < 0.5 ? 1 : 2);
  }
  return build(std::move(soup));
}

/// A cube cut along x = 0.5, on faces of the mesh, up to the height 0.5: without snapping, what lies in the sheet is
/// taken as far as the faces go.
TetMesh cube_with_slit() {
  return cut_mesh(kuhn_cube(4),
                  quad_stroke(Vec3(0.5, -0.1, -0.1), Vec3(0.5, 1.1, -0.1), Vec3(0.5, -0.1, 0.55), Vec3(0.5, 1.1, 0.55)),
                  0);
}

// --- what a vertex is part of
// ------------------------------------------------------------------------------------------------

TEST(Surfaces, of_an_interior_vertex_are_none) {
  const VertexSurfaces found = surfaces_near(build(kuhn_cube(4)), Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(found.count, 0U);
  EXPECT_EQ(found.mobility, Mobility::kFree);
  EXPECT_TRUE(found.is_flat());
  EXPECT_FALSE(found.is_front());
}

TEST(Surfaces, of_flat_skin_are_one_plane_with_its_normal) {
  const VertexSurfaces found = surfaces_near(build(kuhn_cube(4)), Vec3(0.5, 0.5, 0));
  EXPECT_EQ(found.count, 1U);
  EXPECT_EQ(found.mobility, Mobility::kSurface);
  EXPECT_TRUE(found.is_flat());
  EXPECT_EQ(found.surfaces[0].tag, 0U);
  EXPECT_EQ(found.along, Vec3(0, 0, -1));
  EXPECT_NEAR((found.surfaces[0].vector_area - Vec3(0, 0, -6 * 0.0625)).norm(), 0, 1e-15);
}

TEST(Surfaces, of_a_cubes_edge_are_two_with_a_line) {
  const VertexSurfaces found = surfaces_near(build(kuhn_cube(4)), Vec3(0.5, 0, 0));
  EXPECT_EQ(found.count, 2U);
  EXPECT_EQ(found.mobility, Mobility::kLine);
  EXPECT_TRUE(found.is_flat());
  expect_along(found.along, Vec3(1, 0, 0));
}

TEST(Surfaces, of_a_cubes_corner_are_too_many_to_move) {
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(1, 0, 1)}) {
    const VertexSurfaces found = surfaces_near(build(kuhn_cube(4)), corner);
    EXPECT_GT(found.count, 2U);
    EXPECT_EQ(found.mobility, Mobility::kFixed);
  }
}

TEST(Surfaces, of_curved_skin_are_one_that_is_not_flat) {
  const TetMesh mesh = build(ball(8));
  unsigned curved = 0;
  mesh.for_each_vertex([&](VertexId v) {
    const VertexSurfaces found = surfaces_at(mesh, v, star_of(mesh, v));
    if ((mesh.shape_of(v) & shape::kSkin) == 0) {
      EXPECT_EQ(found.mobility, Mobility::kFree);
    } else if (found.count == 1) {
      ++curved;
      EXPECT_FALSE(found.is_flat());
      EXPECT_GT(found.along.dot(mesh.rest(v)), 0.8);
    }
  });
  EXPECT_GT(curved, 300U);
}

TEST(Surfaces, of_a_cut_wall_carry_its_tag) {
  const TetMesh mesh = cut_mesh(kuhn_cube(4), {{Vec3(1, 0, 0), 0.5}}, 0.2);
  const VertexSurfaces found = surfaces_near(mesh, Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(found.count, 1U);
  EXPECT_EQ(found.surfaces[0].tag, 1U);
  EXPECT_EQ(found.mobility, Mobility::kSurface);
  expect_along(found.along, Vec3(1, 0, 0));
}

TEST(Surfaces, of_a_contour_are_skin_and_wall_and_their_line) {
  const TetMesh mesh = cut_mesh(kuhn_cube(4), {{Vec3(1, 0, 0), 0.5}}, 0.2);
  const VertexSurfaces found = surfaces_near(mesh, Vec3(0.5, 0.5, 0));
  EXPECT_EQ(found.count, 2U);
  EXPECT_EQ(found.mobility, Mobility::kLine);
  EXPECT_NE(found.surfaces[0].tag, found.surfaces[1].tag);
  expect_along(found.along, Vec3(0, 1, 0));
  EXPECT_EQ(surfaces_near(mesh, Vec3(0.5, 0, 0)).mobility, Mobility::kFixed);
}

TEST(Surfaces, where_two_cuts_cross_are_two_walls_and_their_line) {
  const TetMesh mesh = cut_mesh(kuhn_cube(4), {{Vec3(1, 0, 0), 0.5}, {Vec3(0, 1, 0), 0.5}}, 0.2);
  const VertexSurfaces found = surfaces_near(mesh, Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(found.count, 2U);
  EXPECT_EQ(found.mobility, Mobility::kLine);
  expect_along(found.along, Vec3(0, 0, 1));
}

TEST(Surfaces, of_a_front_are_both_lips_and_its_direction) {
  const TetMesh mesh = cube_with_slit();
  const VertexSurfaces found = surfaces_near(mesh, Vec3(0.5, 0.5, 0.5));
  ASSERT_TRUE(found.is_front());
  EXPECT_EQ(found.count, 2U);
  EXPECT_EQ(found.mobility, Mobility::kLine);
  EXPECT_EQ(found.surfaces[0].tag, found.surfaces[1].tag);
  expect_along(found.along, Vec3(0, 1, 0));
  for (const VertexId end : found.front_ends) {
    EXPECT_NEAR(std::abs(mesh.rest(end).y() - 0.5), 0.25, 1e-12);
    EXPECT_EQ(mesh.rest(end).z(), 0.5);
  }
  const VertexId v = nearest_vertex(mesh, Vec3(0.5, 0.5, 0.5));
  EXPECT_TRUE(keeps_front(mesh, mesh.rest(v), found, 1e-9));
  EXPECT_FALSE(keeps_front(mesh, mesh.rest(v) + Vec3(0.01, 0, 0), found, 1e-9));
}

TEST(Surfaces, where_a_front_meets_the_skin_hold_the_vertex) {
  EXPECT_EQ(surfaces_near(cube_with_slit(), Vec3(0.5, 0, 0.5)).mobility, Mobility::kFixed);
}

TEST(Surfaces, of_a_border_between_regions_are_a_surface_like_a_wall) {
  const TetMesh mesh = cube_with_regions();
  const VertexSurfaces inside = surfaces_near(mesh, Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(inside.count, 1U);
  EXPECT_EQ(inside.surfaces[0].tag, kBorderTag);
  EXPECT_EQ(inside.mobility, Mobility::kSurface);
  expect_along(inside.along, Vec3(1, 0, 0));
  EXPECT_NEAR(inside.surfaces[0].vector_area.norm(), 6 * 0.0625, 1e-14);
  const VertexSurfaces at_skin = surfaces_near(mesh, Vec3(0.5, 0.5, 0));
  EXPECT_EQ(at_skin.count, 2U);
  EXPECT_EQ(at_skin.mobility, Mobility::kLine);
  expect_along(at_skin.along, Vec3(0, 1, 0));
  EXPECT_EQ(surfaces_near(mesh, Vec3(0.25, 0.5, 0.5)).mobility, Mobility::kFree);
}

TEST(Surfaces, of_a_vertex_pinched_at_load_do_not_let_it_go) {
  const TetMesh mesh = build(
      {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)},
       {{0, 1, 2, 3}, {0, 5, 4, 6}},
       {}});
  ASSERT_NE(mesh.shape_of(VertexId(0)) & shape::kPinched, 0);
  EXPECT_EQ(surfaces_at(mesh, VertexId(0), star_of(mesh, VertexId(0))).mobility, Mobility::kFixed);
}

TEST(Surfaces, tell_folds_from_bends) {
  const auto count_at = [](double height) {
    VertexSurfaces found;
    add_face(found, 0, Vec3(0, 0, 1));
    add_face(found, 0, Vec3(0, height, 1));
    decide_mobility(found);
    return found.count;
  };
  EXPECT_EQ(count_at(0.0), 1U);
  EXPECT_EQ(count_at(1.0), 1U);
  EXPECT_EQ(count_at(6.0), 2U);
}

TEST(Surfaces, of_walls_are_one_whichever_stroke_cut_them) {
  VertexSurfaces found;
  add_face(found, 2, Vec3(0, 0, 1));
  add_face(found, 3, Vec3(0, 0, 1));
  decide_mobility(found);
  EXPECT_EQ(found.count, 1U);
  EXPECT_EQ(found.mobility, Mobility::kSurface);
  EXPECT_FALSE(are_alike(0, 3));
  EXPECT_FALSE(are_alike(kBorderTag, 3));
}

TEST(Surfaces, tell_skin_from_walls_even_in_one_plane) {
  VertexSurfaces found;
  add_face(found, 0, Vec3(0, 0, 1));
  add_face(found, 3, Vec3(0, 0, 1));
  decide_mobility(found);
  EXPECT_EQ(found.count, 2U);
  EXPECT_EQ(found.mobility, Mobility::kFixed);
  EXPECT_EQ(found.find(3, Vec3(0, 0, 1)), 1U);
  EXPECT_EQ(found.find(3, Vec3(0, 0, -1)), 2U);
  EXPECT_EQ(found.find(kBorderTag, Vec3(0, 0, 1)), 2U);
}

TEST(Surfaces, pass_over_faces_without_area) {
  VertexSurfaces found;
  add_face(found, 0, Vec3::Zero());
  decide_mobility(found);
  EXPECT_EQ(found.count, 0U);
  EXPECT_EQ(found.mobility, Mobility::kFree);
}

// --- moves that keep the volume
// ----------------------------------------------------------------------------------------------

/// Moves a vertex where all tets stay positive; false where they would not.
bool try_move(TetMesh& mesh, VertexId v, const Vec3& place) {
  const MoveVertexPlan plan = plan_move_vertex(mesh, v, place);
  if (!plan) return false;
  Transaction transaction(mesh, true);
  apply(transaction, plan);
  transaction.commit();
  return true;
}

// T30
TEST(VolumeKeepingMoves, orthogonal_to_the_vector_area_keep_a_closed_surfaces_volume) {
  TetMesh mesh = build(ball(8));
  Random random(1);
  for (const VertexId v : vertices_of(mesh)) {
    if ((mesh.shape_of(v) & shape::kSkin) != 0) try_move(mesh, v, random.real(0.95, 1.05) * mesh.rest(v));
  }
  const double volume = volume_of(mesh);
  unsigned moved = 0;
  for (unsigned round = 0; round < 10; ++round) {
    for (const VertexId v : vertices_of(mesh)) {
      const VertexSurfaces found = surfaces_at(mesh, v, star_of(mesh, v));
      if (found.mobility != Mobility::kSurface) continue;
      const Vec3 step = random.point(-0.03, 0.03);
      if (try_move(mesh, v, mesh.rest(v) + step - found.along.dot(step) * found.along)) ++moved;
    }
  }
  EXPECT_GT(moved, 2000U);
  EXPECT_NEAR(volume_of(mesh), volume, 1e-13 * volume);
  expect_valid(mesh, volume, 1e-13);
}

TEST(VolumeKeepingMoves, along_contours_keep_the_volume_of_every_piece) {
  TetMesh mesh = cut_mesh(ball(8), {{Vec3(0.3, 0.5, 0.9), 0.1}, {Vec3(1, 0.2, -0.3), 0.05}}, 0.2);
  const std::vector<double> volumes = piece_volumes(mesh);
  Random random(2);
  unsigned moved = 0;
  for (unsigned round = 0; round < 20; ++round) {
    for (const VertexId v : vertices_of(mesh)) {
      const VertexSurfaces found = surfaces_at(mesh, v, star_of(mesh, v));
      if (found.mobility != Mobility::kLine || found.is_front()) continue;
      // Orthogonal to both vector areas: for curved surfaces that is not `along`'s mean line alone.
      const Vec3 line = found.surfaces[0].vector_area.cross(found.surfaces[1].vector_area).normalized();
      EXPECT_GT(std::abs(line.dot(found.along)), 1 - 1e-9);
      if (try_move(mesh, v, mesh.rest(v) + random.real(-0.01, 0.01) * found.along)) ++moved;
    }
  }
  EXPECT_GT(moved, 300U);
  expect_pieces(mesh, volumes, 1e-12);
  expect_valid(mesh, volume_of(mesh));
}

TEST(VolumeStep, gives_a_surface_its_volume_back) {
  TetMesh mesh = build(ball(6));
  const double volume = volume_of(mesh);
  Random random(3);
  unsigned tried = 0;
  for (const VertexId v : vertices_of(mesh)) {
    const Vec3 home = mesh.rest(v);
    const VertexSurfaces found = surfaces_at(mesh, v, star_of(mesh, v));
    if (found.count != 1 || !try_move(mesh, v, home + random.point(-0.02, 0.02))) continue;
    const VertexSurfaces displaced = surfaces_at(mesh, v, star_of(mesh, v));
    Vec3 step;
    ASSERT_TRUE(find_volume_step(displaced, {6.0 * (volume - volume_of(mesh)), 0.0}, step));
    EXPECT_LT(step.cross(displaced.surfaces[0].vector_area).norm(), 1e-15);
    ASSERT_TRUE(try_move(mesh, v, mesh.rest(v) + step));
    EXPECT_NEAR(volume_of(mesh), volume, 1e-14 * volume);
    try_move(mesh, v, home);
    ++tried;
  }
  EXPECT_GT(tried, 100U);
  expect_valid(mesh, volume);
}

TEST(VolumeStep, gives_each_of_two_surfaces_its_own_volume_back) {
  const TetMesh mesh = cut_mesh(ball(6), {{Vec3(0.3, 0.5, 0.9), 0.1}}, 0.2);
  Random random(4);
  unsigned tried = 0;
  mesh.for_each_vertex([&](VertexId v) {
    const VertexSurfaces found = surfaces_at(mesh, v, star_of(mesh, v));
    if (found.count != 2 || found.mobility != Mobility::kLine) return;
    const std::array<double, 2> lost6 = {random.real(-1, 1), random.real(-1, 1)};
    Vec3 step;
    ASSERT_TRUE(find_volume_step(found, lost6, step));
    EXPECT_NEAR(step.dot(found.surfaces[0].vector_area), lost6[0], 1e-12);
    EXPECT_NEAR(step.dot(found.surfaces[1].vector_area), lost6[1], 1e-12);
    EXPECT_LT(std::abs(step.dot(found.along)), 1e-6 * step.norm()) << "longer than needed";
    ++tried;
  });
  EXPECT_GT(tried, 20U);
}

TEST(VolumeStep, is_refused_without_surfaces_on_three_and_on_parallel_ones) {
  Vec3 step;
  VertexSurfaces found;
  EXPECT_FALSE(find_volume_step(found, {1.0, 0.0}, step));
  add_face(found, 0, Vec3(0, 0, 1));
  add_face(found, 1, Vec3(0, 0.05, -1));
  EXPECT_EQ(found.count, 2U);
  EXPECT_FALSE(find_volume_step(found, {1.0, 0.0}, step));
  add_face(found, 2, Vec3(0, 1, 0));
  EXPECT_FALSE(find_volume_step(found, {1.0, 0.0}, step));
}

}  // namespace
}  // namespace incise::test::surfaces_test
