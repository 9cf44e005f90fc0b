// SPDX-License-Identifier: Apache-2.0
// Materials and stops of strokes by the names of regions, and what layers feel like.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/recording/recorded_simulation.h"
#include "app/scene/scene.h"
#include "app/scene/scene_simulation.h"
#include "incise/sim/tissue.h"

namespace incise::region_names_test {
namespace {

/// A box of two named regions, with materials and more keys put in.
std::string scene_with(const std::string& materials, const std::string& more = "") {
  return R"({"format": "incise-scene", "version": 1, "length_unit": 0.001,
    "model": {"box": {"cells": [4, 4, 4], "size": [8, 8, 8]},
              "regions": [{"region": 1, "name": "left kidney", "below": [0, 0, 1, 9]},
                          {"region": 2, "name": "Fat", "below": [0, 0, -1, -4]}]},
    "materials": )" +
         materials + more + "}";
}

app::Scene parse(const std::string& json) {
  Result<app::Scene> scene = app::parse_scene(json, "s.json");
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
  return scene.ok() ? *scene : app::Scene();
}

TEST(RegionNames, materials_go_to_regions_of_a_name) {
  app::Scene scene = parse(scene_with(R"({"default": {"material": "muscle"},
    "regions": [{"region": "fat", "material": "fat", "young": 5000}, {"region": 1, "material": "Kidney"}]})"));
  EXPECT_EQ(scene.options.materials.fallback.young, find_tissue("muscle")->material.young);
  const app::Scene again = parse(app::to_json(scene));
  EXPECT_EQ(app::to_json(again), app::to_json(scene));
  EXPECT_FALSE(app::make_simulation(scene, app::load_model(scene)->mesh).ok());
  const auto loaded = app::take_model(scene);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded->region_names.at(2), "Fat");
  const Materials& materials = scene.options.materials;
  EXPECT_EQ(materials.of(2).young, 5000);
  EXPECT_EQ(materials.of(2).toughness, find_tissue("fat")->material.toughness);
  EXPECT_EQ(materials.of(1).young, find_tissue("kidney")->material.young);
  EXPECT_TRUE(app::make_simulation(scene, loaded->mesh).ok());
  EXPECT_EQ(app::to_json(parse(app::to_json(scene))), app::to_json(scene));
}

TEST(RegionNames, speak_of_tissues_where_the_scene_says_so) {
  app::Scene scene = parse(scene_with(R"({"regions": [{"region": 2, "young": 7000}], "by_name": true})"));
  ASSERT_TRUE(app::take_model(scene).ok());
  EXPECT_EQ(scene.options.materials.of(1).young, find_tissue("kidney")->material.young);
  EXPECT_EQ(scene.options.materials.of(2).young, 7000) << "what is named by hand stands";
}

TEST(RegionNames, that_are_not_there_are_told_with_those_that_are) {
  app::Scene scene = parse(scene_with(R"({"regions": [{"region": "liver", "young": 7000}]})"));
  const auto loaded = app::take_model(scene);
  ASSERT_FALSE(loaded.ok());
  EXPECT_NE(loaded.error().message.find("\"liver\"; there are left kidney, Fat"), std::string::npos)
      << loaded.error().message;
  const auto tissue = app::parse_scene(scene_with(R"({"default": {"material": "cheese"}})"), "s.json");
  ASSERT_FALSE(tissue.ok());
  EXPECT_NE(tissue.error().message.find("materials.default.material is no tissue"), std::string::npos)
      << tissue.error().message;
}

TEST(RegionNames, numbers_of_regions_to_stop_at_must_be_there) {
  app::Scene scene = parse(scene_with(R"({"default": {"young": 20000}})", R"(, "spare": [{"stop_at": [1, 77]}])"));
  const auto loaded = app::take_model(scene);
  ASSERT_FALSE(loaded.ok());
  EXPECT_NE(loaded.error().message.find("stop_at: no tet of the model is in region 77; there are regions"),
            std::string::npos)
      << loaded.error().message;
}

constexpr const char* kPress = R"(, "gravity": [0, 0, 0], "attachments": [{"below": [0, 0, 1, 0.1]}], "strokes": [{
    "blade": [{"name": "press", "edges": [{"t": 0, "points": [[4.1, -1, 9], [4.1, 9, 9]]},
                                          {"t": 1, "points": [[4.1, -1, 1], [4.1, 9, 1]]}]}], "stop_at": ["LEFT kidney"]}])";

TEST(RegionNames, a_stroke_of_a_scene_stops_at_a_region) {
  app::Scene scene = parse(scene_with(R"({"default": {"young": 20000}})", kPress));
  const auto loaded = app::take_model(scene);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(scene.strokes.front().stop_at, (std::vector<std::int32_t>{1}));
  auto simulation = app::RecordedSimulation::create(scene, loaded->mesh);
  ASSERT_TRUE(simulation.ok());
  for (std::uint64_t i = 0; i < scene.frames; ++i) {
    const auto frame = simulation->frame(app::scene_input(scene, i), app::scene_stops(scene, i));
    ASSERT_TRUE(frame.ok()) << frame.error().message;
  }
  std::vector<std::size_t> walls(3, 0);
  const TetMesh& mesh = simulation->simulation().mesh();
  mesh.for_each_tet([&](TetId tet) {
    for (const Link link : mesh.links(tet)) {
      walls[static_cast<std::size_t>(mesh.region(tet))] += link.is_boundary() && link.tag() > 0 ? 1U : 0U;
    }
  });
  EXPECT_EQ(walls[1], 0U);
  EXPECT_GT(walls[2], 20U);
}

/// The median force of the blade between two heights of its edge, N.
double force_between(const std::vector<std::pair<double, double>>& forces, double low, double high) {
  std::vector<double> found;
  for (const auto& [height, force] : forces) {
    if (height > low && height < high) found.push_back(force);
  }
  EXPECT_GT(found.size(), 5U);
  std::nth_element(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2), found.end());
  return found.empty() ? 0 : found[found.size() / 2];
}

TEST(Layers, are_felt_by_the_blade_one_after_the_other) {
  Result<app::Scene> read = app::read_scene(INCISE_SCENES "/sim_layers.json");
  ASSERT_TRUE(read.ok()) << read.error().message;
  app::Scene scene = *read;
  const auto loaded = app::take_model(scene);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  auto simulation = app::RecordedSimulation::create(scene, loaded->mesh);
  ASSERT_TRUE(simulation.ok());
  std::vector<std::pair<double, double>> forces;
  for (std::uint64_t i = 0; i < scene.frames; ++i) {
    const FrameInput input = app::scene_input(scene, i);
    const auto frame = simulation->frame(input);
    ASSERT_TRUE(frame.ok());
    if (input.blade) forces.emplace_back(input.blade->edge.front().z(), frame->blade.force.norm());
  }
  // The block is 18 mm wide: toughness times width. The skin dents by some millimetres before it gives way, and the
  // fat below it then springs back.
  const double width = 0.018;
  EXPECT_NEAR(force_between(forces, 19.5, 21), 120 * width, 0.1 * 120 * width);
  EXPECT_NEAR(force_between(forces, 10, 17), 20 * width, 0.1 * 20 * width);
  EXPECT_NEAR(force_between(forces, 3.5, 7.5), 60 * width, 0.1 * 60 * width);
  EXPECT_LT(force_between(forces, 23.2, 24), 0.4 * 120 * width) << "the dent grows before anything is cut";
}

}  // namespace
}  // namespace incise::region_names_test
