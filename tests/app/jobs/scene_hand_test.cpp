// SPDX-License-Identifier: Apache-2.0
#include "app/jobs/scene_hand.h"

#include <gtest/gtest.h>

#include "app/jobs/simulate_job.h"
#include "incise/sim/haptic_snapshot.h"

namespace incise::app::scene_hand_test {
namespace {

/// A blade that moves for ten frames of a scene of twelve.
Scene moving_blade() {
  Scene scene;
  scene.frames = 12;
  SceneStroke& stroke = scene.strokes.emplace_back();
  stroke.stroke.times = {0, 10.0 / 60};
  stroke.stroke.edges = {{Vec3(0, 0, 0), Vec3(0, 0.01, 0)}, {Vec3(0.02, 0, 0), Vec3(0.02, 0.01, 0)}};
  return scene;
}

HapticSnapshot wall(std::uint64_t serial) {
  HapticSnapshot snapshot;
  snapshot.serial = serial;
  snapshot.touches = true;
  snapshot.tool_position = Vec3(0.005, 0.005, 0);
  snapshot.compliance = Mat3::Identity() / 300;
  snapshot.engaged_length = 0.01;
  snapshot.toughness = 200;
  return snapshot;
}

TEST(SceneHand, TicksEachMillisecondWhileThereIsABlade) {
  const Scene scene = moving_blade();
  SceneHand hand(scene);
  std::uint64_t blades = 0;
  for (std::uint64_t i = 0; i < scene.frames; ++i) {
    blades += scene_input(scene, i).blade ? 1U : 0U;
    hand.feel(i, {});
  }
  EXPECT_GT(blades, 5U);
  EXPECT_EQ(hand.figures().ticks, blades * 16);
  EXPECT_LT(hand.figures().peak_force, 0.5);  // drag alone
}

TEST(SceneHand, FeelsTissueAndNeverGetsEnergyFromIt) {
  const Scene scene = moving_blade();
  SceneHand hand(scene);
  for (std::uint64_t i = 0; i < scene.frames; ++i) hand.feel(i, wall(i + 1));
  EXPECT_GT(hand.figures().peak_force, 0.5);
  EXPECT_GE(hand.figures().sampled_minimum, 0);
}

}  // namespace
}  // namespace incise::app::scene_hand_test
