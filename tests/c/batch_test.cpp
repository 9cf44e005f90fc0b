// SPDX-License-Identifier: Apache-2.0
// Batches through the C interface.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "c/handle.h"
#include "incise/c/incise.h"
#include "support/folder.h"

namespace batch_test {
namespace {

constexpr const char* kPlan =
    R"({"format":"incise-plan","version":1,"name":"boxes","output":{"mesh":null,"before":false},
  "defaults":{"scene":{"format":"incise-scene","version":1,"length_unit":0.1,"model":{"box":{"cells":[3,3,3]}},"frames":3}},
  "items":[{"name":"cut","repeat":3,"random":{"seed":1,"seconds":0.05,"start":0}}]})";

struct Plan {
  incise_plan* plan = nullptr;
  Plan() { EXPECT_EQ(incise_plan_parse(kPlan, nullptr, &plan), INCISE_OK) << incise_last_error(); }
  ~Plan() { EXPECT_EQ(incise_plan_free(plan), INCISE_OK); }
};

/// The report of a call, as JSON.
struct Report {
  nlohmann::json json;
  static void keep(void* user, const char* text) { static_cast<Report*>(user)->json = nlohmann::json::parse(text); }
};

incise_batch_options options(std::uint32_t index, std::uint32_t count) {
  incise_batch_options all{};
  EXPECT_EQ(incise_default_batch_options(&all, sizeof all), INCISE_OK);
  all.shard_index = index;
  all.shard_count = count;
  return all;
}

TEST(CBatch, APlanTellsItsItems) {
  const Plan plan;
  std::uint64_t count = 0;
  ASSERT_EQ(incise_plan_count(plan.plan, &count), INCISE_OK);
  EXPECT_EQ(count, 3U);
  char name[9];
  ASSERT_EQ(incise_plan_name(plan.plan, 2, name, sizeof name, &count), INCISE_OK);
  EXPECT_STREQ(name, "cut-0002");
  EXPECT_EQ(count, 9U);
  ASSERT_EQ(incise_plan_name(plan.plan, 2, name, 4, nullptr), INCISE_OK);
  EXPECT_STREQ(name, "cut");
  EXPECT_EQ(incise_plan_name(plan.plan, 3, name, sizeof name, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_NE(std::string(incise_last_error()).find("3 items"), std::string::npos);
}

TEST(CBatch, ShardsMergeAndVerify) {
  const Plan plan;
  const incise_test::Folder folder;
  const std::string out = folder / "out";
  Report report;
  for (const std::uint32_t shard : {0U, 1U}) {
    const incise_batch_options half = options(shard, 2);
    ASSERT_EQ(incise_batch_run(plan.plan, out.c_str(), &half, Report::keep, &report), INCISE_OK) << incise_last_error();
    EXPECT_EQ(report.json["done"], shard == 0 ? 2 : 1);
    EXPECT_EQ(report.json["stopped"], false);
  }
  ASSERT_EQ(incise_batch_merge(plan.plan, out.c_str(), Report::keep, &report), INCISE_OK) << incise_last_error();
  EXPECT_EQ(report.json["ok"], true);
  incise_batch_options all = options(0, 1);
  all.verify_items = 3;
  ASSERT_EQ(incise_batch_verify(plan.plan, out.c_str(), &all, Report::keep, &report), INCISE_OK);
  EXPECT_EQ(report.json["items"], 3);
  EXPECT_EQ(report.json["ok"], true);
  EXPECT_EQ(incise_batch_run(plan.plan, out.c_str(), nullptr, nullptr, nullptr), INCISE_OK);
}

TEST(CBatch, CallbacksSeeHowFarItIsAndEndIt) {
  struct Seen {
    std::vector<std::uint64_t> done;
    int asked_after_the_end = -1;
  } seen;
  const Plan plan;
  const incise_test::Folder folder;
  incise_batch_options all = options(0, 1);
  all.user = &seen;
  all.progress = [](void* user, std::uint64_t done, std::uint64_t) { static_cast<Seen*>(user)->done.push_back(done); };
  all.should_stop = [](void* user) -> std::int32_t {
    auto* told = static_cast<Seen*>(user);
    const bool stops = told->done.size() >= 2;
    told->asked_after_the_end += stops ? 1 : 0;
    return stops ? 1 : 0;
  };
  Report report;
  ASSERT_EQ(incise_batch_run(plan.plan, (folder / "out").c_str(), &all, Report::keep, &report), INCISE_OK);
  EXPECT_EQ(report.json["stopped"], true);
  EXPECT_EQ(report.json["done"], 1);
  ASSERT_GE(seen.done.size(), 2U);
  EXPECT_EQ(seen.done[0], 0U);
  EXPECT_EQ(seen.done.back(), 1U);
  EXPECT_EQ(seen.asked_after_the_end, 0);
}

TEST(CBatch, APlanMayBeFreedWhileABatchRuns) {
  incise_plan* plan = nullptr;
  ASSERT_EQ(incise_plan_parse(kPlan, nullptr, &plan), INCISE_OK) << incise_last_error();
  const incise_test::Folder folder;
  incise_batch_options all = options(0, 1);
  all.user = &plan;
  all.progress = [](void* user, std::uint64_t, std::uint64_t) {
    auto* handle = static_cast<incise_plan**>(user);
    EXPECT_EQ(incise_plan_free(std::exchange(*handle, nullptr)), INCISE_OK);
  };
  Report report;
  ASSERT_EQ(incise_batch_run(plan, (folder / "out").c_str(), &all, Report::keep, &report), INCISE_OK);
  EXPECT_EQ(plan, nullptr);
  EXPECT_EQ(report.json["done"], 3);
}

TEST(CBatch, WhatIsNoPlanOrNoShardIsSaid) {
  incise_plan* none = nullptr;
  EXPECT_EQ(incise_plan_parse("{", nullptr, &none), INCISE_BAD_FILE);
  EXPECT_EQ(none, nullptr);
  EXPECT_EQ(incise_plan_read("/nowhere/plan.json", &none), INCISE_BAD_FILE);
  EXPECT_EQ(incise_plan_parse(nullptr, nullptr, &none), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_plan_parse(kPlan, nullptr, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_plan_free(nullptr), INCISE_OK);
  EXPECT_EQ(incise_plan_count(nullptr, nullptr), INCISE_BAD_ARGUMENT);
  const Plan plan;
  EXPECT_EQ(incise_batch_merge(nullptr, "out", nullptr, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_batch_run(plan.plan, nullptr, nullptr, nullptr, nullptr), INCISE_BAD_ARGUMENT);
  for (const auto& [index, count] : {std::pair{1U, 1U}, {0U, 0U}, {0U, 100'000U}}) {
    const incise_batch_options bad = options(index, count);
    EXPECT_EQ(incise_batch_run(plan.plan, "out", &bad, nullptr, nullptr), INCISE_BAD_ARGUMENT);
    EXPECT_NE(std::string(incise_last_error()).find("shard_count"), std::string::npos);
  }
  incise_batch_options bad = options(0, 1);
  bad.threads = 0;
  EXPECT_EQ(incise_batch_verify(plan.plan, "out", &bad, nullptr, nullptr), INCISE_BAD_ARGUMENT);
  bad.size = 3;
  EXPECT_EQ(incise_batch_run(plan.plan, "out", &bad, nullptr, nullptr), INCISE_BAD_ARGUMENT);
}

}  // namespace

}  // namespace batch_test
