// SPDX-License-Identifier: Apache-2.0
#include "app/hands/placed_device.h"

#include <gtest/gtest.h>

namespace placed_device_test {
namespace {

using namespace incise;
using app::DevicePlacement;
using app::PlacedDevice;

/// Is where it is told to be, and remembers the force.
class Puppet final : public HapticDevice {
 public:
  explicit Puppet(DeviceState& state, Vec3& force) : state_(state), force_(force) {}
  DeviceState read(double /*time*/) override { return state_; }
  void command(const Vec3& force) override { force_ = force; }

 private:
  DeviceState& state_;
  Vec3& force_;
};

struct Hand {
  DeviceState state;
  Vec3 force = Vec3::Zero();
  PlacedDevice device;
  explicit Hand(const DevicePlacement& placement) : device(std::make_unique<Puppet>(state, force), placement) {}
};

TEST(PlacedDevice, StartsWhereItIsPlacedAndGoesOnInTheWorldsAxes) {
  // Up is y in the world: the device's z.
  Hand hand({Vec3(1, 2, 3), app::axes_for(Vec3::UnitY()), 2});
  hand.state.position = Vec3(0.1, 0.2, 0.3);
  EXPECT_TRUE(hand.device.read(0).position.isApprox(Vec3(1, 2, 3)));
  hand.state.position.z() += 0.01;
  hand.state.velocity = Vec3(0, 0, 0.1);
  const DeviceState moved = hand.device.read(1e-3);
  EXPECT_TRUE(moved.position.isApprox(Vec3(1, 2.02, 3)));
  EXPECT_TRUE(moved.velocity.isApprox(Vec3(0, 0.2, 0)));
  EXPECT_TRUE((moved.orientation * Vec3::UnitZ()).isApprox(Vec3::UnitY()));
  // Forces turn back, and keep their size.
  hand.device.command(Vec3(0, 1.5, 0));
  EXPECT_TRUE(hand.force.isApprox(Vec3(0, 0, 1.5)));
}

TEST(PlacedDevice, IsLiftedLikeAMouse) {
  Hand hand({Vec3::Zero(), Eigen::Matrix3d::Identity(), 1});
  hand.device.read(0);
  hand.state.buttons = PlacedDevice::kLift;
  hand.state.position.x() = 0.001;
  EXPECT_TRUE(hand.device.read(1e-3).position.isApprox(Vec3(0.001, 0, 0)));
  hand.state.position.x() = 0.1;
  hand.state.velocity.x() = 1;
  const DeviceState lifted = hand.device.read(2e-3);
  EXPECT_TRUE(lifted.position.isApprox(Vec3(0.001, 0, 0)));
  EXPECT_TRUE(lifted.velocity.isZero());
  hand.device.command(Vec3(1, 0, 0));
  EXPECT_TRUE(hand.force.isZero());
  hand.state.buttons = 0;
  hand.device.read(3e-3);
  hand.state.position.x() = 0.11;
  EXPECT_TRUE(hand.device.read(4e-3).position.isApprox(Vec3(0.011, 0, 0)));
  hand.device.command(Vec3(1, 0, 0));
  EXPECT_TRUE(hand.force.isApprox(Vec3(1, 0, 0)));
}

TEST(PlacedDevice, IsPlacedAnewForAnotherBodyAndKeepsItsPlaceThroughSilence) {
  Hand hand({Vec3::Zero(), Eigen::Matrix3d::Identity(), 1});
  hand.device.read(0);
  hand.state.is_live = false;
  hand.state.position = Vec3(0.5, 0, 0);
  EXPECT_FALSE(hand.device.read(1e-3).is_live);
  hand.state.is_live = true;
  EXPECT_TRUE(hand.device.read(2e-3).position.isApprox(Vec3(0.5, 0, 0)));
  hand.device.place({Vec3(7, 0, 0), Eigen::Matrix3d::Identity(), 1});
  EXPECT_TRUE(hand.device.read(3e-3).position.isApprox(Vec3(7, 0, 0)));
}

TEST(PlacedDevice, AxesAreRotations) {
  EXPECT_TRUE(app::parse_axes("x,y,z")->isIdentity());
  const Eigen::Matrix3d up = *app::parse_axes("x,z,-y");
  EXPECT_TRUE((up * Vec3::UnitZ()).isApprox(Vec3::UnitY()));
  EXPECT_TRUE(up.isApprox(app::axes_for(Vec3::UnitY())));
  EXPECT_TRUE((app::axes_for(-Vec3::UnitZ()) * Vec3::UnitZ()).isApprox(-Vec3::UnitZ()));
  for (const char* bad : {"", "x", "x,y", "x,y,z,", "x,y,w", "x,x,z", "-x,y,z", "y,x,z", "x,--y,z", "x y z"}) {
    const auto axes = app::parse_axes(bad);
    ASSERT_FALSE(axes.ok()) << bad;
    EXPECT_NE(axes.error().message.find("x,-z,y"), std::string::npos);
  }
}

}  // namespace

}  // namespace placed_device_test
