// SPDX-License-Identifier: Apache-2.0
// Cuts that end inside the body: where they end, and that it does not matter in how many steps the blade went there.
#include "cut/progressive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "support/bodies.h"
#include "support/strokes.h"

namespace incise::test::progressive_test {
namespace {

constexpr double kLow = -0.2, kHigh = 1.2;  // beyond the unit cube

/// Down into the unit cube from above, slightly askew, as deep as `depth` at one side and `far_depth` at the other.
Stroke downwards(double depth, double far_depth, unsigned steps) {
  return quad_stroke(Vec3(0.47, kLow, kHigh), Vec3(0.51, kHigh, kHigh), Vec3(0.47, kLow, 1 - depth),
                     Vec3(0.51, kHigh, 1 - far_depth), steps);
}

/// Right through the cube, x = `x`.
Stroke through(double x, unsigned steps) {
  return quad_stroke(Vec3(x, kLow, kHigh), Vec3(x, kHigh, kHigh), Vec3(x, kLow, kLow), Vec3(x, kHigh, kLow), steps);
}

/// What a cut that ends inside must keep to, in a body at rest. `euler` of its surface: 4 where the cut does not reach
/// the skin, and is a ball of its own.
/// `greatest`: of the distance between the cut's border and the blade's, in mean edges.
void expect_exact_front(SteppedEngine& stepped, const Stroke& stroke, std::uint32_t tag, int euler = 2,
                        double greatest = 0.25) {
  const double h = stepped.h();
  EXPECT_EQ(euler_characteristics(stepped.mesh()), std::vector<int>{euler});
  const bench::Accuracy walls = bench::measure_accuracy(stepped.mesh(), stepped.body(), stroke, tag);
  const double allowed = std::max(0.02 * walls.sweep_area, 0.1 * h * border_length(stepped, stroke));
  EXPECT_LE(walls.area_error * walls.sweep_area, allowed) << "of an area of " << walls.sweep_area;
  EXPECT_GT(walls.sweep_area, 0);
  EXPECT_LE(walls.hausdorff, greatest > 0.25 ? 0.5 : 0.25);
  EXPECT_LE(walls.mean, 0.05);
  const Deviation border = border_deviation(stepped, stroke, tag);
  EXPECT_LE(border.greatest, greatest * h);
  EXPECT_LE(border.mean, (greatest > 0.25 ? 0.06 : 0.05) * h);
}

struct Body {
  const char* name;
  TetSoup (*make)();
};

struct Setting {
  Body body;
  double snap;
};

void PrintTo(const Setting& setting, std::ostream* out) {  // NOLINT(readability-identifier-naming): GoogleTest's
  *out << setting.body.name << ", snap " << setting.snap;
}

class Progressive : public testing::TestWithParam<Setting> {
 protected:
  static TetSoup body() { return GetParam().body.make(); }
  static SteppedOptions options() { return {GetParam().snap, false}; }
  /// The box of the ball is [-1, 1]³: what is meant for the unit cube is moved there.
  static Stroke fitted(Stroke stroke) {
    if (!is_ball()) return stroke;
    for (auto& edge : stroke.edges) {
      for (Vec3& p : edge) p = 2.0 * p - Vec3::Ones();
    }
    return stroke;
  }
  static bool is_ball() { return std::string(GetParam().body.name) == "ball"; }
};

const Body kCube{"cube", [] { return kuhn_cube(5); }}, kJittered{"jittered", [] { return jittered_cube(6, 41); }},
    kBall{"ball", [] { return ball(8); }};
INSTANTIATE_TEST_SUITE_P(settings, Progressive,
                         testing::Values(Setting{kCube, 0.0}, Setting{kCube, 0.2}, Setting{kJittered, 0.0},
                                         Setting{kJittered, 0.2}, Setting{kBall, 0.0}, Setting{kBall, 0.2}),
                         [](const auto& setting) {
                           return std::string(setting.param.body.name) +
                                  (setting.param.snap > 0 ? "_snap" : "_no_snap");
                         });

// --- where cuts end
// -----------------------------------------------------------------------------------------------------------------

// T14
TEST_P(Progressive, planes_that_stop_inside_end_where_the_blade_stands) {
  for (const double depth : {0.17, 0.3, 0.5, 0.63, 0.88}) {
    SCOPED_TRACE(depth);
    SteppedEngine stepped(body(), options());
    const Stroke stroke = fitted(downwards(depth, depth, 15));
    const std::uint32_t tag = stepped.run(stroke);
    expect_exact_front(stepped, stroke, tag);
  }
}

TEST_P(Progressive, planes_that_stop_askew_end_where_the_blade_stands) {
  SteppedEngine stepped(body(), options());
  const Stroke stroke = fitted(downwards(0.31, 0.74, 24));
  const std::uint32_t tag = stepped.run(stroke);
  expect_exact_front(stepped, stroke, tag);
}

TEST_P(Progressive, blades_with_their_tip_inside_end_at_the_tip_too) {
  for (const double tip : {0.35, 0.52, 0.81}) {
    SCOPED_TRACE(tip);
    SteppedEngine stepped(body(), options());
    // The tip hangs from above; the blade moves along y and stops inside.
    const Stroke stroke = fitted(
        quad_stroke(Vec3(0.48, kLow, kHigh), Vec3(0.48, kLow, tip), Vec3(0.52, 0.66, kHigh), Vec3(0.5, 0.66, tip), 20));
    const std::uint32_t tag = stepped.run(stroke);
    // Where both strands of the border pass through one tet beside the corner, its one front point lies between them:
    // so at one place in the jittered cube.
    const bool has_both_strands = std::string(GetParam().body.name) == "jittered" && tip == 0.35;
    expect_exact_front(stepped, stroke, tag, 2, has_both_strands ? 0.5 : 0.25);
  }
}

TEST_P(Progressive, curved_cuts_that_stop_inside_end_where_the_blade_stands) {
  SteppedEngine stepped(body(), options());
  std::vector<Vec3> path;
  for (unsigned i = 0; i <= 20; ++i) {
    const double y = kLow + 0.9 * i / 20;
    path.emplace_back(0.42 + 0.3 * (y - 0.3) * (y - 0.3), y, 0.0);
  }
  const Stroke stroke = fitted(path_stroke(path, kLow, kHigh));
  const std::uint32_t tag = stepped.run(stroke);
  expect_exact_front(stepped, stroke, tag);
}

TEST_P(Progressive, twisting_blades_end_where_they_stand) {
  SteppedEngine stepped(body(), options());
  std::vector<std::vector<Vec3>> edges;
  for (unsigned i = 0; i <= 24; ++i) {
    const double s = i / 24.0, turn = 0.25 * s;
    const Vec3 along(turn, 1.0, 0.1 * turn);
    const Vec3 centre(0.49, 0.5, kHigh - 0.75 * s);
    edges.push_back(divided_edge(centre - 0.8 * along, centre + 0.8 * along, 12));
  }
  const Stroke stroke = fitted(stroke_of(edges));
  const std::uint32_t tag = stepped.run(stroke);
  expect_exact_front(stepped, stroke, tag);
}

TEST_P(Progressive, blades_that_start_inside_cut_from_there) {
  SteppedEngine stepped(body(), options());
  const Stroke stroke = fitted(
      quad_stroke(Vec3(0.25, 0.3, 0.47), Vec3(0.25, 0.7, 0.5), Vec3(0.75, 0.28, 0.53), Vec3(0.75, 0.72, 0.52), 12));
  const std::uint32_t tag = stepped.run(stroke);
  expect_exact_front(stepped, stroke, tag, 4);
}

/// A blade that hangs `depth` deep into the cube and is moved along the direction `along`, from `from` on.
Stroke dragged(const Vec3& from, const Vec3& along, double depth) {
  const Vec3 top = from + Vec3(0, 0, 1.0625), tip = from + Vec3(0, 0, 1.0 - depth);
  return quad_stroke(top + 0.2 * along, tip + 0.2 * along, top + 0.8 * along, tip + 0.8 * along, 30);
}

/// How much of the swept area a stroke opens in the cube of 6³ cells, whose tets have sides in the stroke's plane.
double opened_share(const Stroke& stroke, const Vec3& along, double depth) {
  SteppedEngine stepped(kuhn_cube(6), {0.2, false});
  stepped.run(stroke);
  EXPECT_EQ(stepped.piece_count(), 1U);
  return wall_area(stepped.mesh()) / (0.6 * along.norm() * depth);
}

TEST(PlanesOfFaces, are_opened_by_a_blade_dragged_along_them_however_shallow) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  for (const double depth : {0.05, 0.125, 0.2, 1.0 / 3.0, 0.45}) {
    for (const double off : {0.0, 1e-9}) {
      SCOPED_TRACE(testing::Message() << "depth " << depth << ", " << off << " off the plane");
      EXPECT_GE(opened_share(dragged((0.5 + off) * y, x, depth), x, depth), 0.75);
      EXPECT_GE(opened_share(dragged((0.5 + off) * x, y, depth), y, depth), 0.75);
      EXPECT_GE(opened_share(dragged(off * x, x + y, depth), x + y, depth), 0.75);
    }
  }
}

TEST(PlanesOfFaces, on_the_skin_are_left_alone) {
  SteppedEngine stepped(kuhn_cube(6), {0.2, false});
  stepped.run(dragged(Vec3(0, 1, 0), Vec3::UnitX(), 0.125));
  EXPECT_EQ(wall_area(stepped.mesh()), 0.0);
  EXPECT_EQ(stepped.mesh().hash(), stepped.input().hash());
}

TEST(PlanesOfFaces, cut_before_are_left_alone) {
  SteppedEngine stepped(kuhn_cube(6), {0.2, false});
  stepped.run(subdivided(
      quad_stroke(Vec3(-0.2, 0.5, 1.2), Vec3(-0.2, 0.5, -0.2), Vec3(1.2, 0.5, 1.2), Vec3(1.2, 0.5, -0.2)), 20));
  const std::uint64_t hash = stepped.mesh().hash();
  stepped.run(dragged(0.5 * Vec3::UnitY(), Vec3::UnitX(), 0.125));
  EXPECT_EQ(stepped.mesh().hash(), hash);
}

TEST_P(Progressive, every_step_cuts_up_to_the_blade) {
  SteppedEngine stepped(body(), options());
  const Stroke stroke = fitted(downwards(0.77, 0.77, 30));
  const std::vector<BladePose> poses = poses_of(stroke);
  stepped.begin(poses[0]);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "step " << i);
    if (!stepped.step(poses[i])) break;
    Stroke so_far = stroke;
    so_far.times.resize(i + 1);
    so_far.edges.resize(i + 1);
    double area = 0;
    for (const auto& t : stepped.body().clip(swept_triangles(so_far))) {
      area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    }
    // A step shorter than 0.15 h may wait for the next.
    const double allowed = std::max(0.02 * area, 0.25 * stepped.h() * border_length(stepped, so_far));
    EXPECT_NEAR(wall_area(stepped.mesh()), area, allowed);
    EXPECT_EQ(stepped.piece_count(), 1U);
  }
  stepped.end();
}

// --- any number of steps
// ------------------------------------------------------------------------------------------------------------

// T15
TEST(StepCounts, do_not_change_a_partial_cut) {
  for (const TetSoup& soup : {kuhn_cube(5), jittered_cube(6, 42)}) {
    SteppedEngine reference(soup);
    reference.run(downwards(0.53, 0.61, 15));
    for (const unsigned steps : {1U, 60U, 240U}) {
      SCOPED_TRACE(steps);
      SteppedEngine stepped(soup);
      stepped.run(downwards(0.53, 0.61, steps));
      EXPECT_EQ(stepped.mesh().tet_count(), reference.mesh().tet_count());
      EXPECT_EQ(tets_by_place(stepped.mesh()), tets_by_place(reference.mesh()));
      EXPECT_NEAR(wall_area(stepped.mesh()), wall_area(reference.mesh()), 1e-9);
    }
  }
}

TEST(StepCounts, do_not_change_a_through_cut) {
  for (const TetSoup& soup : {kuhn_cube(5), jittered_cube(6, 43)}) {
    SteppedEngine reference(soup);
    reference.run(through(0.47, 15));
    EXPECT_EQ(reference.piece_count(), 2U);
    for (const unsigned steps : {1U, 60U, 240U}) {
      SCOPED_TRACE(steps);
      SteppedEngine stepped(soup);
      stepped.run(through(0.47, steps));
      EXPECT_EQ(stepped.mesh().tet_count(), reference.mesh().tet_count());
      EXPECT_EQ(tets_by_place(stepped.mesh()), tets_by_place(reference.mesh()));
      EXPECT_NEAR(wall_area(stepped.mesh()), 1.0, 1e-9);
      expect_pieces(stepped.mesh(), {0.47, 0.53}, 1e-9);
    }
  }
}

TEST(StepCounts, do_not_change_pieces_and_area_with_snapping) {
  for (const double depth : {0.57, 1.4}) {
    SteppedEngine reference(jittered_cube(6, 44), {0.2, false});
    reference.run(downwards(depth, depth, 15));
    for (const unsigned steps : {1U, 60U, 240U}) {
      SCOPED_TRACE(testing::Message() << "depth " << depth << ", " << steps << " steps");
      SteppedEngine stepped(jittered_cube(6, 44), {0.2, false});
      stepped.run(downwards(depth, depth, steps));
      EXPECT_EQ(stepped.piece_count(), reference.piece_count());
      const double area = wall_area(reference.mesh());
      EXPECT_NEAR(wall_area(stepped.mesh()), area, std::max(0.02 * area, 0.1 * stepped.h()));
    }
  }
}

// --- what is no motion
// --------------------------------------------------------------------------------------------------------------

/// Steps that must leave the mesh as it is; the journal may hold no step of theirs.
void expect_nothing_done(SteppedEngine& stepped, const std::vector<BladePose>& poses) {
  const std::uint64_t hash = stepped.mesh().hash();
  const std::size_t position = stepped.engine().journal().position();
  for (const BladePose& pose : poses) {
    ASSERT_TRUE(stepped.step(pose));
    ASSERT_EQ(stepped.mesh().hash(), hash);
    ASSERT_EQ(stepped.engine().journal().position(), position);
  }
}

class NoMotion : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(snaps, NoMotion, testing::Values(0.0, 0.2),
                         [](const auto& snap) { return snap.param > 0 ? "snap" : "no_snap"; });

// T18
TEST_P(NoMotion, of_a_blade_outside_changes_nothing) {
  SteppedEngine stepped(kuhn_cube(4), {GetParam(), false});
  std::vector<BladePose> poses = poses_of(
      quad_stroke(Vec3(1.3, kLow, kHigh), Vec3(1.3, kHigh, kHigh), Vec3(1.4, kLow, kLow), Vec3(1.4, kHigh, kLow), 9));
  stepped.begin(poses[0]);
  expect_nothing_done(stepped, poses);
  stepped.end();
  EXPECT_EQ(stepped.engine().journal().size(), 0U);
  EXPECT_EQ(stepped.mesh().hash(), stepped.input().hash());
}

TEST_P(NoMotion, inside_changes_nothing_whatever_the_direction) {
  SteppedEngine stepped(kuhn_cube(4), {GetParam(), false});
  BladePose pose{{Vec3(0.4, 0.5, kLow), Vec3(0.45, 0.55, kHigh)}, Vec3::Zero()};
  stepped.begin(pose);
  std::vector<BladePose> poses(3, pose);
  for (unsigned i = 0; i < 8; ++i) {
    const auto [x, y] = on_circle(i / 8.0);
    pose.direction = Vec3(x, y, 0.1);
    poses.push_back(pose);
  }
  expect_nothing_done(stepped, poses);
  stepped.end();
  EXPECT_EQ(stepped.engine().journal().size(), 0U);
}

TEST_P(NoMotion, along_the_edge_itself_changes_nothing) {
  SteppedEngine stepped(kuhn_cube(4), {GetParam(), false});
  const Vec3 a(0.375, 0.5, -1.5), b(0.375, 0.5, 2.5);  // the shift is exact: nothing is swept
  stepped.begin({{a, b}, Vec3::Zero()});
  expect_nothing_done(stepped, {{{a + Vec3(0, 0, 0.25), b + Vec3(0, 0, 0.25)}, Vec3::Zero()},
                                {{a - Vec3(0, 0, 0.25), b - Vec3(0, 0, 0.25)}, Vec3::Zero()}});
  stepped.end();
  EXPECT_EQ(stepped.mesh().hash(), stepped.input().hash());
}

TEST_P(NoMotion, in_the_middle_of_a_cut_changes_nothing) {
  SteppedEngine stepped(jittered_cube(5, 45), {GetParam(), false});
  const std::vector<BladePose> poses = poses_of(downwards(0.55, 0.55, 12));
  stepped.begin(poses[0]);
  for (std::size_t i = 1; i < poses.size(); ++i) stepped.step(poses[i]);
  stepped.step(poses.back());  // what waited for more motion is cut now
  std::vector<BladePose> still(10, poses.back());
  for (std::size_t i = 5; i < still.size(); ++i) still[i].direction = Vec3(0.1 * static_cast<double>(i), 0, -1);
  expect_nothing_done(stepped, still);
  stepped.end();
}

// --- undo
// --------------------------------------------------------------------------------------------------------------------

TEST_P(NoMotion, undo_in_the_middle_of_a_stroke_takes_it_back_and_ends_it) {
  SteppedEngine stepped(jittered_cube(5, 46), {GetParam(), false});
  Engine& engine = stepped.engine();
  const std::vector<BladePose> poses = poses_of(through(0.47, 20));
  stepped.begin(poses[0]);
  for (std::size_t i = 1; i < 12; ++i) stepped.step(poses[i]);
  const std::uint64_t half_way = stepped.mesh().hash();
  EXPECT_NE(half_way, stepped.input().hash());
  ASSERT_TRUE(engine.undo());
  EXPECT_EQ(stepped.mesh().hash(), stepped.input().hash());
  EXPECT_FALSE(engine.is_in_stroke());
  ASSERT_TRUE(engine.redo());
  EXPECT_EQ(stepped.mesh().hash(), half_way);
  stepped.expect_sound();
  ASSERT_TRUE(engine.undo());
  EXPECT_EQ(stepped.run(through(0.47, 20)), 1U);
  EXPECT_EQ(stepped.piece_count(), 2U);
}

TEST_P(NoMotion, undo_takes_strokes_back_one_by_one) {
  SteppedEngine stepped(jittered_cube(5, 47), {GetParam(), false});
  std::vector<std::uint64_t> hashes = {stepped.mesh().hash()};
  for (const double x : {0.31, 0.52, 0.77}) {
    stepped.run(through(x, 12));
    hashes.push_back(stepped.mesh().hash());
  }
  for (std::size_t i = hashes.size(); i-- > 1;) {
    EXPECT_EQ(stepped.mesh().hash(), hashes[i]);
    ASSERT_TRUE(stepped.engine().undo());
  }
  EXPECT_EQ(stepped.mesh().hash(), hashes[0]);
  while (stepped.engine().redo()) {
  }
  EXPECT_EQ(stepped.mesh().hash(), hashes.back());
  EXPECT_EQ(stepped.piece_count(), 4U);
}

TEST(Steps, that_are_refused_change_nothing_and_the_stroke_goes_on) {
  SteppedEngine stepped(jittered_cube(5, 48));
  Engine& engine = stepped.engine();
  const std::vector<BladePose> poses = poses_of(through(0.47, 10));
  EXPECT_FALSE(engine.step(poses[0]).ok());
  EXPECT_FALSE(engine.end_stroke().ok());
  stepped.begin(poses[0]);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    stepped.step(poses[i]);
    const std::uint64_t hash = stepped.mesh().hash();
    EXPECT_FALSE(engine.step({{poses[i].edge[0]}, Vec3::Zero()}).ok());
    EXPECT_FALSE(engine.step({{poses[i].edge[0], Vec3(0, NAN, 0)}, Vec3::Zero()}).ok());
    EXPECT_FALSE(engine.begin_stroke(poses[0]).ok());
    EXPECT_EQ(stepped.mesh().hash(), hash);
  }
  stepped.end();
  EXPECT_EQ(stepped.piece_count(), 2U);
}

}  // namespace
}  // namespace incise::test::progressive_test
