// SPDX-License-Identifier: Apache-2.0
// Tools under a hand that spare regions: "spare" of a scene.
#include <gtest/gtest.h>

#include <string>

#include "app/jobs/replay_job.h"
#include "app/scene/scene.h"
#include "app/session/session.h"
#include "support/folder.h"
#include "support/strokes.h"

namespace incise::app::session_spare_test {
namespace {

/// A block of 8 cm, region 2 below 3 cm and region 1 above, held at its bottom.
std::string block(const std::string& spare) {
  return R"({"format": "incise-scene", "version": 1, "length_unit": 0.01, "gravity": [0, 0, 0],
    "model": {"box": {"cells": [8, 8, 8], "size": [8, 8, 8]}, "regions": [{"region": 1, "below": [0, 0, -1, 0]},
                                                                     {"region": 2, "below": [0, 0, 1, 3]}]},
    "attachments": [{"below": [0, 0, 1, 0.1]}])" +
         spare + "}";
}

Session open(const std::string& spare) {
  return Session::open(parse_scene(block(spare), "block.json").value()).value();
}

/// Walls of cuts on tets of a region.
std::size_t walls_in(const TetMesh& mesh, std::int32_t region) {
  std::size_t walls = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (const Link link : mesh.links(tet)) {
      if (mesh.region(tet) == region && link.is_boundary() && link.tag() > 0) ++walls;
    }
  });
  return walls;
}

/// A blade that hangs into the block from above, down to 1 cm, and goes through it along y.
std::vector<Vec3> edge_at(double y) {
  return {Vec3(4.03, y, 9), Vec3(4.03, y, 6.3), Vec3(4.03, y, 3.6), Vec3(4.03, y, 1)};
}

void cut_by_hand(Session& session) {
  HandState hands;
  for (double y = -1; y < 9; y += 0.4) {
    hands.blade = BladePose{edge_at(y)};
    ASSERT_TRUE(session.frame(hands).ok());
  }
  ASSERT_TRUE(session.frame().ok());
}

TEST(SessionSpare, a_hand_cuts_all_where_nothing_is_spared) {
  Session session = open("");
  cut_by_hand(session);
  EXPECT_GT(walls_in(session.mesh(), 1), 0U);
  EXPECT_GT(walls_in(session.mesh(), 2), 0U);
}

TEST(SessionSpare, a_hand_does_not_cut_what_its_tool_spares) {
  Session session = open(R"(, "spare": [{"tool": "scalpel", "stop_at": [2]}])");
  cut_by_hand(session);
  EXPECT_GT(walls_in(session.mesh(), 1), 0U);
  EXPECT_EQ(walls_in(session.mesh(), 2), 0U);
}

TEST(SessionSpare, other_tools_are_not_held) {
  Session session = open(R"(, "spare": [{"tool": "scissors", "stop_at": [2]}])");
  cut_by_hand(session);
  EXPECT_GT(walls_in(session.mesh(), 2), 0U);
}

TEST(SessionSpare, scissors_spare_what_they_are_told) {
  for (const std::string& tool : {std::string(), std::string(R"("tool": "scissors", )")}) {
    Session session = open(R"(, "spare": [{)" + tool + R"("stop_at": [2]}])");
    Stroke closing = test::quad_stroke(Vec3(4.03, -1, 9), Vec3(4.03, 5, 12), Vec3(4.03, -1, 9), Vec3(4.03, 5, 0.5), 8);
    for (std::size_t i = 0; i < closing.times.size(); ++i) closing.times[i] = 0.05 * static_cast<double>(i);
    session.follow(closing, ToolKind::kScissors);
    while (session.is_following()) ASSERT_TRUE(session.frame().ok());
    EXPECT_GT(walls_in(session.mesh(), 1), 0U);
    EXPECT_EQ(walls_in(session.mesh(), 2), 0U);
  }
}

TEST(SessionSpare, a_blade_that_begins_in_what_it_spares_cuts_once_it_is_out) {
  Session session = open(R"(, "spare": [{"stop_at": [2]}])");
  HandState hands;
  for (int i = 0; i <= 40; ++i) {  // it comes up out of region 2
    const double z = 1 + 0.15 * i;
    hands.blade = BladePose{{Vec3(4.03, -1, z), Vec3(4.03, 4, z), Vec3(4.03, 9, z)}};
    ASSERT_TRUE(session.frame(hands).ok());
  }
  EXPECT_EQ(walls_in(session.mesh(), 2), 0U);
  EXPECT_GT(walls_in(session.mesh(), 1), 0U);
  std::size_t notices = 0;
  for (const Operation& o : session.log().operations()) notices += o.kind == Operation::Kind::kNotice ? 1U : 0U;
  EXPECT_EQ(notices, 1U);
}

TEST(SessionSpare, a_recording_plays_to_the_same_state) {
  const incise_test::Folder folder;
  Session session = open(R"(, "spare": [{"tool": "scalpel", "stop_at": [2]}])");
  cut_by_hand(session);
  const std::string file = folder / "spared.jsonl";
  ASSERT_TRUE(session.save_recording(file).ok());
  const Result<ReplayResult> played = run_replay({file, true});
  ASSERT_TRUE(played.ok()) << played.error().message;
  EXPECT_FALSE(played->difference.has_value());
}

TEST(SessionSpare, scenes_are_written_with_it_and_say_what_is_wrong) {
  const std::string spare = R"(, "spare": [{"tool": "plane cut", "stop_at": [2, "liver"]}, {"stop_at": ["vessel"]}])";
  const Result<Scene> scene = parse_scene(block(spare), "block.json");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const Result<Scene> again = parse_scene(to_json(*scene), "again.json");
  ASSERT_TRUE(again.ok()) << again.error().message;
  ASSERT_EQ(again->spare.size(), 2U);
  EXPECT_EQ(again->spare[0].tool, ToolKind::kPlaneCut);
  EXPECT_EQ(again->spare[0].stop_at, std::vector<std::int32_t>{2});
  EXPECT_EQ(again->spare[0].stop_names, std::vector<std::string>{"liver"});
  EXPECT_EQ(again->spare[1].tool, std::nullopt);
  const auto message = [](const std::string& wrong) {
    const Result<Scene> read = parse_scene(block(wrong), "block.json");
    return read.ok() ? std::string() : read.error().message;
  };
  EXPECT_NE(message(R"(, "spare": [{"tool": "hammer", "stop_at": [2]}])")
                .find("must be one of scalpel, plane cut, scissors, punch"),
            std::string::npos);
  EXPECT_NE(message(R"(, "spare": [{"tool": "forceps", "stop_at": [2]}])").find("must be one of"), std::string::npos);
  EXPECT_NE(message(R"(, "spare": [{"tool": "scalpel"}])").find("names no regions"), std::string::npos);
  EXPECT_NE(message(R"(, "spare": [{"stop_at": [2], "depth": 1}])").find("depth"), std::string::npos);
  const Result<Session> opened = Session::open(parse_scene(block(spare), "block.json").value());
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(opened.error().message.find("liver"), std::string::npos) << opened.error().message;
}

}  // namespace
}  // namespace incise::app::session_spare_test
