// SPDX-License-Identifier: Apache-2.0
// Tets that a step would leave inside out.
#include "incise/mesh/quality_stats.h"
#include "sim/moving_body.h"

namespace incise::test::body_untangle_test {
namespace {

/// A cut that is not maintained leaves slivers, of L/r of 300 to 1,700.
EngineOptions raw() {
  EngineOptions options;
  options.cut.profile = Profile::kPaper;
  options.maintain.merge = false;
  options.maintain.improve = false;
  return options;
}

/// Without being turned back six stay inside out in the second beam, and some are for a while in the fourth.
TEST(BodyUntangle, slivers_of_a_beam_that_sags_are_turned_back) {
  for (const std::uint64_t seed : {5U, 6U, 7U, 8U}) {
    MovingBody moving(jittered_cube(5, seed), {tissue(300e3, 0.4), {}}, {}, raw());
    moving.hold_where(0);
    for (const double x : {0.31, 0.45, 0.58}) {
      moving.cut(path_stroke({{x, -0.1, 0}, {x + 0.06, 0.5, 0}, {x, 1.1, 0}}, 0.4, 1.2));
    }
    EXPECT_GT(measure_quality(moving.mesh()).lr_max, 250);
    for (unsigned frame = 0; frame < 90; ++frame) {
      moving.advance();
      EXPECT_EQ(moving.body().count_inverted(), 0U) << "seed " << seed << ", frame " << frame;
    }
  }
}

/// Corners that are put where their tets are inside out, in a body that nothing holds: its centre stays.
TEST(BodyUntangle, of_what_is_free_moves_no_centre) {
  BodyOptions options;
  options.gravity = Vec3::Zero();
  MovingBody moving(jittered_cube(3, 2), {tissue(20e3), {}}, options);
  VertexId v;
  moving.mesh().for_each_vertex([&](VertexId u) {
    if ((moving.mesh().rest(u) - Vec3(0.33, 0.33, 0.33)).norm() < 0.15) v = u;
  });
  ASSERT_TRUE(v.is_valid());
  ASSERT_TRUE(moving.body().place(v, moving.mesh().rest(v) + Vec3(0.45, 0.1, 0)).ok());
  ASSERT_GT(moving.body().count_inverted(), 0U);
  const auto centre = [&] {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    moving.mesh().for_each_vertex([&](VertexId u) {
      sum += moving.body().mass(u) * moving.body().positions()[u.value];
      mass += moving.body().mass(u);
    });
    return Vec3(sum / mass);
  };
  const Vec3 before = centre();
  moving.advance(5);
  EXPECT_EQ(moving.body().count_inverted(), 0U);
  EXPECT_LT((centre() - before).norm(), 1e-9);
}

}  // namespace
}  // namespace incise::test::body_untangle_test
