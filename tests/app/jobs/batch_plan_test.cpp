// SPDX-License-Identifier: Apache-2.0
// What plans of batches may say.
#include "app/jobs/batch_plan.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/text/text_file.h"
#include "support/folder.h"

namespace batch_plan_test {
namespace {

using namespace incise;
using Json = nlohmann::ordered_json;

class Plan : public testing::Test {
 protected:
  [[nodiscard]] Result<app::BatchPlan> parse(const Json& text) const {
    return app::parse_batch_plan(text.dump(1), "plan.json", root_);
  }
  [[nodiscard]] std::string error_of(const Json& text) const {
    const auto plan = parse(text);
    EXPECT_FALSE(plan.ok()) << text;
    return plan.ok() ? "" : plan.error().message;
  }
  [[nodiscard]] std::string error_of_item(const Json& item) const {
    Json text = least();
    text["items"][0] = item;
    return error_of(text);
  }
  static Json least() {
    return {{"format", "incise-plan"},
            {"version", 1},
            {"items", Json::array({Json{{"mesh", "cube.mesh"}, {"plane", {1, 0, 0, 0.5}}}})}};
  }
  static Json scene() {
    return Json::parse(R"({"format": "incise-scene", "version": 1, "model": {"box": {"cells": [1, 1, 1]}},
      "length_unit": 1, "frames": 1})");
  }
  /// Has every key that there is.
  static Json full() {
    Json text = least();
    text["name"] = "full";
    text["output"] = {{"mesh", "msh41"}, {"before", false}, {"strokes", false}, {"pose", "deformed"}};
    text["defaults"] = {{"mesh", "cube.mesh"}, {"options", {{"snap", 0.1}, {"profile", "paper"}}}};
    text["items"] = Json::array();
    text["items"].push_back({{"name", "a"}, {"label", "test"}, {"plane", {0, 0, 2, 1}}});
    text["items"].push_back(
        {{"name", "b"},
         {"repeat", 3},
         {"random", {{"seed", 18446744073709551613U}, {"strokes", 2}, {"kinds", {"arc", "core"}}}},
         {"options", {{"profile", "incise"}, {"merge", false}, {"improve", false}, {"work_units", 100}}}});
    text["items"].push_back(
        {{"blade",
          {{{"edges",
             {{{"t", 0}, {"points", {{0, 0, 0}, {0, 0, 1}}}}, {{"t", 1}, {"points", {{1, 0, 0}, {1, 0, 1}}}}}}}}}});
    text["items"].push_back(
        {{"mesh", ""}, {"scene", scene()}, {"random", {{"seed", 1}, {"start", 0}, {"seconds", 2}, {"pause", 0.5}}}});
    return text;
  }

  incise_test::Folder folder_;
  std::string root_ = std::filesystem::path(folder_ / "x").parent_path().string();
  std::string cube_ = folder_.write("cube.mesh", incise_test::cube_mesh(1));
};

TEST_F(Plan, is_read) {
  const auto plan = parse(full());
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  EXPECT_EQ(plan->name, "full");
  EXPECT_EQ(plan->output.format, "msh41");
  EXPECT_FALSE(plan->output.before);
  EXPECT_TRUE(plan->output.as_it_stands);
  ASSERT_EQ(plan->items.size(), 6U);
  EXPECT_EQ(plan->items[0].name, "a");
  EXPECT_EQ(plan->items[0].label, "test");
  EXPECT_EQ(plan->items[0].options.profile, Profile::kPaper);
  EXPECT_EQ(std::get<app::HalfSpace>(plan->items[0].blade).offset, 1);
  EXPECT_EQ(plan->items[3].name, "b-0002");
  EXPECT_EQ(plan->items[3].options.profile, Profile::kIncise);
  EXPECT_EQ(plan->items[3].options.snap, 0.1);
  EXPECT_EQ(plan->items[3].options.merge, false);
  EXPECT_EQ(plan->items[3].options.work_units, 100U);
  const auto& random = std::get<app::RandomStrokes>(plan->items[3].blade);
  EXPECT_EQ(random.seed, 18446744073709551615U);
  EXPECT_EQ(random.kinds, (std::vector<app::RandomKind>{app::RandomKind::kArc, app::RandomKind::kCore}));
  EXPECT_EQ(plan->items[4].name, "item-000004");
  EXPECT_EQ(std::get<std::vector<app::BladeStroke>>(plan->items[4].blade).size(), 1U);
  EXPECT_EQ(plan->items[5].scene->frames, 1U);
  EXPECT_EQ(std::get<app::RandomStrokes>(plan->items[5].blade).seconds, 2);
}

TEST_F(Plan, reads_scenes_and_blades_from_its_folder) {
  folder_.write("scene.json", scene().dump());
  folder_.write("blade.json", R"({"format": "incise-blade", "version": 1, "strokes": [{"edges": [
    {"t": 0, "points": [[0, 0, 0], [0, 0, 1]]}, {"t": 1, "points": [[1, 0, 0], [1, 0, 1]]}]}]})");
  Json text = least();
  text["items"].push_back({{"mesh", "cube.mesh"}, {"blade", "blade.json"}});
  text["items"].push_back({{"scene", "scene.json"}, {"random", Json::object()}});
  text["items"].push_back({{"scene", "scene.json"}, {"random", Json::object()}, {"mesh", "cube.mesh"}});
  folder_.write("plan.json", text.dump());
  const auto plan = app::read_batch_plan(folder_ / "plan.json");
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  EXPECT_EQ(plan->items[2].scene, plan->items[3].scene);  // read once
  text["items"][2]["scene"] = "none.json";
  EXPECT_NE(error_of(text).find("none.json: no such file"), std::string::npos);
}

TEST_F(Plan, tells_what_is_wrong_and_where) {
  const Json cut = {{"mesh", "cube.mesh"}, {"plane", {1, 0, 0, 0.5}}};
  const auto with = [&](const char* key, const Json& value) {
    Json item = cut;
    item[key] = value;
    return error_of_item(item);
  };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_EQ(message.rfind("plan.json:", 0), 0U) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(with("plain", 1), "items[0] has the unknown key \"plain\"; known here: name, label");
  has(with("random", Json::object()), "items[0] has more than one of the keys plane, blade, random");
  has(with("repeat", 3), "items[0] has \"repeat\", which goes with \"random\"");
  has(with("mesh", "none.mesh"), "none.mesh: no such file");
  has(with("mesh", std::string("cube.mesh\0.vtu", 14)), "items[0].mesh must not have a null character");
  has(with("mesh", ""), "items[0] needs the key \"mesh\" or \"scene\"");
  has(with("name", "a/b"), "items[0].name is \"a/b\"; files are named by it");
  for (const char* name : {"..", ".", ".a", "a."}) has(with("name", name), "files are named by it");
  has(with("scene", scene()), "put the strokes into the scene");
  has(with("scene", 1), "items[0].scene must be a scene file's path, or a scene");
  has(with("options", {{"profile", "best"}}), "items[0].options.profile must be one of incise, paper, removal");
  has(with("options", {{"snap", 1}}), "items[0].options.snap is 1; it must be at least 0 and at most 0.4");
  has(error_of_item({{"mesh", "cube.mesh"}}), "items[0] needs one of the keys plane, blade, random");
  has(error_of_item({{"scene", scene()}}), "has a scene without strokes");
  has(error_of_item({{"scene", scene()}, {"random", Json::object()}, {"options", {{"profile", "removal"}}}}),
      "which the profiles incise and paper alone can cut");
  has(error_of_item({{"mesh", "cube.mesh"}, {"plane", {0, 0, 0, 1}}}), "items[0].plane needs a normal");
  has(error_of_item({{"mesh", "cube.mesh"}, {"random", {{"kinds", {"wave"}}}}}),
      "items[0].random.kinds[0] must be one of plane, arc, slit, core");
  has(error_of_item({{"mesh", "cube.mesh"}, {"repeat", 1000001}, {"random", Json::object()}}),
      "items[0].repeat is 1000001; it must be from 1 to 1000000");
  has(error_of_item({{"mesh", "cube.mesh"}, {"repeat", 2}, {"random", {{"seed", 18446744073709551615U}}}}),
      "items[0].random.seed is 18446744073709551615, and the last of 2 items would need one above 2^64 - 1");
  has(error_of_item({{"mesh", "cube.mesh"}, {"repeat", 1000000}, {"name", "half"}, {"random", {{"strokes", 0}}}}),
      "items[0].random.strokes is 0");
}

TEST_F(Plan, has_times_of_strokes_in_scenes_alone) {
  for (const char* time : {"start", "seconds", "pause"}) {
    const Json random = {{time, 0.5}};
    const std::string message = error_of_item({{"mesh", "cube.mesh"}, {"random", random}});
    EXPECT_NE(message.find("items[0].random." + std::string(time) + " is of scenes"), std::string::npos) << message;
    Json text = least();
    text["items"].push_back({{"scene", scene()}, {"random", random}});
    EXPECT_TRUE(parse(text).ok()) << parse(text).error().message;
  }
}

/// A plan may have a thousand scenes: which one is wrong has to be said.
TEST_F(Plan, tells_which_scene_is_wrong) {
  const auto error_with = [&](const char* key, const Json& value) {
    Json item = {{"scene", scene()}, {"random", Json::object()}};
    item["scene"][key] = value;
    return error_of_item(item);
  };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(error_with("version", 99), ": items[0].scene.version is 99");
  has(error_with("speed", 1), ": items[0].scene has the unknown key \"speed\"");
  has(error_with("length_unit", -1), ": items[0].scene.length_unit is -1");
  has(error_with("tools", {{{"ball", 1}}}), ": items[0].scene.tools[0]");
  has(error_with("strokes", {{{"blade", "none.json"}}}),
      ": items[0].scene.strokes[0].blade names a file that cannot be taken: none.json: no such file");
  has(error_with("model", {{"bodies", {{{"file", "none.mesh"}}}}, {"box", {{"cells", {1, 1, 1}}}}}),
      ": items[0] needs the mesh none.mesh: no such file");
  Json text = least();
  text["defaults"] = {{"scene", scene()}};
  text["defaults"]["scene"]["frames"] = 0;
  has(error_of(text), ": defaults.scene.frames is 0");
}

TEST_F(Plan, needs_names_that_differ_and_formats_that_there_are) {
  Json text = least();
  text["items"][0]["name"] = "a";
  text["items"].push_back(text["items"][0]);
  EXPECT_NE(error_of(text).find("items[1].name is \"a\", as that of an item before it"), std::string::npos);
  text["items"][1]["name"] = "A";
  EXPECT_NE(
      error_of(text).find("items[1].name is \"A\", as that of an item before it but for the case of letters: \"a\""),
      std::string::npos);
  text = least();
  text["output"] = {{"mesh", "node"}};
  EXPECT_NE(error_of(text).find("output.mesh must be one of mesh, "), std::string::npos);
  text["output"] = {{"pose", "standing"}};
  EXPECT_NE(error_of(text).find("output.pose must be \"rest\" or \"deformed\""), std::string::npos);
  text["output"] = {{"mesh", nullptr}};
  EXPECT_TRUE(parse(text)->output.format.empty());
  text["items"] = Json::array();
  EXPECT_NE(error_of(text).find("items has 0 entries"), std::string::npos);
  text["version"] = 2;
  EXPECT_NE(error_of(text).find("this program reads version 1"), std::string::npos);
}

TEST_F(Plan, a_key_tells_items_apart_by_all_that_the_plan_says) {
  Json text = full();
  std::set<std::uint64_t> keys;
  const auto plan = parse(text);
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  for (const app::BatchItem& item : plan->items) keys.insert(item.key);
  const auto key = [&](std::size_t index) { return parse(text)->items[index].key; };
  EXPECT_EQ(keys.count(key(0)), 1U);
  text["items"][0]["plane"][3] = 1.0000000000000002;
  EXPECT_TRUE(keys.insert(key(0)).second);
  text["items"][0]["label"] = "train";
  EXPECT_TRUE(keys.insert(key(0)).second);
  text["items"][3]["random"]["pause"] = 0.25;
  EXPECT_TRUE(keys.insert(key(5)).second);
  text["items"][1]["options"]["improve"] = true;
  EXPECT_TRUE(keys.insert(key(1)).second);
  text["items"][3]["scene"]["frames"] = 2;
  EXPECT_TRUE(keys.insert(key(5)).second);
  text["output"]["before"] = true;
  EXPECT_TRUE(keys.insert(key(5)).second);
  EXPECT_EQ(keys.size(), 6U + 6U);
}

// --- schema, page and reader

Json schema() {
  return Json::parse(app::read_text_file(INCISE_DOCS "/plan.schema.json", 1U << 20U).value());
}

std::set<std::string> keys_of(const Json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.at("properties").items()) keys.insert(item.key());
  return keys;
}

std::size_t count_objects(const Json& node) {
  std::size_t count = node.is_object() && node.contains("properties") ? 1 : 0;
  for (const Json& child : node) count += child.is_structured() ? count_objects(child) : 0;
  return count;
}

class PlanSchema : public Plan {
 protected:
  /// The keys that the reader names where it meets one that it does not know.
  [[nodiscard]] std::set<std::string> known_at(const std::string& pointer) const {
    Json text = full();
    text[Json::json_pointer(pointer)]["nonsense"] = 1;
    const std::string error = error_of(text);
    const std::string mark = "has the unknown key \"nonsense\"; known here: ";
    EXPECT_NE(error.find(mark), std::string::npos) << pointer << ": " << error;
    std::set<std::string> keys;
    std::istringstream list(error.substr(error.find(mark) + mark.size()));
    for (std::string key; list >> key;) keys.insert(key.substr(0, key.find(',')));
    return keys;
  }
};

TEST_F(PlanSchema, knows_the_same_keys_as_the_reader) {
  const std::vector<std::pair<std::string, std::string>> places = {
      {"", ""},
      {"/output", "/properties/output"},
      {"/defaults", "/properties/defaults"},
      {"/items/1", "/properties/items/items"},
      {"/items/1/random", "/properties/items/items/properties/random"},
      {"/items/1/options", "/$defs/options"},
  };
  const Json root = schema();
  EXPECT_EQ(count_objects(root), places.size());
  for (const auto& [plan, in_schema] : places) {
    const Json& object = root.at(Json::json_pointer(in_schema));
    EXPECT_EQ(object.at("additionalProperties"), false) << in_schema;
    EXPECT_EQ(keys_of(object), known_at(plan)) << plan;
  }
}

TEST_F(PlanSchema, has_no_key_that_the_page_leaves_out) {
  const std::string page = app::read_text_file(INCISE_DOCS "/batches.md", 1U << 20U).value();
  const Json root = schema();
  std::set<std::string> keys = keys_of(root.at("/$defs/options"_json_pointer));
  keys.merge(keys_of(root));
  keys.merge(keys_of(root.at("/properties/output"_json_pointer)));
  keys.merge(keys_of(root.at("/properties/items/items"_json_pointer)));
  keys.merge(keys_of(root.at("/properties/items/items/properties/random"_json_pointer)));
  EXPECT_GE(keys.size(), 25U);
  for (const std::string& key : keys) {
    EXPECT_TRUE(page.find("`" + key + "`") != page.npos || page.find("." + key + "`") != page.npos ||
                page.find("." + key + "[]") != page.npos)
        << key;
  }
}

TEST_F(PlanSchema, the_example_of_the_page_is_a_plan) {
  const std::string page = app::read_text_file(INCISE_DOCS "/batches.md", 1U << 20U).value();
  const std::size_t begin = page.find("```json\n") + 8;
  folder_.write("liver.mesh", incise_test::cube_mesh(1));
  folder_.write("scene.json", scene().dump());
  const auto plan = app::parse_batch_plan(page.substr(begin, page.find("```", begin) - begin), "batches.md", root_);
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  EXPECT_EQ(plan->items.size(), 302U);
}

TEST_F(PlanSchema, has_the_same_defaults_as_the_reader) {
  const Json root = schema();
  const app::BatchOutput output;
  const app::RandomStrokes random;
  const Json& out = root.at("/properties/output/properties"_json_pointer);
  EXPECT_EQ(out["mesh"]["default"], output.format);
  EXPECT_EQ(out["before"]["default"], output.before);
  EXPECT_EQ(out["strokes"]["default"], output.strokes);
  EXPECT_EQ(out["pose"]["default"], "rest");
  const Json& in = root.at("/properties/items/items/properties/random/properties"_json_pointer);
  EXPECT_EQ(in["seed"]["default"], random.seed);
  EXPECT_EQ(in["strokes"]["default"], random.strokes);
  EXPECT_EQ(in["start"]["default"], random.start);
  EXPECT_EQ(in["seconds"]["default"], random.seconds);
  EXPECT_EQ(in["pause"]["default"], random.pause);
  EXPECT_EQ(in["kinds"]["default"].size(), random.kinds.size());
}

// --- any bytes

/// What must hold of any text: a message that names the file, or items that can be told apart.
/// Returns whether it is a plan.
bool is_sound_plan(const std::string& text, const std::filesystem::path& folder) {
  const auto plan = app::parse_batch_plan(text, "plan.json", folder);
  if (!plan.ok()) {
    EXPECT_EQ(plan.error().code, ErrorCode::kBadFile) << text;
    EXPECT_EQ(plan.error().message.rfind("plan.json:", 0), 0U) << plan.error().message << "\n" << text;
    return false;
  }
  std::set<std::string> names;
  std::set<std::uint64_t> keys;
  for (const app::BatchItem& item : plan->items) {
    EXPECT_FALSE(item.name.empty()) << text;
    EXPECT_EQ(item.name.find_first_of("/\\ \n"), std::string::npos) << text;
    EXPECT_TRUE(names.insert(item.name).second) << text;
    EXPECT_TRUE(keys.insert(item.key).second) << text;
  }
  EXPECT_FALSE(plan->items.empty()) << text;
  return true;
}

TEST_F(Plan, that_is_cut_off_anywhere_is_refused) {
  const std::string text = full().dump(1);
  ASSERT_TRUE(is_sound_plan(text, root_));
  for (std::size_t end = 0; end + 1 < text.size(); ++end)
    ASSERT_FALSE(is_sound_plan(text.substr(0, end), root_)) << end;
}

TEST_F(Plan, with_spoiled_bytes_is_read_or_refused) {
  const std::string text = full().dump();
  std::mt19937 random(11);
  int read = 0, refused = 0;
  for (int round = 0; round < 4000 && !HasFailure(); ++round) {
    std::string spoiled = text;
    for (int i = 0; i <= round % 3; ++i) spoiled[random() % spoiled.size()] = static_cast<char>(random());
    ++(is_sound_plan(spoiled, root_) ? read : refused);
  }
  EXPECT_GT(read, 5);
  EXPECT_GT(refused, 1000);
}

/// Every place of a tree.
void collect(Json& tree, std::vector<Json*>& places) {
  places.push_back(&tree);
  if (tree.is_structured()) {
    for (Json& child : tree) collect(child, places);
  }
}

TEST_F(Plan, with_values_of_other_kinds_is_read_or_refused) {
  const std::vector<Json> others = {nullptr,
                                    true,
                                    -1,
                                    0,
                                    1,
                                    1e300,
                                    -1e-300,
                                    18446744073709551615U,
                                    "",
                                    "a/b",
                                    std::string(1, 'x'),
                                    "\xff\xfe",
                                    Json::array(),
                                    Json::object(),
                                    {1, 2, 3, 4},
                                    {{"x", 1}}};
  std::mt19937 random(5);
  int refused = 0;
  const Json whole = full();
  for (int round = 0; round < 4000 && !HasFailure(); ++round) {
    Json spoiled = whole;
    std::vector<Json*> places;
    collect(spoiled, places);
    Json* place = places[random() % places.size()];
    // From elsewhere in the plan, or made up.
    *place = random() % 2 == 0 ? Json(*places[random() % places.size()]) : others[random() % others.size()];
    refused += is_sound_plan(spoiled.dump(-1, ' ', false, Json::error_handler_t::ignore), root_) ? 0 : 1;
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace

}  // namespace batch_plan_test
