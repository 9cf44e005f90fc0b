// SPDX-License-Identifier: Apache-2.0
// Batches by the command: workers that are killed, and what the exit codes say.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "cli/program.h"

namespace batch_test {
namespace {

using namespace incise_test;
using nlohmann::json;
namespace fs = std::filesystem;

class CliBatch : public testing::Test {
 protected:
  explicit CliBatch(int items = 6, unsigned cells = 3) : items_(items) {
    folder_.write("cube.mesh", cube_mesh(cells, 0.1));
    const json plan = {
        {"format", "incise-plan"},
        {"version", 1},
        {"items",
         {{{"name", "c"}, {"mesh", "cube.mesh"}, {"repeat", items}, {"random", {{"seed", 11}, {"strokes", 2}}}}}}};
    plan_ = folder_.write("plan.json", plan.dump());
  }
  [[nodiscard]] std::vector<std::string> batch(const std::string& out, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"batch", plan_, "-o", folder_ / out});
    return more;
  }
  /// All that a batch has written, but for the files of its shards.
  [[nodiscard]] std::map<std::string, std::string> results(const std::string& out) const {
    std::map<std::string, std::string> files;
    for (const auto& at : fs::recursive_directory_iterator(folder_ / out)) {
      const std::string name = fs::relative(at.path(), folder_ / out).string();
      if (at.is_regular_file() && name.rfind("shard-", 0) != 0) files[name] = read(at.path());
    }
    return files;
  }
  [[nodiscard]] std::size_t lines(const std::string& out) const {
    const std::string text = read(folder_ / (out + "/shard-00000-of-00001.jsonl"));
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  int items_;
  Folder folder_;
  std::string plan_;
};

class CliBatchKilled : public CliBatch {
 protected:
  CliBatchKilled() : CliBatch(60, 5) {}
};

TEST_F(CliBatchKilled, five_times_ends_as_if_it_had_not_been) {
  const auto began = std::chrono::steady_clock::now();
  ASSERT_EQ(run(batch("whole")).code, 0);
  const double whole_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  ASSERT_EQ(run(batch("whole", {"--merge"})).code, 0);
  const unsigned seed = std::random_device()();
  std::mt19937 random(seed);
  SCOPED_TRACE("seed " + std::to_string(seed));
  int killed = 0;
  std::size_t done = 0;
  for (int tries = 0; tries < 40 && killed < 5; ++tries) {
    if (done + 5 > static_cast<std::size_t>(items_)) {  // too little is left to be killed at: begin anew
      fs::remove_all(folder_ / "out");
      done = 0;
    }
    const double seconds = std::uniform_real_distribution<double>(0.02, whole_seconds / 4)(random);
    const Outcome outcome = run_killed(batch("out"), seconds);
    killed += outcome.code == 128 + 9 ? 1 : 0;
    const std::size_t now = fs::exists(folder_ / "out") ? lines("out") : 0;
    EXPECT_GE(now, done);
    done = now;
  }
  EXPECT_EQ(killed, 5);
  const Outcome last = run(batch("out", {"--json"}));
  ASSERT_EQ(last.code, 0) << last.err;
  const json report = json::parse(last.out);
  EXPECT_EQ(report["skipped"], done);
  EXPECT_EQ(report["done"], items_ - static_cast<int>(done));
  ASSERT_EQ(run(batch("out", {"--merge"})).code, 0);
  const auto whole = results("whole");
  EXPECT_EQ(whole.size(), 2U + 2U * static_cast<std::size_t>(items_));
  EXPECT_EQ(results("out"), whole);
}

TEST_F(CliBatch, shards_may_be_counted_either_way) {
  ASSERT_EQ(run(batch("whole")).code, 0);
  ASSERT_EQ(run(batch("whole", {"--merge"})).code, 0);
  for (const char* shard : {"1/3", "2/3", "3/3"}) EXPECT_EQ(run(batch("from_1", {"--shard", shard})).code, 0);
  for (const char* shard : {"0/2", "1/2"}) EXPECT_EQ(run(batch("from_0", {"--shard", shard})).code, 0);
  for (const char* out : {"from_0", "from_1"}) {
    EXPECT_EQ(run(batch(out, {"--merge"})).code, 0);
    EXPECT_EQ(results(out), results("whole"));
  }
  for (const char* shard : {"7/3", ""}) EXPECT_EQ(run(batch("whole", {"--shard", shard})).code, 2) << shard;
}

TEST_F(CliBatch, a_task_of_a_slurm_array_takes_its_part) {
  const std::vector<std::pair<const char*, const char*>> variables = {{"SLURM_ARRAY_TASK_ID", "5"},
                                                                      {"SLURM_ARRAY_TASK_MIN", "4"},
                                                                      {"SLURM_ARRAY_TASK_MAX", "6"},
                                                                      {"SLURM_ARRAY_TASK_STEP", "1"},
                                                                      {"SLURM_ARRAY_TASK_COUNT", "3"}};
  for (const auto& [name, value] : variables) setenv(name, value, 1);
  const Outcome outcome = run(batch("out"));
  const Outcome asked = run(batch("asked", {"--shard", "0/3"}));
  for (const auto& [name, value] : variables) unsetenv(name);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(folder_ / "out/shard-00001-of-00003.jsonl"));
  EXPECT_TRUE(fs::exists(folder_ / "asked/shard-00000-of-00003.jsonl"));
}

TEST_F(CliBatch, exits_with_4_where_something_is_missing_or_differs) {
  ASSERT_EQ(run(batch("out", {"--shard", "0/2"})).code, 0);
  Outcome outcome = run(batch("out", {"--merge"}));
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("missing: c-0001"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out/results.jsonl"));
  EXPECT_EQ(run(batch("out", {"--verify", "2"})).code, 0);
  std::string text = read(folder_ / "out/shard-00000-of-00002.jsonl");
  for (std::size_t at = 0; (at = text.find(",\"hash\":\"", at)) != std::string::npos; ++at) text[at + 9] = '0';
  folder_.write("out/shard-00000-of-00002.jsonl", text);
  outcome = run(batch("out", {"--verify", "3", "--json"}));
  EXPECT_EQ(outcome.code, 4);
  EXPECT_GE(json::parse(outcome.out)["differences"]["count"], 2);
}

TEST_F(CliBatch, says_what_cannot_be) {
  EXPECT_EQ(run(batch("none", {"--merge"})).code, 3);
  EXPECT_EQ(run(batch("none/none")).code, 1);
  EXPECT_EQ(run(batch("out", {"--merge", "--shard", "0/2"})).code, 2);
  EXPECT_EQ(run(batch("out", {"--verify", "0"})).code, 2);
  EXPECT_EQ(run(batch("plan.json")).code, 1);
  folder_.write("plan.json", R"({"format": "incise-plan", "version": 1, "items": [{"mesh": "none.mesh"}]})");
  const Outcome outcome = run(batch("out"));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("plan.json:1: items[0] needs one of the keys plane, blade, random"), std::string::npos)
      << outcome.err;
}

/// As on a disk that is full: a line, a mesh and strokes that cannot be written to their ends.
TEST_F(CliBatch, goes_on_where_a_disk_was_full) {
  ASSERT_EQ(run(batch("whole")).code, 0);
  ASSERT_EQ(run(batch("whole", {"--merge"})).code, 0);
  for (const unsigned long bytes : {500UL, 1500UL, 4000UL}) {
    const std::string out = "out-" + std::to_string(bytes);
    const Outcome outcome = run_limited(batch(out), bytes);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("cannot be written"), std::string::npos) << outcome.err;
    EXPECT_EQ(run(batch(out)).code, 0);
    EXPECT_EQ(run(batch(out, {"--merge"})).code, 0);
    EXPECT_EQ(results(out), results("whole")) << bytes;
  }
}

TEST_F(CliBatch, an_interrupt_leaves_whole_files_and_lines) {
  ASSERT_EQ(run(batch("whole")).code, 0);
  const Outcome outcome = run_interrupted(batch("out"), 0.1);
  EXPECT_TRUE(outcome.code == 130 || outcome.code == 0) << outcome.code;
  ASSERT_EQ(run(batch("out")).code, 0);
  EXPECT_EQ(results("out"), results("whole"));
}

}  // namespace

}  // namespace batch_test
