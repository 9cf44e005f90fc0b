// SPDX-License-Identifier: Apache-2.0
// The solver itself: balance, momentum, and that it keeps up with cuts.
#include "deforming/soft_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "deforming/leak_run.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test::soft_body_test {
namespace {

TetMesh beam_mesh(std::uint64_t seed = 3) {
  double spacing = 0;
  return TetMesh::build(make_body(BodyKind::kBeam, seed, spacing)).value();
}

/// Nothing holds it and nothing pulls.
SoftBodyOptions free_body() {
  SoftBodyOptions options;
  options.held = -1;
  options.stretch = 0;
  options.gravity.setZero();
  return options;
}

double greatest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

Vec3 velocity_at(const Vec3& p) {
  return {0.3 + 0.2 * p.x() - p.y(), -1 + 0.5 * p.z(), p.x() + p.y() - 0.25 * p.z()};
}
void set_velocity(SoftBody& body) {
  for (std::uint32_t v = 0; v < body.mirror().vertices().size(); ++v) {
    body.mirror().vertex(VertexId(v)).velocity = velocity_at(body.mirror().vertex(VertexId(v)).rest);
  }
}

TEST(SoftBody, stays_at_rest_where_nothing_pulls) {
  SoftBody body(beam_mesh(), free_body());
  const std::vector<Vec3> before = body.positions();
  EXPECT_NEAR(body.elastic_energy(), 0.0, 1e-12);
  body.step(1.0 / 60);
  EXPECT_LT(greatest_distance(body.positions(), before), 1e-13);
}

TEST(SoftBody, falls_as_a_whole) {
  SoftBodyOptions options = free_body();
  options.gravity = Vec3(0, 0, -9.81);
  options.sweeps = 100;  // with few it falls later: each substep starts where the velocity of before leads
  SoftBody body(beam_mesh(), options);
  for (unsigned i = 0; i < 30; ++i) body.step(1.0 / 60);
  EXPECT_LT((body.momentum() - 0.5 * body.mass() * options.gravity).norm(), 1e-3 * body.mass() * 0.5 * 9.81);
  EXPECT_LT(body.elastic_energy(), 1e-3 * body.kinetic_energy());
}

TEST(SoftBody, keeps_its_momentum) {
  SoftBodyOptions options = free_body();
  options.sweeps = 200;
  SoftBody body(beam_mesh(), options);
  set_velocity(body);
  const Vec3 before = body.momentum();
  for (unsigned i = 0; i < 5; ++i) body.step(1.0 / 60);
  EXPECT_LT((body.momentum() - before).norm(), 1e-6 * before.norm());
}

TEST(SoftBody, hangs_where_many_more_sweeps_leave_it) {
  SoftBody body(beam_mesh(), {});
  body.settle(2000);
  const std::vector<Vec3> soon = body.positions();
  body.settle(600);
  EXPECT_LT(greatest_distance(body.positions(), soon), 1e-3);
  for (unsigned i = 0; i < 60; ++i) body.step(1.0 / 60);
  EXPECT_LT(greatest_distance(body.positions(), soon), 2e-3);
  EXPECT_EQ(body.inverted(), 0U);
}

TEST(SoftBody, sags_as_a_beam_does) {
  SoftBodyOptions options;
  options.stretch = 0;
  options.young = 100;
  options.gravity = Vec3(0, 0, -0.05);
  SoftBody body(beam_mesh(), options);
  body.settle(4000);
  double sag = 0;
  for (const auto& vertex : body.mirror().vertices()) sag = std::max(sag, vertex.rest.z() - vertex.current.z());
  // Clamped at both ends: ρ g L⁴ / (32 E t²) by bending, ρ g L² / (8 κ G) with κ = 5/6 by shear; linear tets are stiff.
  const double bending = 0.05 * 16 / (32 * 100 * 4.0 / 9.0), shear = 0.05 * 4 / (8 * 5.0 / 6.0 * 100 / 2.8);
  EXPECT_LT(sag, 1.1 * (bending + shear));
  EXPECT_GT(sag, 0.7 * (bending + shear));
}

TEST(SoftBody, follows_cuts_with_its_mass_and_momentum) {
  Engine engine = make_engine(jittered_cube(5, 4));
  SoftBody body(engine.mesh(), free_body());
  set_velocity(body);
  const double mass = body.mass();
  const Vec3 momentum = body.momentum();
  Random random(9);
  for (unsigned i = 0; i < 4; ++i) {
    cut(engine, random_stroke(random, {Vec3(0, 0, 0), Vec3(1, 1, 1)}));
    const FollowReport report = body.follow(engine.journal());
    EXPECT_EQ(body.mirror().fault(), "");
    EXPECT_NEAR(body.mass(), mass, 1e-12 * mass);
    EXPECT_LT((body.momentum() - momentum).norm(), 1e-12 * momentum.norm());
    EXPECT_NEAR(report.energy_after, 0, 1e-10);
  }
}

TEST(SoftBody, comes_apart_where_it_is_cut_and_stays_finite) {
  double spacing = 0;
  Engine engine = make_engine(make_body(BodyKind::kBeam, 5, spacing));
  SoftBody body(engine.mesh(), {});
  body.settle(600);
  cut(engine, plane(engine, Vec3(1, 0.2, 0.1), 1.0));
  const FollowReport report = body.follow(engine.journal());
  EXPECT_LE(report.energy_relaxed, 1.01 * report.energy_before);
  for (unsigned i = 0; i < 120; ++i) {
    body.step(1.0 / 60);
    ASSERT_TRUE(body.is_finite());
  }
  EXPECT_LT(body.elastic_energy(), 0.7 * report.energy_before);
  ASSERT_TRUE(engine.set_positions(body.positions()).ok());
  EXPECT_EQ(body.mirror().difference(engine.mesh()), "");
}

TEST(SoftBody, follows_a_wound_that_opens_while_it_is_cut_deeper) {
  double spacing = 0;
  Engine engine = make_engine(make_body(BodyKind::kBeam, 6, spacing), 0.0);
  SoftBody body(engine.mesh(), {});
  body.settle(600);
  const double mass = body.mass();
  double peak = body.elastic_energy();
  for (unsigned i = 0; i < 5; ++i) {
    const double from = 0.75 - 0.1 * i, to = from - 0.12;
    cut(engine, quad_stroke(Vec3(0.97, -1, from), Vec3(1.04, 2, from), Vec3(0.97, -1, to), Vec3(1.04, 2, to)));
    const FollowReport report = body.follow(engine.journal());
    EXPECT_NEAR(body.mass(), mass, 1e-12 * mass);
    EXPECT_LE(report.energy_relaxed, report.energy_before + 0.03 * peak);
    for (unsigned k = 0; k < 20; ++k) body.step(1.0 / 60);
    ASSERT_TRUE(body.is_finite());
    ASSERT_TRUE(engine.set_positions(body.positions()).ok());
    ASSERT_EQ(body.mirror().difference(engine.mesh()), "");
    peak = std::max(peak, body.elastic_energy());
  }
  EXPECT_GT(engine.journal().position(), 2U);
  // Slivers at the front are soft, by the cap of their modulus, and may stand inside out; few do.
  EXPECT_LE(body.inverted(), engine.mesh().tet_count() / 30);
}

TEST(SoftBody, goes_back_with_an_undo) {
  Engine engine = make_engine(jittered_cube(4, 4));
  SoftBody body(engine.mesh(), {});
  body.settle(2000);
  const std::vector<Vec3> before = body.positions();
  ASSERT_TRUE(engine.set_positions(before).ok());
  cut(engine, plane(engine, Vec3(1, 0, 0), 0.45));
  body.follow(engine.journal());
  engine.undo();
  body.follow(engine.journal());
  EXPECT_EQ(body.positions().size(), before.size());
  EXPECT_EQ(body.mirror().fault(), "");
  EXPECT_LT(greatest_distance(body.positions(), before), 0.05);
}

}  // namespace
}  // namespace incise::test::soft_body_test
