// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "incise/sim/simulated_operator.h"
#include "sim/haptic_scenes.h"

namespace incise::haptic_devices_test {
namespace {

TEST(NullDevice, RestsAtTheOrigin) {
  NullDevice device;
  device.command(Vec3(1, 2, 3));
  EXPECT_EQ(device.read(5).position, Vec3(0, 0, 0));
}

Vec3 read_until(HapticDevice& device, double from, double to) {
  Vec3 position = Vec3::Zero();
  for (double t = from; t <= to; t += 1e-3) position = device.read(t).position;
  return position;
}

TimedPose pose(double time, const Vec3& position, std::uint32_t buttons = 0) {
  return {time, position, Eigen::Quaterniond::Identity(), buttons};
}

TEST(PoseTrack, PassesThroughItsPosesAndRestsOutside) {
  const PoseTrack track =
      PoseTrack::create({pose(1, Vec3(0, 0, 0), 1), pose(2, Vec3(1, 0, 0), 2), pose(4, Vec3(1, 3, 0), 3)}).value();
  EXPECT_EQ(track.at(0).position, Vec3(0, 0, 0));
  EXPECT_EQ(track.at(2).position, Vec3(1, 0, 0));
  EXPECT_EQ(track.at(3.9).buttons, 2U);
  EXPECT_EQ(track.at(9).position, Vec3(1, 3, 0));
  EXPECT_EQ(track.at(9).velocity, Vec3(0, 0, 0));
  EXPECT_EQ(track.end_time(), 4);
}

TEST(PoseTrack, VelocityIsTheSlopeOfThePositionAndHasNoSteps) {
  const PoseTrack track = test::strokes(Vec3(0, 0, 0), Vec3(0.01, 0.02, -0.01), 1, 2);
  const double h = 1e-5;
  for (double t = -0.1; t < 2.2; t += 0.0123) {
    const Vec3 slope = (track.at(t + h).position - track.at(t - h).position) / (2 * h);
    EXPECT_LT((slope - track.at(t).velocity).norm(), 1e-4);
    EXPECT_LT((track.at(t + h).velocity - track.at(t).velocity).norm(), 1e-2);
  }
}

TEST(PoseTrack, TurnsTheShortWay) {
  const Eigen::Quaterniond quarter(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
  const Eigen::Quaterniond same_turn(-quarter.coeffs());
  const PoseTrack track = PoseTrack::create({pose(0, Vec3::Zero()), {1, Vec3::Zero(), same_turn, 0}}).value();
  const Eigen::Quaterniond half = track.at(0.5).orientation;
  EXPECT_NEAR(half.norm(), 1, 1e-12);
  EXPECT_NEAR(std::abs(half.dot(Eigen::Quaterniond(std::cos(M_PI / 8), 0, 0, std::sin(M_PI / 8)))), 1, 1e-12);
}

TEST(PoseTrack, BadTracksAreRefused) {
  EXPECT_FALSE(PoseTrack::create({}).ok());
  EXPECT_FALSE(PoseTrack::create({pose(1, Vec3::Zero()), pose(1, Vec3::Zero())}).ok());
  EXPECT_FALSE(PoseTrack::create({pose(0, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()))}).ok());
  EXPECT_NE(PoseTrack::create({pose(0, Vec3::Zero()), {1, Vec3::Zero(), Eigen::Quaterniond(2, 0, 0, 0), 0}})
                .error()
                .message.find("pose 1"),
            std::string::npos);
}

TEST(RecordedDevice, PlaysItsTrackWhateverTheForce) {
  RecordedDevice device(test::strokes(Vec3(0, 0, 0), Vec3(0, 0, -0.01), 1, 1));
  device.command(Vec3(0, 0, 100));
  EXPECT_NEAR(device.read(0.5).position.z(), -0.01, 1e-15);
  EXPECT_EQ(device.last_force(), Vec3(0, 0, 100));
}

PoseTrack at_rest() {
  return PoseTrack::create({pose(0, Vec3::Zero())}).value();
}

TEST(SimulatedOperator, FollowsThePlan) {
  SimulatedOperator hand(test::strokes(Vec3(0, 0, 0), Vec3(0, 0, -0.01), 2, 1));
  double worst = 0;
  const PoseTrack plan = test::strokes(Vec3(0, 0, 0), Vec3(0, 0, -0.01), 2, 1);
  for (double t = 0; t < 2.5; t += 1e-3) worst = std::max(worst, (hand.read(t).position - plan.at(t).position).norm());
  EXPECT_LT(worst, 5e-4);
}

TEST(SimulatedOperator, GivesWayToTheForceByItsStiffness) {
  SimulatedOperator hand(at_rest());
  hand.command(Vec3(0, 0, 3));
  EXPECT_NEAR(read_until(hand, 0, 3).z(), 3.0 / 300, 1e-9);
}

TEST(SimulatedOperator, MovesByTheMomentumOfTheForceAtFirst) {
  SimulatedOperator hand(at_rest());
  hand.command(Vec3(0, 0, 2));
  EXPECT_NEAR(hand.read(1e-3).velocity.z(), 2e-3 / 0.2, 1e-3);
  EXPECT_NEAR(hand.kinetic_energy(), 0.5 * 0.2 * 1e-4, 2e-6);
}

TEST(SimulatedOperator, IsStableWhateverTheStepAndTheGrip) {
  SimulatedOperator hand(at_rest(), {0.1, 1e6, 0});
  hand.command(Vec3(0, 0, 5));
  double farthest = 0;
  for (int i = 1; i < 300; ++i) farthest = std::max(farthest, hand.read(0.37 * i).position.norm());
  EXPECT_LT(farthest, 1e-5);
}

TEST(SimulatedOperator, NumbersOutOfRangeAreNamed) {
  EXPECT_TRUE(check(HandOptions{}).ok());
  EXPECT_NE(check(HandOptions{0, 1, 1}).error().message.find("mass"), std::string::npos);
  EXPECT_NE(check(HandOptions{1, -1, 1}).error().message.find("stiffness"), std::string::npos);
  EXPECT_NE(check(HandOptions{1, 1, std::numeric_limits<double>::quiet_NaN()}).error().message.find("damping"),
            std::string::npos);
}

}  // namespace
}  // namespace incise::haptic_devices_test
