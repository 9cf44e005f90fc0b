// SPDX-License-Identifier: Apache-2.0
// A slice of incise_leaks: all motions through moving bodies, and more of each at night.
#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "deforming/leak_run.h"
#include "support/campaign.h"

namespace incise::test::leak_test {
namespace {

void expect_no_leak(const LeakSettings& settings) {
  const LeakResult result = run_leak(settings);
  SCOPED_TRACE(testing::Message() << name_of(settings.body) << ", motion " << static_cast<unsigned>(settings.motion)
                                  << ", steps " << settings.steps << ", seed " << settings.seed);
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.invalid, 0U);
  EXPECT_EQ(result.pieces, result.expected);
  EXPECT_EQ(result.crumbs, 0U);
  EXPECT_LE(result.energy_up, kEnergyRise);
}

/// All motions; or every second one, from the first or from the second on.
enum class Motions : unsigned { kAll, kEven, kOdd };

void expect_no_leaks(LeakSettings settings, Motions motions = Motions::kAll) {
  const unsigned first = motions == Motions::kOdd ? 1 : 0, step = motions == Motions::kAll ? 1 : 2;
  for (unsigned motion = first; motion < kMotions; motion += step) {
    settings.motion = static_cast<Motion>(motion);
    // Bodies other than the beam have a test of their own for it, below.
    if (settings.motion == Motion::kStrongTremor && settings.body != BodyKind::kBeam) continue;
    expect_no_leak(settings);
  }
}

LeakSettings in_body(BodyKind body) {
  LeakSettings settings;
  settings.body = body;
  settings.steps = 60;
  settings.seed = 11;
  settings.check_every = 4;
  return settings;
}

TEST(Leaks, none_in_a_beam_under_a_solver) {
  for (const unsigned steps : of_campaign<std::vector<unsigned>>({30}, {30, 120})) {
    LeakSettings settings;
    settings.steps = steps;
    settings.check_every = 4;
    expect_no_leaks(settings);
  }
}

TEST(Leaks, none_in_other_bodies_under_a_solver) {
  // By day each body and each motion, by turns.
  expect_no_leaks(in_body(BodyKind::kCube), of_campaign(Motions::kEven, Motions::kAll));
  expect_no_leaks(in_body(BodyKind::kBall), of_campaign(Motions::kOdd, Motions::kAll));
  expect_no_leaks(in_body(BodyKind::kShuffled), of_campaign(Motions::kEven, Motions::kAll));
}

TEST(Leaks, none_in_other_bodies_under_strong_tremor) {
  for (const BodyKind body : {BodyKind::kCube, BodyKind::kBall, BodyKind::kShuffled}) {
    LeakSettings settings = in_body(body);
    settings.motion = Motion::kStrongTremor;
    expect_no_leak(settings);
  }
}

TEST(Leaks, none_in_a_body_that_sways_with_its_wound_open) {
  for (const double amplitude : of_campaign<std::vector<double>>({0.25, 0.6}, {0.1, 0.25, 0.4, 0.6})) {
    LeakSettings settings;
    settings.mover = Mover::kField;
    settings.amplitude = amplitude;
    settings.steps = 90;
    settings.check_every = 4;
    expect_no_leaks(settings);
  }
}

/// A cut that came out otherwise once.
struct Case {
  BodyKind body;
  Motion motion;
  unsigned steps;
  std::uint64_t seed;
  double amplitude = 0.0;  ///< of the prescribed field; 0: a solver, stretched by half
};

void expect_no_leaks(std::initializer_list<Case> cases) {
  for (const Case& one : cases) {
    LeakSettings settings;
    settings.body = one.body;
    settings.motion = one.motion;
    settings.steps = one.steps;
    settings.seed = one.seed;
    settings.mover = one.amplitude > 0 ? Mover::kField : Mover::kSolver;
    settings.amplitude = one.amplitude;
    settings.stretch = 0.5;
    settings.check_every = 10;
    expect_no_leak(settings);
  }
}

TEST(Leaks, a_blade_that_has_left_the_body_cuts_nothing) {
  expect_no_leaks(
      {{BodyKind::kShuffled, Motion::kStraight, 30, 8307, 0.6}, {BodyKind::kBall, Motion::kReversal, 90, 8310, 0.4}});
}

TEST(Leaks, no_point_of_the_blade_is_left_behind_at_the_skin) {
  expect_no_leaks({{BodyKind::kCube, Motion::kStrongTremor, 30, 8305, 0.25},
                   {BodyKind::kShuffled, Motion::kCurve, 30, 41007, 0.6}});
}

TEST(Leaks, a_blade_that_is_beside_the_body_has_not_turned_back) {
  expect_no_leaks({{BodyKind::kBall, Motion::kReversal, 30, 61010, 0.4}});
}

TEST(Leaks, a_crumb_between_the_lips_joins_no_pieces) {
  expect_no_leaks({{BodyKind::kShuffled, Motion::kStrongTremor, 60, 703, 0.6}});
}

TEST(Leaks, a_wall_that_moves_by_a_crumb_leaves_none) {
  expect_no_leaks({{BodyKind::kCube, Motion::kStrongTremor, 180, 8301, 0.25}});
}

TEST(Leaks, a_vertex_that_snaps_into_an_open_wound_stretches_nothing_across) {
  expect_no_leaks({{BodyKind::kBeam, Motion::kReentry, 60, 9100}, {BodyKind::kShuffled, Motion::kCurve, 120, 9107}});
}

}  // namespace
}  // namespace incise::test::leak_test
