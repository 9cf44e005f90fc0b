// SPDX-License-Identifier: Apache-2.0
// Blades as people move them, through bodies that stand still and bodies that move: what falls apart, and what does
// not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cut/progressive.h"
#include "incise/mesh/bounds.h"
#include "support/bodies.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test::progressive_motion_test {
namespace {

constexpr double kLow = -0.2, kHigh = 1.2;  // beyond the unit cube
constexpr double kCrumb = 0.02;             // of h³: a piece below it is a crumb

/// Across the cube along y, x = `x`: where the blade stands at y.
std::vector<Vec3> blade_at(double y, double x = 0.47) {
  return {Vec3(x, y, kLow), Vec3(x, y, kHigh)};
}

/// The blade at all these places, in steps of at most `spacing` between them.
Stroke visiting(const std::vector<double>& places, double spacing = 0.03, double x = 0.47) {
  std::vector<std::vector<Vec3>> edges = {blade_at(places[0], x)};
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double way = places[i + 1] - places[i], count = std::max(1.0, std::ceil(std::abs(way) / spacing));
    for (double k = 1; k < count; ++k) edges.push_back(blade_at(places[i] + k / count * way, x));
    edges.push_back(blade_at(places[i + 1], x));
  }
  return stroke_of(std::move(edges));
}

/// So many pieces, none of them a crumb.
void expect_whole_pieces(const SteppedEngine& stepped, std::size_t count) {
  const std::vector<double> volumes = piece_volumes(stepped.mesh());
  EXPECT_EQ(volumes.size(), count);
  EXPECT_GE(volumes.front(), kCrumb * std::pow(stepped.h(), 3));
}

class Motion : public testing::TestWithParam<double> {
 protected:
  static SteppedOptions options() { return {GetParam(), false}; }
  static bool snaps() { return GetParam() > 0; }
};
INSTANTIATE_TEST_SUITE_P(snaps, Motion, testing::Values(0.0, 0.2),
                         [](const auto& snap) { return snap.param > 0 ? "snap" : "no_snap"; });

// --- twenty steps through the cube of 6,000 tets
// ----------------------------------------------------------------------------------------

TEST_P(Motion, in_twenty_steps_divides_the_cube_of_6000_tets) {
  for (const double x : {0.47, 0.5, 0.503, 0.55}) {
    SCOPED_TRACE(x);
    SteppedEngine stepped(kuhn_cube(10), options());
    stepped.run(subdivided(stroke_of({blade_at(kLow, x), blade_at(kHigh, x)}), 20));
    EXPECT_EQ(stepped.piece_count(), 2U);
    EXPECT_NEAR(boundary_area(stepped.mesh()), 8.0, 1e-9);
  }
}

TEST(MaintainedMotion, in_twenty_steps_leaves_no_bad_tets) {
  for (const double x : {0.47, 0.503, 0.55}) {
    SCOPED_TRACE(x);
    SteppedEngine stepped(kuhn_cube(10), {0.2, true});
    stepped.run(subdivided(stroke_of({blade_at(kLow, x), blade_at(kHigh, x)}), 20));
    EXPECT_EQ(stepped.piece_count(), 2U);
    EXPECT_NEAR(boundary_area(stepped.mesh()), 8.0, 1e-9);
    EXPECT_EQ(count_bad_tets(stepped.mesh()), 0U);
  }
}

// --- fast, slow, beyond
// ---------------------------------------------------------------------------------------------------------

TEST_P(Motion, in_one_step_through_the_whole_body_divides_it) {
  for (const TetSoup& soup : {jittered_cube(6, 61), ball(8)}) {
    SteppedEngine stepped(soup, options());
    stepped.run(stroke_of({{Vec3(0.11, -3, -3), Vec3(0.13, -3, 3)}, {Vec3(0.15, 3, -3), Vec3(0.12, 3, 3)}}));
    expect_whole_pieces(stepped, 2);
  }
}

TEST_P(Motion, in_very_small_steps_cuts_what_it_passes) {
  SteppedEngine stepped(jittered_cube(5, 62), options());
  const double h = stepped.h(), start = 0.41;
  std::vector<std::vector<Vec3>> edges = {blade_at(kLow), blade_at(start)};
  for (unsigned i = 1; i <= 400; ++i) edges.push_back(blade_at(start + 1e-4 * h * i));
  edges.push_back(blade_at(start + 0.3 * h));
  for (unsigned i = 1; i <= 400; ++i) edges.push_back(blade_at(start + 0.3 * h + 1e-4 * h * i));
  const double end = edges.back()[0].y();
  stepped.run(stroke_of(edges));
  EXPECT_EQ(stepped.piece_count(), 1U);
  EXPECT_NEAR(wall_area(stepped.mesh()), end, std::max(0.02 * end, 0.1 * h));
}

TEST_P(Motion, in_very_small_steps_only_gets_where_one_step_gets) {
  std::vector<std::vector<Vec3>> edges;
  for (unsigned i = 0; i <= 600; ++i) edges.push_back(blade_at(-1e-3 + 1e-4 * i));
  SteppedEngine slow(kuhn_cube(5), options()), fast(kuhn_cube(5), options());
  slow.run(stroke_of(edges));
  fast.run(stroke_of({edges.front(), edges.back()}));
  EXPECT_EQ(slow.mesh().tet_count(), fast.mesh().tet_count());
  EXPECT_NEAR(wall_area(slow.mesh()), wall_area(fast.mesh()), 0.1 * slow.h());
}

TEST_P(Motion, that_leaves_on_the_other_side_divides_the_body) {
  for (const double turn : {0.0, 0.4, -0.9}) {
    SCOPED_TRACE(turn);
    SteppedEngine stepped(jittered_cube(6, 63), options());
    stepped.run(quad_stroke(Vec3(0.45, kLow, -0.7), Vec3(0.51, kLow, 1.7), Vec3(0.49, kHigh + 0.3, -0.7 + turn),
                            Vec3(0.52, kHigh + 0.3, 1.7 + turn), 40));
    expect_whole_pieces(stepped, 2);
  }
}

TEST_P(Motion, that_leaves_at_an_edge_of_the_body_and_re_enters_divides_it) {
  SteppedEngine stepped(jittered_cube(6, 64), options());
  // A short blade from below first, out through the front face, and back in higher up.
  std::vector<std::vector<Vec3>> edges;
  const auto at = [](double y, double z) { return std::vector<Vec3>{Vec3(0.47, y, z), Vec3(0.47, y, z + 0.75)}; };
  for (double y = kLow; y < kHigh + 0.01; y += 0.07) edges.push_back(at(y, -0.2));
  for (double z = -0.2; z < 0.47; z += 0.07) edges.push_back(at(edges.back()[0].y(), z));
  for (double y = kHigh; y > kLow - 0.01; y -= 0.07) edges.push_back(at(y, edges.back()[0].z()));
  stepped.run(stroke_of(edges));
  EXPECT_EQ(stepped.piece_count(), 2U);
}

TEST_P(Motion, that_twists_divides_the_body_along_a_helicoid) {
  SteppedEngine stepped(jittered_cube(6, 65), options());
  std::vector<std::vector<Vec3>> edges;
  for (unsigned i = 0; i <= 45; ++i) {
    const double s = i / 45.0;
    const auto [c, d] = on_circle(0.25 * s);
    const Vec3 along(d, c, 0), centre(0.51, 0.48, kHigh - 1.4 * s);
    edges.push_back(divided_edge(centre - 1.2 * along, centre + 1.2 * along, 24));
  }
  stepped.run(stroke_of(edges));
  expect_whole_pieces(stepped, 2);
  EXPECT_EQ(euler_characteristics(stepped.mesh()), (std::vector<int>{2, 2}));
}

// --- back and forth
// -------------------------------------------------------------------------------------------------------------

// T17
TEST(BackAndForth, makes_the_walls_of_the_monotone_cut) {
  for (const TetSoup& soup : {kuhn_cube(5), jittered_cube(6, 66)}) {
    SteppedEngine monotone(soup);
    monotone.run(visiting({-0.2, 1.2}));
    const std::vector<std::vector<double>> motions = {
        {-0.2, 0.6, 0.3, 1.2},                                  // forward, back, forward
        {-0.2, 0.4, 0.4, 0.4, 0.7, 0.7, 1.2},                   // stop and go
        {-0.2, 0.5, 0.49, 0.52, 0.48, 0.55, 1.2},               // hesitation
        {-0.2, 0.6, -0.3, 1.2},                                 // withdrawal and re-entry
        {-0.2, 0.2, -0.2, 0.45, -0.2, 0.7, 0.1, 0.9, 0.5, 1.2}  // sawing
    };
    for (std::size_t i = 0; i < motions.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "motion " << i);
      SteppedEngine stepped(soup);
      stepped.run(visiting(motions[i]));
      EXPECT_EQ(stepped.mesh().tet_count(), monotone.mesh().tet_count());
      EXPECT_EQ(walls_by_place(stepped.mesh()), walls_by_place(monotone.mesh()));
      EXPECT_NEAR(wall_area(stepped.mesh()), 1.0, 1e-9);
      expect_pieces(stepped.mesh(), {0.47, 0.53}, 1e-9);
    }
  }
}

TEST(BackAndForth, does_not_close_or_lengthen_a_partial_cut) {
  SteppedEngine monotone(jittered_cube(6, 67));
  monotone.run(visiting({-0.2, 0.63}));
  for (const std::vector<double>& places : {std::vector<double>{-0.2, 0.63, 0.2},
                                            std::vector<double>{-0.2, 0.63, -0.2},
                                            {-0.2, 0.3, -0.2, 0.63},
                                            {-0.2, 0.63, 0.1, 0.63}}) {
    SteppedEngine stepped(jittered_cube(6, 67));
    stepped.run(visiting(places));
    EXPECT_EQ(stepped.piece_count(), 1U);
    EXPECT_EQ(stepped.mesh().tet_count(), monotone.mesh().tet_count());
    EXPECT_NEAR(wall_area(stepped.mesh()), wall_area(monotone.mesh()), std::max(0.01, 0.1 * stepped.h()));
  }
}

TEST_P(Motion, back_and_forth_divides_the_body_once) {
  for (const std::vector<double>& places :
       {std::vector<double>{-0.2, 0.6, 0.3, 1.2}, std::vector<double>{-0.2, 0.6, -0.3, 1.2},
        std::vector<double>{-0.2, 1.2, -0.2}, std::vector<double>{-0.2, 0.5, 0.49, 0.52, 0.48, 0.55, 1.2}}) {
    SteppedEngine stepped(jittered_cube(6, 68), options());
    stepped.run(visiting(places));
    expect_whole_pieces(stepped, 2);
  }
}

// T19
TEST_P(Motion, with_tremor_makes_one_sheet) {
  for (const std::uint64_t seed : {71U, 72U, 73U}) {
    SCOPED_TRACE(seed);
    SteppedEngine stepped(jittered_cube(6, 69), options());
    Random random(seed);
    Stroke stroke = visiting({-0.2, 1.2}, 0.02);
    for (auto& edge : stroke.edges) {
      for (Vec3& p : edge) p += 0.05 * stepped.h() * random_direction(random);
    }
    stepped.run(stroke);
    expect_whole_pieces(stepped, 2);
    EXPECT_EQ(euler_characteristics(stepped.mesh()), (std::vector<int>{2, 2}));
    EXPECT_NEAR(wall_area(stepped.mesh()), 1.0, 0.05);
    stepped.mesh().for_each_vertex([&](VertexId v) {
      if ((stepped.mesh().shape_of(v) & shape::kWall) == 0) return;
      EXPECT_NEAR(stepped.mesh().rest(v).x(), 0.47, 0.3 * stepped.h());
    });
  }
}

TEST_P(Motion, with_tremor_on_the_spot_makes_no_piece) {
  for (unsigned seed = 74; seed < 98; ++seed) {
    SCOPED_TRACE(seed);
    SteppedEngine stepped(jittered_cube(6, 70), options());
    Random random(seed);
    Stroke stroke = visiting({-0.2, 0.55}, 0.02);
    for (unsigned i = 0; i < 80; ++i) stroke.edges.push_back(blade_at(0.55));
    for (auto& edge : stroke.edges) {
      for (Vec3& p : edge) p += 0.05 * stepped.h() * random_direction(random);
    }
    stepped.run(stroke);
    EXPECT_EQ(euler_characteristics(stepped.mesh()), std::vector<int>{2});
    EXPECT_NEAR(wall_area(stepped.mesh()), 0.55, 0.25 * stepped.h());
  }
}

// --- sweeps beside themselves
// ---------------------------------------------------------------------------------------------------

// T20
TEST_P(Motion, in_u_shape_cuts_a_slab_out) {
  const double spacing = 0.2, x = 0.45;
  // A blade that turns back within a typical edge, 1.3 cells here, waits as one that trembles does; in one step it may
  // (`Strokes`).
  for (const double gap : {2.0, 1.5}) {
    SCOPED_TRACE(testing::Message() << "gap " << gap << " of the spacing");
    const double width = gap * spacing;
    SteppedEngine stepped(kuhn_cube(5), options());
    stepped.run(subdivided(
        path_stroke({Vec3(x, kHigh, 0), Vec3(x, kLow, 0), Vec3(x + width, kLow, 0), Vec3(x + width, kHigh, 0)}, kLow,
                    kHigh),
        16));
    const double tolerance = snaps() ? 2 * GetParam() * spacing : 1e-9;
    expect_pieces(stepped.mesh(), {x, width, 1 - x - width}, tolerance);
  }
}

// T21
TEST_P(Motion, over_the_same_surface_again_changes_nothing) {
  for (const double offset : {0.0, 1e-15, 1e-9, 1e-4}) {
    // Without snapping, 1e-4 is a cut of its own.
    if (!snaps() && offset > 0) continue;
    SCOPED_TRACE(offset);
    SteppedEngine stepped(jittered_cube(5, 75), options());
    stepped.run(visiting({-0.2, 1.2}));
    const auto tets = tets_by_place(stepped.mesh());
    const std::uint64_t hash = stepped.mesh().hash();
    stepped.run(visiting({-0.2, 1.2}, 0.041, 0.47 + offset));
    EXPECT_EQ(stepped.mesh().tet_count(), tets.size());
    EXPECT_TRUE(tets_by_place(stepped.mesh()) == tets);
    // With snapping, tets that the blade was in for a while are the same again, but in other slots.
    if (!snaps()) {
      EXPECT_EQ(stepped.mesh().hash(), hash);
    }
    EXPECT_EQ(stepped.piece_count(), 2U);
  }
}

// --- older cuts
// -----------------------------------------------------------------------------------------------------------------

TEST_P(Motion, across_an_older_cut_gives_four_pieces) {
  SteppedEngine stepped(jittered_cube(6, 76), options());
  stepped.run(visiting({-0.2, 1.2}));
  stepped.run(quad_stroke(Vec3(kLow, 0.53, kLow), Vec3(kLow, 0.51, kHigh), Vec3(kHigh, 0.55, kLow),
                          Vec3(kHigh, 0.54, kHigh), 30));
  expect_whole_pieces(stepped, 4);
}

TEST_P(Motion, across_an_older_partial_cut_divides_the_body_once) {
  SteppedEngine stepped(jittered_cube(6, 77), options());
  stepped.run(visiting({-0.2, 0.64}));
  ASSERT_EQ(stepped.piece_count(), 1U);
  stepped.run(quad_stroke(Vec3(kLow, kLow, 0.52), Vec3(kLow, kHigh, 0.55), Vec3(kHigh, kLow, 0.49),
                          Vec3(kHigh, kHigh, 0.51), 30));
  EXPECT_EQ(stepped.piece_count(), 2U);
}

TEST_P(Motion, that_ends_in_an_older_cut_gives_three_pieces) {
  SteppedEngine stepped(jittered_cube(6, 78), options());
  stepped.run(visiting({-0.2, 1.2}));
  stepped.run(
      quad_stroke(Vec3(kLow, 0.53, kLow), Vec3(kLow, 0.51, kHigh), Vec3(0.6, 0.55, kLow), Vec3(0.6, 0.54, kHigh), 20));
  EXPECT_EQ(stepped.piece_count(), 3U);
}

/// A cut to y = 0.5 in one stroke, and on from y = `from` in another.
void expect_continuation(double from, const SteppedOptions& options) {
  for (const TetSoup& soup : {kuhn_cube(5), jittered_cube(6, 79)}) {
    SteppedEngine stepped(soup, options);
    stepped.run(visiting({-0.2, 0.513}));
    ASSERT_EQ(stepped.piece_count(), 1U);
    stepped.run(visiting({from, 1.2}));
    expect_whole_pieces(stepped, 2);
  }
}

TEST_P(Motion, that_continues_an_older_cut_exactly_from_its_end_divides_the_body) {
  expect_continuation(0.513, options());
}

TEST_P(Motion, that_continues_an_older_cut_with_a_little_overlap_divides_the_body) {
  expect_continuation(0.5, options());
  expect_continuation(0.42, options());
}

TEST_P(Motion, that_passes_through_an_older_cut_and_on_divides_the_body) {
  expect_continuation(-0.2, options());
}

/// Two edges that turn about one pivot towards each other, until each is `past` the plane in which they meet.
void expect_scissors_cut(double past, const SteppedOptions& options) {
  SteppedEngine stepped(jittered_cube(6, 80), options);
  const Vec3 pivot(0.47, -0.3, 0.5);
  for (const double side : {1.0, -1.0}) {
    std::vector<std::vector<Vec3>> edges;
    for (unsigned i = 0; i <= 20; ++i) {
      const double slope = 2.0 * (1 - i / 20.0) - past * i / 20.0;
      edges.push_back({pivot, pivot + Vec3(0, 2, 2 * side * slope)});
    }
    stepped.run(stroke_of(edges));
    EXPECT_EQ(stepped.piece_count(), side > 0 ? 1U : 2U);
  }
}

TEST_P(Motion, of_two_edges_that_close_like_scissors_divides_the_body) {
  expect_scissors_cut(0.02, options());
}

TEST_P(Motion, of_two_edges_that_close_until_they_just_meet_divides_the_body) {
  expect_scissors_cut(0.0, options());
}

// --- bodies that move
// -------------------------------------------------------------------------------------------------------------

/// A smooth wave of the given amplitude through rest point `p` at time `t` in [0, 1].
Vec3 wave(const Vec3& p, double t, double amplitude) {
  constexpr double kPi = 3.14159265358979;
  const double a = amplitude / std::sqrt(3.0), turn = 2 * kPi * t;
  return a * Vec3(std::sin(kPi * p.y() + 1.7 * p.z() + turn), std::sin(kPi * p.z() + 1.3 * p.x() + 1.5 * turn),
                  std::sin(kPi * p.x() + 1.1 * p.y() - turn));
}

/// How far rest points of walls lie from where the blade passed them, in the moving body.
Deviation deviation_from_passage(const SteppedEngine& stepped, const Stroke& stroke, double amplitude) {
  constexpr unsigned kMoments = 500;
  const Stroke dense = subdivided(stroke_of({stroke.edges.front(), stroke.edges.back()}), kMoments);
  Deviation result;
  double count = 0;
  stepped.mesh().for_each_vertex([&](VertexId v) {
    if ((stepped.mesh().shape_of(v) & shape::kWall) == 0) return;
    const Vec3& p = stepped.mesh().rest(v);
    double nearest = HUGE_VAL;
    for (unsigned i = 0; i <= kMoments; ++i) {
      const Vec3 now = p + wave(p, static_cast<double>(i) / kMoments, amplitude);
      const Vec3 &a = dense.edges[i][0], along = (dense.edges[i][1] - a).normalized();
      nearest = std::min(nearest, (now - a).cross(along).norm());
    }
    result.greatest = std::max(result.greatest, nearest);
    result.mean += nearest;
    count += 1;
  });
  result.mean /= count;
  return result;
}

/// A cut right through a cube while it waves.
void expect_through_cut_of_waving_body(const TetSoup& soup, const SteppedOptions& options, double amplitude,
                                       unsigned frames) {
  SCOPED_TRACE(testing::Message() << "amplitude " << amplitude << " h, " << frames << " frames");
  SteppedEngine stepped(soup, options);
  const Stroke stroke =
      quad_stroke(Vec3(0.46, -0.5, 1.5), Vec3(0.5, 1.5, 1.4), Vec3(0.48, -0.5, -0.4), Vec3(0.52, 1.5, -0.5), frames);
  stepped.run(stroke, [&](std::size_t i) {
    stepped.deform([&](VertexId v) -> Vec3 {
      const Vec3& p = stepped.mesh().rest(v);
      return p + wave(p, static_cast<double>(i) / frames, amplitude * stepped.h());
    });
  });
  expect_whole_pieces(stepped, 2);
  for (const double volume : piece_volumes(stepped.mesh())) EXPECT_GT(volume, 0.25);
  const Deviation walls = deviation_from_passage(stepped, stroke, amplitude * stepped.h());
  EXPECT_LE(walls.greatest, 0.5 * stepped.h());
  EXPECT_LE(walls.mean, 0.08 * stepped.h());
}

// T16
TEST_P(Motion, through_a_body_that_waves_divides_it) {
  for (const double amplitude : {0.15, 0.3, 0.6}) {
    for (const unsigned frames : {15U, 60U, 250U}) {
      expect_through_cut_of_waving_body(kuhn_cube(5), options(), amplitude, frames);
      expect_through_cut_of_waving_body(jittered_cube(5, 81), options(), amplitude, frames);
    }
  }
}

TEST_P(Motion, through_a_body_that_waves_in_a_thousand_frames_divides_it) {
  for (const double amplitude : {0.1, 0.6}) {
    expect_through_cut_of_waving_body(jittered_cube(4, 82), options(), amplitude, 1000);
  }
}

/// Moves the two sides of x = `x` apart behind the blade, which stands at `y` and moves towards greater y.
Vec3 opened(const TetMesh& mesh, VertexId v, double x, double y, double h) {
  const Vec3& p = mesh.rest(v);
  double centre = 0;
  for (const VertexId corner : mesh.vertices(mesh.tet_of(v))) centre += mesh.rest(corner).x() / 4;
  const double gap = 0.3 * std::clamp(y - p.y(), 0.0, 2 * h);
  return p + Vec3(centre < x ? -gap : gap, 0, 0);
}

TEST_P(Motion, through_a_body_that_opens_behind_the_blade_divides_it) {
  for (const unsigned frames : {15U, 60U, 250U}) {
    SCOPED_TRACE(frames);
    SteppedEngine stepped(jittered_cube(5, 83), options());
    const Stroke stroke = subdivided(stroke_of({blade_at(kLow), blade_at(kHigh)}), frames);
    stepped.run(stroke, [&](std::size_t i) {
      const double y = stroke.edges[i == 0 ? 0 : i - 1][0].y() - 0.2 * stepped.h();
      stepped.deform([&](VertexId v) { return opened(stepped.mesh(), v, 0.47, y, stepped.h()); });
    });
    expect_whole_pieces(stepped, 2);
  }
}

TEST_P(Motion, of_the_body_over_a_blade_that_stands_still_cuts_as_if_the_blade_moved) {
  SteppedEngine stepped(jittered_cube(5, 84), options());
  const std::vector<Vec3> edge = blade_at(-0.1);
  stepped.run(stroke_of(std::vector<std::vector<Vec3>>(41, edge)), [&](std::size_t i) {
    stepped.deform(
        [&](VertexId v) -> Vec3 { return stepped.mesh().rest(v) - Vec3(0, 0.03 * static_cast<double>(i), 0); });
  });
  expect_pieces(stepped.mesh(), {0.47, 0.53}, snaps() ? 0.05 : 1e-9);
}

TEST_P(Motion, of_body_and_blade_together_cuts_nothing) {
  SteppedEngine stepped(jittered_cube(5, 85), options());
  std::vector<std::vector<Vec3>> edges;
  for (unsigned i = 0; i <= 20; ++i) {
    edges.push_back(blade_at(0.5));
    for (Vec3& p : edges.back()) p += 0.0625 * i * Vec3(1, -2, 0.5);
  }
  stepped.run(stroke_of(edges), [&](std::size_t i) {
    stepped.deform([&](VertexId v) -> Vec3 {
      return stepped.mesh().rest(v) + 0.0625 * static_cast<double>(i) * Vec3(1, -2, 0.5);
    });
  });
  EXPECT_LE(wall_area(stepped.mesh()), 0.02);
  EXPECT_EQ(stepped.piece_count(), 1U);
}

/// A blade inside the body and one that hangs into it from above, each moved from within it along x.
std::vector<Stroke> strokes_begun_inside() {
  const Stroke buried =
      quad_stroke(Vec3(0.25, 0.3, 0.47), Vec3(0.25, 0.7, 0.5), Vec3(0.75, 0.28, 0.53), Vec3(0.75, 0.72, 0.52), 24);
  const Stroke hanging =
      quad_stroke(Vec3(0.2, 0.45, 1.1), Vec3(0.2, 0.45, 0.6), Vec3(0.8, 0.47, 1.1), Vec3(0.8, 0.47, 0.6), 24);
  return {buried, hanging};
}

TEST_P(Motion, begun_inside_a_body_that_has_moved_cuts_from_there) {
  for (const Stroke& stroke : strokes_begun_inside()) {
    SteppedEngine at_rest(jittered_cube(5, 91), options());
    at_rest.run(stroke);
    for (const double by : {1e-9, 0.3}) {
      SCOPED_TRACE(by);
      SteppedEngine moved(jittered_cube(5, 91), options());
      moved.deform([&](VertexId v) -> Vec3 { return moved.mesh().rest(v) + by * Vec3(1, -2, 0.5); });
      Stroke along = stroke;
      for (auto& edge : along.edges) {
        for (Vec3& p : edge) p += by * Vec3(1, -2, 0.5);
      }
      moved.run(along);
      EXPECT_GE(wall_area(moved.mesh()), 0.9 * wall_area(at_rest.mesh()));
      EXPECT_LE(wall_area(moved.mesh()), 1.1 * wall_area(at_rest.mesh()));
      EXPECT_EQ(moved.piece_count(), 1U);
    }
  }
}

TEST_P(Motion, begun_inside_a_body_that_waves_cuts_from_there) {
  for (const Stroke& stroke : strokes_begun_inside()) {
    SteppedEngine stepped(jittered_cube(5, 92), options());
    const auto waves = [&](std::size_t i) {
      const double t = (1.0 + static_cast<double>(i)) / 25;
      stepped.deform([&](VertexId v) -> Vec3 {
        return stepped.mesh().rest(v) + wave(stepped.mesh().rest(v), t, 0.1 * stepped.h());
      });
    };
    stepped.run(stroke, waves);
    EXPECT_GE(wall_area(stepped.mesh()), 0.15);
    EXPECT_EQ(stepped.piece_count(), 1U);
  }
}

TEST_P(Motion, begun_inside_against_its_direction_cuts_nothing_before_it_turns) {
  SteppedEngine stepped(jittered_cube(5, 93), options());
  stepped.deform([&](VertexId v) -> Vec3 { return stepped.mesh().rest(v) + Vec3(1e-9, 0, 0); });
  const auto pose = [](double x) { return BladePose{{Vec3(x, 0.45, 1.1), Vec3(x, 0.45, 0.6)}, Vec3::UnitX()}; };
  stepped.begin(pose(0.5));
  for (double x = 0.47; x > 0.3; x -= 0.03) stepped.step(pose(x));
  EXPECT_EQ(wall_area(stepped.mesh()), 0.0);
  for (double x = 0.3; x < 0.8; x += 0.03) stepped.step(pose(x));
  stepped.end();
  EXPECT_NEAR(wall_area(stepped.mesh()), 0.3 * 0.4, 0.03);
}

// --- bodies that are not whole
// ------------------------------------------------------------------------------------------------------------

/// The share of tets that are inverted as the body stands now.
double inverted_share(const TetMesh& mesh, const std::vector<Vec3>& positions) {
  double count = 0;
  mesh.for_each_tet([&](TetId tet) {
    const auto& [a, b, c, d] = mesh.vertices(tet);
    const Vec3 &p = positions[a.value], &q = positions[b.value], &r = positions[c.value], &s = positions[d.value];
    if ((q - p).cross(r - p).dot(s - p) <= 0) count += 1;
  });
  return count / static_cast<double>(mesh.tet_count());
}

// T32
TEST_P(Motion, through_a_body_with_inverted_tets_completes) {
  for (const std::uint64_t seed : {86U, 87U, 88U, 89U}) {
    SCOPED_TRACE(seed);
    SteppedEngine stepped(jittered_cube(6, seed), options());
    Random random(seed);
    std::vector<Vec3> positions;
    stepped.mesh().for_each_vertex([&](VertexId v) { positions.push_back(stepped.mesh().rest(v)); });
    while (inverted_share(stepped.mesh(), positions) < 0.05) {
      const auto i = static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(positions.size()) - 1));
      positions[i] += 1.2 * stepped.h() * random_direction(random);
    }
    stepped.deform([&](VertexId v) { return positions[v.value]; });
    stepped.run(
        quad_stroke(Vec3(0.45, -0.6, 1.6), Vec3(0.5, 1.6, 1.6), Vec3(0.48, -0.6, -0.6), Vec3(0.5, 1.6, -0.6), 40));
    EXPECT_GT(wall_area(stepped.mesh()), 0.5);
  }
}

TEST_P(Motion, through_a_body_that_is_crushed_flat_completes) {
  SteppedEngine stepped(jittered_cube(5, 90), options());
  stepped.deform([&](VertexId v) -> Vec3 {
    const Vec3& p = stepped.mesh().rest(v);
    return {p.x(), p.y(), 0.5};
  });
  stepped.run(visiting({-0.2, 1.2}));
}

TEST_P(Motion, through_needles_and_shells_divides_them) {
  SteppedEngine needle_cut(needle(10), options());
  const Box box = rest_bounds(needle_cut.mesh());
  const Vec3 middle = 0.5 * (box.lo + box.hi), along = (box.hi - box.lo).normalized();
  const Vec3 u = along.cross(Vec3(0.3, 0.8, 0.5)).normalized() * 9, v = along.cross(u).normalized() * 9;
  needle_cut.run(quad_stroke(middle - u - v, middle + u - v, middle - u + v, middle + u + v, 20));
  EXPECT_EQ(needle_cut.piece_count(), 2U);
  SteppedEngine shell(kuhn_box(Vec3(0, 0, 0), Vec3(1, 1, 0.1), {8, 8, 1}), options());
  shell.run(visiting({-0.2, 1.2}));
  EXPECT_EQ(shell.piece_count(), 2U);
}

}  // namespace
}  // namespace incise::test::progressive_motion_test
