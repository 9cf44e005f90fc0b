// SPDX-License-Identifier: Apache-2.0
#include "app/hands/haptic_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "incise/sim/simulated_operator.h"

namespace haptic_loop_test {
namespace {

using namespace incise;
using app::HapticLoop;
using app::HapticLoopOptions;
using app::HapticLoopStatistics;
using app::LatencyHistogram;

TEST(LatencyHistogram, IsEmptyAtFirst) {
  const LatencyHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.microseconds().max, 0);
}

TEST(LatencyHistogram, PercentilesAreThoseOfTheSampleToTheWidthOfABucket) {
  LatencyHistogram histogram;
  std::vector<double> sample;
  std::uint64_t number = 12345;
  for (int i = 0; i < 20000; ++i) {
    number = number * 6364136223846793005U + 1442695040888963407U;
    const std::uint64_t duration = (number >> 40U) >> (number % 16U);
    histogram.add(duration);
    sample.push_back(1e-3 * static_cast<double>(duration));
  }
  const app::Percentiles exact = app::percentiles(sample);
  const app::Percentiles found = histogram.microseconds();
  EXPECT_EQ(histogram.count(), sample.size());
  EXPECT_NEAR(found.p50, exact.p50, 0.017 * exact.p50);
  EXPECT_NEAR(found.p99, exact.p99, 0.017 * exact.p99);
  EXPECT_NEAR(found.p999, exact.p999, 0.017 * exact.p999);
  EXPECT_DOUBLE_EQ(found.max, exact.max);
}

TEST(LatencyHistogram, EveryDurationLiesInItsBucketTheLongestToo) {
  for (unsigned bit = 0; bit < 34; ++bit) {
    for (const std::uint64_t offset : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}}) {
      LatencyHistogram histogram;
      const std::uint64_t duration = (std::uint64_t{1} << bit) + offset;
      histogram.add(duration);
      histogram.add(0xFFFFFFFFU);  // so that the median is not cut off at the longest
      const double told = 1e3 * histogram.microseconds().p50;
      const auto exact = static_cast<double>(std::min<std::uint64_t>(duration, 0xFFFFFFFFU));
      EXPECT_GE(told, exact * (1 - 1e-12));
      EXPECT_LE(told, exact * (1 + 1.0 / 64) + 1e-9);
    }
  }
}

/// Waits until the loop has made `ticks` more ticks, however long that takes.
void wait_for_ticks(const HapticLoop& loop, std::uint64_t ticks) {
  const std::uint64_t until = loop.statistics().ticks + ticks;
  while (loop.statistics().ticks < until) std::this_thread::yield();
}

/// Counts what the loop does to it.
class CountingDevice final : public HapticDevice {
 public:
  DeviceState read(double time) override {
    is_steady = is_steady && time >= last_time;
    last_time = time;
    ++reads;
    DeviceState state;
    state.position = Vec3(0, 0, -5e-3);
    return state;
  }
  void command(const Vec3& force) override {
    last_force = force;
    strongest = std::max(strongest, force.norm());
    ++commands;
  }
  std::uint64_t reads = 0, commands = 0;
  double last_time = 0, strongest = 0;
  bool is_steady = true;
  Vec3 last_force = Vec3::Constant(1);
};

HapticSnapshot soft_wall(std::uint64_t serial) {
  HapticSnapshot s;
  s.serial = serial;
  s.touches = true;
  s.compliance.diagonal().setConstant(1e-2);
  s.cutting_direction = -Vec3::UnitZ();
  s.flat_normal = Vec3::UnitX();
  s.engaged_length = 0.01;
  s.toughness = 1e4;
  return s;
}

TEST(HapticLoop, ReadsAndCommandsOncePerTickUntilItIsStopped) {
  CountingDevice device;
  HapticLoop loop(device);
  EXPECT_FALSE(loop.is_running());
  ASSERT_TRUE(loop.start().ok());
  EXPECT_TRUE(loop.is_running());
  wait_for_ticks(loop, 30);
  loop.stop();
  EXPECT_FALSE(loop.is_running());
  const HapticLoopStatistics statistics = loop.statistics();
  EXPECT_GE(statistics.ticks, 30U);
  EXPECT_EQ(device.reads, statistics.ticks);
  EXPECT_EQ(device.commands, statistics.ticks + 1);  // the last is the one below
  EXPECT_EQ(device.last_force, Vec3(0, 0, 0));
  EXPECT_TRUE(device.is_steady);
  EXPECT_GT(device.last_time, 0);
}

TEST(HapticLoop, FeelsWhatThePhysicsPublishes) {
  CountingDevice device;
  HapticLoopOptions options;
  options.tool.passivity.is_controlled = false;  // the device is put into the wall by force
  HapticLoop loop(device, options);
  loop.publish(soft_wall(7));
  ASSERT_TRUE(loop.start().ok());
  wait_for_ticks(loop, 40);
  ASSERT_TRUE(loop.take_tool_state());
  EXPECT_EQ(loop.tool_state().snapshot, 7U);
  EXPECT_GT(loop.tool_state().force.z(), 0.1);
  EXPECT_GT(loop.tool_state().tool_position.z(), -5e-3);
  EXPECT_GE(loop.tool_state().tick, 1U);
  loop.publish(soft_wall(3));  // older than what it has
  wait_for_ticks(loop, 3);
  loop.stop();
  EXPECT_EQ(loop.statistics().snapshots, 2U);
  EXPECT_EQ(loop.statistics().refused, 1U);
}

TEST(HapticLoop, StatisticsAreInOrder) {
  CountingDevice device;
  HapticLoopOptions options;
  options.wants_realtime = true;  // granted or not, it runs
  options.spin = 1e-4;
  HapticLoop loop(device, options);
  ASSERT_TRUE(loop.start().ok());
  wait_for_ticks(loop, 50);
  loop.stop();
  const HapticLoopStatistics statistics = loop.statistics();
  for (const app::Percentiles& p : {statistics.compute, statistics.lateness}) {
    EXPECT_LE(p.p50, p.p99);
    EXPECT_LE(p.p99, p.p999);
    EXPECT_LE(p.p999, p.max);
  }
  EXPECT_GT(statistics.compute.max, 0);
}

TEST(HapticLoop, CountsTheDeadlinesThatASlowDeviceMisses) {
  class SlowDevice final : public HapticDevice {
   public:
    DeviceState read(double /*time*/) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      return {};
    }
    void command(const Vec3& /*force*/) override {}
  };
  SlowDevice device;
  HapticLoop loop(device);
  ASSERT_TRUE(loop.start().ok());
  wait_for_ticks(loop, 5);
  loop.stop();
  // Each read spans at least four deadlines.
  EXPECT_GE(loop.statistics().missed, 4 * loop.statistics().ticks);
}

TEST(HapticLoop, GoesOnWhereItWasStopped) {
  CountingDevice device;
  HapticLoop loop(device);
  ASSERT_TRUE(loop.start().ok());
  wait_for_ticks(loop, 5);
  loop.stop();
  loop.stop();
  const std::uint64_t ticks = loop.statistics().ticks;
  ASSERT_TRUE(loop.start().ok());
  EXPECT_FALSE(loop.start().ok());
  wait_for_ticks(loop, 5);
  loop.stop();
  EXPECT_GE(loop.statistics().ticks, ticks + 5);
  EXPECT_TRUE(device.is_steady);
}

TEST(HapticLoop, StopsByItselfWhenItGoesAway) {
  CountingDevice device;
  {
    HapticLoop loop(device);
    ASSERT_TRUE(loop.start().ok());
    wait_for_ticks(loop, 3);
  }
  EXPECT_EQ(device.last_force, Vec3(0, 0, 0));
  EXPECT_EQ(device.commands, device.reads + 1);
}

TEST(HapticLoop, BadOptionsAreNamedAndDoNotStart) {
  CountingDevice device;
  HapticLoopOptions options;
  options.rate = 0;
  EXPECT_NE(HapticLoop(device, options).start().error().message.find("rate"), std::string::npos);
  options = {};
  options.spin = 1;
  EXPECT_NE(check(options).error().message.find("spin"), std::string::npos);
  options = {};
  options.tool.max_force = -1;
  EXPECT_NE(check(options).error().message.find("force"), std::string::npos);
  EXPECT_EQ(device.reads, 0U);
}

TEST(HapticLoop, ASimulatedHandGivesEnergyToTheWallAndNeverGetsMoreBack) {
  const auto pose = [](double time, double z) {
    return TimedPose{time, Vec3(0, 0, z), Eigen::Quaterniond::Identity(), 0};
  };
  SimulatedOperator hand(PoseTrack::create({pose(0, 0), pose(0.05, -3e-3), pose(0.1, 0), pose(0.15, -3e-3)}).value());
  HapticLoop loop(hand);
  loop.publish(soft_wall(1));
  ASSERT_TRUE(loop.start().ok());
  wait_for_ticks(loop, 200);
  loop.stop();
  ASSERT_TRUE(loop.take_tool_state());
  EXPECT_GE(loop.tool_state().passivity.sampled_minimum, 0);
}

}  // namespace

}  // namespace haptic_loop_test
