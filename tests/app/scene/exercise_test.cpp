// SPDX-License-Identifier: Apache-2.0
// Exercises: what the ideal is, and what an attempt is worth.
#include "app/scene/exercise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/jobs/simulate_job.h"
#include "app/scene/exercise_score.h"
#include "app/scene/scene_simulation.h"
#include "support/scene_cases.h"

namespace exercise_test {
namespace {

using namespace incise;
using namespace incise_test;

/// A blade of 20 mm with its tip at one point, then at another, after dipping in, and lifted out at the end.
Json straight_cut(double start, const Vec3& from, const Vec3& to, double tilt = 0) {
  const auto key = [&](double t, const Vec3& tip, double height) {
    const double z = tip.z() + height;
    return Json{{"t", t}, {"points", {{tip.x(), tip.y() + 20 * tilt, z + 20}, {tip.x(), tip.y(), z}}}};
  };
  return {{"blade", {{{"edges", {key(0, from, 12), key(0.2, from, 0), key(0.6, to, 0), key(0.8, to, 12)}}}}},
          {"start", start}};
}

/// A block of 30 x 16 x 10 mm; its top is to be cut along y = 8.3 from x = 8 to x = 22, 4 mm deep.
Json exercise_scene() {
  Json scene = least_scene();
  scene.erase("frames");
  scene["duration"] = 2.5;
  scene["length_unit"] = 0.001;
  scene["gravity"] = {0, 0, 0};
  scene["model"]["box"] = {{"cells", {15, 8, 5}}, {"size", {30, 16, 10}}};
  scene["attachments"] = {{{"below", {0, 0, 1, 0.1}}}};
  scene["materials"] = {{"default", {{"toughness", 1}}}};
  scene["damping"] = 2;
  scene["exercise"] = {{"target", {{8, 8.3, 10}, {22, 8.3, 10}}},
                       {"depth", 4},
                       {"tolerances", {{"line", 0.7}, {"depth", 0.7}}},
                       {"ideal", straight_cut(0.1, {8, 8.3, 6}, {22, 8.3, 6})}};
  return scene;
}

app::Scene parsed(const Json& scene) {
  Result<app::Scene> result = app::parse_scene(scene.dump(1), "scene.json");
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result.ok() ? std::move(result).value() : app::Scene();
}

app::ExerciseScore run(const app::Scene& scene) {
  const Result<app::SimulateResult> result = app::run_simulate(scene, {});
  EXPECT_TRUE(result.ok()) << result.error().message;
  EXPECT_TRUE(result->report.job.change.ok);
  return result->report.exercise.value();
}

app::ExerciseScore score_of(const std::vector<Json>& strokes) {
  Json scene = exercise_scene();
  scene["strokes"] = strokes;
  return run(parsed(scene));
}

/// What an attempt lost for one kind of fault.
double lost(const app::ExerciseScore& score, const std::string& kind) {
  double points = 0;
  for (const app::ExerciseDeduction& d : score.deductions) points += d.kind == kind ? d.points : 0;
  return points;
}

/// What was lost is what the criteria say, and no more than the most that each of them says.
void expect_agrees_with_itself(const app::ExerciseScore& score) {
  double points = 100;
  std::size_t deduction = 0;
  for (const app::ExerciseCriterion& c : score.criteria) {
    EXPECT_GE(c.lost, 0) << c.kind;
    EXPECT_LE(c.lost, c.most) << c.kind;
    points -= c.lost;
    if (c.lost == 0) continue;
    ASSERT_LT(deduction, score.deductions.size());
    EXPECT_EQ(score.deductions[deduction].kind, c.kind);
    EXPECT_EQ(score.deductions[deduction++].points, c.lost);
  }
  EXPECT_EQ(deduction, score.deductions.size());
  EXPECT_NEAR(score.points, std::max(points, 0.0), 1e-9);
  EXPECT_EQ(score.is_passed, score.points >= score.pass);
  const Json written = Json::parse(to_json(score));
  EXPECT_EQ(written["criteria"].size(), score.criteria.size());
  EXPECT_EQ(written["is_passed"], score.is_passed);
}

TEST(ExerciseScore, agrees_with_itself_whatever_was_done) {
  for (const Vec3& to : {Vec3(22, 8.3, 6), Vec3(22, 10.5, 4), Vec3(15, 8.3, 8), Vec3(25, 8.3, -1)}) {
    expect_agrees_with_itself(score_of({straight_cut(0.1, {8, 8.3, to.z()}, to, 0.3)}));
  }
  expect_agrees_with_itself(score_of({}));
}

TEST(ExerciseScore, of_the_ideal_is_nearly_all_points) {
  const app::ExerciseScore score = run(with_ideal(parsed(exercise_scene())));
  EXPECT_GE(score.points, 95) << to_text(score);
  EXPECT_NEAR(score.target_length, 14, 1e-12);
  EXPECT_GE(score.coverage_pct, 97);
  EXPECT_LT(score.line_max, 0.1);
  EXPECT_LT(score.overshoot, 0.1);
  EXPECT_NEAR(score.depth_mean, 4, 0.1);
  EXPECT_LT(score.angle_error_max, 1e-9);
  EXPECT_NEAR(score.cut_area, 14 * 4, 3);
  EXPECT_EQ(score.strokes, 1U);
  EXPECT_EQ(score.away_length, 0);
  EXPECT_FALSE(score.is_through);
  EXPECT_NEAR(score.seconds, 0.8, 0.04);
}

TEST(ExerciseScore, of_nothing_is_nothing) {
  const app::ExerciseScore score = score_of({});
  EXPECT_EQ(score.points, 0);
  ASSERT_EQ(score.deductions.size(), 1U);
  EXPECT_EQ(score.deductions[0].reason, "nothing was cut");
  EXPECT_EQ(score.missed_length, score.target_length);
  EXPECT_TRUE(std::isnan(score.line_rms) && std::isnan(score.depth_mean) && std::isnan(score.angle_error_mean));
  EXPECT_EQ(Json::parse(to_json(score))["line"]["rms"], nullptr);
}

TEST(ExerciseScore, of_a_stroke_in_the_air_is_nothing) {
  const app::ExerciseScore score = score_of({straight_cut(0.1, {8, 8.3, 11}, {22, 8.3, 11})});
  EXPECT_EQ(score.points, 0);
  EXPECT_EQ(score.strokes, 0U);
}

TEST(ExerciseScore, of_a_cut_elsewhere_is_nothing) {
  const app::ExerciseScore score = score_of({straight_cut(0.1, {8, 13.1, 6}, {22, 13.1, 6})});
  EXPECT_EQ(score.points, 0);
  EXPECT_EQ(score.coverage_pct, 0);
  EXPECT_NEAR(score.away_length, 14, 0.5);
  EXPECT_EQ(score.deductions.at(0).reason, "nothing was cut along the line");
}

TEST(ExerciseScore, of_half_the_line_is_about_half_the_points) {
  const app::ExerciseScore score = score_of({straight_cut(0.1, {8, 8.3, 6}, {15, 8.3, 6})});
  EXPECT_NEAR(score.coverage_pct, 50, 5);
  EXPECT_NEAR(score.missed_length, 7, 0.7);
  EXPECT_LT(score.points, 75);
  EXPECT_GT(score.points, 50);
}

TEST(ExerciseScore, tells_a_cut_beside_the_line) {
  const app::ExerciseScore score = score_of({straight_cut(0.1, {8, 9.7, 6}, {22, 9.7, 6})});
  EXPECT_NEAR(score.line_mean, 1.4, 0.1);
  EXPECT_NEAR(lost(score, "line"), 10, 1.5);  // half way from one tolerance to three
}

TEST(ExerciseScore, tells_a_cut_beyond_the_ends) {
  const app::ExerciseScore score = score_of({straight_cut(0.1, {6, 8.3, 6}, {25, 8.3, 6})});
  EXPECT_NEAR(score.overshoot, 3, 0.5);
  EXPECT_EQ(score.coverage_pct, 100);
  EXPECT_GT(lost(score, "overshoot"), 10);
}

TEST(ExerciseScore, tells_a_cut_of_the_wrong_depth) {
  const app::ExerciseScore shallow = score_of({straight_cut(0.1, {8, 8.3, 8}, {22, 8.3, 8})});
  EXPECT_NEAR(shallow.depth_mean, 2, 0.1);
  EXPECT_GT(lost(shallow, "depth"), 5);
  EXPECT_EQ(lost(shallow, "too_deep"), 0);
  const app::ExerciseScore deep = score_of({straight_cut(0.1, {8, 8.3, 4}, {22, 8.3, 4})});
  EXPECT_NEAR(deep.too_deep, 2, 0.2);
  EXPECT_LT(deep.points, shallow.points);
  EXPECT_FALSE(deep.is_through);
}

TEST(ExerciseScore, tells_a_cut_through_and_through) {
  const app::ExerciseScore score = score_of({straight_cut(0.1, {8, 8.3, -1}, {22, 8.3, -1})});
  EXPECT_TRUE(score.is_through);
  EXPECT_EQ(lost(score, "through"), 30);
  EXPECT_LE(score.points, 35);
}

TEST(ExerciseScore, tells_a_blade_that_is_not_upright) {
  const app::ExerciseScore score = score_of({straight_cut(0.1, {8, 8.3, 6}, {22, 8.3, 6}, 0.5)});
  EXPECT_NEAR(score.angle_error_mean, 26.565, 0.1);
  EXPECT_GT(lost(score, "angle"), 10);
}

TEST(ExerciseScore, counts_strokes_beyond_those_allowed) {
  const std::vector<Json> strokes = {straight_cut(0.1, {8, 8.3, 6}, {15, 8.3, 6}),
                                     straight_cut(1.1, {14.5, 8.3, 6}, {22, 8.3, 6})};
  const app::ExerciseScore score = score_of(strokes);
  EXPECT_EQ(score.strokes, 2U);
  EXPECT_EQ(lost(score, "strokes"), 10);
  EXPECT_GE(score.coverage_pct, 95);
}

TEST(ExerciseScore, tells_a_second_wound) {
  const app::ExerciseScore score =
      score_of({straight_cut(0.1, {8, 8.3, 6}, {22, 8.3, 6}), straight_cut(1.1, {8, 13.1, 6}, {15, 13.1, 6})});
  EXPECT_NEAR(score.away_length, 7, 1.1);
  EXPECT_GT(score.away_area, 20);
  EXPECT_GT(lost(score, "elsewhere"), 20);
}

TEST(ExerciseScore, covers_nothing_of_a_target_far_from_the_skin) {
  Json scene = exercise_scene();
  scene["exercise"]["target"] = {{8, 8.3, 14}, {22, 8.3, 14}};
  const app::ExerciseScore score = run(with_ideal(parsed(scene)));
  EXPECT_EQ(score.coverage_pct, 0);
  EXPECT_EQ(score.points, 0);
}

TEST(ExerciseScore, tells_force_above_what_is_allowed) {
  Json json = exercise_scene();
  json["materials"] = {{"default", {{"young", 50000}, {"toughness", 300}}}};
  json["exercise"]["max_force"] = 0.1;
  const app::ExerciseScore score = run(with_ideal(parsed(json)));
  EXPECT_GT(score.peak_force, 0.1);
  EXPECT_GT(score.force_frames, 0U);
  EXPECT_GT(lost(score, "force"), 0);
  json["exercise"]["max_force"] = 100;
  EXPECT_EQ(lost(run(with_ideal(parsed(json))), "force"), 0);
}

TEST(ExerciseScore, notes_strokes_that_were_taken_back_as_corrections) {
  Json json = exercise_scene();
  json["strokes"] = {straight_cut(0, {8, 13.1, 6}, {22, 13.1, 6}), straight_cut(1, {8, 8.3, 6}, {22, 8.3, 6})};
  const app::Scene scene = parsed(json);
  Simulation simulation = make_simulation(scene, std::move(app::load_model(scene)->mesh)).value();
  app::ExerciseScorer scorer(scene, simulation.mesh());
  for (std::uint64_t i = 0; i < scene.frames; ++i) {
    const FrameInput input = scene_input(scene, i);
    scorer.add(input, simulation.frame(input).value(), simulation);
    if (i == 54) {
      EXPECT_TRUE(simulation.undo());
    }
  }
  const app::ExerciseScore score = scorer.score(simulation);
  EXPECT_EQ(score.corrections, 1U);
  EXPECT_EQ(score.strokes, 1U);
  EXPECT_GE(score.points, 95) << to_text(score);
  EXPECT_NE(to_text(score).find("1 taken back"), std::string::npos);
  EXPECT_TRUE(simulation.undo());
  EXPECT_EQ(scorer.score(simulation).corrections, 2U);
  EXPECT_EQ(scorer.score(simulation).points, 0);
  EXPECT_TRUE(simulation.redo());
  EXPECT_EQ(to_json(scorer.score(simulation)), to_json(score));
}

TEST(ExerciseScore, is_the_same_for_the_same_frames) {
  const app::Scene scene = with_ideal(parsed(exercise_scene()));
  EXPECT_EQ(to_json(run(scene)), to_json(run(scene)));
}

TEST(ExerciseScore, is_not_there_without_an_exercise) {
  EXPECT_FALSE(app::run_simulate(parsed(least_scene()), {})->report.exercise.has_value());
}

// --- the ideal

TEST(Ideal, begins_with_the_attempt) {
  const app::Scene scene = parsed(exercise_scene());
  const app::Scene shown = with_ideal(scene);
  std::uint64_t first = 0;
  while (!scene_input(shown, first).blade) ++first;
  std::size_t seen = 0;
  for (std::uint64_t k = 0; k < 100; ++k) {
    const std::vector<BladePose> ideal = ideal_poses(scene, k);
    const std::optional<BladePose> blade = scene_input(shown, first + k).blade;
    ASSERT_EQ(ideal.size(), blade ? 1U : 0U) << k;
    if (!blade) continue;
    EXPECT_EQ(ideal[0].edge, blade->edge);
    ++seen;
  }
  EXPECT_GE(seen, 48U);  // 0.8 s, from its first place to its last
  EXPECT_LE(seen, 50U);
  EXPECT_TRUE(ideal_poses(scene, ~std::uint64_t{0}).empty());
  EXPECT_TRUE(ideal_poses(parsed(least_scene()), 0).empty());
}

TEST(Ideal, replaces_the_strokes_and_has_time_to_end) {
  Json json = exercise_scene();
  json["strokes"] = {straight_cut(0, {8, 13.1, 6}, {22, 13.1, 6})};
  json["duration"] = 0.5;
  const app::Scene scene = parsed(json);
  const app::Scene shown = with_ideal(scene);
  ASSERT_EQ(shown.strokes.size(), 1U);
  EXPECT_EQ(shown.strokes[0].stroke.edges, scene.exercise->ideal[0].stroke.edges);
  EXPECT_GE(shown.frames, 84U);
  EXPECT_LE(shown.frames, 86U);
  EXPECT_EQ(with_ideal(parsed(least_scene())).frames, 10U);
}

// --- the exercises that come with the program

class ShippedExercise : public testing::TestWithParam<const char*> {};

TEST_P(ShippedExercise, gives_its_ideal_nearly_all_points) {
  const Result<app::Scene> scene = app::read_scene(std::string(INCISE_SCENES "/") + GetParam() + ".json");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  if (!scene->model.file.empty() && !app::find_model(*scene).ok()) {
    GTEST_SKIP() << scene->model.file << " is not there; script/models all makes it";
  }
  app::Scene shown = with_ideal(*scene);
  shown.frames = static_cast<std::uint64_t>(shown.strokes.back().stroke.times.back() * 60) + 30;
  const app::ExerciseScore score = run(shown);
  EXPECT_GE(score.points, 95) << to_text(score);
  EXPECT_TRUE(score.is_passed);
  EXPECT_EQ(score.force_frames, 0U);
  EXPECT_FALSE(score.is_through);
  expect_agrees_with_itself(score);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedExercise,
                         testing::Values("train_skin", "train_vein", "train_fat", "train_core", "train_excision"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace

}  // namespace exercise_test
