// SPDX-License-Identifier: Apache-2.0
#include "app/hands/mouse_device.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace incise::app::mouse_device_test {
namespace {

Vec3 read_until(HapticDevice& device, double from, double to) {
  Vec3 position = Vec3::Zero();
  for (double t = from; t <= to; t += 1e-3) position = device.read(t).position;
  return position;
}

TEST(MouseDevice, GoesWhereThePointerGoesAtItsScale) {
  MouseOptions options;
  options.scale = 1e-3;
  MouseDevice mouse(options, Vec3(1, 0, 0));
  mouse.move_to(Vec3(100, 100, 0));
  EXPECT_EQ(read_until(mouse, 0, 0.1), Vec3(1, 0, 0));
  mouse.move_to(Vec3(110, 95, 0), 2);
  EXPECT_LT((read_until(mouse, 0.1, 0.5) - Vec3(1.01, -0.005, 0)).norm(), 1e-6);
  EXPECT_EQ(mouse.read(0.5).buttons, 2U);
}

TEST(MouseDevice, StaysWhileTheClutchIsHeld) {
  MouseDevice mouse;
  mouse.move_to(Vec3(0, 0, 0));
  mouse.move_to(Vec3(5, 0, 0), 0, true);
  EXPECT_EQ(read_until(mouse, 0, 0.2), Vec3(0, 0, 0));
  mouse.move_to(Vec3(5.25, 0, 0));
  EXPECT_NEAR(read_until(mouse, 0.2, 2).x(), 0.25, 1e-6);
}

TEST(MouseDevice, AJumpOfThePointerIsAMotionWithBoundedAcceleration) {
  MouseDevice mouse;
  mouse.move_to(Vec3(0, 0, 0));
  mouse.read(0);
  mouse.move_to(Vec3(0.01, 0, 0));
  Vec3 velocity = Vec3::Zero();
  double farthest = 0;
  for (int i = 1; i < 300; ++i) {
    const DeviceState state = mouse.read(1e-3 * i);
    EXPECT_LE((state.velocity - velocity).norm(), 40 * 1.002e-3);
    velocity = state.velocity;
    farthest = std::max(farthest, state.position.x());
  }
  EXPECT_NEAR(farthest, 0.01, 0.004);
  EXPECT_NEAR(mouse.read(0.3).position.x(), 0.01, 1e-5);
}

TEST(MouseDevice, RemembersTheForce) {
  MouseDevice mouse;
  EXPECT_FALSE(mouse.take_force());
  mouse.command(Vec3(0, 0, 1));
  EXPECT_TRUE(mouse.take_force());
  EXPECT_EQ(mouse.last_force(), Vec3(0, 0, 1));
}

}  // namespace
}  // namespace incise::app::mouse_device_test
