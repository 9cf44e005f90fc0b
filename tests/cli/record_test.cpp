// SPDX-License-Identifier: Apache-2.0
// Recording and replaying with the command, and what is left of both when it is killed.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "cli/program.h"

namespace record_test {
namespace {

using namespace incise_test;
using nlohmann::json;

class CliRecord : public testing::Test {
 protected:
  Outcome cut(std::vector<std::string> more) {
    more.insert(more.begin(), {"cut", cube_, "--record", log_, "-o", folder_ / "cut.mesh"});
    return run(more);
  }
  Outcome replay(std::vector<std::string> more) {
    more.insert(more.begin(), {"replay", log_});
    return run(more);
  }

  Folder folder_;
  std::string cube_ = folder_.write("cube.mesh", cube_mesh(4, 0.1));
  std::string log_ = folder_ / "cut.jsonl";
};

TEST_F(CliRecord, replays_to_the_same_mesh) {
  const std::string blade = INCISE_SCENES "/cube_cross.json";
  for (const std::vector<std::string>& way :
       std::vector<std::vector<std::string>>{{"--blade", blade},
                                             {"--blade", blade, "--profile", "paper"},
                                             {"--blade", blade, "--budget-us", "500", "--snap", "0"},
                                             {"--blade", blade, "--no-merge", "--no-improve"},
                                             {"--plane", "1,2,3,2.9", "--seed", "18446744073709551615"}}) {
    const Outcome made = cut(way);
    ASSERT_EQ(made.code, 0) << made.err;
    const Outcome again = replay({"--verify", "-o", folder_ / "again.mesh"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(again.err.find("note"), std::string::npos) << again.err;
    EXPECT_NE(again.out.find("hash "), std::string::npos);
    EXPECT_EQ(read(folder_ / "again.mesh"), read(folder_ / "cut.mesh")) << way[1];
    EXPECT_EQ(replay({"-q"}).out, "");
  }
}

TEST_F(CliRecord, keeps_one_line_per_step_of_a_blade) {
  ASSERT_EQ(cut({"--blade", INCISE_SCENES "/cube_core.json", "--report", folder_ / "r.json"}).code, 0);
  std::istringstream lines(read(log_));
  std::map<std::string, int> calls;
  json call;
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) {
    call = json::parse(line);
    ++calls[call["call"]];
  }
  const json report = json::parse(read(folder_ / "r.json"));
  EXPECT_EQ(calls["step"], report["cut"]["steps"]);
  EXPECT_EQ(calls["begin"], report["strokes"]);
  EXPECT_EQ(calls["end"], report["strokes"]);
  EXPECT_EQ(calls["maintain"], report["strokes"]);
  EXPECT_EQ(calls["cut"], 0);
  EXPECT_EQ(call["hash"], report["hash"]);
}

TEST_F(CliRecord, exits_with_4_where_a_hash_differs) {
  ASSERT_EQ(cut({"--plane", "1,0,0,0.4"}).code, 0);
  std::string text = read(log_);
  const std::size_t at = text.find("\"hash\":\"", text.find("\"cut\"")) + 8;
  text[at] = text[at] == '0' ? '1' : '0';
  folder_.write("cut.jsonl", text);
  const Outcome verified = replay({"--verify", "-o", folder_ / "again.mesh"});
  EXPECT_EQ(verified.code, 4);
  EXPECT_NE(
      verified.err.find("cut.jsonl:2: the call \"cut\" came out differently: expected hash " + text.substr(at, 16)),
      std::string::npos)
      << verified.err;
  EXPECT_EQ(replay({}).code, 0);  // the end is as it was
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"cube.mesh", "cut.jsonl", "cut.mesh"}));
}

TEST_F(CliRecord, exits_with_3_on_what_is_no_recording) {
  EXPECT_EQ(replay({}).code, 3);
  EXPECT_EQ(run({"replay", cube_}).code, 3);
  ASSERT_EQ(cut({"--plane", "1,0,0,0.4"}).code, 0);
  folder_.write("cube.mesh", cube_mesh(4));
  const Outcome outcome = replay({"--verify"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("is not the mesh of the recording"), std::string::npos) << outcome.err;
  EXPECT_EQ(replay({"-o", folder_ / "again.xyz"}).code, 2);
  EXPECT_EQ(replay({"-o", folder_ / "none/again.mesh"}).code, 1);
  EXPECT_EQ(run({"replay"}).code, 2);
}

TEST_F(CliRecord, tells_of_a_log_that_was_cut_off) {
  ASSERT_EQ(cut({"--blade", INCISE_SCENES "/cube_cross.json"}).code, 0);
  const std::string text = read(log_);
  folder_.write("cut.jsonl", text.substr(0, text.find("\"call\":\"end\"") + 3));
  const Outcome outcome = replay({"--verify"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("the recording is cut off"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("a stroke is still under way"), std::string::npos) << outcome.err;
}

TEST_F(CliRecord, keeps_an_old_recording_when_a_run_fails_before_it_cuts) {
  ASSERT_EQ(cut({"--plane", "1,0,0,0.4"}).code, 0);
  const std::string old = read(log_);
  EXPECT_EQ(cut({"--blade", folder_ / "none.json"}).code, 3);
  EXPECT_EQ(cut({"--plane", "0,0,0,1"}).code, 2);
  EXPECT_EQ(run({"cut", folder_ / "none.mesh", "--plane", "1,0,0,0.4", "--record", log_}).code, 3);
  EXPECT_EQ(read(log_), old);
}

TEST_F(CliRecord, does_not_write_over_other_files_of_the_command) {
  const std::string before = read(cube_);
  for (const std::string& file : {cube_, folder_ / "./cube.mesh", folder_ / "out.mesh", folder_ / "./out.mesh"}) {
    const Outcome outcome = run({"cut", cube_, "--plane", "1,0,0,0.4", "--record", file, "-o", folder_ / "out.mesh"});
    EXPECT_EQ(outcome.code, 2) << file;
    EXPECT_NE(outcome.err.find("give it a name of its own"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(read(cube_), before);
  const Outcome outcome = run({"cut", cube_, "--plane", "1,0,0,0.4", "--record", folder_ / "none/r.jsonl"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("folder does not exist"), std::string::npos) << outcome.err;
}

/// A blade that goes through the unit cube in many steps.
std::string slow_blade(int steps) {
  json edges = json::array();
  for (int i = 0; i <= steps; ++i) {
    const double x = -0.2 + 1.4 * i / steps;
    edges.push_back({{"t", i}, {"points", {{x, 0.4 + 0.1 * x, -0.5}, {x, 0.45, 0.5}, {x, 0.43, 1.5}}}});
  }
  return json({{"format", "incise-blade"}, {"version", 1}, {"strokes", {{{"edges", edges}}, {{"edges", edges}}}}})
      .dump();
}

int kill_rounds() {
  const char* rounds = std::getenv("INCISE_KILL_ROUNDS");
  return rounds == nullptr ? 30 : std::atoi(rounds);
}

TEST_F(CliRecord, killed_at_any_moment_leaves_a_log_that_replays_and_no_partial_mesh) {
  const std::string cube = folder_.write("cube.mesh", cube_mesh(14));
  const std::string blade = folder_.write("blade.json", slow_blade(60));
  const std::string out = folder_ / "cut.mesh";
  const std::vector<std::string> cut = {"cut", cube, "--blade", blade, "-q", "--record", log_, "-o", out};
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(run(cut).code, 0);
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string whole_log = read(log_);
  const std::string whole_mesh = read(out);
  std::mt19937_64 random(11);
  int cut_short = 0;
  for (int round = 0; round < kill_rounds(); ++round) {
    std::filesystem::remove(log_);
    std::filesystem::remove(out);
    const double delay = 1.1 * whole_s * static_cast<double>(random() >> 11U) * 0x1p-53;
    const Outcome killed = run_killed(cut, delay);
    ASSERT_TRUE(killed.code == 128 + 9 || killed.code == 0) << killed.err;
    if (std::filesystem::exists(out)) {
      EXPECT_EQ(read(out), whole_mesh) << round;
    }
    if (!std::filesystem::exists(log_)) continue;  // it had not cut yet
    const std::string log = read(log_);
    ASSERT_EQ(log, whole_log.substr(0, log.size())) << round;  // not a byte that would not have been there
    cut_short += log.size() < whole_log.size() ? 1 : 0;
    const Outcome again = replay({"--verify", "-q"});
    ASSERT_EQ(again.code, 0) << round << again.err;
  }
  EXPECT_GT(cut_short, kill_rounds() / 10);
  RecordProperty("killed_while_recording", cut_short);
}

}  // namespace

}  // namespace record_test
