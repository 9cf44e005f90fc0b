// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/passivity.h"

#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <string>

#include "incise/sim/simulated_operator.h"
#include "sim/haptic_scenes.h"
#include "support/random.h"

namespace incise::passivity_test {
namespace {

using test::HapticRun;
using test::HapticScene;
using test::Random;

constexpr double kDt = 1e-3;

TEST(PassivityObserver, MovingAgainstTheForcePutsEnergyIn) {
  PassivityObserver observer;
  observer.add(Vec3(0, 0, 2), Vec3(0, 0, -0.5));
  EXPECT_DOUBLE_EQ(observer.energy(), 1);
  observer.add(Vec3(0, 0, 2), Vec3(0, 0, 1.5));
  observer.add(Vec3(0, 0, 2), Vec3(0, 0, -0.5));
  EXPECT_DOUBLE_EQ(observer.energy(), -1);
  EXPECT_DOUBLE_EQ(observer.minimum(), -2);
}

TEST(PassivityController, AForceThatResistsPassesUnchanged) {
  PassivityController controller;
  const Vec3 push(0, 0, 1), down(0, 0, -1e-4);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(controller.limit(kDt, down, down / kDt, push), push);
  EXPECT_EQ(controller.report().damped_ticks + controller.report().scaled_ticks, 0U);
}

TEST(PassivityController, TheDamperTakesWhatIsMissingAlongTheMotionOnly) {
  PassivityOptions options;
  options.initial_energy = 1;  // the held port has plenty: what is seen is the sampled one
  options.max_saved_energy = 1;
  PassivityController controller(options);
  const Vec3 out = controller.limit(kDt, Vec3::Zero(), Vec3(0.1, 0, 0), Vec3(2, 1, 0));
  EXPECT_NEAR(out.x(), 0, 1e-6);
  EXPECT_DOUBLE_EQ(out.y(), 1);
  EXPECT_EQ(controller.report().damped_ticks, 1U);
  EXPECT_NEAR(controller.report().removed_energy, 2 * 0.1 * kDt, 1e-9);
}

TEST(PassivityController, WhatWasPutInMayBeTakenBackAndNoMore) {
  PassivityOptions options;
  options.max_acceleration = 0;
  options.position_quantum = 0;
  options.initial_energy = 0;
  PassivityController controller(options);
  const Vec3 push(0, 0, 1), down(0, 0, -1e-4), up = -down;
  for (int i = 0; i < 100; ++i) controller.limit(kDt, down, down / kDt, push);
  double given = 0;
  for (int i = 0; i < 1000; ++i) given += controller.limit(kDt, up, up / kDt, push).dot(up);
  EXPECT_GT(given, 0.9 * 100 * 1e-4);
  EXPECT_LE(given, 100 * 1e-4 + 1e-12);
}

TEST(PassivityController, NeverLengthensAForceNorLetsTheSampledEnergyFallBelowZero) {
  Random random(5);
  for (int run = 0; run < 50; ++run) {
    PassivityController controller;
    const double size = random.real(1e-6, 1e-2), strength = random.real(0.01, 100);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 wanted = random.point(-strength, strength);
      const Vec3 force =
          controller.limit(random.real(1e-4, 5e-3), random.point(-size, size), random.point(-1, 1), wanted);
      ASSERT_LE(force.norm(), wanted.norm() * (1 + 1e-12));
    }
    EXPECT_GE(controller.report().sampled_minimum, 0);
    EXPECT_GT(controller.report().surprises + controller.report().damped_ticks, 0U);
  }
}

TEST(PassivityController, TheHeldEnergyStaysAtLeastZeroForTheWorstMotionInReach) {
  // The device moves with the force, as far as it may: the worst that a hand within the limits can do.
  PassivityOptions options;
  options.max_saved_energy = 1e-3;
  for (int seed = 0; seed < 20; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    PassivityController controller(options);
    const double reach = 0.999 * (options.max_acceleration * kDt * kDt + 2 * options.position_quantum);
    Vec3 displacement = Vec3::Zero(), force = Vec3::Zero();
    for (int i = 0; i < 3000; ++i) {
      const bool is_worst = random.integer(0, 3) > 0;
      const Vec3 way = is_worst && force.norm() > 0 ? force : random.point(-1, 1);
      const Vec3 next = displacement + reach * way.normalized();
      displacement = next.norm() < 2e-4 ? next : Vec3(displacement * 0.7);
      force = controller.limit(kDt, displacement, displacement / kDt, random.point(-3, 3));
    }
    EXPECT_EQ(controller.report().surprises, 0U);
    EXPECT_GE(controller.report().held_minimum, 0);
    EXPECT_GE(controller.report().sampled_minimum, 0);
    EXPECT_GT(controller.report().scaled_ticks, 0U);
  }
}

TEST(PassivityController, AfterAJumpOfTheDeviceForcesComeBack) {
  PassivityController controller;
  const Vec3 push(0, 0, 1);
  for (int i = 0; i < 50; ++i) controller.limit(kDt, Vec3(0, 0, -2e-5), Vec3(0, 0, -0.02), push);
  controller.limit(kDt, Vec3(0, 0, 0.1), Vec3(0, 0, 0), push);  // a sensor lost its place
  EXPECT_GE(controller.report().surprises, 1U);
  EXPECT_LT(controller.report().held_minimum, 0);
  controller.limit(kDt, Vec3::Zero(), Vec3::Zero(), push);
  Vec3 force = Vec3::Zero();
  for (int i = 0; i < 50; ++i) force = controller.limit(kDt, Vec3(0, 0, -2e-5), Vec3(0, 0, -0.02), push);
  EXPECT_EQ(force, push);
}

TEST(PassivityOptions, NumbersOutOfRangeAreNamed) {
  EXPECT_TRUE(check(PassivityOptions{}).ok());
  PassivityOptions options;
  options.max_acceleration = -1;
  EXPECT_NE(check(options).error().message.find("acceleration"), std::string::npos);
  options = {};
  options.initial_energy = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(check(options).ok());
}

// Scenes: a simulated hand, a tool and late snapshots.

struct NastyScene {
  std::string name;
  double stiffness;  ///< N/m of the wall
  double quantum;    ///< m
  int lag;           ///< ticks
  bool leaks;        ///< without controller more comes out than went in
};

std::ostream& operator<<(std::ostream& out, const NastyScene& scene) {
  return out << scene.name;
}

class PassivityInScenes : public testing::TestWithParam<NastyScene> {
 protected:
  [[nodiscard]] static HapticRun tap(const NastyScene& nasty, bool is_controlled) {
    HapticScene scene;
    scene.physics = test::wall(nasty.stiffness);
    scene.quantum = nasty.quantum;
    scene.lag = nasty.lag;
    scene.seconds = 4;
    scene.options.coupling_damping = 0;  // nothing helps but the controller
    scene.options.drag = 0;
    scene.options.passivity.is_controlled = is_controlled;
    scene.options.passivity.position_quantum = nasty.quantum;
    SimulatedOperator hand(test::strokes(Vec3(0, 0, 2e-3), Vec3(0, 0, -4e-3), 0.5, 8), {0.15, 200, 2});
    return run(scene, hand);
  }
};

TEST_P(PassivityInScenes, EnergyNeverFallsBelowZeroWithTheController) {
  const HapticRun run = tap(GetParam(), true);
  EXPECT_GE(run.passivity.sampled_minimum, 0);
  EXPECT_GE(run.sampled_minimum, -1e-15);
  EXPECT_EQ(run.passivity.surprises, 0U);
  EXPECT_GE(run.passivity.held_minimum, 0);
  EXPECT_GE(run.held_minimum, -PassivityOptions{}.initial_energy - 1e-15);
  EXPECT_GT(run.largest_force, 0.05);
}

TEST_P(PassivityInScenes, WithoutTheControllerTheObserversSeeTheLeak) {
  const HapticRun run = tap(GetParam(), false);
  const double lowest = std::min(run.passivity.sampled_minimum, run.passivity.held_minimum);
  EXPECT_EQ(lowest < -1e-4, GetParam().leaks) << lowest;
}

INSTANTIATE_TEST_SUITE_P(Nasty, PassivityInScenes,
                         testing::Values(NastyScene{"soft", 100, 0, 17, true}, NastyScene{"stiff", 3000, 0, 17, true},
                                         NastyScene{"rigid", 1e6, 0, 17, true},
                                         NastyScene{"stiff_quantised", 3000, 5.5e-5, 17, true},
                                         NastyScene{"rigid_quantised", 1e6, 1e-5, 17, true},
                                         NastyScene{"stiff_three_frames_late", 3000, 0, 51, true}),
                         [](const auto& scene) { return scene.param.name; });

TEST(PassivityInScenesOfJitter, SnapshotsOfNoiseCannotPumpEnergyIntoTheHand) {
  for (const bool is_controlled : {false, true}) {
    Random random(11);
    HapticScene scene;
    scene.options.passivity.is_controlled = is_controlled;
    scene.physics = [&](const Vec3& tool, std::uint64_t serial) {
      HapticSnapshot s = test::liver_at(tool + random.point(-2e-3, 2e-3), serial);
      s.toughness = 1e6;
      s.cut_friction = 1e6;
      s.force = random.point(-3, 3);
      s.compliance *= random.real(0, 3);
      s.touches = random.integer(0, 4) > 0;
      return s;
    };
    SimulatedOperator hand(test::strokes(Vec3(0, 0, 0), Vec3(0, 0.01, -0.01), 1, 2));
    const HapticRun result = run(scene, hand);
    if (is_controlled) {
      EXPECT_GE(result.passivity.sampled_minimum, 0);
      EXPECT_EQ(result.passivity.surprises, 0U);
      EXPECT_GE(result.passivity.held_minimum, 0);
    } else {
      EXPECT_LT(result.passivity.sampled_minimum, -1e-3);
    }
  }
}

TEST(PassivityInScenesOfJitter, ADeviceThatShakesBeyondReachLeavesTheSampledEnergyAtLeastZero) {
  Random random(3);
  HapticTool tool;
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < 20000; ++i) {
    if (i % 17 == 0) tool.accept(test::wall(1e5)(tool.tool_position(), static_cast<std::uint64_t>(i + 1)));
    const Vec3 place = random.point(-5e-3, 5e-3);
    tool.tick(kDt, place, (place - last) / kDt);
    last = place;
  }
  EXPECT_GE(tool.passivity().sampled_minimum, 0);
  EXPECT_GT(tool.passivity().surprises, 10000U);
}

}  // namespace
}  // namespace incise::passivity_test
