// SPDX-License-Identifier: Apache-2.0
// Scenes for tests, as JSON.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "incise/sim/contact.h"

namespace incise_test {

using Json = nlohmann::ordered_json;

/// The least that a scene needs, and a number of frames.
inline Json least_scene() {
  return {{"format", "incise-scene"},
          {"version", 1},
          {"model", {{"box", {{"cells", {2, 2, 2}}}}}},
          {"length_unit", 0.1},
          {"frames", 10}};
}

inline Json blade_stroke(double begin, double end) {
  return {{"name", "across"},
          {"edges",
           {{{"t", begin}, {"points", {{0.43, -0.2, -0.2}, {0.43, -0.2, 1.2}}}},
            {{"t", end}, {"points", {{0.46, 1.2, -0.2}, {0.46, 1.2, 1.2}}}}}}};
}

/// The names of the fields of a tool that moves.
struct ToolFieldNames {
  std::vector<std::string> points, numbers;

  void operator()(const char* name, const incise::Vec3& /*point*/) { points.emplace_back(name); }
  void operator()(const char* name, double /*number*/) { numbers.emplace_back(name); }
  void operator()(const char* name, const std::vector<incise::Vec3>& /*points*/) {
    ADD_FAILURE() << name << ": a scene has no word for a list of points that moves";
  }
};

/// A tool of each kind that moves, first at a place, then along a path.
inline Json moving_tools() {
  Json tools = Json::array();
  incise::for_each_tool_kind([&](const auto& shape) {
    if (!shape.kMoves) return;
    ToolFieldNames fields;
    shape.for_each_field(shape, fields);
    const auto put = [&](Json& at, double height) {
      for (std::size_t i = 0; i < fields.points.size(); ++i) at[fields.points[i]] = {static_cast<double>(i), 0, height};
    };
    Json numbers, begin = {{"t", 0.1}}, end = {{"t", 0.3}};
    for (const std::string& name : fields.numbers) numbers[name] = 0.1;
    Json still = numbers, moving = numbers;
    put(still, 1.2);
    put(begin, 2);
    put(end, 1);
    moving["path"] = {begin, end};
    tools.push_back({{shape.kName, still}});
    tools.push_back({{shape.kName, moving}});
  });
  return tools;
}

/// A scene with every key that there is but `frames`, `model.file`, `model.bodies` and `stretch`, small and quick.
inline Json full_scene() {
  Json scene = least_scene();
  scene.erase("frames");
  scene["name"] = "everything";
  scene["model"] = {{"box", {{"cells", {3, 2, 2}}, {"size", {1, 1, 1}}, {"origin", {0, 0, 0}}, {"jitter", 0.05}}},
                    {"regions", {{{"region", 3}, {"below", {0, 0, 1, 0.4}}}}}};
  scene["materials"] = {{"default",
                         {{"density", 900},
                          {"young", 8000},
                          {"poisson", 0.3},
                          {"toughness", 5},
                          {"cut_friction", 0.1},
                          {"stiffening", 3},
                          {"rupture", 0.2},
                          {"fibre", {1, 0.5, 0}},
                          {"fibre_young", 3000},
                          {"prony", {{{"share", 0.5}, {"seconds", 0.2}}}},
                          {"rigid", false}}},
                        {"regions",
                         {{{"region", 3},
                           {"density", 1100},
                           {"young", 2e4},
                           {"poisson", 0.4},
                           {"toughness", 2},
                           {"cut_friction", 0},
                           {"stiffening", 0},
                           {"rupture", 0}}}}};
  scene["gravity"] = {0, 0.5, -9.81};
  scene["damping"] = 1.5;
  scene["attachments"] = {
      {{"below", {1, 0, 0, 0.01}}, {"surface", true}},
      {{"box", {{"low", {0.9, -1, -1}}, {"high", {2, 2, 2}}}}, {"stiffness", 500}, {"strength", 1000}, {"tears", true}},
      {{"ball", {{"centre", {0, 0, 0}}, {"radius", 0.1}}}}};
  scene["tools"] = moving_tools();
  const Json table = {{"name", "table"}, {"plane", {0, 0, 2, -1}}};
  scene["tools"].insert(scene["tools"].begin(), table);
  scene["spare"] = {{{"tool", "scissors"}, {"stop_at", {3}}}, {{"stop_at", {3, 0}}}};
  scene["hooks"] = {{{"name", "hook"},
                     {"radius", 0.3},
                     {"stiffness", 50},
                     {"strength", 1000},
                     {"tears", false},
                     {"path", {{{"t", 0.05}, {"position", {1, 1, 1}}}, {{"t", 0.25}, {"position", {1, 1.2, 1.3}}}}}}};
  scene["sutures"] = {{{"name", "suture"},
                       {"from", {0.2, 0.3, 0.4}},
                       {"to", {0.7, 0.3, 0.4}},
                       {"stiffness", 30},
                       {"rest_length", 0.3},
                       {"pushes", false},
                       {"strength", 50},
                       {"start", 0.3}}};
  scene["strokes"] = {{{"blade", {blade_stroke(0, 0.4)}}, {"start", 0.1}, {"stretch", 0.5}, {"pause", 0.05}},
                      {{"blade",
                        {{{"name", "rigid"},
                          {"edge", {{0, 0, -0.2}, {0, 0, 1.2}}},
                          {"poses",
                           {{{"t", 0.5}, {"position", {-0.2, 0.6, 0}}, {"orientation", {1, 0, 0, 0}}},
                            {{"t", 0.7}, {"position", {1.2, 0.6, 0}}, {"orientation", {0.6, 0, 0, 0.8}}}}}}}},
                       {"direction", {1, 0, 0}}}};
  scene["duration"] = 1;
  scene["frame_seconds"] = 0.02;
  scene["settle"] = {{"frames", 5}, {"speed", 1e-3}};
  scene["seed"] = 12345678901234567890U;
  scene["solver"] = {{"relaxation", "position-based"}, {"substeps", 3}, {"iterations", 2}, {"average_volumes", true}};
  scene["cut"] = {{"snap", 0.1}, {"profile", "incise"}};
  scene["maintain"] = {{"merge", true}, {"improve", true}, {"work_units", 5000}};
  scene["contact"] = {{"stiffness", 100}, {"flat_height", 0.1}, {"self", true}, {"friction", 0.2}};
  scene["view"] = {{"from", {1, -2, 3}}, {"up", {0, 0, 2}},       {"target", {0.5, 0.4, 0.9}}, {"distance", 4.5},
                   {"zoom", 1.5},        {"color", "region"},     {"wireframe", true},         {"opacity", 0.25},
                   {"theme", "light"},   {"clip", {0, 1, 0, 0.1}}};
  scene["hand"] = {{"tool", "punch"}, {"depth", 0.4}, {"angle", -20}, {"ring", 0.15}, {"grip", 0.25}};
  scene["exercise"] = {
      {"name", "a cut"},
      {"instructions", "Cut along the line."},
      {"target", {{0.45, 0.1, 1}, {0.45, 0.9, 1}}},
      {"depth", 0.5},
      {"angle", 5},
      {"tolerances", {{"line", 0.1}, {"depth", 0.2}, {"angle", 15}, {"force", 0.5}}},
      {"max_force", 3},
      {"strokes", 2},
      {"pass", 80},
      {"divide", {{"regions", {3}}, {"name", "the rind"}}},
      {"spare", {{{"regions", {4, 5}}, {"name", "the core"}, {"depth", 0.1}}}},
      {"remove",
       {{"regions", {6}}, {"name", "the spot"}, {"share", 0.9}, {"margin", {0.1, 0.2}}, {"volume", {0.01, 0.02}}}},
      {"ideal", {{"blade", {blade_stroke(0, 0.4)}}, {"start", 0.1}, {"direction", {0, 1, 0}}}}};
  return scene;
}

}  // namespace incise_test
