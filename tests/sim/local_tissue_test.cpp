// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/local_tissue.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/haptic_scenes.h"

namespace incise::local_tissue_test {
namespace {

using test::liver_at;

/// So stiff that the tool is where its handle is.
constexpr double kRigid = 1e9;

Vec3 pressed(double depth) {
  return {0, 0, -depth};
}

TEST(LocalTissue, AFreeToolFeelsNothing) {
  LocalTissue tissue;
  EXPECT_EQ(tissue.force(500, Vec3(1, 2, 3)), Vec3(0, 0, 0));
  HapticSnapshot away = liver_at(Vec3::Zero());
  away.touches = false;
  tissue.follow(away);
  EXPECT_EQ(tissue.force(500, Vec3(1, 2, 3)), Vec3(0, 0, 0));
}

TEST(LocalTissue, TheForceOfTheSnapshotIsFeltAtItsPlace) {
  LocalTissue tissue;
  HapticSnapshot s = liver_at(Vec3(1, 2, 3));
  s.force = Vec3(0.3, 0.1, 0.5);
  tissue.follow(s);
  EXPECT_LT((tissue.force(kRigid, s.tool_position) - s.force).norm(), 1e-6);
}

TEST(LocalTissue, TheForceIsExtrapolatedWithTheLocalStiffness) {
  LocalTissue tissue;
  HapticSnapshot s = liver_at(Vec3::Zero());
  s.force = Vec3(0, 0, 0.5);
  tissue.follow(s);
  EXPECT_NEAR(tissue.force(kRigid, pressed(1e-3)).z(), 0.5 + 300 * 1e-3, 1e-5);
  EXPECT_NEAR(tissue.force(kRigid, Vec3(2e-3, 0, 0)).x(), -300 * 2e-3, 1e-5);
}

TEST(LocalTissue, TissueAndSpringActInARow) {
  LocalTissue tissue;
  tissue.follow(liver_at(Vec3::Zero()));
  EXPECT_NEAR(tissue.force(600, pressed(1e-3)).z(), 1e-3 / (1.0 / 300 + 1.0 / 600), 1e-12);
}

TEST(LocalTissue, RigidTissueLeavesTheSpringAlone) {
  LocalTissue tissue;
  HapticSnapshot s = liver_at(Vec3::Zero());
  s.compliance.setZero();
  tissue.follow(s);
  EXPECT_NEAR(tissue.force(600, pressed(1e-3)).z(), 0.6, 1e-12);
}

TEST(LocalTissue, ForceRisesToRuptureDropsToCuttingAndStaysThere) {
  LocalTissue tissue;
  tissue.follow(liver_at(Vec3::Zero()));
  const double cutting = 200 * 0.01 + 20 * 0.01, rupture = 1.2 * 200 * 0.01 + 20 * 0.01;
  double highest = 0;
  bool was_cutting = false;
  for (double depth = 0; depth < 0.03; depth += 1e-5) {
    const double force = tissue.force(kRigid, pressed(depth)).z();
    highest = std::max(highest, force);
    EXPECT_LE(tissue.is_cutting() ? std::abs(force - cutting) : 0.0, 1e-6);
    was_cutting = was_cutting || tissue.is_cutting();
  }
  EXPECT_TRUE(was_cutting);
  EXPECT_LE(highest, rupture + 1e-6);
  EXPECT_GT(highest, rupture - 0.01);
  EXPECT_NEAR(tissue.cut_slip(), 0.03 - cutting / 300, 2e-5);
}

TEST(LocalTissue, WhenPhysicsSaysRupturedThereIsNoOnset) {
  LocalTissue tissue;
  HapticSnapshot s = liver_at(Vec3::Zero());
  s.ruptured = true;
  s.force = Vec3(0, 0, 2.2);
  tissue.follow(s);
  EXPECT_NEAR(tissue.force(kRigid, pressed(1e-3)).z(), 2.2, 1e-6);
}

TEST(LocalTissue, TheWayBackIsSofterByTheSlipAndCostsTheWorkOfFracture) {
  LocalTissue tissue({1.0, 0.5});
  tissue.follow(liver_at(Vec3::Zero()));
  const double step = 1e-6, turn = 0.02, limit = 2.2;
  double work = 0, depth = 0;
  for (; depth < turn; depth += step) work += step * tissue.force(kRigid, pressed(depth)).z();
  const double slip = tissue.cut_slip();
  while (tissue.force(kRigid, pressed(depth)).z() > 0) {
    work -= step * tissue.force(kRigid, pressed(depth)).z();
    depth -= step;
  }
  EXPECT_NEAR(slip, turn - limit / 300, 1e-5);
  EXPECT_NEAR(depth, slip, 1e-5);
  EXPECT_NEAR(work, limit * slip, 1e-3 * limit * slip);
}

TEST(LocalTissue, RuptureNeedsItsOnsetAgainAfterTheForceWasTaken) {
  LocalTissue tissue;
  tissue.follow(liver_at(Vec3::Zero()));
  tissue.force(kRigid, pressed(0.02));
  ASSERT_TRUE(tissue.is_cutting());
  tissue.force(kRigid, pressed(0.02 - 3e-3));
  EXPECT_TRUE(tissue.is_cutting());
  tissue.force(kRigid, pressed(0.02 - 5e-3));
  EXPECT_FALSE(tissue.is_cutting());
}

TEST(LocalTissue, ABladeDrawnBackOrMovedAlongItsEdgeMeetsFrictionAlone) {
  LocalTissue tissue;
  tissue.follow(liver_at(Vec3::Zero()));
  EXPECT_NEAR(tissue.force(kRigid, pressed(-0.01)).z(), -20 * 0.01, 1e-6);
  tissue.follow(liver_at(Vec3::Zero(), 2));
  EXPECT_NEAR(tissue.force(kRigid, Vec3(0, 0.01, 0)).y(), -20 * 0.01, 1e-6);
}

TEST(LocalTissue, AcrossItsFlatTheBladeMeetsTheElasticBody) {
  LocalTissue tissue;
  tissue.follow(liver_at(Vec3::Zero()));
  EXPECT_NEAR(tissue.force(kRigid, Vec3(0.05, 0, 0)).x(), -300 * 0.05, 1e-4);
}

TEST(LocalTissue, LimitsHoldWithCouplingBetweenTheAxes) {
  LocalTissue tissue;
  HapticSnapshot s = liver_at(Vec3::Zero());
  s.compliance << 4e-3, 1e-3, 5e-4, 1e-3, 5e-3, 2e-3, 5e-4, 2e-3, 3e-3;
  tissue.follow(s);
  const Vec3 force = tissue.force(400, Vec3(5e-3, 3e-2, -3e-2));
  EXPECT_LE(std::abs(force.y()), 0.2 + 1e-12);
  EXPECT_NEAR(force.z(), 2.2, 1e-9);
}

TEST(LocalTissue, TissueWithoutToughnessAndFrictionLetsTheBladePass) {
  LocalTissue tissue;
  HapticSnapshot s = liver_at(Vec3::Zero());
  s.toughness = s.cut_friction = 0;
  tissue.follow(s);
  EXPECT_NEAR(tissue.force(500, Vec3(0, 0.01, -0.01)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace incise::local_tissue_test
