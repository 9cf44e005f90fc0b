// SPDX-License-Identifier: Apache-2.0
// Smoothing of contours and walls: equations 2 to 4, the fitted plane, and what both keep.
#include "paper/paper_boundary_laplacian.h"

#include <cmath>

#include "incise/mesh/quality_stats.h"
#include "paper/paper_classes.h"
#include "paper/paper_region.h"
#include "paper/paper_support.h"

namespace incise::test::paper_boundary_laplacian_test {
namespace {

using paper::smooth_on_contour;
using paper::smooth_on_wall;

// --- contours
// ----------------------------------------------------------------------------------------------------------------

/// Equations 2 to 4 as they stand, with their angle brackets read as parentheses and n as nd.
Vec3 equations_2_to_4(const Vec3& ori, const Vec3& a, const Vec3& b) {
  const Vec3 nd = (a - ori).cross(b - a).cross(b - a).normalized();
  const Vec3 mid = 0.5 * (a + b);
  const double dist = (ori - mid).dot(nd);
  return mid + dist * nd;
}

TEST(ContourSmoothing, is_equations_2_to_4_wherever_these_are_defined) {
  Random random(1);
  for (unsigned i = 0; i < 1000; ++i) {
    const Vec3 c = random.point(-1, 1), a = random.point(-1, 1), b = random.point(-1, 1);
    EXPECT_LT((smooth_on_contour(c, a, b) - equations_2_to_4(c, a, b)).norm(), 1e-12);
  }
}

TEST(ContourSmoothing, keeps_the_distance_from_the_neighbours_line_and_reaches_their_middle) {
  const Vec3 e = smooth_on_contour(Vec3(0.9, 0.25, 3), Vec3(0, 0, 3), Vec3(2, 0, 3));
  EXPECT_LT((e - Vec3(1, 0.25, 3)).norm(), 1e-15);
}

// T29
TEST(ContourSmoothing, sends_a_collinear_vertex_to_the_middle) {
  const Vec3 a(0.1, 0.2, 0.3), b(1.7, -0.4, 2.3);
  for (const double t : {0.1, 0.5, 0.93, -0.5}) {
    EXPECT_LT((smooth_on_contour(a + t * (b - a), a, b) - 0.5 * (a + b)).norm(), 1e-15);
  }
}

TEST(ContourSmoothing, stays_where_both_neighbours_are_one_point) {
  EXPECT_EQ(smooth_on_contour(Vec3(1, 2, 3), Vec3(0, 0, 0), Vec3(0, 0, 0)), Vec3(1, 2, 3));
}

// T29
TEST(ContourSmoothing, of_a_planar_polygon_keeps_its_area) {
  Random random(2);
  std::vector<Vec3> polygon;
  for (unsigned i = 0; i < 40; ++i) {
    const auto [x, y] = on_circle((i + random.real(-0.3, 0.3)) / 40.0);
    polygon.emplace_back(random.real(0.8, 1.2) * Vec3(x, y, 0));
  }
  const double area = area_inside(polygon);
  for (unsigned sweep = 0; sweep < 5; ++sweep) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t n = polygon.size();
      polygon[i] = smooth_on_contour(polygon[i], polygon[(i + n - 1) % n], polygon[(i + 1) % n]);
    }
    EXPECT_NEAR(area_inside(polygon), area, 1e-14 * area);
  }
}

// --- walls
// ----------------------------------------------------------------------------------------------------------------

TEST(WallSmoothing, moves_parallel_to_the_fitted_plane_to_below_the_centre) {
  const std::vector<Vec3> ring = {Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(2, 2, 1), Vec3(0, 2, 1)};
  EXPECT_LT((smooth_on_wall(Vec3(0.3, 1.8, 1.5), ring) - Vec3(1, 1, 1.5)).norm(), 1e-15);
}

/// Area of the boundary, and volume inside, of the closed surface of one body do not tell on which wall a vertex is:
/// the cut is flat, so that both must stay.
TEST(BoundarySmoothing, beside_a_flat_wall_keeps_volumes_and_area) {
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(0.3, 0.5, 0.9), 0.8}});
  const std::vector<double> volumes = piece_volumes(body.mesh);
  const double area = wall_area(body.mesh), mean = measure_quality(body.mesh).lr_mean;
  Transaction transaction(body.mesh, true);
  const MaintainStatistics done =
      paper::smooth_boundary(transaction, paper::find_divided_vertices(body.mesh, body.journal, 0));
  transaction.commit();
  EXPECT_GT(done.moved_vertices, 100U);
  EXPECT_GT(done.work_units, done.moved_vertices);
  expect_valid(body.mesh, 1.0);
  expect_pieces(body.mesh, volumes, 1e-13);
  EXPECT_NEAR(wall_area(body.mesh), area, 1e-12);
  EXPECT_LT(measure_quality(body.mesh).lr_mean, mean);
}

TEST(BoundarySmoothing, moves_contours_and_walls_but_no_other_skin_and_no_corners) {
  CutBody body = cut_as_paper(jittered_cube(5, 1), curved_stroke());
  std::vector<Vec3> places;
  std::vector<bool> may_move;
  paper::ClassFinder classes;
  for (std::uint32_t slot = 0; slot < body.mesh.vertex_slots(); ++slot) {
    const VertexId v(slot);
    const paper::VertexClass found = classes.classify(body.mesh, v);
    places.push_back(body.mesh.rest(v));
    may_move.push_back((body.mesh.shape_of(v) & shape::kWall) != 0 && found != paper::VertexClass::kCorner);
  }
  Transaction transaction(body.mesh, true);
  const std::uint64_t moved = paper::smooth_boundary(transaction, paper::find_all_vertices(body.mesh)).moved_vertices;
  transaction.commit();
  std::uint64_t differ = 0;
  for (std::uint32_t slot = 0; slot < body.mesh.vertex_slots(); ++slot) {
    const bool is_elsewhere = body.mesh.rest(VertexId(slot)) != places[slot];
    differ += is_elsewhere ? 1U : 0U;
    EXPECT_TRUE(!is_elsewhere || may_move[slot]) << slot;
  }
  EXPECT_EQ(differ, moved);
  expect_valid(body.mesh, 1.0, 2e-3);
}

/// Where the vertices of a cut lie after some classes of them were smoothed, one class after the other; all at once
/// where none is named.
std::vector<Vec3> places_after(std::initializer_list<paper::VertexClass> order) {
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(0.3, 0.5, 0.9), 0.8}});
  const std::vector<VertexId> all = paper::find_all_vertices(body.mesh);
  std::vector<std::vector<VertexId>> lists;
  paper::ClassFinder classes;
  for (const paper::VertexClass asked : order) {
    lists.emplace_back();
    for (const VertexId v : all) {
      if (classes.classify(body.mesh, v) == asked) lists.back().push_back(v);
    }
  }
  if (lists.empty()) lists.push_back(all);
  Transaction transaction(body.mesh, true);
  for (const std::vector<VertexId>& list : lists) paper::smooth_boundary(transaction, list);
  transaction.commit();
  std::vector<Vec3> places;
  body.mesh.for_each_vertex([&](VertexId v) { places.push_back(body.mesh.rest(v)); });
  return places;
}

TEST(BoundarySmoothing, moves_contours_before_walls) {
  using paper::VertexClass;
  const std::vector<Vec3> places = places_after({});
  EXPECT_EQ(places, places_after({VertexClass::kContour, VertexClass::kSurface}));
  EXPECT_NE(places, places_after({VertexClass::kSurface, VertexClass::kContour}));
}

TEST(BoundarySmoothing, makes_no_tet_bad_shaped) {
  CutBody body = cut_as_paper(jittered_cube(6, 4), {{Vec3(0.3, 0.5, 0.9), 0.8}});
  const double worst = measure_quality(body.mesh).lr_max, bad = measure_quality(body.mesh).lr_over_200_pct;
  Transaction transaction(body.mesh, true);
  paper::smooth_boundary(transaction, paper::find_divided_vertices(body.mesh, body.journal, 0));
  transaction.commit();
  EXPECT_LE(measure_quality(body.mesh).lr_max, worst);
  EXPECT_LE(measure_quality(body.mesh).lr_over_200_pct, bad);
  expect_valid(body.mesh, 1.0);
}

}  // namespace
}  // namespace incise::test::paper_boundary_laplacian_test
