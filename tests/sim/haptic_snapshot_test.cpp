// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/haptic_snapshot.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/haptic_scenes.h"

namespace incise::haptic_snapshot_test {
namespace {

using test::liver_at;

TEST(HapticSnapshot, ForcesOfCuttingAreToughnessAndFrictionTimesLength) {
  const HapticSnapshot liver = liver_at(Vec3::Zero());
  EXPECT_DOUBLE_EQ(liver.fracture_force(), 200 * 0.01);
  EXPECT_DOUBLE_EQ(liver.friction_force(), 20 * 0.01);
}

TEST(HapticSnapshot, TheEdgeIsOrthogonalToTheCutAndTheFlat) {
  HapticSnapshot s;
  s.cutting_direction = -Vec3::UnitY();
  s.flat_normal = Vec3::UnitX();
  EXPECT_EQ(s.edge_direction(), Vec3(0, 0, -1));
}

TEST(HapticSnapshot, SoundOnesPassRigidOnesToo) {
  HapticSnapshot s = liver_at(Vec3::Zero());
  EXPECT_TRUE(is_sound(s));
  s.compliance.setZero();
  EXPECT_TRUE(check(s).ok());
}

TEST(HapticSnapshot, AFreeToolNeedsNothingElse) {
  HapticSnapshot s = liver_at(Vec3::Zero());
  s.touches = false;
  s.force.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(is_sound(s));
}

TEST(HapticSnapshot, EachBrokenPromiseIsNamed) {
  const auto defect = [](auto&& breaks) {
    HapticSnapshot s = liver_at(Vec3::Zero());
    breaks(s);
    EXPECT_FALSE(is_sound(s));
    const Status status = check(s);
    return status.ok() ? std::string() : status.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(defect([&](HapticSnapshot& s) { s.force.x() = nan; }).find("force"), std::string::npos);
  EXPECT_NE(defect([&](HapticSnapshot& s) { s.tool_position.x() = nan; }).find("places"), std::string::npos);
  EXPECT_NE(defect([](HapticSnapshot& s) { s.flat_normal *= 2; }).find("length 1"), std::string::npos);
  EXPECT_NE(defect([](HapticSnapshot& s) { s.flat_normal = s.cutting_direction; }).find("orthogonal"),
            std::string::npos);
  EXPECT_NE(defect([](HapticSnapshot& s) { s.compliance(0, 1) += 1e-3; }).find("symmetric"), std::string::npos);
  EXPECT_NE(defect([](HapticSnapshot& s) { s.compliance(2, 2) = -1e-3; }).find("eigenvalue"), std::string::npos);
  EXPECT_NE(defect([](HapticSnapshot& s) { s.compliance(0, 1) = s.compliance(1, 0) = 1; }).find("eigenvalue"),
            std::string::npos);
  EXPECT_NE(defect([](HapticSnapshot& s) { s.toughness = -1; }).find("lie in [0, 1e+15]"), std::string::npos);
}

}  // namespace
}  // namespace incise::haptic_snapshot_test
