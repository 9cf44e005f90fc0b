// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/cutting_energy.h"

#include <gtest/gtest.h>

#include "incise/sim/local_tissue.h"
#include "sim/haptic_scenes.h"

namespace incise::cutting_energy_test {
namespace {

TEST(CuttingEnergy, WorkIsWhatTheToolIsPushedAgainst) {
  CuttingEnergy account;
  account.move_tool(Vec3(0, 0, 0), Vec3(0, 0, 0));
  account.move_tool(Vec3(0, 0, 2), Vec3(0, 0, -0.01));
  EXPECT_DOUBLE_EQ(account.balance().external, 0.01);
}

TEST(CuttingEnergy, ALiftedToolDoesNoWorkUntilItMovesAgain) {
  CuttingEnergy account;
  account.move_tool(Vec3(0, 0, 2), Vec3(0, 0, 0));
  account.lift_tool();
  account.move_tool(Vec3(0, 0, 2), Vec3(0, 0, -1));
  EXPECT_EQ(account.balance().external, 0);
  account.add_work(0.5);
  EXPECT_EQ(account.balance().external, 0.5);
}

TEST(CuttingEnergy, WhatIsLeftIsDissipated) {
  CuttingEnergy account(1.0);
  account.add_work(2);
  account.set_stored(1.25, 0.25, 0.125);
  account.add_cut(200, 1e-3);
  account.add_friction(0.5, 0.1);
  const EnergyBalance balance = account.balance();
  EXPECT_DOUBLE_EQ(balance.stored, 0.625);
  EXPECT_DOUBLE_EQ(balance.fracture, 0.2);
  EXPECT_DOUBLE_EQ(balance.friction, 0.05);
  EXPECT_DOUBLE_EQ(balance.dissipated, 2 - 0.625 - 0.2 - 0.05);
  EXPECT_FALSE(balance.is_created());
}

TEST(CuttingEnergy, MoreAreaThanWorkPaysForIsFlaggedBeyondTheTolerance) {
  CuttingEnergy account(0, {0.1, 0});
  account.add_work(1);
  account.add_cut(200, 1.05 / 200);
  EXPECT_FALSE(account.balance().is_created());
  account.add_cut(200, 0.1 / 200);
  EXPECT_TRUE(account.balance().is_created());
}

TEST(CuttingEnergy, TheLocalTissuePaysForTheAreaItsEdgeOpens) {
  LocalTissue tissue({1.0, 0.5});
  const HapticSnapshot liver = test::liver_at(Vec3::Zero());
  tissue.follow(liver);
  CuttingEnergy account;
  Vec3 force = Vec3::Zero();
  for (int i = 0; i <= 30000; ++i) {
    const Vec3 place(0, 0, -1e-6 * i);
    force = tissue.force(1e9, place);
    account.move_tool(force, place);
  }
  account.add_cut(liver.toughness, liver.engaged_length * tissue.cut_slip());
  account.add_friction(liver.friction_force(), tissue.cut_slip());
  account.set_stored(0.5 * force.dot(liver.compliance * force), 0);
  const EnergyBalance balance = account.balance();
  EXPECT_GT(balance.fracture, 0.04);
  EXPECT_NEAR(balance.dissipated, 0, 1e-3 * balance.external);
  EXPECT_FALSE(balance.is_created());
}

}  // namespace
}  // namespace incise::cutting_energy_test
