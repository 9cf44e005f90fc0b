// SPDX-License-Identifier: Apache-2.0
// Simulating with the command: what it writes, what it refuses, and what is left when it is stopped.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "incise/io/mesh_file.h"
#include "support/scene_cases.h"

namespace simulate_test {
namespace {

using namespace incise_test;

class CliSimulate : public testing::Test {
 protected:
  Outcome simulate(std::vector<std::string> more) const {
    more.insert(more.begin(), {"simulate", scene_});
    return run(more);
  }
  Json report_of(std::vector<std::string> more) const {
    more.insert(more.end(), {"--report", "-"});
    const Outcome outcome = simulate(more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.code == 0 ? Json::parse(outcome.out) : Json();
  }

  Folder folder_;
  std::string scene_ = folder_.write("scene.json", full_scene().dump(1));
};

TEST_F(CliSimulate, writes_report_series_and_recording) {
  const Outcome outcome = simulate(
      {"--report", folder_ / "r.json", "-o", folder_ / "out.pvd", "--every", "10", "--record", folder_ / "r.jsonl"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("50 frames, 1 s"), std::string::npos) << outcome.out;
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"out.pvd", "out_frames", "r.json", "r.jsonl", "scene.json"}));
  const Json report = Json::parse(read(folder_ / "r.json"));
  EXPECT_EQ(report["scene"]["frames"], 50);
  EXPECT_EQ(report["validity"]["ok"], true);
  const Outcome again = run({"replay", folder_ / "r.jsonl", "--verify", "-o", folder_ / "end.vtu"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("hash " + report["state_hash"].get<std::string>()), std::string::npos) << again.out;
  EXPECT_EQ(read(folder_ / "end.vtu"), read(folder_ / "out_frames/frame_00005.vtu"));
}

TEST_F(CliSimulate, lets_arguments_go_before_the_scene) {
  const Json plain = report_of({});
  EXPECT_EQ(plain["options"]["seed"].get<std::uint64_t>(), 12345678901234567890U);
  EXPECT_EQ(report_of({"--frames", "7"})["scene"]["frames"], 7);
  EXPECT_EQ(report_of({"--threads", "2"})["state_hash"], plain["state_hash"]);
  const Json other = report_of({"--seed", "5"});  // another jitter
  EXPECT_EQ(other["options"]["seed"], 5);
  EXPECT_NE(other["hash"], plain["hash"]);
  const Json paper = report_of({"--profile", "paper"});
  EXPECT_EQ(paper["options"]["profile"], "paper");
  EXPECT_GT(paper["mesh"]["after"]["tets"], paper["mesh"]["before"]["tets"]);
}

TEST_F(CliSimulate, spends_at_most_a_budget_on_maintenance_and_the_same_every_time) {
  const Json tight = report_of({"--budget-us", "1"});
  EXPECT_EQ(tight["options"]["budget_us"], 1);
  EXPECT_LT(tight["maintain"]["work_units"], report_of({"--budget-us", "100000"})["maintain"]["work_units"]);
  EXPECT_EQ(report_of({"--budget-us", "1"})["state_hash"], tight["state_hash"]);
}

TEST_F(CliSimulate, scores_the_attempt_of_the_scene_and_the_ideal) {
  Json json = full_scene();
  json["materials"] = Json::object();
  json["exercise"]["target"] = {{0.45, 0, 1}, {0.45, 1, 1}};
  json["exercise"]["depth"] = 1;
  json["exercise"].erase("remove");
  json["tools"] = Json::array();
  json["hooks"] = Json::array();
  json["strokes"] = Json::array();
  folder_.write("scene.json", json.dump(1));
  const Json attempt = report_of({})["exercise"];
  EXPECT_EQ(attempt["format"], "incise-exercise-score");
  EXPECT_EQ(attempt["points"], 0);
  EXPECT_EQ(attempt["deductions"][0]["kind"], "nothing");
  const Json ideal = report_of({"--ideal"})["exercise"];
  EXPECT_GT(ideal["points"], 50);
  EXPECT_EQ(ideal["cuts"]["strokes"], 1);
  const Outcome text = simulate({"--ideal", "--record", folder_ / "r.jsonl", "--page", folder_ / "page.html"});
  const std::string page = read(folder_ / "page.html");
  EXPECT_NE(page.find("<h1>a cut</h1>"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(text.out.find("of 100 points"), std::string::npos) << text.out;
  EXPECT_EQ(run({"replay", folder_ / "r.jsonl", "--verify"}).code, 0);
}

TEST_F(CliSimulate, has_no_ideal_where_the_scene_has_none) {
  folder_.write("scene.json", least_scene().dump(1));
  EXPECT_EQ(simulate({"--ideal"}).code, 3);
  EXPECT_NE(simulate({"--ideal"}).err.find("this scene has no exercise.ideal"), std::string::npos);
  EXPECT_FALSE(report_of({}).contains("exercise"));
  const Outcome page = simulate({"--page", folder_ / "page.html"});
  EXPECT_EQ(page.code, 3);
  EXPECT_NE(page.err.find("--page tells how an exercise went; this scene has no exercise"), std::string::npos);
}

TEST_F(CliSimulate, exits_with_2_on_usage) {
  EXPECT_EQ(run({"simulate"}).code, 2);
  EXPECT_EQ(simulate({"--frames", "0"}).code, 2);
  EXPECT_EQ(simulate({"--threads", "0"}).code, 2);
  EXPECT_EQ(simulate({"--profile", "best"}).code, 2);
  EXPECT_NE(simulate({"-o", folder_ / "out.vtu"}).err.find("a simulation is written as .pvd"), std::string::npos);
  EXPECT_EQ(simulate({"-o", folder_ / "out.vtu"}).code, 2);
  EXPECT_EQ(simulate({"--every", "3"}).code, 2);
  EXPECT_EQ(simulate({"--record", scene_}).code, 2);
  EXPECT_EQ(Json::parse(read(scene_)), full_scene());
}

TEST_F(CliSimulate, exits_with_3_on_bad_input_and_names_it) {
  EXPECT_EQ(run({"simulate", folder_ / "none.json"}).code, 3);
  Json scene = full_scene();
  scene["gravty"] = 1;
  folder_.write("scene.json", scene.dump(1));
  const Outcome unknown = simulate({});
  EXPECT_EQ(unknown.code, 3);
  EXPECT_NE(unknown.err.find("has the unknown key \"gravty\""), std::string::npos) << unknown.err;
  scene = full_scene();
  scene["model"] = {{"file", "none.mesh"}};
  folder_.write("scene.json", scene.dump());
  EXPECT_EQ(simulate({}).code, 3);
  scene["model"] = {{"box", {{"cells", {1, 1, 1}}}}};
  scene["attachments"] = {{{"below", {0, 0, 1, -1}}}};
  scene.erase("spare");  // of regions that this box does not have
  folder_.write("scene.json", scene.dump());
  const Outcome loose = simulate({"-o", folder_ / "out.pvd", "--record", folder_ / "r.jsonl"});
  EXPECT_EQ(loose.code, 3);
  EXPECT_NE(loose.err.find("attachments[0] holds no vertex"), std::string::npos) << loose.err;
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"scene.json"});
}

TEST_F(CliSimulate, exits_with_1_where_it_cannot_write) {
  EXPECT_EQ(simulate({"--report", folder_ / "none/r.json"}).code, 1);
  folder_.write("out_frames", "a file in the way");
  const Outcome outcome = simulate({"-o", folder_ / "out.pvd"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("is in the way of the series"), std::string::npos) << outcome.err;
}

TEST_F(CliSimulate, replay_exits_with_4_where_a_frame_differs) {
  ASSERT_EQ(simulate({"--record", folder_ / "r.jsonl"}).code, 0);
  std::string text = read(folder_ / "r.jsonl");
  const std::size_t at = text.find("\"hash\":\"", text.find("\"frame\"")) + 8;
  text[at] = text[at] == '0' ? '1' : '0';
  folder_.write("r.jsonl", text);
  const Outcome outcome = run({"replay", folder_ / "r.jsonl", "--verify"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("r.jsonl:3: the call \"frame\" came out differently"), std::string::npos) << outcome.err;
}

TEST_F(CliSimulate, interrupted_leaves_no_part_of_a_series) {
  Json scene = full_scene();
  scene["model"]["box"]["cells"] = {8, 8, 8};
  scene.erase("duration");
  scene["frames"] = 100000;
  folder_.write("scene.json", scene.dump());
  for (const double seconds : {0.05, 0.3, 0.6}) {
    const Outcome outcome =
        run_interrupted({"simulate", scene_, "-o", folder_ / "out.pvd", "--report", folder_ / "r.json"}, seconds);
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"scene.json"}) << seconds;
  }
  EXPECT_EQ(run_hung_up({"simulate", scene_, "-o", folder_ / "out.pvd"}, 0.6).code, 128 + 1);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"scene.json"});
}

TEST_F(CliSimulate, says_where_its_series_is_and_what_has_no_effect) {
  const Outcome outcome =
      run({"simulate", scene_, "--frames", "1", "--profile", "paper", "--budget-us", "9", "-o", folder_ / "out.pvd"});
  EXPECT_NE(outcome.err.find("--budget-us has no effect with --profile paper"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("(series, with the folder out_frames)"), std::string::npos) << outcome.err;
  EXPECT_EQ(run({"simulate", scene_, "--frames", "1", "--budget-us", "9"}).err.find("no effect"), std::string::npos);
}

TEST_F(CliSimulate, a_gzipped_scene_is_called_so) {
  folder_.write("scene.json.gz", "\x1f\x8b\x08 and so on");
  const Outcome outcome = run({"simulate", folder_ / "scene.json.gz"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("the file is gzipped; gunzip it first"), std::string::npos) << outcome.err;
}

TEST_F(CliSimulate, killed_at_any_moment_leaves_a_recording_that_replays) {
  Json scene = full_scene();
  scene["model"]["box"]["cells"] = {6, 6, 6};
  folder_.write("scene.json", scene.dump());
  for (const double seconds : {0.1, 0.2, 0.3, 0.4}) {
    std::filesystem::remove(folder_ / "r.jsonl");
    const Outcome killed = run_killed({"simulate", scene_, "--record", folder_ / "r.jsonl", "-q"}, seconds);
    ASSERT_TRUE(killed.code == 128 + 9 || killed.code == 0) << killed.err;
    if (!std::filesystem::exists(folder_ / "r.jsonl")) continue;  // it had not begun
    const Outcome again = run({"replay", folder_ / "r.jsonl", "--verify", "-q"});
    EXPECT_EQ(again.code, 0) << again.err;
  }
}

}  // namespace

}  // namespace simulate_test
