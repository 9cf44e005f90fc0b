// SPDX-License-Identifier: Apache-2.0
// What a scene file says, what is refused, and what the hands do in each frame.
#include "incise/app/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "app/folder.h"
#include "app/scene_cases.h"
#include "incise/app/scene_simulation.h"
#include "incise/app/text_file.h"

namespace {

using namespace incise;
using namespace incise_test;

app::Scene parsed(const Json& scene) {
  Result<app::Scene> result = app::parse_scene(scene.dump(), "scene.json");
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result.ok() ? std::move(result).value() : app::Scene();
}

std::string error_of(const Json& scene) {
  const Result<app::Scene> result = app::parse_scene(scene.dump(1), "scene.json");
  return result.ok() ? "" : result.error().message;
}

/// Expects that a full scene with a value put at a place is refused with some words.
void expect_refused(const std::string& pointer, const Json& value, const std::string& words) {
  Json scene = full_scene();
  scene[Json::json_pointer(pointer)] = value;
  const std::string error = error_of(scene);
  EXPECT_NE(error.find(words), std::string::npos) << pointer << ": " << error;
  EXPECT_EQ(error.rfind("scene.json:", 0), 0U) << error;
}

TEST(Scene, reads_the_least_with_defaults) {
  const app::Scene scene = parsed(least_scene());
  EXPECT_EQ(scene.options.body.length_unit, 0.1);
  EXPECT_EQ(scene.frames, 10U);
  EXPECT_EQ(scene.options.frame_seconds, 1.0 / 60);
  EXPECT_EQ(scene.options.engine.maintain.work_units, kUnlimitedWork);
  EXPECT_TRUE(scene.strokes.empty() && scene.hooks.empty() && scene.tools.empty() && scene.attachments.empty());
}

TEST(Scene, reads_every_key) {
  const app::Scene scene = parsed(full_scene());
  EXPECT_EQ(scene.seed, 12345678901234567890U);
  EXPECT_EQ(scene.frames, 50U);
  EXPECT_EQ(scene.options.body.relaxation, Relaxation::kPositionBased);
  EXPECT_EQ(scene.options.body.substeps, 3U);
  EXPECT_EQ(scene.options.materials.of(3).young, 2e4);
  EXPECT_EQ(scene.options.materials.of(0).toughness, 5);
  EXPECT_EQ(scene.options.contact_stiffness, 100);
  EXPECT_EQ(scene.options.flat_height, 0.1);
  EXPECT_EQ(scene.attachments.size(), 3U);
  EXPECT_TRUE(std::isinf(scene.attachments[0].stiffness));
  EXPECT_EQ(scene.attachments[1].stiffness, 500);
  const auto& table = std::get<PlaneTool>(scene.tools[0].keys.front());
  EXPECT_EQ(table.normal, Vec3(0, 0, 1));
  EXPECT_EQ(table.offset, -0.5);
  EXPECT_EQ(scene.strokes[0].stroke.times, (std::vector<double>{0.1, 0.1 + 0.5 * 0.4}));
  EXPECT_EQ(scene.strokes[1].direction, Vec3(1, 0, 0));
  EXPECT_TRUE(scene.strokes[1].stroke.edges[1][0].isApprox(Vec3(1.2, 0.6, -0.2), 1e-12));
}

TEST(Scene, written_and_read_again_is_the_same_bit_for_bit) {
  for (const Json& json : {least_scene(), full_scene()}) {
    const app::Scene scene = parsed(json);
    const std::string text = app::to_json(scene);
    const Result<app::Scene> again = app::parse_scene(text, "again.json");
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(app::to_json(*again), text);
    for (std::uint64_t frame = 0; frame < scene.frames; ++frame) {
      const FrameInput a = scene_input(scene, frame);
      const FrameInput b = scene_input(*again, frame);
      ASSERT_EQ(a.blade.has_value(), b.blade.has_value());
      if (a.blade) {
        EXPECT_EQ(a.blade->edge, b.blade->edge);
      }
      EXPECT_EQ(a.tools.size(), b.tools.size());
    }
  }
}

TEST(Scene, refuses_numbers_out_of_range_and_says_where) {
  expect_refused("/length_unit", 0, "length_unit is 0; it must be above 0");
  expect_refused("/damping", -1, "damping is -1; it must be at least 0");
  expect_refused("/frame_seconds", 2, "frame_seconds is 2; it must be above 0 and at most 1");
  expect_refused("/materials/default/poisson", 0.5, "materials.default.poisson is 0.5");
  expect_refused("/materials/regions/0/young", 0, "materials.regions[0].young is 0");
  expect_refused("/model/box/cells/1", 0, "model.box.cells[1] must be a whole number above 0");
  expect_refused("/model/box/cells", {4000, 4000, 4000}, "more than 2^28 tets");
  expect_refused("/model/box/size", {1, 0, 1}, "model.box.size must be above 0");
  expect_refused("/model/box/jitter", 0.2, "model.box.jitter is 0.2");
  expect_refused("/model/regions/0/below", {0, 0, 0, 1}, "needs a normal that is not zero");
  expect_refused("/attachments/1/stiffness", 0, "attachments[1].stiffness is 0");
  expect_refused("/attachments/1/box/low/0", 3, "low corner that is not below");
  expect_refused("/tools/1/ball/radius", 0, "tools[1].ball.radius is 0");
  expect_refused("/hooks/0/path/1/t", 0.05, "hooks[0].path[1].t must be later");
  expect_refused("/solver/substeps", 0, "solver.substeps is 0; it must be from 1 to 1000");
  expect_refused("/solver/relaxation", "magic", "solver.relaxation must be \"block-descent\"");
  expect_refused("/solver", Json{{"relaxation", "magic"}}, "solver.relaxation must be");
  expect_refused("/cut/snap", 0.5, "cut.snap is 0.5");
  expect_refused("/cut/profile", "best", "cut.profile must be");
  expect_refused("/settle", Json::object(), "lacks the key \"frames\"");
  expect_refused("/seed", -1, "seed must be a whole number");
}

TEST(Scene, refuses_what_contradicts_itself) {
  expect_refused("/frames", 5, "has both \"frames\" and \"duration\"");
  expect_refused("/model/file", "cube.mesh", "needs either the key \"file\" or the key \"box\"");
  expect_refused("/attachments/0/ball", {{"centre", {0, 0, 0}}, {"radius", 1}},
                 "needs one of the keys box, ball, below");
  expect_refused("/tools/1/plane", {0, 0, 1, 0}, "needs one of the keys plane, ball, rod");
  expect_refused("/tools/2/ball/centre", {0, 0, 0}, "needs one of the keys centre, path");
  expect_refused("/tools/4/rod/to", {0, 0, 0}, "put it into the path");
  expect_refused("/materials/regions/1", {{"region", 3}}, "materials.regions[1].region is named before");
}

TEST(Scene, refuses_strokes_that_do_not_fit_in_time) {
  expect_refused("/strokes/0/start", 0.4, "strokes[1] begins at 0.5 s, but the stroke before it ends at 0.6 s");
  expect_refused("/strokes/0/stretch", 0.01, "strokes[0] lasts less than a frame");
  Json early = full_scene();
  early["strokes"][0]["blade"][0]["edges"][0]["t"] = -0.5;
  EXPECT_NE(error_of(early).find("strokes[0] begins before 0 s"), std::string::npos) << error_of(early);
  Json still = full_scene();
  still["strokes"][0]["blade"][0]["edges"].erase(1);
  EXPECT_NE(error_of(still).find("give it two times"), std::string::npos) << error_of(still);
}

TEST(Scene, puts_the_strokes_of_a_blade_one_after_the_other) {
  const Folder folder;
  const Json blade = {{"format", "incise-blade"},
                      {"version", 1},
                      {"strokes", {blade_stroke(0, 0.4), blade_stroke(0, 0.4), blade_stroke(2, 2.5)}}};
  folder.write("b.json", blade.dump());
  Json scene = least_scene();
  scene["strokes"] = {{{"blade", "b.json"}, {"start", 0.25}, {"stretch", 2}, {"pause", 0.5}}};
  const Result<app::Scene> read = app::read_scene(folder.write("s.json", scene.dump()));
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->strokes.size(), 3U);
  EXPECT_DOUBLE_EQ(read->strokes[0].stroke.times.front(), 0.25);
  EXPECT_DOUBLE_EQ(read->strokes[0].stroke.times.back(), 1.05);
  EXPECT_DOUBLE_EQ(read->strokes[1].stroke.times.front(), 1.55);
  EXPECT_DOUBLE_EQ(read->strokes[1].stroke.times.back(), 2.35);
  EXPECT_DOUBLE_EQ(read->strokes[2].stroke.times.front(), 4.25);
}

TEST(Scene, names_what_is_wrong_with_a_blade_file) {
  const Folder folder;
  Json scene = least_scene();
  scene["strokes"] = {{{"blade", "none.json"}}};
  const std::string path = folder.write("s.json", scene.dump());
  EXPECT_NE(app::read_scene(path).error().message.find("none.json: no such file"), std::string::npos);
  folder.write("none.json", "{\"format\":\"incise-blade\",\n\"version\":7,\"strokes\":[]}");
  EXPECT_NE(app::read_scene(path).error().message.find("none.json:2: version is 7"), std::string::npos);
}

TEST(Scene, goes_on_half_a_second_after_the_last_key_time_unless_told_otherwise) {
  Json scene = full_scene();
  scene.erase("duration");
  EXPECT_EQ(parsed(scene).frames, 60U);  // the last stroke ends at 0.7 s
}

// --- what the hands do

TEST(SceneInput, moves_the_blade_from_its_first_to_its_last_key) {
  Json json = least_scene();
  json["frame_seconds"] = 0.1;
  json["strokes"] = {{{"blade", {blade_stroke(0.25, 0.65)}}, {"direction", {0, 1, 0}}}};
  const app::Scene scene = parsed(json);
  EXPECT_FALSE(scene_input(scene, 1).blade.has_value());  // ends at 0.2
  const auto y = [&](std::uint64_t frame) { return scene_input(scene, frame).blade->edge[1].y(); };
  EXPECT_EQ(y(2), -0.2);  // the stroke begins within it
  EXPECT_NEAR(y(3), -0.2 + 1.4 * (0.15 / 0.4), 1e-12);
  EXPECT_NEAR(y(5), -0.2 + 1.4 * (0.35 / 0.4), 1e-12);
  EXPECT_EQ(y(6), 1.2);
  EXPECT_FALSE(scene_input(scene, 7).blade.has_value());
  EXPECT_EQ(scene_input(scene, 3).blade->direction, Vec3(0, 1, 0));
}

TEST(SceneInput, of_a_stroke_that_begins_at_once_has_its_first_key_in_one_frame_alone) {
  Json json = least_scene();
  json["frame_seconds"] = 0.1;
  json["strokes"] = {{{"blade", {blade_stroke(0, 0.4)}}}};
  const app::Scene scene = parsed(json);
  EXPECT_EQ(scene_input(scene, 0).blade->edge[0].y(), -0.2);
  EXPECT_GT(scene_input(scene, 1).blade->edge[0].y(), -0.2);
  EXPECT_EQ(scene_input(scene, 3).blade->edge[0].y(), 1.2);
  EXPECT_FALSE(scene_input(scene, 4).blade.has_value());
}

TEST(SceneInput, lifts_the_blade_between_strokes) {
  const app::Scene scene = parsed(full_scene());
  int strokes = 0;
  bool was_there = false;
  for (std::uint64_t frame = 0; frame < scene.frames; ++frame) {
    const std::array<std::string, 4> ways = {"`" + key, "." + key + "`", "." + key + "[]", "\"" + key + "\""};
    const bool is_there = std::any_of(ways.begin(), ways.end(),
                                      [&](const std::string& way) { return text.find(way) != std::string::npos; });
    EXPECT_TRUE(is_there) << key;
  }
}

TEST(SceneSchema, the_example_of_the_page_about_scenes_is_a_scene) {
  const std::string text = page();
  const std::size_t begin = text.find("```json\n") + 8;
  const auto scene = app::parse_scene(text.substr(begin, text.find("```", begin) - begin), "scenes.md");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  EXPECT_TRUE(app::load_model(*scene).ok());
  EXPECT_EQ(scene->frames, 180U);
}

/// Compares every default that an object of the schema names with what the reader puts there.
int compare_defaults(const Json& object, const Json& found, const std::string& path) {
  int compared = 0;
  for (const auto& item : object.at("properties").items()) {
    if (!found.contains(item.key())) continue;
    const Json& value = found.at(item.key());
    if (item.value().contains("default")) {
      EXPECT_EQ(item.value().at("default"), value) << path << "/" << item.key();
      ++compared;
    } else if (item.value().contains("properties")) {
      compared += compare_defaults(item.value(), value, path + "/" + item.key());
    }
  }
  return compared;
}

TEST(SceneSchema, has_the_same_defaults_as_the_reader) {
  const Json found = Json::parse(app::to_json(parsed(least_scene())));
  EXPECT_GE(compare_defaults(schema(), found, ""), 20);
}

}  // namespace
