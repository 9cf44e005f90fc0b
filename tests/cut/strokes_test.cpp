// SPDX-License-Identifier: Apache-2.0
// Blades that curve, close, meet themselves, stop inside, stand still or go back.
#include "support/strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cut/sweep.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::strokes_test {
namespace {

constexpr double kLow = -0.2, kHigh = 1.2;  // beyond the unit cube

/// x = c + bend·(y − ½)² from below the unit cube to above it.
std::vector<Vec3> parabola(double c, double bend, unsigned segments = 24) {
  std::vector<Vec3> path;
  for (unsigned i = 0; i <= segments; ++i) {
    const double y = kLow + (kHigh - kLow) * i / segments;
    path.emplace_back(c + bend * (y - 0.5) * (y - 0.5), y, 0.0);
  }
  return path;
}

std::vector<Vec3> with_x_and_y_exchanged(std::vector<Vec3> path) {
  for (Vec3& p : path) std::swap(p.x(), p.y());
  return path;
}

struct Setting {
  double snap;
  Profile profile;
};

class Strokes : public testing::TestWithParam<Setting> {
 protected:
  static Engine engine_on(const TetSoup& soup) { return make_engine(soup, GetParam().snap, GetParam().profile); }
};
INSTANTIATE_TEST_SUITE_P(settings, Strokes,
                         testing::Values(Setting{0.0, Profile::kIncise}, Setting{0.2, Profile::kIncise},
                                         Setting{0.0, Profile::kPaper}),
                         [](const auto& setting) {
                           if (setting.param.profile == Profile::kPaper) return "paper";
                           return setting.param.snap > 0 ? "snap" : "no_snap";
                         });

// --- curves
// ---------------------------------------------------------------------------------------------------------------

TEST_P(Strokes, along_an_arc_give_two_pieces_of_the_right_volumes) {
  for (const bool in_one_step : {true, false}) {
    Engine engine = engine_on(jittered_cube(6, 11));
    const std::vector<Vec3> path = parabola(0.4, 0.5);
    cut(engine, in_one_step ? profile_stroke(path, kLow, kHigh) : path_stroke(path, kLow, kHigh));
    const double left = 0.4 + 0.5 / 12.0;
    expect_pieces(engine.mesh(), {left, 1 - left}, 0.01);
    EXPECT_EQ(euler_characteristics(engine.mesh()), (std::vector<int>{2, 2}));
  }
}

// T10
TEST_P(Strokes, of_a_coring_cylinder_give_a_core_and_a_ring) {
  const Vec3 centre(0.5, 0.5, 0);
  const double area = area_inside(arc_path(centre, 0.31, 0, 1, 32));
  for (const bool is_jittered : {false, true}) {
    SCOPED_TRACE(is_jittered);
    Engine engine = engine_on(is_jittered ? jittered_cube(8, 12) : kuhn_cube(8));
    cut(engine, coring_stroke(centre, 0.31, 32, kLow, kHigh));
    const Components pieces = find_components(engine.mesh());
    ASSERT_EQ(pieces.count(), 2U);
    const std::size_t core = pieces.volume[0] < pieces.volume[1] ? 0 : 1;
    EXPECT_NEAR(pieces.volume[core], area, 0.03 * area);
    const std::vector<int> chi = euler_characteristics(engine.mesh());
    EXPECT_EQ(chi[core], 2);
    EXPECT_EQ(chi[1 - core], 0);
  }
}

TEST_P(Strokes, of_a_cylinder_swept_around_as_a_motion_that_returns_give_a_core_too) {
  Engine engine = engine_on(jittered_cube(6, 13));
  std::vector<Vec3> path = arc_path(Vec3(0.5, 0.5, 0), 0.3, 0, 1, 32);
  path.back() = path.front();
  cut(engine, path_stroke(path, kLow, kHigh));
  EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
}

TEST_P(Strokes, of_a_cylinder_in_several_steps_give_a_core) {
  Engine engine = engine_on(jittered_cube(6, 14));
  std::vector<Vec3> path = arc_path(Vec3(0.45, 0.55, 0), 0.3, 0, 1, 24);
  path.back() = path.front();
  std::vector<std::vector<Vec3>> edges;
  for (const double z : {-0.2, 0.13, 0.41, 0.77, 1.2}) {
    edges.push_back(path);
    for (Vec3& p : edges.back()) p.z() = z;
  }
  cut(engine, stroke_of(edges));
  EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
}

// T13
TEST_P(Strokes, three_by_two_curved_sheets_give_twelve_pieces) {
  Engine engine = engine_on(jittered_cube(6, 15));
  for (const double c : {0.22, 0.48, 0.77}) cut(engine, profile_stroke(parabola(c, 0.12), kLow, kHigh));
  for (const double c : {0.31, 0.66}) {
    cut(engine, profile_stroke(with_x_and_y_exchanged(parabola(c, -0.1)), kLow, kHigh));
  }
  EXPECT_EQ(find_components(engine.mesh()).count(), 12U);
  EXPECT_EQ(euler_characteristics(engine.mesh()), std::vector<int>(12, 2));
}

// --- sweeps that meet themselves
// --------------------------------------------------------------------------------------------

// T12
TEST_P(Strokes, that_cross_themselves_in_one_sweep_give_four_pieces) {
  const std::vector<Vec3> path = {Vec3(0.47, kLow, 0), Vec3(0.47, kHigh, 0), Vec3(1.4, kHigh, 0), Vec3(1.4, 0.53, 0),
                                  Vec3(kLow, 0.53, 0)};
  Engine engine = engine_on(kuhn_cube(5));
  const CutStatistics statistics = cut(engine, path_stroke(path, kLow, kHigh));
  EXPECT_EQ(statistics.sheets, 2U);
  expect_pieces(engine.mesh(), {0.47 * 0.53, 0.47 * 0.47, 0.53 * 0.53, 0.53 * 0.47}, 1e-12);
}

TEST_P(Strokes, that_cross_themselves_in_many_small_steps_give_four_pieces) {
  std::vector<Vec3> path;
  const std::vector<Vec3> corners = {Vec3(0.47, kLow, 0), Vec3(0.47, kHigh, 0), Vec3(1.4, kHigh, 0), Vec3(1.4, 0.53, 0),
                                     Vec3(kLow, 0.53, 0)};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    for (unsigned k = 0; k < 9; ++k) path.emplace_back(corners[i] + (corners[i + 1] - corners[i]) * k / 9.0);
  }
  path.push_back(corners.back());
  Engine engine = engine_on(kuhn_cube(5));
  cut(engine, path_stroke(path, kLow, kHigh));
  EXPECT_EQ(find_components(engine.mesh()).count(), 4U);
}

TEST_P(Strokes, that_loop_over_their_own_path_cut_the_loop_out) {
  std::vector<Vec3> path = {Vec3(-0.3, 0.31, 0), Vec3(0.1, 0.31, 0), Vec3(0.3, 0.31, 0)};
  for (const Vec3& p : arc_path(Vec3(0.62, 0.53, 0), 0.22, 0.75, 1.5, 24)) path.push_back(p);
  for (const double y : {0.4, 0.2, -0.3}) path.emplace_back(0.40, y, 0.0);
  Engine engine = engine_on(jittered_cube(6, 16));
  cut(engine, path_stroke(path, kLow, kHigh));
  EXPECT_EQ(find_components(engine.mesh()).count(), 3U);
}

// T20
TEST_P(Strokes, in_u_shape_cut_a_slab_of_the_right_volume) {
  const double spacing = 0.2;
  for (const double gap : {2.0, 1.0, 0.5, 0.23, 0.1, 0.05}) {
    for (const bool in_one_step : {true, false}) {
      SCOPED_TRACE(testing::Message() << "gap " << gap << " of the spacing, one step " << in_one_step);
      const double x = 0.45, width = gap * spacing;
      const std::vector<Vec3> path = {Vec3(x, kHigh, 0), Vec3(x, kLow, 0), Vec3(x + width, kLow, 0),
                                      Vec3(x + width, kHigh, 0)};
      Engine engine = engine_on(kuhn_cube(5));
      cut(engine, in_one_step ? profile_stroke(path, kLow, kHigh) : path_stroke(path, kLow, kHigh));
      const Components pieces = find_components(engine.mesh());
      ASSERT_EQ(pieces.count(), 3U);
      std::size_t middle = 0;  // the piece of a tet between the two sheets
      double nearest = 1;
      engine.mesh().for_each_tet([&](TetId tet) {
        double centre = 0;
        for (const VertexId v : engine.mesh().vertices(tet)) centre += engine.mesh().rest(v).x() / 4;
        if (std::abs(centre - x - width / 2) < nearest) {
          nearest = std::abs(centre - x - width / 2);
          middle = pieces.label[tet.value];
        }
      });
      const double slab = pieces.volume[middle];
      const double tolerance = GetParam().snap > 0 ? 2 * GetParam().snap * spacing : 1e-12;
      EXPECT_NEAR(slab, width, tolerance);
    }
  }
}

TEST_P(Strokes, in_u_shape_with_the_bend_inside_cut_a_tongue_out) {
  std::vector<Vec3> path = {Vec3(0.31, kHigh, 0)};
  for (const Vec3& p : arc_path(Vec3(0.5, 0.5, 0), 0.19, 0.5, 1.0, 12)) path.push_back(p);
  path.emplace_back(0.69, kHigh, 0);
  for (const bool in_one_step : {true, false}) {
    Engine engine = engine_on(jittered_cube(6, 17));
    cut(engine, in_one_step ? profile_stroke(path, kLow, kHigh) : path_stroke(path, kLow, kHigh));
    EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
  }
}

// --- going back, standing still
// ------------------------------------------------------------------------------------------------

TEST(DoublePasses, that_go_back_over_themselves_cut_no_more_than_once) {
  const Stroke once = path_stroke(parabola(0.4, 0.3), kLow, kHigh);
  Engine single = make_engine(jittered_cube(5, 18));
  cut(single, once);
  Engine both_ways = make_engine(jittered_cube(5, 18));
  cut(both_ways, followed_by(once, reversed(once)));
  EXPECT_EQ(both_ways.mesh().tet_count(), single.mesh().tet_count());
  EXPECT_EQ(find_components(both_ways.mesh()).count(), 2U);
}

TEST(DoublePasses, that_leave_their_slit_little_by_little_leave_no_gap) {
  std::vector<std::vector<Vec3>> edges;
  for (const double x : {0.0, 0.5, 1.0, 0.98, 1.01, 1.035, 1.5}) edges.push_back({{x, 0, 0}, {x, 1, 0}});
  const SweptSurface surface = sweep(stroke_of(edges), 0.02);  // at 1.01 the blade is in it still
  double area = 0;
  for (const SweptTriangle& t : surface.triangles) {
    const auto at = [&](unsigned k) { return surface.points[t.points[k]].position; };
    area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  EXPECT_NEAR(area, 1.5, 1e-12);
}

TEST(DoublePasses, given_twice_cut_no_more_than_once) {
  for (const Stroke& stroke :
       {path_stroke(parabola(0.4, 0.3), kLow, kHigh), coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 24, kLow, kHigh)}) {
    Engine engine = make_engine(jittered_cube(5, 19));
    cut(engine, stroke);
    const std::size_t tets = engine.mesh().tet_count();
    cut(engine, stroke);
    EXPECT_EQ(engine.mesh().tet_count(), tets);
    EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
  }
}

TEST_P(Strokes, that_stop_and_go_or_hesitate_give_two_pieces) {
  const auto blade = [](double y) { return std::vector<Vec3>{Vec3(0.47, y, kLow), Vec3(0.47, y, kHigh)}; };
  for (const std::vector<double>& places :
       {std::vector<double>{-0.2, 0.4, 0.4, 0.4, 1.2}, std::vector<double>{-0.2, 0.6, 0.3, 1.2},
        std::vector<double>{-0.2, 0.5, 0.49, 0.52, 0.48, 0.55, 1.2}, std::vector<double>{-0.2, 0.6, -0.2, 1.2}}) {
    std::vector<std::vector<Vec3>> edges;
    for (const double y : places) edges.push_back(blade(y));
    Engine engine = engine_on(kuhn_cube(5));
    cut(engine, stroke_of(edges));
    if (GetParam().profile == Profile::kIncise) {
      EXPECT_EQ(find_components(engine.mesh()).count(), 2U) << "stops at " << places[1];
    }
  }
}

// T18
TEST_P(Strokes, without_motion_change_nothing) {
  const std::vector<Vec3> blade = {Vec3(0.4, 0.5, kLow), Vec3(0.45, 0.55, kHigh)};
  const std::vector<Vec3> shifted = {blade[0] + 0.25 * (blade[1] - blade[0]), blade[1] + 0.25 * (blade[1] - blade[0])};
  for (const Stroke& stroke : {stroke_of({blade, blade}), stroke_of({blade, blade, blade}), stroke_of({blade, shifted}),
                               stroke_of({blade, {blade[1], blade[0]}})}) {
    Engine engine = engine_on(kuhn_cube(4));
    const std::uint64_t hash = engine.mesh().hash();
    cut(engine, stroke);
    EXPECT_EQ(engine.mesh().hash(), hash);
    EXPECT_EQ(engine.journal().size(), 0U);
  }
}

TEST_P(Strokes, outside_the_body_change_nothing) {
  Engine engine = engine_on(kuhn_cube(4));
  const std::uint64_t hash = engine.mesh().hash();
  cut(engine, coring_stroke(Vec3(2.5, 0.5, 0), 0.4, 16, kLow, kHigh));
  cut(engine, coring_stroke(Vec3(0.5, 0.5, 0), 3.0, 16, kLow, kHigh));  // around it
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_EQ(engine.journal().size(), 0U);
}

TEST_P(Strokes, that_turn_about_one_end_of_the_blade_cut_a_fan) {
  const Vec3 pivot(0.47, -0.3, -0.3);
  std::vector<std::vector<Vec3>> edges;
  for (const Vec3& p : arc_path(Vec3(-0.3, -0.3, 0), 3.0, 0.0, 0.25, 6)) {
    edges.push_back({pivot, Vec3(0.47, p.x(), p.y())});
  }
  Engine engine = engine_on(kuhn_cube(5));
  cut(engine, stroke_of(edges));
  expect_pieces(engine.mesh(), {0.47, 0.53}, 1e-12);
}

// --- partial cuts
// ------------------------------------------------------------------------------------------------------------------

TEST_P(Strokes, that_stop_inside_leave_one_piece_and_a_closed_front) {
  for (const TetSoup& soup : {kuhn_cube(5), jittered_cube(6, 20)}) {
    for (const double depth : {0.07, 0.3, 0.5, 0.63, 0.97}) {
      SCOPED_TRACE(depth);
      Engine engine = engine_on(soup);
      cut(engine, quad_stroke(Vec3(0.47, kLow, kHigh), Vec3(0.51, kHigh, kHigh), Vec3(0.47, kLow, 1 - depth),
                              Vec3(0.51, kHigh, 1 - depth)));
      EXPECT_EQ(euler_characteristics(engine.mesh()), std::vector<int>{2});
      EXPECT_LE(wall_area(engine.mesh()), 1.3 * depth + 0.05);
      if (depth > 0.4) {
        EXPECT_GE(wall_area(engine.mesh()), depth - 0.3);
      }
    }
  }
}

TEST_P(Strokes, that_stop_inside_may_be_continued_by_another_stroke) {
  Engine engine = engine_on(jittered_cube(6, 21));
  const double front = 0.43;
  cut(engine, quad_stroke(Vec3(0.47, kLow, kHigh), Vec3(0.51, kHigh, kHigh), Vec3(0.47, kLow, front),
                          Vec3(0.51, kHigh, front)));
  ASSERT_EQ(find_components(engine.mesh()).count(), 1U);
  cut(engine,
      quad_stroke(Vec3(0.47, kLow, kHigh), Vec3(0.51, kHigh, kHigh), Vec3(0.47, kLow, kLow), Vec3(0.51, kHigh, kLow)));
  if (GetParam().profile == Profile::kIncise) {
    EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
  }
}

TEST_P(Strokes, that_lie_inside_the_body_keep_one_piece) {
  Engine engine = engine_on(jittered_cube(7, 22));
  cut(engine, quad_stroke(Vec3(0.2, 0.2, 0.5), Vec3(0.2, 0.8, 0.55), Vec3(0.8, 0.2, 0.45), Vec3(0.8, 0.8, 0.5)));
  EXPECT_EQ(find_components(engine.mesh()).count(), 1U);
  EXPECT_GT(wall_area(engine.mesh()), 0.05);
}

TEST_P(Strokes, of_a_coring_cylinder_that_stops_inside_keep_one_piece) {
  Engine engine = engine_on(jittered_cube(7, 23));
  cut(engine, coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 24, kHigh, 0.4));
  EXPECT_EQ(find_components(engine.mesh()).count(), 1U);
  EXPECT_GT(wall_area(engine.mesh()), 0.3);
}

TEST_P(Strokes, with_a_tip_at_mesh_vertices_on_edges_or_in_faces_stay_valid) {
  const double one_above = std::nextafter(0.5, 1.0), one_below = std::nextafter(0.5, 0.0);
  for (const double x : {0.5, one_above, one_below, 0.375}) {
    for (const double tip : {0.5, one_above, one_below, 0.25, 0.4}) {
      for (const double y : {0.5, one_above, 0.75}) {
        SCOPED_TRACE(testing::Message() << x << " " << tip << " " << y);
        Engine engine = engine_on(kuhn_cube(4));
        // Down onto the grid, and a tilted one whose end lies at a grid point.
        cut(engine, quad_stroke(Vec3(x, kLow, kHigh), Vec3(x, y, kHigh), Vec3(x, kLow, tip), Vec3(x, y, tip), 2));
        cut(engine, quad_stroke(Vec3(0, 0, kHigh), Vec3(1, 1, kHigh), Vec3(0, 0, tip), Vec3(x, y, tip), 2));
        EXPECT_EQ(find_components(engine.mesh()).count(), 1U);
      }
    }
  }
}

// T9
TEST_P(Strokes, fifty_partial_and_curved_ones_after_another_stay_valid) {
  Random random(24);
  Engine engine = engine_on(jittered_cube(4, 25));
  const double volume = volume_of(engine.mesh());
  for (unsigned i = 0; i < 50; ++i) {
    SCOPED_TRACE(testing::Message() << "stroke " << i);
    const Vec3 start = random.point(-0.2, 1.2), along = 0.25 * random.point(-1, 1), motion = 0.4 * random.point(-1, 1),
               bend = 0.2 * random.point(-1, 1);
    std::vector<std::vector<Vec3>> edges;
    for (unsigned k = 0; k <= 4; ++k) {
      const double s = 0.25 * k;
      edges.push_back({start + s * motion + s * s * bend, start + along + s * motion - s * s * bend});
    }
    cut(engine, stroke_of(edges));
    if (testing::Test::HasFailure()) return;
  }
  expect_valid(engine.mesh(), volume);
}

// --- defects of the input
// --------------------------------------------------------------------------------------------------------------

TEST(FlatTets, stay_whole_where_a_blade_crosses_them_once_or_twice) {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 1e-13)};
  soup.tets = {{0, 1, 2, 3}};
  const std::vector<Vec3> path = {Vec3(0.3, kHigh, 0), Vec3(0.3, kLow, 0), Vec3(0.6, kLow, 0), Vec3(0.6, kHigh, 0)};
  for (const Stroke& stroke : {profile_stroke(path, kLow, kHigh), path_stroke({path[0], path[1]}, kLow, kHigh)}) {
    Engine engine = make_engine(soup);
    ASSERT_TRUE(engine.cut(stroke).ok());
    EXPECT_EQ(engine.mesh().tet_count(), 1U);
  }
}

}  // namespace
}  // namespace incise::test::strokes_test
