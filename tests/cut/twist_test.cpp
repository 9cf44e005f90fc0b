// SPDX-License-Identifier: Apache-2.0
// A blade that turns while it moves sweeps a smooth surface, not ridges.
#include "cut/twist.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cut/blade_constants.h"
#include "cut/sheet_crossing.h"
#include "cut/sweep.h"
#include "support/strokes.h"

namespace incise::test::twist_test {
namespace {

using Row = std::vector<Vec3>;

/// A straight edge of length 2 along a line at some angle, at some height.
Row turned(double angle, double height) {
  const Vec3 along(std::cos(angle), std::sin(angle), 0);
  return {Vec3(0, 0, height) - along, Vec3(0, 0, height) + along};
}

/// A screw: one turn by `turn` over a unit of height.
Stroke screw(double turn, unsigned steps) {
  Stroke stroke;
  for (unsigned i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    stroke.times.push_back(t);
    stroke.edges.push_back(turned(turn * t, t));
  }
  return stroke;
}

/// The least cosine between the normals of triangles of a sweep that share an edge.
double sharpest_fold(const SweptSurface& surface) {
  double least = 1.0;
  const auto normal = [&](const SweptTriangle& t) {
    const Vec3& a = surface.points[t.points[0]].position;
    return (surface.points[t.points[1]].position - a).cross(surface.points[t.points[2]].position - a).normalized();
  };
  for (const SweptTriangle& t : surface.triangles) {
    for (const SweptTriangle& u : surface.triangles) {
      unsigned shared = 0;
      for (const std::uint32_t p : t.points) shared += std::count(u.points.begin(), u.points.end(), p) > 0 ? 1U : 0U;
      if (shared == 2) least = std::min(least, normal(t).dot(normal(u)));
    }
  }
  return least;
}

TEST(EdgeDivision, leaves_an_edge_alone_that_sweeps_a_plane) {
  EdgeDivision division(3);
  const Row from = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)};
  const Row to = {Vec3(0, 1, 0), Vec3(1.5, 2, 0), Vec3(2, 5, 0)};  // it turns and shrinks, but in its plane
  EXPECT_TRUE(division.divide(from, to, 1e-9).empty());
  EXPECT_EQ(division.divided(to), to);
}

TEST(EdgeDivision, tells_how_each_segment_is_divided) {
  EdgeDivision division(2);
  const auto parts = division.divide(turned(0, 0), turned(0.5, 0.2), 0.01);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_GT(parts[0].size(), 2U);
  EXPECT_EQ(parts[0].back(), 1.0);
  const Row row = division.divided(turned(0.5, 0.2));
  EXPECT_EQ(row, divided(turned(0.5, 0.2), parts));
  EXPECT_EQ(row.size(), parts[0].size() + 1);
  EXPECT_EQ(row.back(), turned(0.5, 0.2).back());
}

TEST(EdgeDivision, divides_what_is_divided_and_no_more_than_it_must) {
  EdgeDivision division(2);
  division.divide(turned(0, 0), turned(0.3, 0.2), 0.01);
  const Row from = division.divided(turned(0.3, 0.2)), to = division.divided(turned(0.6, 0.4));
  EXPECT_TRUE(division.divide(from, to, 0.01).empty());  // the same turn again
  const auto parts = division.divide(from, to, 0.001);
  ASSERT_EQ(parts.size(), from.size() - 1);
  EXPECT_EQ(division.divided(turned(0.6, 0.4)).size(), divided(from, parts).size());
}

TEST(EdgeDivision, divides_an_edge_where_it_turns_about_a_point_of_its_own) {
  // In its plane, and on a cone: about the point at a quarter of its length.
  for (const double height : {0.0, 0.4}) {
    const auto edge = [&](double angle) {
      const Vec3 along(std::cos(angle), std::sin(angle), height);
      return Row{Vec3(-1.0 * along), Vec3(3.0 * along)};
    };
    EdgeDivision division(2);
    const auto parts = division.divide(edge(0), edge(0.2), 0.1);
    ASSERT_EQ(parts.size(), 1U);
    ASSERT_EQ(parts[0].size(), 2U);
    EXPECT_NEAR(parts[0][0], 0.25, 1e-12);
    EXPECT_EQ(division.points(), 2U);
    EXPECT_LT(division.divided(edge(0.4))[1].norm(), 1e-12);
    EXPECT_TRUE(division.divide(division.divided(edge(0.2)), division.divided(edge(0.4)), 0.1).empty());
  }
}

TEST(EdgeDivision, leaves_an_edge_alone_that_hardly_turns_or_turns_about_its_end) {
  EdgeDivision division(2);
  EXPECT_TRUE(division.divide(turned(0, 0), turned(0.04, 0), 0.05).empty());
  const Vec3 pivot(-1, 0, 0);
  EXPECT_TRUE(division.divide(Row{pivot, Vec3(1, 0, 0)}, Row{pivot, Vec3(0.8, 0.6, 0)}, 1e-6).empty());
}

TEST(EdgeDivision, has_a_greatest_number_of_parts) {
  EdgeDivision division(2);
  const auto parts = division.divide(turned(0, 0), turned(1.5, 3), 1e-12);
  EXPECT_EQ(parts[0].size(), static_cast<std::size_t>(kMostTwistParts));
}

TEST(EdgeDivision, makes_a_screw_smooth_that_folds_however_short_its_steps_are) {
  for (const unsigned steps : {5U, 10U, 20U}) {
    EXPECT_LT(sharpest_fold(sweep(screw(3.0, steps))), 0.0) << steps;
    EXPECT_GT(sharpest_fold(sweep(with_divided_edge(screw(3.0, steps), 0.002))), 0.8) << steps;
  }
}

/// Turns about its middle, on a disc or a double cone.
Stroke about_its_middle(double rise, double turns, unsigned steps) {
  std::vector<Row> edges;
  for (unsigned i = 0; i <= steps; ++i) {
    const auto [x, y] = on_circle(turns * i / steps);
    const Vec3 along(x, y, rise);
    edges.push_back({Vec3(-1.0 * along), along});
  }
  return stroke_of(std::move(edges));
}

TEST(WithDividedEdge, keeps_the_point_that_an_edge_turns_about) {
  for (const double rise : {0.0, 0.8}) {
    const Stroke divided = with_divided_edge(about_its_middle(rise, 0.4, 16), 0.1);
    ASSERT_EQ(divided.edges.front().size(), 3U);
    for (const Row& row : divided.edges) EXPECT_EQ(row[1], divided.edges.front()[1]);
    EXPECT_FALSE(meets_itself(sweep(divided), 1e-6));
    EXPECT_TRUE(meets_itself(sweep(about_its_middle(rise, 0.4, 16)), 1e-6));  // as it is given, its strips overlap
  }
}

TEST(MeetsItself, sees_a_cone_that_was_swept_twice_through_its_tip) {
  EXPECT_FALSE(meets_itself(sweep(with_divided_edge(about_its_middle(0.8, 0.9, 16), 0.1)), 1e-6));
  EXPECT_TRUE(meets_itself(sweep(with_divided_edge(about_its_middle(0.8, 1.3, 16), 0.1)), 1e-6));
}

/// A blade of two points that goes from place to place.
Stroke through(const std::vector<Vec3>& places) {
  std::vector<Row> edges;
  for (const Vec3& place : places) edges.push_back({place, place + Vec3(0, 0, 1)});
  return stroke_of(std::move(edges));
}

TEST(SharpTurns, are_turns_of_more_than_half_a_right_angle) {
  const Vec3 start(0, 0, 0), then(1, 0, 0);
  EXPECT_EQ(count_sharp_turns(through({start, then, {2, 0.9, 0}}), 1e-6), 0U);
  EXPECT_EQ(count_sharp_turns(through({start, then, {2, 1.1, 0}}), 1e-6), 1U);
  EXPECT_EQ(count_sharp_turns(through({start, then, {0.5, 0.1, 0}}), 1e-6), 1U) << "back";
}

TEST(SharpTurns, pass_over_moves_that_are_too_short_and_count_the_place_where_it_comes_round) {
  const Vec3 start(0, 0, 0), then(1, 0, 0), there(2, 0, 0);
  EXPECT_EQ(count_sharp_turns(through({start, then, {1, 1e-7, 0}, there}), 1e-6), 0U);
  std::vector<Vec3> half_round;
  for (int i = 0; i <= 16; ++i) {
    const auto [x, y] = on_circle(-0.25 + 0.5 * i / 16.0);
    half_round.emplace_back(x, 0.5 * y, 0);
  }
  EXPECT_EQ(count_sharp_turns(through(half_round), 1e-6), 0U);
  half_round.push_back(half_round.front());
  EXPECT_EQ(count_sharp_turns(through(half_round), 1e-6), 2U) << "at both ends of its arc";
}

TEST(ComesRound, asks_all_points_of_the_edge) {
  Stroke stroke = through({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}});
  EXPECT_TRUE(comes_round(stroke, 1e-6));
  stroke.edges.back()[1].x() += 1e-3;
  EXPECT_FALSE(comes_round(stroke, 1e-6));
  EXPECT_TRUE(comes_round(stroke, 1e-2));
}

TEST(CountCrossings, counts_the_walls_between_two_places) {
  const SweptSurface surface = sweep(through({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}));
  const Sheet sheet(surface);
  const auto between = [&](const Vec3& a, const Vec3& b) { return count_crossings(sheet, {a, 1}, {b, 2}); };
  EXPECT_EQ(between({1, 1, 0.5}, {2, 2, 0.5}), 0U);
  EXPECT_EQ(between({1, 1, 0.5}, {4, 1, 0.5}), 1U);
  EXPECT_EQ(between({1, -1, 0.5}, {1, 4, 0.5}), 2U);
  EXPECT_EQ(between({1, 1, 0.5}, {-1, 1, 0.5}), 0U) << "where the sheet is open";
  EXPECT_EQ(between({1, 0, 0.5}, {1, 1, 0.5}) + between({1, 0, 0.5}, {1, -1, 0.5}), 1U) << "from a place on a wall";
}

}  // namespace
}  // namespace incise::test::twist_test
