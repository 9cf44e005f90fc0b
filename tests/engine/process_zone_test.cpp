// SPDX-License-Identifier: Apache-2.0
#include "engine/process_zone.h"

#include <gtest/gtest.h>

#include "incise/engine/engine.h"
#include "incise/mesh/shapes.h"

namespace incise::process_zone_test {
namespace {

using detail::FrontPoint;
using detail::ProcessZone;

TetMesh cube() {
  return *TetMesh::build(kuhn_cube(8));
}

FrontPoint point_at(const TetMesh& mesh, const Vec3& place, double radius) {
  const auto found = find_tissue(mesh, BodyShape::kRest, {&place, 1});
  EXPECT_TRUE(found[0].has_value());
  return {*found[0], place, radius};
}

TEST(ProcessZone, SharesOfEachPointAddUpToOneAndLieWithinItsRadius) {
  const TetMesh mesh = cube();
  const std::vector<FrontPoint> points = {point_at(mesh, {0.41, 0.5, 0.5}, 0.3), point_at(mesh, {0.6, 0.52, 0.5}, 0.3)};
  ProcessZone zone;
  zone.find(mesh, points);
  std::vector<double> sums(2);
  for (const ProcessZone::Share& share : zone.shares()) {
    sums[share.point] += share.weight;
    EXPECT_LT((zone.bearers()[share.bearer].rest - points[share.point].rest).norm(), 0.3);
  }
  EXPECT_NEAR(sums[0], 1, 1e-12);
  EXPECT_NEAR(sums[1], 1, 1e-12);
  EXPECT_GT(zone.bearers().size(), 50U);
}

TEST(ProcessZone, WhereTetsAreLargerThanTheZoneTheirCornersBearThePoint) {
  const TetMesh mesh = cube();
  ProcessZone zone;
  zone.find(mesh, std::vector<FrontPoint>{point_at(mesh, {0.44, 0.47, 0.45}, 1e-3)});
  ASSERT_EQ(zone.shares().size(), 4U);
  Vec3 mean = Vec3::Zero();
  for (const ProcessZone::Share& share : zone.shares()) mean += share.weight * zone.bearers()[share.bearer].rest;
  EXPECT_LT((mean - Vec3(0.44, 0.47, 0.45)).norm(), 1e-12);
}

TEST(ProcessZone, VerticesThatStayKeepTheLagsOfTheirSprings) {
  const TetMesh mesh = cube();
  ProcessZone zone;
  zone.find(mesh, std::vector<FrontPoint>{point_at(mesh, {0.41, 0.5, 0.5}, 0.25)});
  for (ProcessZone::Bearer& bearer : zone.bearers()) bearer.lag = bearer.rest.x();
  zone.find(mesh, std::vector<FrontPoint>{point_at(mesh, {0.55, 0.5, 0.5}, 0.25)});
  std::size_t fresh = 0, kept = 0;
  for (std::size_t i = 0; i < zone.bearers().size(); ++i) {
    EXPECT_EQ(zone.bearers()[i].lag, zone.is_fresh(i) ? 0 : zone.bearers()[i].rest.x());
    ++(zone.is_fresh(i) ? fresh : kept);
  }
  EXPECT_GT(fresh, 5U);
  EXPECT_GT(kept, 5U);
}

TEST(ProcessZone, WhatACutHasPartedBearsNothing) {
  Engine engine = Engine::create(cube()).value();
  const BladePose from{{{-0.1, -0.1, 0.53}, {-0.1, 1.1, 0.53}}, Vec3(Vec3::UnitX())};
  BladePose to = from;
  for (Vec3& point : to.edge) point.x() = 1.1;
  ASSERT_TRUE(engine.begin_stroke(from).ok());
  ASSERT_TRUE(engine.step(to).ok());
  ASSERT_TRUE(engine.end_stroke().ok());
  ProcessZone zone;
  zone.find(engine.mesh(), std::vector<FrontPoint>{point_at(engine.mesh(), {0.5, 0.5, 0.6}, 0.3)});
  for (const ProcessZone::Bearer& bearer : zone.bearers()) EXPECT_GT(bearer.rest.z(), 0.53 - 1e-9);
  EXPECT_GT(zone.bearers().size(), 20U);
}

}  // namespace
}  // namespace incise::process_zone_test
