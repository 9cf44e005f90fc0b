// SPDX-License-Identifier: Apache-2.0
// Crossings of edges by strips, against one test after the other; edges crossed twice.
#include "cut/strip_crossing.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "cut/flagged_body.h"
#include "cut/strips.h"
#include "support/bodies.h"

namespace incise::test::strip_crossing_test {
namespace {

std::vector<std::uint32_t> all_masters(const FlaggedBody& body) {
  std::vector<std::uint32_t> all(body.complex().size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

std::uint32_t count_crossings(const TetMesh& mesh, const Sheet& sheet, const ClosedEdge& edge) {
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < sheet.triangle_count(); ++t) {
    count += segment_crosses_triangle({mesh.rest(edge.a), edge.a.value}, {mesh.rest(edge.b), edge.b.value},
                                      sheet.point(t, 0), sheet.point(t, 1), sheet.point(t, 2))
                 ? 1U
                 : 0U;
  }
  return count;
}

/// How often a strip crosses each edge that it crosses.
std::map<std::uint32_t, std::uint32_t> crossings_of(FlaggedBody& body, const Strip& strip, std::uint32_t step) {
  StripCrossings crossings;
  std::map<std::uint32_t, std::uint32_t> counts;
  for (const StripCrossing& c : crossings.find(body.mesh(), strip, all_masters(body), body.complex(), step)) {
    EXPECT_TRUE(counts.emplace(c.edge, c.count).second);
    EXPECT_LE(c.t, c.t_last);
  }
  return counts;
}

TEST(StripCrossings, are_those_that_each_edge_and_triangle_have) {
  Random random(1);
  for (unsigned run = 0; run < 20; ++run) {
    FlaggedBody body(run % 2 == 0 ? jittered_cube(3, run) : kuhn_cube(3));
    const auto strip = strip_of_all(random_rows(random, 2 + run % 4, 2 + run % 3, 1.2));
    const auto counts = crossings_of(body, *strip, 1);
    for (std::uint32_t e = 0; e < body.complex().edges().size(); ++e) {
      const std::uint32_t expected = count_crossings(body.mesh(), strip->sheet, body.complex().edges()[e]);
      EXPECT_EQ(counts.count(e) > 0 ? counts.at(e) : 0U, expected);
    }
  }
}

TEST(StripCrossings, of_all_strips_sum_to_those_of_the_sheet) {
  Random random(2);
  for (unsigned run = 0; run < 10; ++run) {
    FlaggedBody body(kuhn_cube(3));
    Rows rows = random_rows(random, 5, 3, 1.5);
    for (Row& row : rows) {
      for (Vec3& p : row) p = Vec3(std::round(3 * p.x()), std::round(3 * p.y()), std::round(3 * p.z())) / 3.0;
    }
    std::map<std::uint32_t, std::uint32_t> sum;  // blade points on mesh vertices: every test is degenerate
    for (std::uint32_t r = 1; r < rows.size(); ++r) {
      for (const auto& [edge, count] : crossings_of(body, *strip_to(rows, r), r)) sum[edge] += count;
    }
    EXPECT_EQ(sum, crossings_of(body, *strip_of_all(rows), 99));
  }
}

TEST(StripCrossings, tell_where_the_edge_is_crossed) {
  FlaggedBody body(kuhn_cube(1));
  const Rows rows = {{Vec3(0.3, -1, -1), Vec3(0.3, -1, 2)}, {Vec3(0.3, 2, -1), Vec3(0.3, 2, 2)}};
  const auto strip = strip_of_all(rows);
  StripCrossings crossings;
  for (const StripCrossing& c : crossings.find(body.mesh(), *strip, all_masters(body), body.complex(), 1)) {
    const ClosedEdge& edge = body.complex().edges()[c.edge];
    const double x = (1 - c.t) * body.mesh().rest(edge.a).x() + c.t * body.mesh().rest(edge.b).x();
    EXPECT_NEAR(x, 0.3, 1e-15);
    EXPECT_EQ(c.count, 1U);
  }
}

// --- edges crossed twice ---------------------------------------------------------------------------------------------

/// A long edge from (0, 0, 0) to (1, 0, 0), in one tet.
TetSoup long_tet() {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0), Vec3(0.5, 0.3, 1)};
  soup.tets = {{0, 1, 2, 3}};
  return soup;
}

/// A blade along z that follows a path in the xy-plane, in one strip.
std::vector<BetweenCrossings> between_on_long_edge(const Row& path, double gap) {
  FlaggedBody body(long_tet());
  Rows rows(2);
  for (const Vec3& p : path) {
    rows[0].emplace_back(p.x(), p.y(), -1);
    rows[1].emplace_back(p.x(), p.y(), 2);
  }
  const auto strip = strip_of_all(rows);
  StripCrossings crossings;
  const auto& crossed = crossings.find(body.mesh(), *strip, all_masters(body), body.complex(), 1);
  std::vector<BetweenCrossings> found = find_doubly_crossed(body.mesh(), *strip, crossed, body.complex(), gap);
  std::erase_if(found, [&](const BetweenCrossings& b) {
    const ClosedEdge& edge = body.complex().edges()[b.edge];
    return edge.a != VertexId(0) || edge.b != VertexId(1);
  });
  return found;
}

TEST(DoublyCrossed, finds_the_place_between_two_sheets) {
  const auto found = between_on_long_edge({Vec3(0.2, -1, 0), Vec3(0.2, 2, 0), Vec3(0.6, 2, 0), Vec3(0.6, -1, 0)}, 0.02);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].t, 0.4, 1e-12);
}

TEST(DoublyCrossed, leaves_sheets_alone_that_are_closer_than_the_gap) {
  const Row path = {Vec3(0.2, -1, 0), Vec3(0.2, 2, 0), Vec3(0.21, 2, 0), Vec3(0.21, -1, 0)};
  EXPECT_TRUE(between_on_long_edge(path, 0.02).empty());
  EXPECT_EQ(between_on_long_edge(path, 0.005).size(), 1U);
}

TEST(DoublyCrossed, leaves_an_edge_alone_that_grazes_a_smooth_sheet) {
  Row path;
  for (int i = -10; i <= 10; ++i) path.emplace_back(0.5 + 0.05 * i, 0.02 - 0.002 * i * i, 0);
  EXPECT_TRUE(between_on_long_edge(path, 0.02).empty());
}

TEST(DoublyCrossed, counts_an_end_on_the_sheet_as_crossed) {
  const auto found = between_on_long_edge({Vec3(0, -1, 0), Vec3(0, 2, 0), Vec3(0.6, 2, 0), Vec3(0.6, -1, 0)}, 0.02);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].t, 0.3, 1e-12);
}

}  // namespace
}  // namespace incise::test::strip_crossing_test
