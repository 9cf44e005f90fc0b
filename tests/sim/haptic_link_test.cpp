// SPDX-License-Identifier: Apache-2.0
// Force feedback over a link that is late: the device is in another place than the loop that computes its force.
#include <gtest/gtest.h>

#include <cstdio>
#include <deque>
#include <limits>

#include "sim/haptic_scenes.h"
#include "support/random.h"

namespace incise::haptic_link_test {
namespace {

using test::DelayedPress;
using test::DelayedRun;
using test::Random;

/// What the held port may give at most: its initial energy, 20 µJ, and rounding of positions to the sensor's steps.
constexpr double kGiven = 3e-5;

DelayedPress press(double wall, int delay, double lost) {
  DelayedPress press;
  press.wall = wall;
  press.delay = delay;
  press.lost = lost;
  press.options.passivity.position_quantum = 2e-5;
  press.options.passivity.link_delay = 1e-3 * delay;
  return press;
}

TEST(HapticLink, GivesALightGripNoEnergyThreeMillisecondsAwayWithTicksLost) {
  for (const double wall : {300.0, 1000.0, 3000.0, 1e5}) {
    for (const double mass : {0.05, 0.1, 0.2}) {
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        DelayedPress here = press(wall, 3, 0.01);
        here.hand.mass = mass;
        here.seed = seed;
        const DelayedRun run = test::run(here);
        EXPECT_GE(run.least_energy, -kGiven) << wall << " N/m, " << mass << " kg, seed " << seed;
        EXPECT_GT(run.force, 0.1) << wall << " N/m, " << mass << " kg, seed " << seed;
      }
    }
  }
}

TEST(HapticLink, ThatIsNotToldOfGivesALightGripMuchEnergy) {
  DelayedPress here = press(1000, 3, 0.01);
  here.options.passivity.link_delay = 0;
  const DelayedRun run = test::run(here);
  EXPECT_LT(run.least_energy, -0.01);
  EXPECT_GT(run.motion, 0.002);
}

TEST(HapticLink, GivesNoEnergyOverDelaysUpToTwentyMilliseconds) {
  for (const int delay : {1, 2, 5, 10, 20}) {
    for (const double wall : {300.0, 1000.0, 1e5}) {
      EXPECT_GE(test::run(press(wall, delay, 0)).least_energy, -kGiven) << delay << " ms, " << wall << " N/m";
    }
  }
}

TEST(HapticLink, LetsTheHandRestAndPrintsWhatThatCosts) {
  const DelayedRun near = test::run(press(1000, 0, 0));
  for (const int delay : {0, 1, 3, 5, 10}) {
    const DelayedPress here = press(1000, delay, 0.01);
    const DelayedRun run = test::run(here);
    const HapticTool tool(here.options);
    const double drag = tool.drag(1e-3);
    std::printf(
        "%2d ms each way: drag %.2f N s/m (%.2f N at 0.1 m/s), coupling %3.0f N/m, force at rest %.2f of that "
        "without a delay, the hand moves by %.3f mm\n",
        delay, drag, 0.1 * drag, tool.coupling_stiffness(), run.force / near.force, 1e3 * run.motion);
    if (delay <= 3) {
      EXPECT_LT(run.motion, 1e-3) << delay << " ms";
    }
  }
}

/// A device that goes wherever it gets most, within reach of what it did last; no ticks are lost.
TEST(HapticLink, KeepsTheEnergyAtTheDeviceAtLeastZeroForTheWorstMotionInReach) {
  constexpr double kDt = 1e-3;
  Random random(11);
  for (const int delay : {1, 3, 8}) {
    PassivityOptions options;
    options.link_delay = 1e-3 * delay;
    options.position_quantum = 0;
    PassivityController controller(options);
    const auto late = static_cast<std::size_t>(2 * delay) + 1;  // displacements come as late as forces went
    std::deque<Vec3> forces(late, Vec3::Zero());
    Vec3 displacement = Vec3::Zero(), last = Vec3::Zero();
    double energy = options.initial_energy, least = energy;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 acting = forces.front();
      forces.pop_front();
      // Now against the force, so that there is something to be had, now along it.
      const double reach = options.max_acceleration * kDt * kDt * random.real(0, 1);
      const Vec3 way = acting.norm() > 0 ? Vec3(acting.normalized()) : Vec3(random.point(-1, 1).normalized());
      displacement = last + (i / 200 % 2 == 0 ? -reach : reach) * way;
      if (displacement.norm() > 3e-4) displacement = last * (1 - 0.05);
      energy -= acting.dot(displacement);
      least = std::min(least, energy);
      last = displacement;
      forces.push_back(controller.limit(kDt, displacement, displacement / kDt, random.point(-3, 3)));
    }
    EXPECT_EQ(controller.report().surprises, 0U) << delay << " ms";
    EXPECT_GE(least, -1e-12) << delay << " ms";
    EXPECT_NEAR(controller.report().held_energy, energy, 1e-9) << delay << " ms";
    EXPECT_GT(controller.report().held_energy, 0) << delay << " ms";
  }
}

TEST(HapticLink, DelaysOutOfRangeAreNamed) {
  for (const double delay : {-1e-3, 0.06, std::numeric_limits<double>::quiet_NaN()}) {
    PassivityOptions options;
    options.link_delay = delay;
    const Status status = check(options);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("delay"), std::string::npos);
  }
}

TEST(HapticLink, AToolOfADelayThatIsRefusedStaysFinite) {
  for (const double delay : {-1.0, 1e300, std::numeric_limits<double>::infinity()}) {
    HapticToolOptions options;
    options.passivity.link_delay = delay;
    HapticTool tool(options);
    for (int i = 0; i < 10; ++i) {
      EXPECT_TRUE(tool.tick(1e-3, Vec3(0, 0, -1e-3 * i), Vec3(0, 0, -1)).allFinite()) << delay;
    }
  }
}

}  // namespace
}  // namespace incise::haptic_link_test
