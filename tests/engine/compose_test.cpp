// SPDX-License-Identifier: Apache-2.0
// Strokes that meet older cuts: what they cut together is the union of their sheets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "incise/mesh/quality_stats.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::compose_test {
namespace {

using Row = std::vector<Vec3>;
using Rows = std::vector<Row>;

/// A plane through the middle of the unit cube, oblique to its mesh: an edge along `a` that is swept along `b`.
struct Plane {
  Vec3 centre = Vec3(0.52, 0.47, 0.55);
  Vec3 a = Vec3(0.9, 0.3, 0.2).normalized();
  Vec3 n = Vec3(0.9, 0.3, 0.2).cross(Vec3(0.1, 0.8, 0.5)).normalized();
  Vec3 b = n.cross(a);

  [[nodiscard]] Row at(double s, double from = -2.0, double to = 2.0, double lift = 0.0) const {
    return {centre + s * b + from * a + lift * n, centre + s * b + to * a + lift * n};
  }
  [[nodiscard]] Rows sweep(double from, double to, unsigned steps, double lift = 0.0) const {
    Rows rows;
    for (unsigned i = 0; i <= steps; ++i) rows.push_back(at(from + (to - from) * i / steps, -2.0, 2.0, lift));
    return rows;
  }
};

constexpr double kWhole = 1.1;  // as far from the middle as the plane reaches, and a little beyond
constexpr double kElement = 0.2;

Engine engine_for(TetSoup soup, const EngineOptions& options = {}) {
  auto engine = Engine::create(build(std::move(soup)), options);
  EXPECT_TRUE(engine) << engine.error().message;
  return std::move(*engine);
}

/// Makes one stroke along some rows; the mesh stays valid.
void stroke(Engine& engine, const Rows& rows) {
  const double volume = volume_of(engine.mesh());
  const auto pose = [](const Row& row) {
    BladePose at;
    at.edge = row;
    return at;
  };
  ASSERT_TRUE(engine.begin_stroke(pose(rows.front())));
  for (std::size_t i = 1; i < rows.size(); ++i) ASSERT_TRUE(engine.step(pose(rows[i])));
  ASSERT_TRUE(engine.end_stroke());
  expect_valid(engine.mesh(), volume, 1e-11);
}

std::size_t pieces(const Engine& engine) {
  return piece_volumes(engine.mesh()).size();
}

double worst(const Engine& engine) {
  return measure_quality(engine.mesh()).lr_max;
}

/// The growth of the body in one stroke along the whole plane.
double growth_in_one(const TetSoup& soup, const Plane& plane) {
  Engine engine = engine_for(soup);
  const auto before = static_cast<double>(engine.mesh().tet_count());
  stroke(engine, plane.sweep(-kWhole, kWhole, 20));
  EXPECT_EQ(pieces(engine), 2U);
  return static_cast<double>(engine.mesh().tet_count()) - before;
}

TEST(Compose, strokes_that_go_on_from_each_other_are_one) {
  const Plane plane;
  const double one = growth_in_one(kuhn_cube(5), plane);
  for (const unsigned count : {2U, 3U, 5U, 7U, 14U}) {
    SCOPED_TRACE(count);
    Engine engine = engine_for(kuhn_cube(5));
    const auto before = static_cast<double>(engine.mesh().tet_count());
    for (unsigned i = 0; i < count; ++i) {
      const double from = -kWhole + 2 * kWhole * i / count, to = -kWhole + 2 * kWhole * (i + 1) / count;
      stroke(engine, plane.sweep(from, to, 1 + 20 / count));
    }
    EXPECT_EQ(pieces(engine), 2U);
    EXPECT_LE(worst(engine), 25.0);
    EXPECT_LT(static_cast<double>(engine.mesh().tet_count()) - before, 1.3 * std::max(one, 40.0));
  }
}

/// Rows of a blade that turns by `turn` about the middle of the cube while it passes through it.
Rows screw(double turn, unsigned steps) {
  const Plane plane;
  Rows rows;
  for (unsigned i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const Vec3 along = std::cos(turn * t) * plane.a + std::sin(turn * t) * plane.n;
    const Vec3 middle = plane.centre + kWhole * (2 * t - 1) * plane.b;
    rows.push_back({middle - 2.0 * along, middle + 2.0 * along});
  }
  return rows;
}

TEST(Compose, a_blade_that_turns_does_not_meet_what_it_cut) {
  for (const double turn : {0.5, 1.5, 3.0}) {
    for (const unsigned steps : {12U, 48U}) {
      SCOPED_TRACE(testing::Message() << turn << " " << steps);
      Engine engine = engine_for(kuhn_cube(5));
      stroke(engine, screw(turn, steps));
      EXPECT_EQ(pieces(engine), 2U);
      EXPECT_LE(worst(engine), 60.0);
      EXPECT_LT(engine.mesh().tet_count(), 1400U);
    }
  }
}

TEST(Compose, strokes_that_overlap_are_one) {
  const Plane plane;
  for (const double overlap : {0.05, 0.25, 0.5, 1.0, 2.0}) {
    SCOPED_TRACE(overlap);
    Engine engine = engine_for(kuhn_cube(5));
    stroke(engine, plane.sweep(-kWhole, 0.03, 10));
    stroke(engine, plane.sweep(0.03 - overlap * kElement, kWhole, 10));
    EXPECT_EQ(pieces(engine), 2U);
    EXPECT_LE(worst(engine), 25.0);
  }
}

TEST(Compose, strokes_with_tissue_between_them_stay_two) {
  const Plane plane;
  for (const double gap : {0.25, 0.5, 1.0}) {
    SCOPED_TRACE(gap);
    Engine engine = engine_for(kuhn_cube(5));
    stroke(engine, plane.sweep(-kWhole, 0.03, 10));
    stroke(engine, plane.sweep(0.03 + gap * kElement, kWhole, 10));
    EXPECT_EQ(pieces(engine), 1U);
  }
}

TEST(Compose, strokes_from_both_sides_meet) {
  const Plane plane;
  for (const double over : {0.0, 0.05, 0.25}) {
    SCOPED_TRACE(over);
    Engine engine = engine_for(kuhn_cube(5));
    stroke(engine, plane.sweep(-kWhole, 0.03 + over * kElement, 10));
    stroke(engine, plane.sweep(kWhole, 0.03 - over * kElement, 10));
    EXPECT_EQ(pieces(engine), 2U);
    EXPECT_LE(worst(engine), 25.0);
  }
}

TEST(Compose, deeper_passes_over_one_line_are_one) {
  const Plane plane;
  Engine engine = engine_for(kuhn_cube(5));
  for (const double depth : {-0.2, 0.1, 0.35, 2.0}) {
    Rows rows;
    for (unsigned i = 0; i <= 12; ++i) rows.push_back(plane.at(-kWhole + 2 * kWhole * i / 12, -2.0, depth));
    stroke(engine, rows);
  }
  EXPECT_EQ(pieces(engine), 2U);
  EXPECT_LE(worst(engine), 25.0);
}

TEST(Compose, the_same_partial_stroke_again_changes_next_to_nothing) {
  const Plane plane;
  for (const TetSoup& soup : {kuhn_cube(5), jittered_cube(6, 4)}) {
    Engine engine = engine_for(soup);
    stroke(engine, plane.sweep(-kWhole, 0.1, 8));
    const auto before = static_cast<double>(engine.mesh().tet_count());
    for (unsigned i = 0; i < 10; ++i) stroke(engine, plane.sweep(-kWhole, 0.1, 8));
    EXPECT_EQ(pieces(engine), 1U);
    EXPECT_LT(static_cast<double>(engine.mesh().tet_count()), 1.02 * before);
  }
}

/// A hand wanders by a tenth of the mean edge to either side: 0.2 of it lie between two of its strokes. In a cube of
/// three cells that is more than 0.2 of the typical edge.
TEST(Compose, the_same_partial_stroke_beside_itself_changes_next_to_nothing) {
  const Plane plane;
  const TetSoup soup = kuhn_cube(3);
  for (const double lift : {-0.086, 0.086}) {
    SCOPED_TRACE(lift);
    Engine engine = engine_for(soup);
    stroke(engine, plane.sweep(-kWhole, 0.1, 8));
    const std::size_t before = engine.mesh().tet_count();
    stroke(engine, plane.sweep(-kWhole, 0.1, 8, lift));
    EXPECT_EQ(pieces(engine), 1U);
    EXPECT_LE(engine.mesh().tet_count(), before + before / 20);
  }
}

TEST(Compose, a_stroke_that_starts_at_a_wall_reaches_it_and_spares_the_other_lip) {
  const Plane plane;
  Engine engine = engine_for(kuhn_cube(5));
  stroke(engine, plane.sweep(-kWhole, kWhole, 20));
  const std::vector<double> halves = piece_volumes(engine.mesh());
  ASSERT_EQ(halves.size(), 2U);
  Rows rows;  // upright on the first plane, on the side that its normal points to
  for (unsigned i = 0; i <= 16; ++i) {
    const Vec3 foot = plane.centre + (-kWhole + 2 * kWhole * i / 16) * plane.b;
    rows.push_back({foot, foot + 2.0 * plane.n});
  }
  stroke(engine, rows);
  const std::vector<double> volumes = piece_volumes(engine.mesh());
  EXPECT_EQ(volumes.size(), 3U);
  const auto is_there = [&](double volume) {
    return std::any_of(volumes.begin(), volumes.end(), [&](double v) { return std::abs(v - volume) < 1e-9; });
  };
  EXPECT_TRUE(is_there(halves[0]) || is_there(halves[1]));  // one half is as it was
}

TEST(Compose, planes_that_cross_make_four_pieces) {
  const Plane plane;
  Engine engine = engine_for(kuhn_cube(5));
  stroke(engine, plane.sweep(-kWhole, kWhole, 20));
  Plane other;
  other.a = plane.n;
  other.n = -plane.a;
  stroke(engine, other.sweep(-kWhole, kWhole, 16));
  EXPECT_EQ(pieces(engine), 4U);
}

TEST(Compose, planes_through_one_axis_leave_no_splinters_between_each_other) {
  struct Star {
    Vec3 from, to;    // the axis
    Rows half_edges;  // of the blade, from the axis to one end
  };
  const std::vector<Star> stars = {{{1.1513, 0.8167, -0.0658},
                                    {-0.4112, 0.6088, 0.451},
                                    {{{0.6053, -1.8854, 1.0719}},
                                     {{0.1258, -2.1916, -0.5009}},
                                     {{-0.3092, -1.5829, -1.5713}},
                                     {{-0.6511, -0.3809, -2.1216}},
                                     {{-0.7473, 1.0997, -1.8172}}}},
                                   {{1.5043, 0.9668, 0.8151},
                                    {0.4785, -0.3922, -0.2277},
                                    {{{-1.7643, 0.28, 1.3707}},
                                     {{-0.7351, -0.9184, 1.92}},
                                     {{0.3802, -1.5246, 1.6128}},
                                     {{1.4048, -1.6083, 0.7141}},
                                     {{1.927, -1.0121, -0.5766}}}}};
  for (const Star& star : stars) {
    Engine engine = engine_for(kuhn_cube(5));
    for (const Row& half : star.half_edges) {
      Rows rows;
      for (unsigned i = 0; i < 12; ++i) {
        const Vec3 middle = star.from + (star.to - star.from) * (i / 11.0);
        rows.push_back({middle - half[0], middle + half[0]});
      }
      stroke(engine, rows);
    }
    EXPECT_LE(worst(engine), 25.0);
  }
}

/// Walls that maintenance has smoothed pass their axis within a thousandth of an edge: the third plane cuts a chip off.
TEST(Compose, planes_through_one_axis_leave_no_chips_where_nothing_snaps) {
  const std::vector<std::array<Row, 2>> planes = {
      {{{{-1.70004, -0.196667, -0.726921}, {1.750075, 2.387495, 0.576464}},
        {{-1.060471, -1.590819, 0.344234}, {2.389644, 0.993343, 1.647619}}}},
      {{{{-1.769624, 1.304516, 1.268476}, {1.819658, 0.886312, -1.418933}},
        {{-1.130055, -0.089636, 2.339631}, {2.459227, -0.50784, -0.347778}}}},
      {{{{0.079716, 2.482578, 1.697562}, {-0.029681, -0.29175, -1.848019}},
        {{0.719284, 1.088426, 2.768717}, {0.609888, -1.685902, -0.776863}}}}};
  EngineOptions options;
  options.cut.snap = 0;
  Engine engine = engine_for(kuhn_cube(8), options);
  for (const auto& [first, last] : planes) {
    Rows rows;
    for (unsigned i = 0; i < 12; ++i) {
      const double t = i / 11.0;
      rows.push_back({first[0] + t * (last[0] - first[0]), first[1] + t * (last[1] - first[1])});
    }
    stroke(engine, rows);
  }
  EXPECT_EQ(pieces(engine), 6U);
}

TEST(Compose, undo_takes_the_second_stroke_back_and_it_can_be_made_again) {
  const Plane plane;
  Engine engine = engine_for(kuhn_cube(5));
  stroke(engine, plane.sweep(-kWhole, 0.03, 10));
  const std::uint64_t half = engine.mesh().hash();
  stroke(engine, plane.sweep(0.03, kWhole, 10));
  EXPECT_EQ(pieces(engine), 2U);
  ASSERT_TRUE(engine.undo());
  EXPECT_EQ(engine.mesh().hash(), half);
  stroke(engine, plane.sweep(0.03, kWhole, 10));
  EXPECT_EQ(pieces(engine), 2U);
}

}  // namespace
}  // namespace incise::test::compose_test
