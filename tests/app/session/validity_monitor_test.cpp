// SPDX-License-Identifier: Apache-2.0
#include "app/session/validity_monitor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <utility>

#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"

namespace incise::app::validity_monitor_test {
namespace {

constexpr double kTolerance = 1e-12;

/// The light once no check is under way.
ValidityLight settled(const ValidityMonitor& monitor) {
  constexpr int kTries = 30000;
  ValidityLight light = monitor.light();
  for (int i = 0; i < kTries && light.state == ValidityState::kChecking; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    light = monitor.light();
  }
  return light;
}

/// Waits for its turn.
ValidityLight checked(ValidityMonitor& monitor, const TetMesh& mesh) {
  while (!monitor.check(mesh)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return settled(monitor);
}

/// Two tets that share a single edge: dirty input.
TetMesh hinge() {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  soup.tets = {{0, 2, 3, 1}, {0, 4, 5, 1}};
  return TetMesh::build(soup).value();
}

TEST(ValidityMonitor, ASoundMeshIsValid) {
  const ValidityMonitor monitor(cube_mesh(3), kTolerance);
  const ValidityLight light = settled(monitor);
  EXPECT_EQ(light.state, ValidityState::kValid);
  EXPECT_EQ(light.text, "valid");
}

TEST(ValidityMonitor, ACutMeshIsValid) {
  Engine engine = Engine::create(cube_mesh(4), {}).value();
  ValidityMonitor monitor(engine.mesh(), kTolerance);
  const Box around{Vec3::Constant(-0.5), Vec3::Constant(1.5)};
  for (const double offset : {0.31, 0.47, 0.83}) {
    ASSERT_TRUE(engine.cut(plane_stroke(around, Vec3(1, 0.2, 0.1), offset).value()).ok());
    EXPECT_EQ(checked(monitor, engine.mesh()).text, "valid");
  }
}

TEST(ValidityMonitor, AMeshOfAnotherVolumeBreaksTheContract) {
  ValidityMonitor monitor(cube_mesh(3), kTolerance);
  settled(monitor);
  TetSoup soup = kuhn_cube(3);
  for (Vec3& point : soup.points) point *= 1.001;
  const ValidityLight light = checked(monitor, TetMesh::build(soup).value());
  EXPECT_EQ(light.state, ValidityState::kBroken);
  EXPECT_EQ(light.text, "1 volume_drift");
  EXPECT_EQ(checked(monitor, cube_mesh(3)).state, ValidityState::kValid);
}

TEST(ValidityMonitor, DefectsOfTheInputAreNoFault) {
  ValidityMonitor monitor(hinge(), kTolerance);
  const ValidityLight light = settled(monitor);
  EXPECT_EQ(light.state, ValidityState::kValid);
  EXPECT_EQ(light.text.rfind("as sound as the input: ", 0), 0U) << light.text;
  EXPECT_EQ(checked(monitor, hinge()).state, ValidityState::kValid);
}

TEST(ValidityMonitor, DefectsThatTheInputDidNotHaveAreAFault) {
  ValidityMonitor monitor(cube_mesh(1), 10);
  settled(monitor);
  const ValidityLight light = checked(monitor, hinge());
  EXPECT_EQ(light.state, ValidityState::kBroken);
  EXPECT_NE(light.text.find("1 nonmanifold_edge"), std::string::npos) << light.text;
}

TEST(ValidityMonitor, TakesNoMeshWhileACheckIsUnderWay) {
  const TetMesh large = cube_mesh(24), small = cube_mesh(2);
  ValidityMonitor monitor(large, kTolerance);
  EXPECT_EQ(monitor.light().state, ValidityState::kChecking);
  EXPECT_FALSE(monitor.check(small));
  EXPECT_EQ(settled(monitor).state, ValidityState::kValid);
}

TEST(ValidityMonitor, EndsWithinACheckAndMoves) {
  ValidityMonitor first(cube_mesh(16), kTolerance);
  ValidityMonitor second(std::move(first));
  first = ValidityMonitor(cube_mesh(2), kTolerance);
  EXPECT_EQ(settled(first).state, ValidityState::kValid);
  EXPECT_EQ(settled(second).state, ValidityState::kValid);
  const ValidityMonitor gone(cube_mesh(16), kTolerance);
}

}  // namespace
}  // namespace incise::app::validity_monitor_test
