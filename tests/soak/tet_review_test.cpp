// SPDX-License-Identifier: Apache-2.0
// The judge of the attacks finds each defect in a mesh that has it.
#include "soak/tet_review.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "soak/sheet_pieces.h"
#include "support/bodies.h"

namespace incise::test::tet_review_test {
namespace {

/// A unit corner: right angles at point 0.
TetSoup corner() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 1, 2, 3}}, {}};
}

/// Two tets on both sides of one face.
TetSoup pair() {
  TetSoup soup = corner();
  soup.points.emplace_back(1, 1, 1);
  soup.tets.push_back({1, 2, 3, 4});
  return soup;
}

/// Two cubes apart.
TetSoup two_cubes() {
  TetSoup soup = kuhn_cube(2), other = kuhn_box(Vec3(3, 0, 0), Vec3(4, 1, 1), {2, 2, 2});
  const auto shift = static_cast<std::uint32_t>(soup.points.size());
  for (auto t : other.tets) {
    for (std::uint32_t& v : t) v += shift;
    soup.tets.push_back(t);
  }
  soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
  return soup;
}

std::vector<std::string> defects_of(const TetSoup& soup) {
  return grown_defects({}, review(soup));
}

TEST(TetReview, finds_nothing_wrong_with_a_sound_mesh) {
  const TetReview found = review(jittered_cube(4, 1));
  EXPECT_TRUE(is_spotless(found));
  EXPECT_EQ(found.tets, 384U);
  EXPECT_EQ(found.components, 1U);
  EXPECT_NEAR(found.volume, 1, 1e-14);
}

TEST(TetReview, knows_the_shape_of_a_corner) {
  const TetReview found = review(corner());
  EXPECT_NEAR(found.volume, 1.0 / 6, 1e-16);
  const double inradius = 0.5 / (1.5 + std::sqrt(3.0) / 2);
  EXPECT_NEAR(found.worst_ratio, std::sqrt(2.0) / inradius, 1e-12);
}

TEST(TetReview, finds_a_tet_that_is_turned_over) {
  TetSoup soup = pair();
  std::swap(soup.tets[1][0], soup.tets[1][1]);
  EXPECT_EQ(review(soup).nonpositive, 1U);
  EXPECT_EQ(defects_of(soup).size(), 1U);
}

TEST(TetReview, finds_a_flat_tet) {
  TetSoup soup = corner();
  soup.points[3] = Vec3(0.5, 0.25, 0);
  const TetReview found = review(soup);
  EXPECT_EQ(found.nonpositive, 1U);
  EXPECT_TRUE(std::isinf(found.worst_ratio));
}

TEST(TetReview, finds_a_sliver_that_is_positive) {
  TetSoup soup = corner();
  soup.points[3] = Vec3(0.25, 0.25, 1e-14);
  const TetReview found = review(soup);
  EXPECT_EQ(found.nonpositive, 0U);
  EXPECT_GT(found.worst_ratio, 1e13);
}

TEST(TetReview, finds_points_that_are_not_finite) {
  TetSoup soup = corner();
  soup.points[2].y() = std::numeric_limits<double>::quiet_NaN();
  const TetReview found = review(soup);
  EXPECT_EQ(found.nonfinite, 1U);
  EXPECT_EQ(found.nonpositive, 1U);
  EXPECT_TRUE(std::isinf(found.worst_ratio));
}

TEST(TetReview, finds_corners_that_repeat_or_are_not_there) {
  TetSoup soup = corner();
  soup.tets.push_back({0, 1, 1, 2});
  soup.tets.push_back({0, 1, 2, 9});
  EXPECT_EQ(review(soup).strange_corners, 2U);
}

TEST(TetReview, finds_a_tet_that_is_there_twice) {
  TetSoup soup = corner();
  soup.tets.push_back({1, 2, 0, 3});
  EXPECT_EQ(review(soup).duplicate_tets, 1U);
}

TEST(TetReview, finds_a_face_of_three_tets) {
  TetSoup soup = pair();
  soup.points.emplace_back(2, 2, 2);
  soup.tets.push_back({1, 2, 3, 5});
  const TetReview found = review(soup);
  EXPECT_EQ(found.overshared_faces, 1U);
  EXPECT_EQ(found.components, 3U) << "a face of three tets joins none of them";
}

TEST(TetReview, finds_tets_that_touch_along_an_edge) {
  TetSoup soup = corner();
  soup.points.emplace_back(0, -1, 0);
  soup.points.emplace_back(0, 0, -1);
  soup.tets.push_back({0, 1, 4, 5});
  const TetReview found = review(soup);
  EXPECT_EQ(found.bad_edges, 1U);
  EXPECT_EQ(found.singleton_vertices, 2U);
  EXPECT_EQ(found.components, 2U);
}

TEST(TetReview, finds_tets_that_touch_at_a_vertex) {
  TetSoup soup = corner();
  for (const Vec3& p : {Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)}) soup.points.push_back(p);
  soup.tets.push_back({0, 5, 4, 6});
  const TetReview found = review(soup);
  EXPECT_EQ(found.singleton_vertices, 1U);
  EXPECT_EQ(found.bad_edges, 0U);
}

TEST(TetReview, finds_a_vertex_of_no_tet) {
  TetSoup soup = corner();
  soup.points.emplace_back(5, 5, 5);
  EXPECT_EQ(review(soup).loose_vertices, 1U);
}

TEST(TetReview, counts_components_through_faces) {
  EXPECT_EQ(review(two_cubes()).components, 2U);
  EXPECT_TRUE(is_spotless(review(two_cubes())));
}

TEST(TetReview, names_only_what_has_grown) {
  TetReview before, after;
  before.nonpositive = after.nonpositive = 3;
  before.bad_edges = 2;
  after.bad_edges = 5;
  EXPECT_EQ(grown_defects(before, after), std::vector<std::string>{"bad boundary edges 2 -> 5"});
  EXPECT_TRUE(grown_defects(after, before).empty());
}

TEST(TetReview, tells_convex_bodies_from_others) {
  EXPECT_TRUE(is_convex(jittered_cube(3, 1)));
  EXPECT_TRUE(is_convex(pair()));
  EXPECT_FALSE(is_convex(two_cubes()));
  TetSoup dented = kuhn_cube(2);
  for (Vec3& p : dented.points) {
    if (p == Vec3(0.5, 0.5, 1)) p.z() = 0.9;
  }
  EXPECT_FALSE(is_convex(dented));
}

// --- what planes must leave

const Vec3 kOblique = Vec3(1, 0.3, 0.2).normalized(), kAcross = Vec3(-0.3, 1, 0).normalized();

TEST(SheetPieces, of_a_plane_are_two) {
  EXPECT_EQ(pieces_of_plane(kuhn_cube(5), {Vec3(0.5, 0.5, 0.5), kOblique}, 0.1), 2U);
}

TEST(SheetPieces, count_what_a_plane_leaves_of_several_bodies) {
  EXPECT_EQ(pieces_of_plane(two_cubes(), {Vec3(0.45, 0.5, 0.5), Vec3(1, 0.001, 0)}, 0.1), 3U);
  EXPECT_EQ(pieces_of_plane(two_cubes(), {Vec3(0.45, 0.5, 0.45), Vec3(0.001, 0.001, 1)}, 0.1), 4U);
}

TEST(SheetPieces, are_not_known_where_one_is_thin) {
  EXPECT_FALSE(pieces_of_plane(kuhn_cube(5), {Vec3(0.05, 0.5, 0.5), Vec3(1, 0.001, 0)}, 0.1));
}

TEST(SheetPieces, are_not_known_where_a_plane_goes_through_a_vertex) {
  EXPECT_FALSE(pieces_of_plane(kuhn_cube(2), {Vec3(0.5, 0.5, 0.5), kOblique}, 0.1));
}

TEST(SheetPieces, of_a_cross_are_four) {
  const Vec3 middle(0.51, 0.52, 0.53);
  EXPECT_EQ(pieces_of_star(kuhn_cube(5), {{middle, kOblique}, {middle, kAcross}}, 0.1), 4U);
  EXPECT_FALSE(pieces_of_star(kuhn_cube(5), {{Vec3(0.95, 0.95, 0.5), kOblique}, {Vec3(0.95, 0.95, 0.5), kAcross}}, 0.1))
      << "one of them is a sliver along an edge of the cube";
}

TEST(SheetPieces, of_a_tee_are_three_and_two_where_a_gap_stays) {
  const Vec3 middle(0.31, 0.52, 0.53);
  const TetSoup cube = kuhn_cube(8);
  const SheetPlane wall{middle, kOblique}, divider{middle, kAcross};
  EXPECT_EQ(pieces_of_tee(cube, wall, divider, 0, 0.05), 3U);
  EXPECT_EQ(pieces_of_tee(cube, wall, divider, -0.02, 0.05), 3U);
  EXPECT_EQ(pieces_of_tee(cube, wall, divider, 0.35, 0.05), 2U);
  EXPECT_FALSE(pieces_of_tee(cube, wall, divider, 0.02, 0.05));
  EXPECT_FALSE(pieces_of_tee(cube, wall, divider, -2, 0.05)) << "the stub goes through what is below";
}

}  // namespace
}  // namespace incise::test::tet_review_test
