// SPDX-License-Identifier: Apache-2.0
#include "app/hands/scene_hand_tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace incise::app::scene_hand_tools_test {
namespace {

const Box kBlock{{0, 0, 0}, {80, 40, 16}};

Scene scene_with_exercise() {
  Scene scene;
  scene.options.body.length_unit = 1e-3;
  scene.exercise.emplace().depth = 3.5;
  scene.exercise->angle = 30;
  return scene;
}

TEST(SceneHandTools, scenes_call_the_tools_by_their_names_in_small_letters) {
  for (std::size_t i = 0; i < kToolCount; ++i) {
    std::string name = kTools[i].name;
    name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    const auto tool = static_cast<ToolKind>(i);
    EXPECT_EQ(scene_name_of(tool), name);
    EXPECT_EQ(tool_named(name), tool);
    Scene scene;
    scene.hand.emplace().tool = tool;
    EXPECT_EQ(tool_for(scene), tool);
  }
}

TEST(SceneHandTools, a_scene_without_a_word_leaves_the_tool_and_goes_by_the_body) {
  Scene scene;
  scene.options.body.length_unit = 1e-3;
  EXPECT_FALSE(tool_for(scene).has_value());
  const ToolSettings settings = settings_for(scene, kBlock);
  EXPECT_EQ(settings.depth, 2);
  EXPECT_EQ(settings.angle, 0);
  EXPECT_EQ(settings.grasp_radius, 8);
  EXPECT_EQ(settings.metres, 1e-3);
}

TEST(SceneHandTools, grips_are_as_stiff_as_the_stiffest_tissue) {
  Scene scene;
  scene.options.materials.fallback.young = 2e3;
  const double soft = settings_for(scene, kBlock).grasp_stiffness;
  Material stiff;
  stiff.young = 6e3;
  scene.options.materials.by_region = {{4, stiff}};
  EXPECT_NEAR(settings_for(scene, kBlock).grasp_stiffness, 3 * soft, 1e-9 * soft);
}

TEST(SceneHandTools, an_exercise_puts_a_scalpel_of_its_depth_and_angle_into_the_hand) {
  const Scene scene = scene_with_exercise();
  EXPECT_EQ(tool_for(scene), ToolKind::kScalpel);
  const ToolSettings settings = settings_for(scene, kBlock);
  EXPECT_EQ(settings.depth, 3.5);
  EXPECT_NEAR(settings.angle, M_PI / 6, 1e-12);
}

TEST(SceneHandTools, an_exercise_of_a_flat_angle_tilts_no_further_than_tools_go) {
  Scene scene = scene_with_exercise();
  scene.exercise->angle = 89;
  ToolMachine tools{settings_for(scene, kBlock)};
  EXPECT_NEAR(tools.settings().angle, HandPreset::kMostTilt * M_PI / 180, 1e-12);
}

TEST(SceneHandTools, what_the_scene_says_of_the_hand_comes_before_all) {
  Scene scene = scene_with_exercise();
  scene.hand = HandPreset{ToolKind::kPunch, 15, -10, 4, 6};
  EXPECT_EQ(tool_for(scene), ToolKind::kPunch);
  const ToolSettings settings = settings_for(scene, kBlock);
  EXPECT_EQ(settings.depth, 15);
  EXPECT_NEAR(settings.angle, -M_PI / 18, 1e-12);
  EXPECT_EQ(settings.punch_radius, 4);
  EXPECT_EQ(settings.grasp_radius, 6);
  scene.hand = HandPreset{};
  EXPECT_EQ(tool_for(scene), ToolKind::kScalpel) << "what it leaves out is the exercise's";
  EXPECT_EQ(settings_for(scene, kBlock).depth, 3.5);
}

}  // namespace
}  // namespace incise::app::scene_hand_tools_test
