// SPDX-License-Identifier: Apache-2.0
// Free pieces move as Newton says, whatever the unfinished descent leaves of their momenta.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "moving_body.h"

namespace incise::test::body_fall_test {
namespace {

constexpr double kG = 9.81;         // m/s²
constexpr double kStep = 1.0 / 60;  // s
constexpr unsigned kSubsteps = 4;
constexpr double kH = kStep / kSubsteps;

/// Mass, centre and momentum of the vertices that a sieve lets through.
struct Lump {
  double mass = 0;
  Vec3 centre = Vec3::Zero(), momentum = Vec3::Zero(), spin = Vec3::Zero();  // spin: about the centre
};

template <class Sieve>
Lump lump_of(const MovingBody& moving, const Sieve& sieve) {
  const DeformableBody::State& s = moving.state();
  Lump lump;
  const auto for_each = [&](const auto& visit) {
    for (std::uint32_t v = 0; v < s.places.size(); ++v) {
      if (s.is_live(VertexId(v)) && sieve(VertexId(v))) visit(VertexId(v));
    }
  };
  for_each([&](VertexId v) {
    lump.mass += s.mass_of(v);
    lump.centre += s.mass_of(v) * s.places[v.value];
    lump.momentum += s.momentum_of(v);
  });
  lump.centre /= lump.mass;
  for_each([&](VertexId v) { lump.spin += (s.places[v.value] - lump.centre).cross(s.momentum_of(v)); });
  return lump;
}

Lump whole(const MovingBody& moving) {
  return lump_of(moving, [](VertexId) { return true; });
}

/// The pieces as the solver tells them apart; to be called after it has moved on.
std::vector<Lump> pieces_of(const MovingBody& moving) {
  std::vector<Lump> lumps;
  for (std::uint32_t i = 0; i < moving.state().pieces.size(); ++i) {
    lumps.push_back(lump_of(moving, [&](VertexId v) { return moving.state().piece_of[v] == i; }));
  }
  return lumps;
}

/// What implicit Euler makes of a free fall.
Lump after(Lump lump, unsigned steps) {
  const unsigned n = steps * kSubsteps;
  lump.centre += n * kH * lump.momentum / lump.mass;
  lump.centre.z() -= kG * kH * kH * n * (n + 1) / 2;
  lump.momentum.z() -= lump.mass * kG * kH * n;
  return lump;
}

void expect_near(const Lump& found, const Lump& expected, double length, double momentum, double tolerance) {
  EXPECT_NEAR(found.mass, expected.mass, 1e-12 * expected.mass);
  EXPECT_LT((found.centre - expected.centre).norm(), tolerance * length);
  EXPECT_LT((found.momentum - expected.momentum).norm(), tolerance * momentum);
}

/// A body that swings and turns as it falls.
void stir(MovingBody& moving) {
  moving.mesh().for_each_vertex([&](VertexId v) {
    const Vec3 r = moving.mesh().rest(v) - Vec3(0.5, 0.5, 0.5);
    const Vec3 velocity = Vec3(1, 2, 0.5).cross(r) + Vec3(0.3 * r.x(), -0.5 * r.y() * r.x(), 0.2);
    ASSERT_TRUE(moving.body().set_velocity(v, velocity).ok());
  });
}

void expect_falls(double poisson, double young, Relaxation relaxation) {
  BodyOptions options;
  options.relaxation = relaxation;
  MovingBody moving(jittered_cube(4, 1), {tissue(young, poisson), {}}, options);
  stir(moving);
  const Lump start = whole(moving);
  moving.advance(120);
  const Lump expected = after(start, 120);
  expect_near(whole(moving), expected, 0.5 * kG * 4, expected.momentum.norm(), 1e-9);
}

TEST(BodyFall, ABodyFallsWithItsMomentumAndItsPlaceKept) {
  expect_falls(0.45, 3e3, Relaxation::kBlockDescent);
  expect_falls(0.3, 300e3, Relaxation::kBlockDescent);
}

TEST(BodyFall, ThePositionBasedRelaxationFallsAlike) {
  expect_falls(0.4, 3e3, Relaxation::kPositionBased);
}

TEST(BodyFall, PiecesThatACutMakesOfAFallingBodyFallAsOneDid) {
  for (const bool in_steps : {false, true}) {
    SCOPED_TRACE(in_steps);
    MovingBody moving(jittered_cube(4, 2), {tissue(3e3), {}});
    stir(moving);
    const Lump start = whole(moving);
    moving.advance(30);
    const Lump before = whole(moving);
    moving.cut_plane(Vec3(1, 0.1, 0), 0.55);
    if (in_steps) moving.cut_plane(Vec3(0, 1, 0.2), 0.6);
    const Lump at_cut = whole(moving);
    expect_near(at_cut, before, 1, before.momentum.norm(), 0.01);  // the centre moves a little as vertices are put in
    EXPECT_LT((at_cut.momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());

    moving.advance(1);
    ASSERT_EQ(moving.state().pieces.size(), in_steps ? 4U : 2U);
    const std::vector<Lump> pieces = pieces_of(moving);
    moving.advance(89);
    const std::vector<Lump> fallen = pieces_of(moving);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Lump expected = after(pieces[i], 89);
      expect_near(fallen[i], expected, 0.5 * kG * 4, expected.momentum.norm(), 1e-9);
    }
    const Lump expected = after(start, 120);
    expect_near(whole(moving), expected, 0.01 * 0.5 * kG * 4, expected.momentum.norm(), 1e-2);
    EXPECT_LT((whole(moving).momentum - expected.momentum).norm(), 1e-9 * expected.momentum.norm());
    EXPECT_EQ(moving.body().count_inverted(), 0U);
  }
}

TEST(BodyFall, AngularMomentumOfASpinningBodyIsKept) {
  MovingBody moving(jittered_cube(4, 3), {tissue(20e3), {}});
  stir(moving);
  const Vec3 spin = whole(moving).spin;
  moving.advance(120);
  const double drift = (whole(moving).spin - spin).norm() / spin.norm();
  RecordProperty("drift over 2 s", std::to_string(drift));
  std::printf("angular momentum: drift %.2e over 2 s\n", drift);
  EXPECT_LT(drift, 1e-9);

  const Vec3 before = whole(moving).spin;
  moving.cut_plane(Vec3(1, 0.1, 0), 0.55);
  const double jump = (whole(moving).spin - before).norm() / before.norm();
  std::printf("angular momentum: %.2e lost in a cut\n", jump);
  EXPECT_LT(jump, 0.05);
}

/// What keeps the energy of a free body in bounds takes nothing from its spin.
TEST(BodyFall, AFreeBodySpinsOnForTenSeconds) {
  for (const double rate : {3.0, 20.0, 30.0}) {
    BodyOptions options;
    options.gravity = Vec3::Zero();
    MovingBody moving(kuhn_box(Vec3::Zero(), {0.04, 0.04, 0.04}, {4, 4, 4}), {tissue(30e3), {}}, options);
    moving.mesh().for_each_vertex([&](VertexId v) {
      const Vec3 r = moving.mesh().rest(v) - Vec3(0.02, 0.02, 0.02);
      ASSERT_TRUE(moving.body().set_velocity(v, Vec3(0.02, 0, 0) + Vec3(0.1, 0.2, rate).cross(r)).ok());
    });
    const Lump before = whole(moving);
    moving.advance(600);
    const Lump after_it = whole(moving);
    EXPECT_LT((after_it.spin - before.spin).norm(), 1e-9 * before.spin.norm()) << rate << " rad/s";
    EXPECT_LT((after_it.momentum - before.momentum).norm(), 1e-9 * before.momentum.norm()) << rate << " rad/s";
    EXPECT_EQ(moving.body().count_inverted(), 0U);
  }
}

/// A chip much smaller than a tet, cut off a corner, keeps its shape, falls as a point, and sleeps after a second.
TEST(BodyFall, ACrumbMovesAsAPointAndSleeps) {
  EngineOptions sharp;
  sharp.cut.snap = 0;
  sharp.maintain.merge = sharp.maintain.improve = false;
  MovingBody moving(kuhn_cube(4), {tissue(3e3), {}}, {}, sharp);
  moving.hold_where(0);
  moving.advance(2);
  moving.cut_plane(Vec3(1, 1.1, 1.2), 3.265);
  moving.advance(2);
  ASSERT_EQ(moving.state().pieces.size(), 2U);
  ASSERT_EQ(moving.state().crumbs.size(), 1U);
  const std::vector<std::uint32_t> chip = moving.state().crumbs[0].vertices;
  const Vec3 before = moving.state().places[chip[0]];
  const Vec3 side = moving.state().places[chip[1]] - before;
  moving.advance(30);
  EXPECT_LT(moving.state().places[chip[0]].z(), before.z() - 0.5);
  EXPECT_LT((moving.state().places[chip[1]] - moving.state().places[chip[0]] - side).norm(), 1e-12);
  moving.advance(60);
  const Vec3 asleep = moving.state().places[chip[0]];
  moving.advance(30);
  EXPECT_EQ(moving.state().places[chip[0]], asleep);
  EXPECT_EQ(moving.body().velocity(VertexId(chip[0])), Vec3::Zero());
  ASSERT_TRUE(moving.engine().undo());
  moving.follow();
  moving.advance(2);
  EXPECT_TRUE(moving.state().crumbs.empty());
  EXPECT_EQ(moving.body().active_vertices(), moving.mesh().vertex_count() - 25);
}

/// What has fallen five lengths from what is held costs nothing more.
TEST(BodyFall, WhatHasFallenFarSleeps) {
  MovingBody moving(kuhn_cube(4), {tissue(300e3), {}});
  moving.hold_where(0);
  moving.cut_plane(Vec3(1, 0, 0), 0.55);
  moving.advance(150);
  const std::size_t loose = static_cast<std::size_t>(
      std::count_if(moving.state().piece_of.begin(), moving.state().piece_of.end(),
                    [&](std::uint32_t piece) { return moving.state().pieces[piece].is_free; }));
  ASSERT_GT(loose, 0U);
  EXPECT_LE(moving.body().active_vertices(), moving.mesh().vertex_count() - loose - 25);
  const Lump lump =
      lump_of(moving, [&](VertexId v) { return moving.state().pieces[moving.state().piece_of[v]].is_free; });
  EXPECT_LT(lump.centre.z(), -4);
  EXPECT_GT(lump.centre.z(), -9);
}

/// A cut elsewhere does not set what sleeps far away in motion again.
TEST(BodyFall, WhatHasFallenFarSleepsThroughOtherCuts) {
  MovingBody moving(kuhn_cube(4), {tissue(300e3), {}});
  moving.hold_where(0);
  moving.cut_plane(Vec3(1, 0, 0), 0.55);
  moving.advance(150);
  const auto is_free = [&](VertexId v) { return moving.state().pieces[moving.state().piece_of[v]].is_lost; };
  const Lump before = lump_of(moving, is_free);
  ASSERT_GT(before.mass, 0);
  moving.cut_plane(Vec3(1, 0, 0), 0.3);
  moving.advance(20);
  const Lump after = lump_of(moving, is_free);
  EXPECT_EQ(after.mass, before.mass);
  EXPECT_EQ(after.centre, before.centre);
}

/// What sleeps in a falling piece holds the rest of it like a wall: taken for free, the piece gained energy.
TEST(BodyFall, APieceOfWhichAPartSleepsGainsNoEnergy) {
  MovingBody moving(kuhn_cube(4), {tissue(3e3), {}});
  moving.hold_where(0);
  moving.cut_plane(Vec3(1, 0, 0), 0.3);
  moving.advance(20);
  auto& state = const_cast<DeformableBody::State&>(moving.state());
  for (std::uint32_t slot = 0; slot < state.places.size(); ++slot) {
    const VertexId v(slot);
    if (!state.is_live(v) || !state.pieces[state.piece_of[v]].is_free || state.rest[v].y() < 0.4) continue;
    state.set_momentum(v, Vec3::Zero());
    state.order.put_to_sleep(v);
  }
  double energy = moving.body().energy().total();
  for (unsigned i = 0; i < 30; ++i) {
    moving.advance();
    const double now = moving.body().energy().total();
    EXPECT_LE(now, energy + 1e-5 * std::abs(energy)) << i;
    energy = now;
  }
}

TEST(BodyFall, DampingSlowsAllPiecesAlike) {
  BodyOptions options;
  options.gravity = Vec3::Zero();
  options.damping = 2;
  MovingBody moving(jittered_cube(3, 4), {tissue(3e3), {}}, options);
  stir(moving);
  const Lump start = whole(moving);
  moving.advance(60);
  double kept = 1;
  for (unsigned i = 0; i < 60 * kSubsteps; ++i) kept /= 1 + options.damping * kH;
  EXPECT_LT((whole(moving).momentum - kept * start.momentum).norm(), 1e-10 * start.momentum.norm());
}

/// What comes off a body that rests falls at once and as a whole, and the rest stays where it is.
TEST(BodyFall, APieceThatComesOffAHeldBodyFalls) {
  BodyOptions options;
  options.damping = 20;
  MovingBody moving(kuhn_cube(6), {tissue(300e3), {}}, options);
  moving.hold_where(0);
  for (unsigned i = 0; i < 600 && moving.body().active_vertices() > 0; ++i) moving.advance();
  ASSERT_EQ(moving.body().active_vertices(), 0U);
  moving.cut_plane(Vec3(1, 0, 0), 0.55);
  moving.advance(2);
  ASSERT_EQ(moving.state().pieces.size(), 2U);
  const auto is_loose = [&](VertexId v) { return moving.state().pieces[moving.state().piece_of[v]].is_free; };
  const Lump loose = lump_of(moving, is_loose);
  double kept = 0;  // v after n substeps of v' = (v − g h) with the damping
  for (unsigned i = 0; i < 2 * kSubsteps; ++i) kept = kept / (1 + options.damping * kH) - kG * kH;
  EXPECT_NEAR(loose.momentum.z() / loose.mass, kept, 1e-6 * kG);
  moving.advance(120);
  EXPECT_TRUE(moving.body().is_finite());
  const Lump rest = lump_of(moving, [&](VertexId v) { return !is_loose(v); });
  EXPECT_GT(rest.centre.z(), 0.45);
}

/// New pieces of a large body are told apart a few steps later; slots that died meanwhile come back.
TEST(BodyFall, ALargeBodyIsCutAgainAndAgainWhileItFalls) {
  MovingBody moving(jittered_cube(28, 5), {tissue(30e3), {}});
  ASSERT_GT(moving.mesh().vertex_count(), 20000U);
  const Lump start = whole(moving);
  moving.advance(2);
  unsigned steps = 2;
  for (int i = 0; i < 5; ++i) {
    moving.cut_plane(Vec3(0, 0, 1), 0.2 + 0.13 * i);
    moving.advance(1);
    ++steps;
  }
  moving.advance(3);
  ASSERT_EQ(moving.state().pieces.size(), 6U);
  const Lump expected = after(start, steps + 3);
  EXPECT_LT((whole(moving).momentum - expected.momentum).norm(), 1e-9 * expected.momentum.norm());
}

}  // namespace
}  // namespace incise::test::body_fall_test
