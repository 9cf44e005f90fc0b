// SPDX-License-Identifier: Apache-2.0
// The exercises of the window's cards are those that come with Incise, and what they put into the hand does them.
#include "app/session/starting_exercise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/hands/punch.h"
#include "app/hands/scene_hand_tools.h"
#include "app/session/session.h"
#include "app/session/shipped_exercises.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"
#include "support/folder.h"

namespace incise::app::starting_exercise_test {
namespace {

using incise_test::Folder;

constexpr double kMust = 95;  // points of 100

std::string file_of(const std::string& name) {
  return incise_test::read(std::string(INCISE_SCENES) + "/" + name + ".json");
}

ExerciseScore score_of_ideal(const Scene& scene) {
  const Scene shown = with_ideal(scene);
  Session session = Session::open(shown).value();
  for (std::uint64_t i = 0; i < shown.frames; ++i) EXPECT_TRUE(session.frame().ok());
  EXPECT_TRUE(validate(session.mesh(), ValidateLevel::kGeometry).ok);
  return session.score().value();
}

TEST(StartingExercise, files_are_compiled_in_as_they_stand) {
  EXPECT_EQ(shipped_exercise(StartingExercise::kSkin), file_of("train_skin"));
  EXPECT_EQ(shipped_exercise(StartingExercise::kFat), file_of("train_fat"));
  EXPECT_EQ(shipped_exercise(StartingExercise::kCore), file_of("train_core"));
  EXPECT_EQ(shipped_exercise(StartingExercise::kExcision), file_of("train_excision"));
  EXPECT_TRUE(shipped_exercise(StartingExercise::kVein).empty());
  EXPECT_TRUE(shipped_exercise(StartingExercise::kCount).empty());
}

TEST(StartingExercise, each_opens_with_its_title_and_has_an_ideal) {
  const Folder folder;
  for (std::size_t i = 0; i < kStartingExercises.size(); ++i) {
    const Result<Scene> scene = scene_of(static_cast<StartingExercise>(i), folder / "");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->name, kStartingExercises[i].title);
    ASSERT_TRUE(scene->exercise.has_value());
    EXPECT_FALSE(scene->exercise->ideal.empty());
    EXPECT_TRUE(tool_for(*scene).has_value());
  }
  EXPECT_FALSE(scene_of(StartingExercise::kCount).ok());
}

TEST(StartingExercise, the_hand_holds_what_the_exercise_asks_for) {
  const Folder folder;
  const auto settings_of = [&](StartingExercise exercise) {
    return settings_for(scene_of(exercise, folder / "").value(), {{0, 0, 0}, {60, 60, 24}});
  };
  EXPECT_EQ(settings_of(StartingExercise::kSkin).depth, 3.5);
  EXPECT_EQ(settings_of(StartingExercise::kFat).depth, 3.8);
  EXPECT_EQ(settings_of(StartingExercise::kVein).depth, 4);
  EXPECT_EQ(settings_of(StartingExercise::kCore).punch_radius, 4);
  EXPECT_EQ(settings_of(StartingExercise::kCore).depth, 15);
  EXPECT_NEAR(settings_of(StartingExercise::kExcision).angle, M_PI / 4, 1e-12);
  EXPECT_EQ(tool_for(scene_of(StartingExercise::kCore).value()), ToolKind::kPunch);
}

TEST(StartingExercise, the_ideal_of_the_vein_opens_it_and_spares_its_far_wall) {
  const Folder folder;
  const ExerciseScore score = score_of_ideal(scene_of(StartingExercise::kVein, folder / "").value());
  EXPECT_GE(score.points, kMust) << to_text(score);
  EXPECT_TRUE(score.is_passed);
}

TEST(StartingExercise, a_vein_that_is_hardly_scratched_is_not_opened) {
  const Folder folder;
  Scene scene = scene_of(StartingExercise::kVein, folder / "").value();
  for (SceneStroke& stroke : scene.exercise->ideal) {
    for (auto& edge : stroke.stroke.edges) {
      for (Vec3& point : edge) point += 2.5 * Vec3::UnitZ();
    }
  }
  const ExerciseScore score = score_of_ideal(scene);
  EXPECT_LT(score.points, scene.exercise->pass) << to_text(score);
}

TEST(StartingExercise, a_click_with_the_punch_that_is_in_hand_passes_the_biopsy) {
  const Scene scene = scene_of(StartingExercise::kCore).value();
  Session session = Session::open(scene).value();
  const ToolSettings settings = settings_for(scene, rest_bounds(session.mesh()));
  session.follow(punch_stroke({21, 21.3, 24}, Vec3::UnitZ(), settings), ToolKind::kPunch);
  while (session.is_following()) ASSERT_TRUE(session.frame().ok());
  EXPECT_EQ(find_components(session.mesh()).count(), 2U);
  const ExerciseScore score = session.score().value();
  EXPECT_GE(score.points, kMust) << to_text(score);
}

}  // namespace
}  // namespace incise::app::starting_exercise_test
