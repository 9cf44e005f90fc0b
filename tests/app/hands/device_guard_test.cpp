// SPDX-License-Identifier: Apache-2.0
#include "app/hands/device_guard.h"

#include <gtest/gtest.h>

#include <cmath>

namespace device_guard_test {
namespace {

using namespace incise;
using app::DeviceGuard;
using app::DeviceGuardOptions;

/// Words every millisecond from `from` to `to`, at rest in `position`.
void hear(DeviceGuard& guard, double from, double to, const Vec3& position = Vec3::Zero()) {
  for (int i = 0; from + 1e-3 * i <= to; ++i) guard.hear(from + 1e-3 * i, position);
}

TEST(DeviceGuard, BelievesADeviceThatHasSettledAndLetsTheForceComeSlowly) {
  DeviceGuard guard;
  EXPECT_FALSE(guard.is_live(0));
  hear(guard, 0, 0.09);
  EXPECT_FALSE(guard.is_live(0.09));
  hear(guard, 0.091, 0.101);
  EXPECT_TRUE(guard.is_live(0.101));
  EXPECT_LT(guard.share(0.101), 0.01);
  hear(guard, 0.102, 0.225);
  EXPECT_NEAR(guard.share(0.225), 0.5, 1e-9);
  hear(guard, 0.226, 0.4);
  EXPECT_EQ(guard.share(0.4), 1);
}

TEST(DeviceGuard, TakesTheForceAwayAtOnceWhereItIsSilentJumpsOrMakesNoSense) {
  for (const int fault : {0, 1, 2, 3, 4, 5}) {
    DeviceGuard guard;
    hear(guard, 0, 0.5);
    ASSERT_EQ(guard.share(0.5), 1);
    double time = 0.501;
    const Vec3 nowhere(std::nan(""), 0, 0), jump(0.01, 0, 0);
    if (fault == 0) {
      time = 0.53;  // silence
    } else if (fault == 3) {
      guard.lose(time);
    } else if (fault > 3) {  // at rest, and says that it is fast
      EXPECT_FALSE(guard.hear(time, Vec3::Zero(), Vec3(0, fault == 4 ? 3.1 : std::nan(""), 0)));
    } else {
      EXPECT_FALSE(guard.hear(time, fault == 1 ? jump : nowhere));
    }
    EXPECT_EQ(guard.share(time), 0) << fault;
    EXPECT_FALSE(guard.is_live(time)) << fault;
    // It has to settle anew.
    hear(guard, time + 1e-3, time + 0.09, Vec3(0.01, 0, 0));
    EXPECT_FALSE(guard.is_live(time + 0.09)) << fault;
    hear(guard, time + 0.091, time + 0.5, Vec3(0.01, 0, 0));
    EXPECT_EQ(guard.share(time + 0.5), 1) << fault;
  }
}

TEST(DeviceGuard, LetsAFastHandAndLateWordsPass) {
  DeviceGuard guard;
  // 2 m/s, to and fro, with every tenth word 10 ms late.
  double time = 0;
  for (int i = 0; i < 1000; ++i) {
    time += i % 10 == 0 ? 0.01 : 1e-3;
    EXPECT_TRUE(guard.hear(time, Vec3(2.0 / 20 * std::sin(20 * time), 0, 0)));
  }
  EXPECT_EQ(guard.share(time), 1);
}

TEST(DeviceGuard, BadOptionsAreNamed) {
  EXPECT_TRUE(check(DeviceGuardOptions()).ok());
  DeviceGuardOptions options;
  options.silence = 0;
  EXPECT_NE(check(options).error().message.find("silence"), std::string::npos);
  options = {};
  options.max_speed = std::nan("");
  EXPECT_NE(check(options).error().message.find("speed"), std::string::npos);
  options = {};
  options.max_step = -1;
  EXPECT_NE(check(options).error().message.find("step"), std::string::npos);
  options = {};
  options.settle = -1;
  EXPECT_NE(check(options).error().message.find("settles"), std::string::npos);
  options = {};
  options.recovery = 0;
  EXPECT_NE(check(options).error().message.find("comes back"), std::string::npos);
}

}  // namespace

}  // namespace device_guard_test
