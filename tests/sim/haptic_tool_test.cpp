// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/haptic_tool.h"

#include <gtest/gtest.h>

#include <limits>
#include <new>
#include <random>

#include "incise/sim/simulated_operator.h"
#include "sim/haptic_scenes.h"
#include "support/allocation.h"

namespace incise::haptic_tool_test {
namespace {

using test::HapticRun;
using test::HapticScene;
using test::liver_at;

constexpr double kDt = 1e-3;

HapticToolOptions without_limits() {
  HapticToolOptions options;
  options.passivity.is_controlled = false;
  options.drag = 0;
  return options;
}

/// Holds the device at one place until the tool has settled.
Vec3 settle(HapticTool& tool, const Vec3& place, int ticks = 200) {
  Vec3 force = Vec3::Zero();
  for (int i = 0; i < ticks; ++i) force = tool.tick(kDt, place, Vec3::Zero());
  return force;
}

TEST(HapticTool, InTheAirNothingIsFeltAndTheToolIsAtTheDevice) {
  HapticTool tool(without_limits());
  EXPECT_EQ(tool.tick(kDt, Vec3(1, 2, 3), Vec3(0.1, 0, 0)), Vec3(0, 0, 0));
  EXPECT_EQ(tool.tool_position(), Vec3(1, 2, 3));
}

TEST(HapticTool, AtRestItFeelsTissueAndCouplingInARow) {
  HapticTool tool(without_limits());
  ASSERT_TRUE(tool.accept(liver_at(Vec3::Zero())));
  const Vec3 force = settle(tool, Vec3(0, 0, -2e-3));
  EXPECT_NEAR(force.z(), 2e-3 / (1.0 / 300 + 1.0 / 500), 1e-6);
  EXPECT_NEAR(tool.tool_position().z(), -2e-3 + force.z() / 500, 1e-7);
}

TEST(HapticTool, TheCuttingForceIsToughnessTimesLengthPlusFriction) {
  HapticTool tool(without_limits());
  tool.accept(liver_at(Vec3::Zero()));
  double force = 0;
  for (int i = 0; i < 600; ++i) force = tool.tick(kDt, Vec3(0, 0, -5e-5 * i), Vec3(0, 0, -0.05)).z();
  EXPECT_NEAR(force, 2.2, 1e-9);
  EXPECT_TRUE(tool.tissue().is_cutting());
}

TEST(HapticTool, ForceAndStretchSaturate) {
  HapticToolOptions options = without_limits();
  options.max_stretch = 2e-3;
  HapticTool tool(options);
  HapticSnapshot rigid = liver_at(Vec3::Zero());
  rigid.compliance.setZero();
  rigid.toughness = 1e9;
  tool.accept(rigid);
  EXPECT_NEAR(settle(tool, Vec3(0, 0, -0.03), 2000).z(), 500 * 2e-3, 1e-6);
  EXPECT_NEAR(tool.tool_position().z(), -0.03 + 2e-3, 1e-9);
  options.max_stretch = 1;
  HapticTool strong(options);
  strong.accept(rigid);
  EXPECT_NEAR(settle(strong, Vec3(0, 0, -0.03)).norm(), options.max_force, 1e-9);
}

TEST(HapticTool, ANewSnapshotDoesNotClickAndCountsFullyAfterOnePeriod) {
  HapticTool tool(without_limits());
  tool.accept(liver_at(Vec3::Zero(), 1));
  const Vec3 place(0, 0, -2e-3);
  Vec3 last = settle(tool, place);
  HapticSnapshot stronger = liver_at(Vec3(0, 0, 2e-3), 2);
  tool.accept(stronger);
  double largest = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 force = tool.tick(kDt, place, Vec3::Zero());
    largest = std::max(largest, (force - last).norm());
    last = force;
  }
  EXPECT_NEAR(settle(tool, place).z(), 4e-3 / (1.0 / 300 + 1.0 / 500), 1e-6);
  const double jump = 2e-3 / (1.0 / 300 + 1.0 / 500);
  EXPECT_LT(largest, 0.15 * jump);
}

TEST(HapticTool, SixtyHertzSnapshotsOfASmoothWallAreFeltSmoothly) {
  HapticScene scene;
  scene.physics = test::wall(300);
  scene.options.coupling_damping = 0.2;
  SimulatedOperator hand(test::strokes(Vec3(0, 0, 5e-4), Vec3(0, 0, -5e-3), 1, 2));
  const HapticRun run = test::run(scene, hand);
  EXPECT_GT(run.largest_force, 0.3);
  EXPECT_LT(run.largest_step, 0.05 * run.largest_force);
}

TEST(HapticTool, LosingContactFadesOverOnePeriod) {
  HapticTool tool(without_limits());
  tool.accept(liver_at(Vec3::Zero(), 1));
  const Vec3 place(0, 0, -2e-3);
  const double before = settle(tool, place).norm();
  HapticSnapshot away;
  away.serial = 2;
  tool.accept(away);
  EXPECT_GT(tool.tick(kDt, place, Vec3::Zero()).norm(), 0.8 * before);
  settle(tool, place, 20);
  EXPECT_LT(settle(tool, place, 1).norm(), 0.05 * before);
}

TEST(HapticTool, OldAndUnsoundSnapshotsAreRefused) {
  HapticTool tool;
  EXPECT_FALSE(tool.accept(HapticSnapshot{}));
  EXPECT_TRUE(tool.accept(liver_at(Vec3::Zero(), 5)));
  EXPECT_FALSE(tool.accept(liver_at(Vec3::Zero(), 5)));
  HapticSnapshot unsound = liver_at(Vec3::Zero(), 6);
  unsound.force.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(tool.accept(unsound));
  tool.tick(kDt, Vec3::Zero(), Vec3::Zero());
  EXPECT_FALSE(tool.accept(liver_at(Vec3::Zero(), 4)));
}

TEST(HapticTool, InputThatIsNotFiniteGivesNoForceAndLeavesNoTrace) {
  HapticTool tool(without_limits()), other(without_limits());
  const Vec3 place(0, 0, -2e-3), bad(0, std::numeric_limits<double>::quiet_NaN(), 0);
  for (HapticTool* each : {&tool, &other}) {
    each->accept(liver_at(Vec3::Zero()));
    settle(*each, place);
  }
  EXPECT_EQ(tool.tick(kDt, bad, Vec3::Zero()), Vec3(0, 0, 0));
  EXPECT_EQ(tool.tick(kDt, place, bad), Vec3(0, 0, 0));
  for (const double dt :
       {0.0, -1e-3, 1e-300, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(tool.tick(dt, place, Vec3::Zero()), Vec3(0, 0, 0)) << dt;
    EXPECT_FALSE(HapticTool::check_tick(dt, place, Vec3::Zero()).ok()) << dt;
  }
  EXPECT_EQ(tool.tick(kDt, Vec3(1e300, 0, 0), Vec3::Zero()), Vec3(0, 0, 0));
  EXPECT_EQ(tool.tick(kDt, place, Vec3(0, 1e160, 0)), Vec3(0, 0, 0));
  EXPECT_EQ(settle(tool, place, 1), settle(other, place, 1));
}

/// Whatever is taken gives numbers: of options, snapshots and ticks of all sizes.
TEST(HapticTool, WhatIsTakenGivesNumbers) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * 0x1p-64 * static_cast<double>(random());
  };
  const auto any = [&] { return std::pow(10, random() % 2 == 0 ? uniform(-320, 308) : uniform(-6, 6)); };
  const auto either_way = [&] { return random() % 2 == 0 ? any() : -any(); };
  const auto now_and_then = [&](double& number, const auto& make) {
    if (random() % 4 == 0) number = make();
  };
  std::size_t tools = 0, ticks = 0;
  for (int round = 0; round < 20'000; ++round) {
    HapticToolOptions options;
    for (double* option : {&options.coupling_stiffness, &options.coupling_damping, &options.drag, &options.max_stretch,
                           &options.max_force, &options.physics_period, &options.passivity.initial_energy,
                           &options.passivity.max_acceleration, &options.passivity.recovery_time}) {
      now_and_then(*option, any);
    }
    HapticSnapshot snapshot = liver_at(Vec3::Zero());
    for (int k = 0; k < 3; ++k) {
      now_and_then(snapshot.tool_position[k], either_way);
      now_and_then(snapshot.force[k], either_way);
      now_and_then(snapshot.contact_point[k], either_way);
      now_and_then(snapshot.compliance(k, k), any);
    }
    for (double* number : {&snapshot.engaged_length, &snapshot.toughness, &snapshot.cut_friction})
      now_and_then(*number, any);
    if (!check(options).ok()) continue;
    HapticTool tool(options);
    if (!tool.accept(snapshot)) continue;
    ++tools;
    for (int tick = 0; tick < 6; ++tick) {
      double dt = 1e-3;
      Vec3 place(1e-4 * tick, 0.1, 0), velocity(0.1, 0, -0.2);
      now_and_then(dt, any);
      for (int k = 0; k < 3; ++k) {
        now_and_then(place[k], either_way);
        now_and_then(velocity[k], either_way);
      }
      const Vec3 force = tool.tick(dt, place, velocity);
      if (HapticTool::check_tick(dt, place, velocity).ok()) ++ticks;
      ASSERT_TRUE(force.allFinite() && tool.tool_position().allFinite()) << round << " " << dt;
      ASSERT_LE(force.norm(), options.max_force * (1 + 1e-9)) << round << " " << dt;
    }
  }
  EXPECT_GT(tools, 100U);
  EXPECT_GT(ticks, 100U);
}

TEST(HapticTool, EqualInputsGiveEqualBits) {
  const auto once = [] {
    HapticScene scene;
    scene.physics = test::wall(800);
    SimulatedOperator hand(test::strokes(Vec3(0, 0, 1e-3), Vec3(1e-3, 0, -5e-3), 0.5, 4));
    return test::run(scene, hand);
  };
  const HapticRun a = once(), b = once();
  EXPECT_EQ(a.last_position, b.last_position);
  EXPECT_EQ(a.force_squared, b.force_squared);
  EXPECT_EQ(a.passivity.sampled_energy, b.passivity.sampled_energy);
}

TEST(HapticTool, TicksAllocateNothing) {
  HapticTool tool;
  HapticSnapshot snapshot = liver_at(Vec3::Zero());
  const std::size_t before = test::allocation_count();
  for (int i = 0; i < 500; ++i) {
    snapshot.serial = static_cast<std::uint64_t>(i + 1);
    if (i % 17 == 0) tool.accept(snapshot);
    tool.tick(kDt, Vec3(0, 0, -1e-5 * i), Vec3(0, 0, -0.01));
  }
  EXPECT_EQ(test::allocation_count(), before);
  ::operator delete(::operator new(8));
  EXPECT_GT(test::allocation_count(), before);  // the count does count
}

TEST(HapticTool, TheControllerLeavesSlowPressingAlone) {
  // The force of an honest tissue is felt as it is: the controller is for worlds that give what they did not get.
  const auto force_of = [](bool is_controlled) {
    HapticScene scene;
    scene.physics = test::wall(300);
    scene.options.passivity.is_controlled = is_controlled;
    SimulatedOperator hand(test::strokes(Vec3(0, 0, 1e-3), Vec3(0, 0, -5e-3), 4, 1));
    scene.seconds = 4;
    return test::run(scene, hand).force_squared;
  };
  EXPECT_NEAR(force_of(true), force_of(false), 0.02 * force_of(false));
}

TEST(HapticToolOptions, NumbersOutOfRangeAreNamed) {
  EXPECT_TRUE(check(HapticToolOptions{}).ok());
  const auto defect = [](auto&& breaks) {
    HapticToolOptions options;
    breaks(options);
    return check(options).error().message;
  };
  EXPECT_NE(defect([](HapticToolOptions& o) { o.coupling_stiffness = 0; }).find("stiffness"), std::string::npos);
  EXPECT_NE(defect([](HapticToolOptions& o) { o.max_force = -1; }).find("force"), std::string::npos);
  EXPECT_NE(defect([](HapticToolOptions& o) { o.rupture.onset = 0.5; }).find("rupture"), std::string::npos);
  EXPECT_NE(defect([](HapticToolOptions& o) { o.passivity.max_saved_energy = -1; }).find("saved"), std::string::npos);
}

}  // namespace
}  // namespace incise::haptic_tool_test
