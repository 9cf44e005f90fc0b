// SPDX-License-Identifier: Apache-2.0
// How far walls may lie from what their stroke swept.
#include "improve/reference.h"

#include "improve/support.h"

namespace incise::test::reference_test {
namespace {

/// The references of a stroke that swept a square in the plane z = 0.
References references_of(std::uint32_t stroke) {
  const std::vector<Vec3> points = {Vec3(-5, -5, 0), Vec3(5, -5, 0), Vec3(5, 5, 0), Vec3(-5, 5, 0)};
  const std::vector<TriangleTree::Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  References references;
  references.extend(stroke, points, triangles);
  return references;
}

/// A triangle at a height, with its centroid for a sample.
Piece piece_at(double height) {
  const Facet facet = {Vec3(0, 0, height), Vec3(1, 0, height), Vec3(0, 1, height)};
  return {{facet}, {(facet[0] + facet[1] + facet[2]) / 3.0}};
}

bool allows(const References& references, std::uint32_t tag, double before, double after, double tolerance) {
  Reach reach;
  return references.allows(tag, piece_at(before), piece_at(after), tolerance, reach);
}

TEST(References, let_a_wall_lie_within_the_tolerance_of_its_sweep) {
  References references = references_of(3);
  EXPECT_TRUE(allows(references, 3, 0.0, 0.009, 0.01));
  EXPECT_TRUE(allows(references, 3, 0.0, -0.009, 0.01));
  EXPECT_FALSE(allows(references, 3, 0.0, 0.011, 0.01));
}

TEST(References, let_a_wall_that_is_too_far_come_nearer_but_not_go_further) {
  References references = references_of(3);
  EXPECT_TRUE(allows(references, 3, 0.1, 0.09, 0.01));
  EXPECT_TRUE(allows(references, 3, 0.1, -0.09, 0.01));
  EXPECT_FALSE(allows(references, 3, 0.1, 0.11, 0.01));
}

TEST(References, measure_once_how_far_the_old_piece_lies) {
  References references = references_of(3);
  Reach reach;
  EXPECT_TRUE(references.allows(3, piece_at(0.1), piece_at(0.005), 0.01, reach));
  EXPECT_FALSE(reach.has_value()) << "not needed";
  EXPECT_TRUE(references.allows(3, piece_at(0.1), piece_at(0.09), 0.01, reach));
  ASSERT_TRUE(reach.has_value());
  EXPECT_GE(*reach, 0.1);
  EXPECT_LE(*reach, 0.1 + 0.01);
}

TEST(References, compare_pieces_with_each_other_where_there_is_no_sweep) {
  const References references;
  for (const std::uint32_t tag : {0U, 7U}) {
    EXPECT_TRUE(allows(references, tag, 0.5, 0.509, 0.01));
    EXPECT_FALSE(allows(references, tag, 0.5, 0.511, 0.01));
    EXPECT_FALSE(allows(references, tag, 0.5, 0.489, 0.01));
  }
}

/// The walls of a plane cut, measured against a sweep that lies beside them.
double tolerance_of(double beside, bool is_bad) {
  Engine engine = make_engine(kuhn_cube(4), 0.0);
  cut(engine, plane(engine, Vec3(0, 0, 1), 0.4));
  References references;
  const std::vector<Vec3> points = {Vec3(-1, -1, 0.4 + beside), Vec3(3, -1, 0.4 + beside), Vec3(-1, 3, 0.4 + beside)};
  references.extend(1, points, std::vector<TriangleTree::Triangle>{{0, 1, 2}});
  references.measure(engine.mesh(), engine.journal().step(0).opened);
  return references.tolerance(1, is_bad);
}

TEST(References, give_a_fresh_wall_at_least_the_tolerance_of_all) {
  EXPECT_EQ(tolerance_of(0.0, false), kWallTolerance);
  EXPECT_EQ(References().tolerance(1, false), kWallTolerance);
  EXPECT_GE(tolerance_of(0.0, true), kWallTolerance);
}

TEST(References, give_a_coarse_wall_what_it_had_within_bounds) {
  EXPECT_GT(tolerance_of(0.005, false), kWallTolerance);
  EXPECT_GE(tolerance_of(0.005, true), tolerance_of(0.005, false));
  EXPECT_EQ(tolerance_of(1.0, false), tolerance_of(2.0, false)) << "bounded";
  EXPECT_LE(tolerance_of(1.0, true), 0.2);
}

TEST(References, let_a_moving_vertex_lie_as_far_off_as_it_did) {
  References references = references_of(3);
  const auto allows_apex = [&](double before, double after) {
    return references.allows_apex(3, Vec3(0, 0, before), Vec3(0.1, 0, after), 0.01, 1.0);
  };
  EXPECT_TRUE(allows_apex(0.0, 0.009));
  EXPECT_FALSE(allows_apex(0.0, 0.011));
  EXPECT_TRUE(allows_apex(0.1, 0.099));
  EXPECT_FALSE(allows_apex(0.1, 0.101));
  EXPECT_TRUE(references.allows_apex(4, Vec3(0, 0, 0), Vec3(0, 0, 1), 0.01, 1.0)) << "no sweep is known";
}

TEST(References, know_all_that_a_stroke_has_swept_however_it_was_told) {
  std::vector<Vec3> points;
  std::vector<TriangleTree::Triangle> triangles;
  References references;
  for (std::uint32_t k = 0; k < 40; ++k) {  // a staircase of squares, one more with each call
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) {
      points.emplace_back(corner + Vec3(k, 0, k));
    }
    triangles.push_back({4 * k, 4 * k + 1, 4 * k + 2});
    triangles.push_back({4 * k, 4 * k + 2, 4 * k + 3});
    references.extend(3, points, triangles);
    for (std::uint32_t old = 0; old <= k; ++old) {
      const Vec3 inside(old + 0.5, 0.5, old);
      EXPECT_TRUE(references.allows_apex(3, inside + Vec3(0, 0, 0.3), inside, 0.01, 1.0)) << k << " " << old;
    }
    const Vec3 next(k + 1.5, 0.5, k + 1);
    EXPECT_FALSE(references.allows_apex(3, Vec3(k + 0.5, 0.5, k), next, 0.01, 1.0)) << "not swept yet";
  }
  references.begin(3);
  EXPECT_TRUE(references.allows_apex(3, Vec3(0, 0, 0), Vec3(0, 0, 1), 0.01, 1.0)) << "forgotten";
}

TEST(References, measure_nothing_without_fresh_walls) {
  References references = references_of(1);
  const double before = references.tolerance(1, false);
  references.measure(build(kuhn_cube(1)), {});
  EXPECT_EQ(references.tolerance(1, false), before);
}

}  // namespace
}  // namespace incise::test::reference_test
