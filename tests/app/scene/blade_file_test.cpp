// SPDX-License-Identifier: Apache-2.0
#include "app/scene/blade_file.h"

#include <gtest/gtest.h>

namespace blade_file_test {
namespace {

using namespace incise;
using app::parse_blade;

const std::string kHead = R"({"format":"incise-blade","version":1,"strokes":[)";
const std::string kTail = "]}";

std::string polyline(const std::string& edges) {
  return kHead + R"({"name":"s","edges":[)" + edges + "]}" + kTail;
}

std::string rigid(const std::string& edge, const std::string& poses) {
  return kHead + R"({"edge":)" + edge + R"(,"poses":[)" + poses + "]}" + kTail;
}

std::string pose(const std::string& t, const std::string& position, const std::string& orientation) {
  return "{\"t\":" + t + ",\"position\":" + position + ",\"orientation\":" + orientation + "}";
}

std::string error_of(const std::string& text) {
  const auto blade = parse_blade(text, "b.json");
  EXPECT_FALSE(blade.ok()) << text;
  if (blade.ok()) return "";
  EXPECT_EQ(blade.error().code, ErrorCode::kBadFile);
  EXPECT_EQ(blade.error().message.substr(0, 7), "b.json:");
  return blade.error().message;
}

void expect_error(const std::string& text, const std::string& part) {
  const std::string message = error_of(text);
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(BladeFile, reads_polylines) {
  const auto blade =
      parse_blade(polyline(R"({"t":0,"points":[[0,0,0],[1,2,3]]},{"t":0.5,"points":[[0,0,1],[1,2,4]]})"), "b");
  ASSERT_TRUE(blade.ok()) << blade.error().message;
  ASSERT_EQ(blade->size(), 1U);
  const Stroke& stroke = blade->front();
  EXPECT_EQ(stroke.name, "s");
  EXPECT_EQ(stroke.times, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(stroke.edges[1][1], Vec3(1, 2, 4));
  EXPECT_TRUE(check(stroke).ok());
}

TEST(BladeFile, moves_a_rigid_edge) {
  const auto blade = parse_blade(
      rigid("[[1,0,0],[2,0,5]]", pose("0", "[0,0,0]", "[1,0,0,0]") + "," +
                                     pose("1", "[10,0,0]", "[0.70710678118654752,0,0,0.70710678118654752]")),
      "b");
  ASSERT_TRUE(blade.ok()) << blade.error().message;
  EXPECT_EQ(blade->front().edges[0][1], Vec3(2, 0, 5));
  EXPECT_TRUE(blade->front().edges[1][0].isApprox(Vec3(10, 1, 0), 1e-15));
  EXPECT_TRUE(blade->front().edges[1][1].isApprox(Vec3(10, 2, 5), 1e-15));
}

TEST(BladeFile, reads_every_scene) {
  for (const char* name : {"bunny_stroke", "cube_plane", "cube_cross", "cube_core"}) {
    const auto blade = app::read_blade(std::string(INCISE_SCENES "/") + name + ".json");
    ASSERT_TRUE(blade.ok()) << blade.error().message;
    for (const Stroke& stroke : *blade) EXPECT_TRUE(check(stroke).ok());
  }
}

TEST(BladeFile, refuses_what_is_no_blade) {
  error_of("");
  error_of("{");
  error_of("[]");
  error_of("\"blade\"");
  expect_error("{}", "lacks the key \"format\"");
  expect_error(R"({"format":"incise-blade","strokes":[]})", "lacks the key \"version\"");
  expect_error(R"({"format":"incise-scene","version":1,"strokes":[]})", "format must be \"incise-blade\"");
  expect_error(R"({"format":"incise-blade","version":2,"strokes":[]})", "version is 2");
  expect_error(R"({"format":"incise-blade","version":1,"strokes":[]})", "strokes has 0 entries");
  expect_error(R"({"format":"incise-blade","version":1})", "lacks the key \"strokes\"");
}

TEST(BladeFile, refuses_unknown_and_missing_keys_by_path) {
  expect_error(R"({"format":"incise-blade","version":1,"strokes":[],"speed":1})", "unknown key \"speed\"");
  expect_error(kHead + R"({"edges":[],"nmae":"x"})" + kTail, "strokes[0] has the unknown key \"nmae\"");
  expect_error(kHead + R"({"name":"x"})" + kTail, "strokes[0] lacks the key \"edges\"");
  expect_error(kHead + R"({"edges":[],"poses":[],"edge":[]})" + kTail, "unknown key \"edges\"");
  expect_error(polyline(R"({"t":0,"points":[[0,0,0],[1,0,0]],"x":0})"),
               "strokes[0].edges[0] has the unknown key \"x\"");
  expect_error(polyline(R"({"points":[[0,0,0],[1,0,0]]})"), "strokes[0].edges[0] lacks the key \"t\"");
  expect_error(rigid("[[0,0,0],[1,0,0]]", R"({"t":0,"position":[0,0,0]})"), "strokes[0].poses[0] lacks the key");
  expect_error(kHead + R"({"edge":[[0,0,0],[1,0,0]]})" + kTail, "strokes[0] lacks the key \"poses\"");
}

TEST(BladeFile, refuses_bad_edges) {
  expect_error(polyline(R"({"t":0,"points":[[0,0,0]]})"),
               "strokes[0].edges[0].points has 1 entries; it needs at least 2");
  expect_error(polyline(R"({"t":0,"points":[[0,0,0],[1,0]]})"), "points[1] must be an array of 3 numbers");
  expect_error(polyline(R"({"t":0,"points":[[0,0,0],[1,0,"a"]]})"), "points[1][2] must be a finite number");
  expect_error(polyline(R"({"t":0,"points":[[0,0,0],[1,0,null]]})"), "not null");
  error_of(polyline(R"({"t":0,"points":[[0,0,0],[1,0,1e999]]})"));
  error_of(polyline(R"({"t":0,"points":[[0,0,0],[1,0,NaN]]})"));
  expect_error(polyline(R"({"t":0,"points":[[0,0,0],[1,0,0]]},{"t":1,"points":[[0,0,0],[1,0,0],[2,0,0]]})"),
               "strokes[0].edges[1].points has 3 points, but the first time has 2");
}

TEST(BladeFile, refuses_times_that_do_not_increase) {
  const std::string at_one = R"({"t":1,"points":[[0,0,0],[1,0,0]]})";
  expect_error(polyline(at_one + "," + at_one), "strokes[0].edges[1].t must be later");
  expect_error(rigid("[[0,0,0],[1,0,0]]", pose("1", "[0,0,0]", "[1,0,0,0]") + "," + pose("0", "[0,0,0]", "[1,0,0,0]")),
               "strokes[0].poses[1].t must be later");
}

TEST(BladeFile, refuses_bad_poses) {
  const std::string edge = "[[0,0,0],[1,0,0]]";
  expect_error(rigid(edge, pose("0", "[0,0,0]", "[1,0,0,0.01]")), "strokes[0].poses[0].orientation has length");
  expect_error(rigid(edge, pose("0", "[0,0,0]", "[0,0,0,0]")), "orientation has length 0");
  expect_error(rigid(edge, pose("0", "[0,0,0]", "[1,0,0]")), "orientation must be an array of 4 numbers");
  expect_error(rigid(edge, pose("0", "[0,null,0]", "[1,0,0,0]")), "position[1] must be a finite number");
  expect_error(rigid("[[1e308,0,0],[1,0,0]]", pose("0", "[1e308,0,0]", "[1,0,0,0]")), "out of the range");
  EXPECT_TRUE(parse_blade(rigid(edge, pose("0", "[0,0,0]", "[1.0000005,0,0,0]")), "b").ok());
}

TEST(BladeFile, names_lines_and_files) {
  expect_error("{\"format\":\"incise-blade\",\n\"version\":1,\n\"strokes\":[{\"edges\":[],\n\"x\":1}]}", "b.json:4:");
  const auto missing = app::read_blade("no/such/blade.json");
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message.find("no/such/blade.json: no such file"), std::string::npos);
  const auto folder = app::read_blade(INCISE_SCENES);
  ASSERT_FALSE(folder.ok());
  EXPECT_NE(folder.error().message.find("is a folder"), std::string::npos);
}

TEST(BladeFile, strokes_may_stop_at_regions) {
  const std::string edges = R"("edges":[{"t":0,"points":[[0,0,0],[1,0,0]]},{"t":1,"points":[[0,1,0],[1,1,0]]}])";
  const std::string text = kHead + "{" + edges + R"(},{"name":"deep","stop_at":["fat",3],)" + edges + "}" + kTail;
  const auto blade = app::parse_blade_file(text, "b.json");
  ASSERT_TRUE(blade.ok()) << blade.error().message;
  ASSERT_EQ(blade->size(), 2U);
  EXPECT_TRUE((*blade)[0].stop_at.empty());
  EXPECT_EQ((*blade)[1].stop_at, (std::vector<std::int32_t>{3}));
  EXPECT_EQ((*blade)[1].stop_names, (std::vector<std::string>{"fat"}));
  // Who knows of no regions says so, and does not cut deeper than was asked.
  expect_error(text, "stroke 1 (deep) has stop_at");
  expect_error(kHead + R"({"stop_at":[],)" + edges + "}" + kTail, "stop_at");
  expect_error(kHead + R"({"stop_at":[-1],)" + edges + "}" + kTail, "must be a region's number or its name");
  expect_error(kHead + R"({"stop_at":"fat",)" + edges + "}" + kTail, "stop_at");
}

}  // namespace

}  // namespace blade_file_test
