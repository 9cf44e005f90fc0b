// SPDX-License-Identifier: Apache-2.0
// What a scene file says, what is refused, and what the hands do in each frame.
#include "app/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

#include "app/scene/scene_simulation.h"
#include "app/text/text_file.h"
#include "app/view/scene_camera.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "support/folder.h"
#include "support/scene_cases.h"

namespace scene_test {
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
  EXPECT_EQ(scene.options.engine.maintain.work_units, kFrameWorkUnits);
  EXPECT_TRUE(scene.strokes.empty() && scene.hooks.empty() && scene.tools.empty() && scene.attachments.empty());
}

TEST(Scene, reads_every_key) {
  const app::Scene scene = parsed(full_scene());
  EXPECT_EQ(scene.seed, 12345678901234567890U);
  EXPECT_EQ(scene.frames, 50U);
  EXPECT_EQ(scene.options.body.relaxation, Relaxation::kPositionBased);
  EXPECT_EQ(scene.options.body.substeps, 3U);
  EXPECT_TRUE(scene.options.body.average_volumes);
  EXPECT_EQ(scene.options.materials.of(3).young, 2e4);
  EXPECT_EQ(scene.options.materials.of(0).toughness, 5);
  EXPECT_EQ(scene.options.contact_stiffness, 100);
  EXPECT_EQ(scene.options.flat_height, 0.1);
  EXPECT_TRUE(scene.options.body.self.on);
  EXPECT_EQ(scene.options.body.self.friction, 0.2);
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

TEST(Scene, reads_how_it_is_first_seen) {
  const app::Scene scene = parsed(full_scene());
  ASSERT_TRUE(scene.view.has_value());
  EXPECT_EQ(scene.view->from, Vec3(1, -2, 3));
  EXPECT_EQ(scene.view->target, Vec3(0.5, 0.4, 0.9));
  EXPECT_EQ(scene.view->distance, 4.5);
  EXPECT_EQ(scene.view->clip->offset, 0.1);
  const app::ViewOptions options = view_options_of(scene);
  EXPECT_EQ(options.color, app::ColorBy::kRegion);
  EXPECT_EQ(options.theme, app::Theme::kLight);
  EXPECT_EQ(options.skin_opacity, 0.25);
  EXPECT_TRUE(options.shows_wireframe);
  EXPECT_FALSE(parsed(least_scene()).view.has_value());
}

TEST(Scene, reads_the_exercise_and_its_ideal) {
  const app::Scene scene = parsed(full_scene());
  ASSERT_TRUE(scene.exercise.has_value());
  const app::Exercise& exercise = *scene.exercise;
  EXPECT_EQ(exercise.instructions, "Cut along the line.");
  EXPECT_EQ(exercise.target.size(), 2U);
  EXPECT_EQ(exercise.tolerances.angle, 15);
  EXPECT_EQ(exercise.strokes, 2U);
  ASSERT_EQ(exercise.ideal.size(), 1U);
  EXPECT_EQ(exercise.ideal[0].stroke.times.back(), 0.5);
  EXPECT_EQ(exercise.ideal[0].direction, Vec3(0, 1, 0));
  Json json = full_scene();
  json["exercise"]["ideal"] = 1;
  json["exercise"].erase("tolerances");
  const app::Exercise other = *parsed(json).exercise;
  EXPECT_EQ(other.ideal[0].stroke.edges, scene.strokes[1].stroke.edges);
  EXPECT_DOUBLE_EQ(other.tolerances.line, 0.05 * 0.8);
  EXPECT_EQ(other.tolerances.depth, 0.125);
}

TEST(Scene, reads_what_is_in_hand) {
  const app::HandPreset hand = parsed(full_scene()).hand.value();
  EXPECT_EQ(hand.tool, app::ToolKind::kPunch);
  EXPECT_EQ(hand.depth, 0.4);
  EXPECT_EQ(hand.angle, -20);
  EXPECT_EQ(hand.ring, 0.15);
  EXPECT_EQ(hand.grip, 0.25);
  Json json = least_scene();
  json["hand"] = Json::object();
  const app::HandPreset empty = parsed(json).hand.value();
  EXPECT_FALSE(empty.tool.has_value());
  EXPECT_FALSE(empty.depth || empty.angle || empty.ring || empty.grip);
}

TEST(Scene, refuses_what_no_hand_can_have) {
  const std::vector<std::pair<Json, std::string>> cases = {
      {{{"tool", "saw"}}, "hand.tool must be one of orbit, scalpel"},
      {{{"tool", ""}}, "hand.tool must be one of"},
      {{{"depth", 0}}, "hand.depth"},
      {{{"angle", 69}}, "hand.angle"},
      {{{"ring", -1}}, "hand.ring"},
      {{{"grip", "wide"}}, "hand.grip"}};
  for (const auto& [hand, told] : cases) {
    Json json = least_scene();
    json["hand"] = hand;
    EXPECT_NE(error_of(json).find(told), std::string::npos) << error_of(json);
  }
}

TEST(Scene, without_view_and_exercise_is_written_without_them) {
  const Json written = Json::parse(app::to_json(parsed(least_scene())));
  EXPECT_FALSE(written.contains("view") || written.contains("exercise") || written.contains("hand"));
  Json json = least_scene();
  json["view"] = Json::object();
  const std::string text = app::to_json(parsed(json));
  EXPECT_EQ(Json::parse(text)["view"].size(), 5U);  // what has a default
  EXPECT_EQ(app::to_json(parsed(Json::parse(text))), text);
}

TEST(SceneView, frames_the_body_from_where_the_scene_says) {
  const Box body{Vec3::Zero(), Vec3(4, 2, 1)};
  const app::Viewport viewport;
  Json json = least_scene();
  const app::Camera plain = camera_of(parsed(json), body, viewport);
  EXPECT_EQ(plain.up, Vec3(0, 0, 1));
  EXPECT_TRUE(plain.target.isApprox(Vec3(2, 1, 0.5), 1e-12));
  json["view"] = {{"from", {3, 0, 4}}, {"zoom", 2}};
  const app::Camera seen = camera_of(parsed(json), body, viewport);
  EXPECT_TRUE(seen.backward().isApprox(Vec3(0.6, 0, 0.8), 1e-12));
  app::Camera all = seen;
  frame_all(all, viewport, body);
  EXPECT_DOUBLE_EQ(2 * seen.distance, all.distance);
  json["view"] = {{"target", {1, 0, 0}}, {"distance", 6}, {"up", {0, 3, 0}}};
  const app::Camera placed = camera_of(parsed(json), Box(), viewport);
  EXPECT_EQ(placed.target, Vec3(1, 0, 0));
  EXPECT_EQ(placed.distance, 6);
  EXPECT_EQ(placed.up, Vec3(0, 1, 0));
}

TEST(SceneView, has_up_against_gravity) {
  Json json = least_scene();
  json["gravity"] = {0, 9.81, 0};
  EXPECT_EQ(camera_of(parsed(json), Box(), {}).up, Vec3(0, -1, 0));
  json["gravity"] = {0, 0, 0};
  EXPECT_EQ(camera_of(parsed(json), Box(), {}).up, Vec3(0, 0, 1));
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
  expect_refused("/length_unit", 1e300, "length_unit is 1e+300; it must be above 0 and at most 1e+30");
  expect_refused("/damping", -1e-9, "damping is -1e-09; it must be at least 0");
  expect_refused("/damping", 1e31, "damping is 1e+31; it must be at least 0 and at most 1e+30");
  expect_refused("/materials/default/young", 1e300,
                 "materials.default.young is 1e+300; it must be above 0 and at most");
  expect_refused("/frame_seconds", 2, "frame_seconds is 2; it must be above 0 and at most 1");
  expect_refused("/materials/default/poisson", 0.5, "materials.default.poisson is 0.5");
  expect_refused("/materials/regions/0/young", 0, "materials.regions[0].young is 0");
  expect_refused("/model/box/cells/1", 0, "model.box.cells[1] must be a whole number above 0");
  expect_refused("/model/box/cells", {4000, 4000, 4000}, "more than 2^28 tets");
  expect_refused("/model/box/size", {1, 0, 1}, "model.box.size must be above 0");
  expect_refused("/model/box/jitter", 0.2, "model.box.jitter is 0.2");
  expect_refused("/model/regions/0/below", {0, 0, 0, 1}, "needs a normal that is not zero");
  expect_refused("/model/regions/0", Json{{"region", 1}}, "model.regions[0] needs one of the keys box, ball, below");
  expect_refused("/attachments/1/stiffness", 0, "attachments[1].stiffness is 0");
  expect_refused("/attachments/1/box/low/0", 3, "low corner that is not below");
  expect_refused("/tools/1/ball/radius", 0, "tools[1].ball.radius is 0");
  expect_refused("/hooks/0/path/1/t", 0.05, "hooks[0].path[1].t must be later");
  expect_refused("/solver/substeps", 0, "solver.substeps is 0; it must be from 1 to 1000");
  expect_refused("/solver/average_volumes", 1, "solver.average_volumes");
  expect_refused("/solver/relaxation", "magic", "solver.relaxation must be \"block-descent\"");
  expect_refused("/solver", Json{{"relaxation", "magic"}}, "solver.relaxation must be");
  expect_refused("/cut/snap", 0.5, "cut.snap is 0.5");
  expect_refused("/cut/profile", "best", "cut.profile must be");
  expect_refused("/settle", Json::object(), "lacks the key \"frames\"");
  expect_refused("/seed", -1, "seed must be a whole number");
}

TEST(Scene, refuses_sutures_that_hold_nothing) {
  expect_refused("/sutures/0/stiffness", 0, "sutures[0].stiffness is 0; it must be above 0");
  expect_refused("/sutures/0/rest_length", -1, "sutures[0].rest_length is -1; it must be at least 0");
  expect_refused("/sutures/0/strength", 0, "sutures[0].strength is 0; it must be above 0");
  expect_refused("/sutures/0/start", -1, "sutures[0].start is -1; it must be at least 0 and at most");
  expect_refused("/sutures/0/pushes", 1, "sutures[0].pushes");
  expect_refused("/sutures/0/from", {0, 0}, "sutures[0].from must be an array of 3");
  expect_refused("/sutures/0/to", {0.2, 0.3, 0.4}, "sutures[0] has both ends in one place; move \"to\"");
  expect_refused("/sutures/0/color", "blue", "has the unknown key \"color\"");
  expect_refused("/sutures/0", Json{{"from", {0, 0, 0}}}, "sutures[0] lacks the key \"to\"");
}

/// Times are at the ends of frames; lengths in the model's unit become metres.
TEST(Scene, puts_sutures_in_when_they_begin) {
  Json json = full_scene();
  const auto first_frame = [&](double start) {
    json["sutures"][0]["start"] = start;
    const app::Scene scene = parsed(json);
    const Simulation simulation = make_simulation(scene, std::move(load_model(scene)->mesh)).value();
    return simulation.sutures().at(0).suture.first_frame;
  };
  EXPECT_EQ(first_frame(0), 0U);
  EXPECT_EQ(first_frame(0.3), 15U);  // the first whose end is later
  EXPECT_EQ(first_frame(0.31), 15U);
  EXPECT_EQ(first_frame(0.0199), 0U);
  const app::Scene scene = parsed(json);
  const Simulation simulation = make_simulation(scene, std::move(load_model(scene)->mesh)).value();
  const SutureState state = simulation.sutures().at(0);
  EXPECT_EQ(state.status, SutureStatus::kHolds);
  EXPECT_EQ(state.suture.stiffness, 30);
  EXPECT_DOUBLE_EQ(state.suture.rest_length, 0.03);
  EXPECT_FALSE(state.suture.pushes);
  EXPECT_EQ(state.suture.strength, 50);
  EXPECT_LT((state.rest[1] - Vec3(0.7, 0.3, 0.4)).norm(), 1e-9);
}

TEST(Scene, refuses_materials_that_cannot_be) {
  expect_refused("/materials/default/fibre", {1, 0}, "materials.default.fibre must be an array of 3");
  expect_refused("/materials/default/fibre", {0, 0, 0}, "materials.default has \"fibre_young\", but no direction");
  expect_refused("/materials/default/fibre_young", -1, "materials.default.fibre_young is -1");
  expect_refused("/materials/default/prony/0/seconds", 0, "materials.default.prony[0].seconds is 0");
  expect_refused("/materials/default/prony/0", Json{{"share", 1}},
                 "materials.default.prony[0] lacks the key \"seconds\"");
  const Json term = {{"share", 1}, {"seconds", 1}};
  expect_refused("/materials/default/prony", {term, term, term, term}, "materials.default.prony");
  expect_refused("/materials/default/rigid", 1, "materials.default.rigid must be true or false");
}

TEST(Scene, refuses_pins_and_hooks_that_bear_nothing) {
  expect_refused("/attachments/1/strength", 0, "attachments[1].strength is 0; it must be above 0");
  expect_refused("/attachments/0/strength", 1, "attachments[0] has a strength, but holds rigidly");
  expect_refused("/hooks/0/strength", -1, "hooks[0].strength is -1; it must be above 0");
  expect_refused("/hooks/0/tears", "no", "hooks[0].tears must be true or false");
}

/// Bodies share no points, even where these are in the same place, and keep their labels.
TEST(Scene, puts_several_bodies_into_one_mesh) {
  Json json = least_scene();
  json["model"]["bodies"] = {{{"box", {{"cells", {1, 1, 1}}}}, {"region", 4}, {"move", {0, 0, 1}}},
                             {{"box", {{"cells", {1, 2, 1}}}}, {"move", {3, 0, 0}}}};
  const app::Scene scene = parsed(json);
  const TetMesh mesh = app::load_model(scene)->mesh;
  EXPECT_EQ(mesh.tet_count(), 48U + 6U + 12U);
  EXPECT_EQ(find_components(mesh).count(), 3U);
  std::size_t labelled = 0;
  mesh.for_each_tet([&](TetId t) { labelled += mesh.region(t) == 4 ? 1U : 0U; });
  EXPECT_EQ(labelled, 6U);
  EXPECT_EQ(rest_bounds(mesh).hi, Vec3(4, 1, 2));
  EXPECT_EQ(app::to_json(parsed(Json::parse(app::to_json(scene)))), app::to_json(scene));
  json["model"]["bodies"][0]["file"] = "a.mesh";
  EXPECT_NE(error_of(json).find("model.bodies[0] needs either the key \"file\" or the key \"box\""), std::string::npos);
}

TEST(Scene, refuses_a_stretch_out_of_range) {
  expect_refused("/stretch", {1, 1, 2.5}, "stretch must lie in [0.5, 2] on every axis");
  expect_refused("/stretch", {0.4, 1, 1}, "stretch must lie in [0.5, 2] on every axis");
  expect_refused("/stretch", 1.2, "stretch must be an array of 3");
}

/// A bar that is drawn out and held at both ends pulls at them with what the law of its tissue says where it is free
/// across: ψ = μ/2 (|F|² − 3) + μ/2 (J − 1)² − μ (J − 1) without Poisson's ratio.
TEST(Scene, holds_a_stretched_body_drawn_out) {
  Json json = least_scene();
  json["model"]["box"] = {{"cells", {6, 2, 2}}, {"size", {3, 1, 1}}};
  json["length_unit"] = 0.01;
  json["materials"]["default"] = {{"young", 1e4}, {"poisson", 0}, {"density", 1000}};
  json["gravity"] = {0, 0, 0};
  json["damping"] = 20;
  json["stretch"] = {1.2, 1, 1};
  json["attachments"] = {{{"below", {-1, 0, 0, -2.999}}}, {{"below", {1, 0, 0, 0.001}}, {"stiffness", 1e4}}};
  const app::Scene scene = parsed(json);
  EXPECT_EQ(parsed(Json::parse(app::to_json(scene))).stretch, Vec3(1.2, 1, 1));
  Simulation simulation = make_simulation(scene, std::move(load_model(scene)->mesh)).value();
  double high = 0;
  simulation.mesh().for_each_vertex([&](VertexId v) { high = std::max(high, simulation.mesh().current(v).x()); });
  EXPECT_DOUBLE_EQ(high, 3.3);  // drawn out about the middle, at once
  ASSERT_TRUE(simulation.settle(600, 1e-6).ok());
  double held = 0;  // by the springs, which were without force at -0.3
  simulation.mesh().for_each_vertex([&](VertexId v) {
    if (simulation.mesh().rest(v).x() < 0.001) held += 1e4 * 0.01 * (simulation.mesh().current(v).x() + 0.3);
  });
  const double mu = 5000, s = 1.2, across2 = (2 * s - 1) / (s * s), volume = s * across2;
  const double pull = mu * (s + (volume - 2) * across2) * 1e-4;
  EXPECT_NEAR(held, pull, 0.03 * pull);
}

TEST(Scene, refuses_a_suture_where_there_is_no_tissue) {
  Json json = full_scene();
  json["sutures"][0]["to"] = {0.7, 0.3, 1.9};
  const app::Scene scene = parsed(json);
  const auto made = make_simulation(scene, std::move(load_model(scene)->mesh));
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().code, ErrorCode::kBadFile);
  const std::string start = "sutures[0]: end 1 of a suture is at (0.7, 0.3, 1.9), where there is no tissue at rest; ";
  EXPECT_EQ(made.error().message.rfind(start + "the nearest is at (", 0), 0U) << made.error().message;
}

TEST(Scene, refuses_views_that_cannot_be_seen) {
  expect_refused("/view/from", {0, 0, 0}, "view.from is zero; give a direction");
  expect_refused("/view/up", {0, 0}, "view.up must be an array of 3");
  expect_refused("/view/distance", 0, "view.distance is 0; it must be above 0");
  expect_refused("/view/zoom", -1, "view.zoom is -1");
  expect_refused("/view/opacity", 0, "view.opacity is 0; it must be above 0 and at most 1");
  expect_refused("/view/color", "blue", "view.color must be one of tissue, region, stroke, quality");
  expect_refused("/view/theme", "blue", "view.theme must be one of dark, light");
  expect_refused("/view/clip", {0, 0, 0, 1}, "view.clip needs a normal that is not zero");
}

TEST(Scene, refuses_exercises_that_cannot_be_done) {
  expect_refused("/exercise/target", Json::array({{0, 0, 0}}), "exercise.target");
  expect_refused("/exercise/target/1", {0.45, 0.1, 1}, "exercise.target[1] must be apart from the point before it");
  expect_refused("/exercise/depth", 0, "exercise.depth is 0; it must be above 0");
  expect_refused("/exercise/angle", 90, "exercise.angle is 90");
  expect_refused("/exercise/tolerances/line", 0, "exercise.tolerances.line is 0");
  expect_refused("/exercise/tolerances/angle", 91, "exercise.tolerances.angle is 91");
  expect_refused("/exercise/tolerances/force", -1, "exercise.tolerances.force is -1");
  expect_refused("/exercise/max_force", -1, "exercise.max_force is -1");
  expect_refused("/exercise/strokes", 0, "exercise.strokes is 0; it must be from 1");
  expect_refused("/exercise/ideal", 2, "exercise.ideal must be the number of one of the scene's strokes");
  expect_refused("/exercise/ideal", "none.json", "exercise.ideal must be the number");
  expect_refused("/exercise/ideal/stretch", 0.001, "exercise.ideal lasts less than a frame");
  expect_refused("/exercise/pass", 101, "exercise.pass is 101");
  expect_refused("/exercise/divide", Json{{"name", "x"}}, "exercise.divide lacks the key \"regions\"");
  expect_refused("/exercise/spare/0/depth", -1, "exercise.spare[0].depth is -1");
  expect_refused("/exercise/spare/0/regions", Json::array(), "exercise.spare[0].regions");
  expect_refused("/exercise/remove/regions", {-1}, "exercise.remove.regions[0] must be a region's number or its name");
  expect_refused("/exercise/remove/share", 0, "exercise.remove.share is 0");
  expect_refused("/exercise/remove/margin", {2, 1}, "exercise.remove.margin must be the least and the greatest");
  expect_refused("/exercise", Json{{"depth", 1}}, "lacks the key \"target\"");
  expect_refused("/exercise", Json{{"target", {{0, 0, 0}, {1, 0, 0}}}}, "lacks the key \"depth\"");
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
  json["strokes"] = {{{"blade", {blade_stroke(0.25, 0.65)}}, {"direction", {0, 1, 0}}, {"slicing", 2.5}}};
  const app::Scene scene = parsed(json);
  EXPECT_FALSE(scene_input(scene, 1).blade.has_value());  // ends at 0.2
  const auto y = [&](std::uint64_t frame) { return scene_input(scene, frame).blade->edge[1].y(); };
  EXPECT_EQ(y(2), -0.2);  // the stroke begins within it
  EXPECT_NEAR(y(3), -0.2 + 1.4 * (0.15 / 0.4), 1e-12);
  EXPECT_NEAR(y(5), -0.2 + 1.4 * (0.35 / 0.4), 1e-12);
  EXPECT_EQ(y(6), 1.2);
  EXPECT_FALSE(scene_input(scene, 7).blade.has_value());
  EXPECT_EQ(scene_input(scene, 3).blade->direction, Vec3(0, 1, 0));
  EXPECT_EQ(scene_input(scene, 3).blade->slicing, 2.5);
  EXPECT_EQ(scene_input(app::parse_scene(app::to_json(scene), "again.json").value(), 3).blade->slicing, 2.5);
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
    const bool is_there = scene_input(scene, frame).blade.has_value();
    strokes += is_there && !was_there ? 1 : 0;
    was_there = is_there;
  }
  EXPECT_EQ(strokes, 2);
}

TEST(SceneInput, has_tools_and_hooks_while_they_are_there) {
  const app::Scene scene = parsed(full_scene());  // 0.02 s a frame
  const FrameInput before = scene_input(scene, 1);
  const std::size_t kinds = moving_tools().size() / 2;
  EXPECT_EQ(before.tools.size(), 1 + kinds);  // a plane, and one of each kind that stays
  EXPECT_TRUE(before.hooks.empty());
  const FrameInput now = scene_input(scene, 6);  // ends at 0.14
  ASSERT_EQ(now.tools.size(), 1 + 2 * kinds);
  EXPECT_TRUE(std::get<BallTool>(now.tools[2]).centre.isApprox(Vec3(0, 0, 1.8), 1e-12));
  EXPECT_TRUE(std::get<RodTool>(now.tools[4]).to.isApprox(Vec3(1, 0, 1.8), 1e-12));
  ASSERT_EQ(now.hooks.size(), 1U);
  EXPECT_TRUE(now.hooks[0].position.isApprox(Vec3(1, 1.09, 1.135), 1e-12));
  EXPECT_TRUE(scene_input(scene, 13).hooks.empty());
}

// --- the model

TEST(SceneModel, is_painted_and_held_by_place) {
  const app::Scene scene = parsed(full_scene());
  const Result<io::LoadedMesh> loaded = app::load_model(scene);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const TetMesh& mesh = loaded->mesh;
  EXPECT_EQ(mesh.tet_count(), 72U);
  int painted = 0;
  mesh.for_each_tet([&](TetId t) { painted += mesh.region(t) == 3 ? 1 : 0; });
  EXPECT_GT(painted, 0);
  EXPECT_LT(painted, 72);
  EXPECT_EQ(find_attached(mesh, scene.attachments[0]).size(), 9U);  // the side x = 0
  EXPECT_EQ(find_attached(mesh, scene.attachments[2]).size(), 1U);
  const app::Attachment all{app::HalfSpace{Vec3(0, 0, 1), 9}, false};
  const app::Attachment skin{app::HalfSpace{Vec3(0, 0, 1), 9}, true};
  EXPECT_EQ(find_attached(mesh, all).size(), 36U);
  EXPECT_EQ(find_attached(mesh, skin).size(), 34U);
}

TEST(SceneModel, says_which_attachment_holds_nothing) {
  Json json = least_scene();
  json["attachments"] = {{{"below", {0, 0, 1, 0.1}}}, {{"below", {0, 0, 1, -5}}}};
  const app::Scene scene = parsed(json);
  const auto made = make_simulation(scene, std::move(app::load_model(scene)->mesh));
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("attachments[1] holds no vertex"), std::string::npos);
}

TEST(SceneModel, is_looked_for_beside_the_scene) {
  const Folder folder;
  folder.write("cube.mesh", cube_mesh(1));
  Json json = least_scene();
  json["model"] = {{"file", "cube.mesh"}};
  Result<app::Scene> scene = app::read_scene(folder.write("s.json", json.dump()));
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(app::load_model(*scene)->mesh.tet_count(), 6U);
  scene->model.file = "none.mesh";
  EXPECT_NE(app::load_model(*scene).error().message.find("none.mesh\": no such file"), std::string::npos);
}

// --- schema and reader

Json schema() {
  return Json::parse(app::read_text_file(INCISE_DOCS "/scene.schema.json", 1U << 20U).value());
}

std::set<std::string> keys_of(const Json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.at("properties").items()) keys.insert(item.key());
  return keys;
}

/// The keys that the reader names where it meets one that it does not know.
std::set<std::string> known_at(const std::string& pointer) {
  Json scene = full_scene();
  scene["model"]["bodies"] = {{{"box", {{"cells", {1, 1, 1}}}}}};
  Json& object = scene[Json::json_pointer(pointer)];
  object["nonsense"] = 1;
  const std::string error = error_of(scene);
  const std::string mark = "has the unknown key \"nonsense\"; known here: ";
  EXPECT_NE(error.find(mark), std::string::npos) << pointer << ": " << error;
  std::set<std::string> keys;
  std::istringstream list(error.substr(error.find(mark) + mark.size()));
  for (std::string key; list >> key;) keys.insert(key.substr(0, key.find(',')));
  return keys;
}

std::size_t count_objects(const Json& node) {
  std::size_t count = node.is_object() && node.contains("properties") ? 1 : 0;
  for (const Json& child : node) count += child.is_structured() ? count_objects(child) : 0;
  return count;
}

using Places = std::vector<std::pair<std::string, std::string>>;

/// Where the tools of `full_scene` that move are, and where the schema tells of each.
Places places_of_moving_tools() {
  Places places;
  const Json tools = full_scene().at("tools");
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const std::string kind = tools[i].items().begin().key();
    if (!tools[i].at(kind).is_object()) continue;  // the plane
    const bool has_path = tools[i].at(kind).contains("path");
    const std::string scene = "/tools/" + std::to_string(i) + "/" + kind;
    const std::string in_schema = "/properties/tools/items/properties/" + kind;
    places.emplace_back(scene + (has_path ? "/path/0" : ""), in_schema + (has_path ? "/properties/path/items" : ""));
  }
  return places;
}

TEST(SceneSchema, knows_the_same_keys_as_the_reader) {
  Places places = {
      {"", ""},
      {"/model", "/properties/model"},
      {"/model/box", "/$defs/box"},
      {"/model/bodies/0", "/properties/model/properties/bodies/items"},
      {"/model/regions/0", "/properties/model/properties/regions/items"},
      {"/materials", "/properties/materials"},
      {"/materials/default", "/properties/materials/properties/default"},
      {"/materials/regions/0", "/properties/materials/properties/regions/items"},
      {"/materials/default/prony/0", "/$defs/prony"},
      {"/attachments/0", "/properties/attachments/items"},
      {"/attachments/1/box", "/properties/attachments/items/properties/box"},
      {"/attachments/2/ball", "/properties/attachments/items/properties/ball"},
      {"/tools/0", "/properties/tools/items"},
      {"/hooks/0", "/properties/hooks/items"},
      {"/hooks/0/path/0", "/properties/hooks/items/properties/path/items"},
      {"/sutures/0", "/properties/sutures/items"},
      {"/spare/0", "/properties/spare/items"},
      {"/strokes/0", "/$defs/scene_stroke"},
      {"/view", "/properties/view"},
      {"/hand", "/properties/hand"},
      {"/exercise", "/properties/exercise"},
      {"/exercise/tolerances", "/properties/exercise/properties/tolerances"},
      {"/exercise/divide", "/properties/exercise/properties/divide"},
      {"/exercise/spare/0", "/properties/exercise/properties/spare/items"},
      {"/exercise/remove", "/properties/exercise/properties/remove"},
      {"/strokes/0/blade/0", "/$defs/stroke/oneOf/0"},
      {"/strokes/0/blade/0/edges/0", "/$defs/stroke/oneOf/0/properties/edges/items"},
      {"/strokes/1/blade/0", "/$defs/stroke/oneOf/1"},
      {"/strokes/1/blade/0/poses/0", "/$defs/stroke/oneOf/1/properties/poses/items"},
      {"/settle", "/properties/settle"},
      {"/solver", "/properties/solver"},
      {"/cut", "/properties/cut"},
      {"/maintain", "/properties/maintain"},
      {"/contact", "/properties/contact"},
  };
  const Places of_tools = places_of_moving_tools();
  places.insert(places.end(), of_tools.begin(), of_tools.end());
  const Json root = schema();
  EXPECT_EQ(count_objects(root), places.size());
  for (const auto& [scene, in_schema] : places) {
    const Json& object = root.at(Json::json_pointer(in_schema));
    EXPECT_EQ(object.at("additionalProperties"), false) << in_schema;
    EXPECT_EQ(keys_of(object), known_at(scene)) << scene;
  }
}

std::string page() {
  return app::read_text_file(INCISE_DOCS "/scenes.md", 1U << 20U).value();
}

/// All keys of all objects of the schema.
void add_keys(const Json& node, std::set<std::string>& keys) {
  if (node.is_object() && node.contains("properties")) keys.merge(keys_of(node));
  for (const Json& child : node) {
    if (child.is_structured()) add_keys(child, keys);
  }
}

TEST(SceneSchema, has_no_key_that_the_page_about_scenes_leaves_out) {
  std::set<std::string> keys;
  add_keys(schema(), keys);
  keys.erase("orientation");  // of blade files, which have a page of their own
  EXPECT_GE(keys.size(), 60U);
  const std::string text = page();
  for (const std::string& key : keys) {
    const std::array<std::string, 4> ways = {"`" + key, "." + key + "`", "." + key + "[]", "\"" + key + "\""};
    EXPECT_TRUE(std::any_of(ways.begin(), ways.end(), [&](const std::string& way) {
      return text.find(way) != std::string::npos;
    })) << key;
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

Json schema_of_object(const Json& properties, const Json& required) {
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}, {"required", required}};
}

/// A kind of tool as the schema tells it: at a place, or along a path; its points move, its numbers do not.
Json schema_of_tool(const ToolFieldNames& fields) {
  constexpr int kMaxPathKeys = 1048576;
  Json properties, key = {{"t", {{"type", "number"}, {"description", "s, rising"}, {"minimum", 0}}}};
  Json at_each_time = Json::array({"t"});
  for (const std::string& name : fields.numbers) {
    properties[name] = {{"type", "number"}, {"description", "length units"}, {"exclusiveMinimum", 0}};
  }
  for (const std::string& name : fields.points) {
    properties[name] = key[name] = {{"$ref", "#/$defs/vec3"}};
    at_each_time.push_back(name);
  }
  properties["path"] = {{"type", "array"},
                        {"items", schema_of_object(key, at_each_time)},
                        {"minItems", 2},
                        {"description", "where it is at each time"},
                        {"maxItems", kMaxPathKeys}};
  Json tool = schema_of_object(properties, fields.numbers);
  tool["oneOf"] = {{{"required", fields.points}}, {{"required", {"path"}}}};
  return tool;
}

/// The schema with those tools that are registered; the rest as it stands.
std::string schema_of_tools(const std::string& text) {
  Json root = Json::parse(text);
  Json all = Json::array(), cutting = all;
  for (std::size_t i = 0; i < app::kToolCount; ++i) {
    all.push_back(app::scene_name_of(static_cast<app::ToolKind>(i)));
    if (app::kTools[i].cuts) cutting.push_back(all.back());
  }
  root["/properties/hand/properties/tool/enum"_json_pointer] = all;
  root["/properties/spare/items/properties/tool/enum"_json_pointer] = cutting;
  Json& pressing = root["/properties/tools/items"_json_pointer];
  Json kinds = {{"name", pressing["properties"]["name"]}, {"plane", pressing["properties"]["plane"]}};
  Json one_of = Json::array({{{"required", {"plane"}}}});
  for_each_tool_kind([&](const auto& shape) {
    if (!shape.kMoves) return;
    ToolFieldNames fields;
    shape.for_each_field(shape, fields);
    kinds[shape.kName] = schema_of_tool(fields);
    one_of.push_back({{"required", {shape.kName}}});
  });
  pressing["properties"] = kinds;
  pressing["oneOf"] = one_of;
  return root.dump(1) + "\n";
}

/// "`a`, `b` and `c`".
std::string listed_keys(const std::vector<std::string>& keys) {
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    text += (i == 0 ? "`" : (i + 1 < keys.size() ? ", `" : " and `")) + keys[i] + "`";
  }
  return text;
}

/// The page about scenes, with a row for each tool that it has none for; what a row tells beyond its keys stays.
std::string page_of_tools(const std::string& text) {
  std::string page = text;
  for_each_tool_kind([&](const auto& shape) {
    const std::string begin = std::string("| `tools[].") + shape.kName + "` |";
    if (!shape.kMoves || page.find(begin) != std::string::npos) return;
    ToolFieldNames fields;
    shape.for_each_field(shape, fields);
    std::vector<std::string> of_path = fields.points;
    of_path.insert(of_path.begin(), "t");
    const std::size_t last = page.find('\n', page.rfind("\n| `tools[].") + 1) + 1;
    page.insert(last, begin + " " + listed_keys(fields.numbers) + ", and either " + listed_keys(fields.points) +
                          ", or a `path` of " + listed_keys(of_path) + " | above 0 | |\n");
  });
  return page;
}

/// The types of the npm package with those tools of the window that are registered.
std::string types_of_tools(const std::string& text) {
  std::string names;
  for (const app::ToolRow& row : app::kTools) names += (names.empty() ? "'" : " | '") + std::string(row.name) + "'";
  return std::regex_replace(text, std::regex("export type ToolName = [^;]*;"), "export type ToolName = " + names + ";");
}

/// Expects that a file of the project is what it would be made now; writes it where that is asked for.
void expect_made(const std::string& file, std::string (*make)(const std::string& text)) {
  const std::string text = app::read_text_file(file, 1U << 20U).value();
  const std::string made = make(text);
  if (std::getenv("INCISE_UPDATE_GOLDENS") != nullptr) {
    ASSERT_TRUE(app::write_text_file(file, made).ok());
  } else {
    EXPECT_EQ(text, made) << file << " lacks a tool; INCISE_UPDATE_GOLDENS=1 writes it anew";
  }
}

TEST(SceneSchema, the_page_about_scenes_gets_a_row_for_a_tool_that_it_lacks) {
  std::string without = page();
  const std::size_t at = without.find("| `tools[].ball`");
  without.erase(at, without.find('\n', at) + 1 - at);
  const std::string again = page_of_tools(without);
  EXPECT_NE(
      again.find("| `tools[].ball` | `radius`, and either `centre`, or a `path` of `t` and `centre` | above 0 | |\n"),
      std::string::npos);
  EXPECT_EQ(again.size(), page().size());
}

TEST(SceneSchema, and_the_types_of_the_web_name_the_tools_that_are_registered) {
  expect_made(INCISE_DOCS "/scene.schema.json", schema_of_tools);
  expect_made(INCISE_DOCS "/scenes.md", page_of_tools);
  expect_made(INCISE_DOCS "/../bindings/web/index.d.mts", types_of_tools);
}

TEST(SceneSchema, has_the_same_defaults_as_the_reader) {
  const Json found = Json::parse(app::to_json(parsed(least_scene())));
  EXPECT_GE(compare_defaults(schema(), found, ""), 20);
}

}  // namespace

}  // namespace scene_test
