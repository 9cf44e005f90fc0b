// SPDX-License-Identifier: Apache-2.0
// A hand at a haptic device in a simulation without a window.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/hands/fake_haply.h"
#include "cli/program.h"

namespace device_test {
namespace {

using namespace incise_test;
using incise::Vec3;
using incise::test::FakeHaply;

/// A block of 10 cm on a table.
std::string block(int frames) {
  return R"({"format":"incise-scene","version":1,"name":"block","length_unit":0.1,
    "model":{"box":{"cells":[8,8,8]}},"materials":{"default":{"young":10000,"toughness":5}},
    "attachments":[{"below":[0,0,1,0.001]}],"frames":)" +
         std::to_string(frames) + "}";
}

/// Down and along.
Vec3 saw(double time) {
  const double down = std::min(time / 0.4, 1.0), along = std::clamp((time - 0.5) / 0.6, 0.0, 1.0);
  return {0.07 * along, 0, -0.035 * down};
}

TEST(CliDevice, ACutByHandIsRecordedAndReplayed) {
  FakeHaply service(saw);
  const Folder folder;
  const std::string scene = folder.write("block.json", block(90));
  const std::string device = "haply=127.0.0.1:" + std::to_string(service.port());
  const Outcome cut = run({"simulate", scene, "--device", device, "--record", folder / "r.jsonl", "--report", "-"});
  ASSERT_EQ(cut.code, 0) << cut.err;
  const nlohmann::json report = nlohmann::json::parse(cut.out);
  EXPECT_TRUE(report["validity"]["ok"]);
  EXPECT_GT(report["cut"]["cut_tets"], 5);
  EXPECT_GT(service.strongest(), 0.01);
  EXPECT_TRUE(service.parting_force().isZero(0));
  const Outcome again = run({"replay", folder / "r.jsonl", "--verify"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find(report["state_hash"].get<std::string>()), std::string::npos) << again.out;
}

TEST(CliDevice, ADeviceThatBreaksOffDoesNotEndTheScene) {
  FakeHaply service(saw);
  const Folder folder;
  const std::string scene = folder.write("block.json", block(60));
  std::atomic<bool> has_ended{false};
  std::thread breaks([&] {
    while (service.forces() < 300 && !has_ended) std::this_thread::yield();
    service.set_fault(FakeHaply::Fault::kSilence);
  });
  const Outcome cut = run({"simulate", scene, "--device", "haply=127.0.0.1:" + std::to_string(service.port())});
  has_ended = true;
  breaks.join();
  EXPECT_GE(service.forces(), 300U);
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_NE(cut.out.find("60 frames"), std::string::npos) << cut.out;
}

TEST(CliDevice, WhatCannotBeIsSaid) {
  const Folder folder;
  const std::string scene = folder.write("block.json", block(5));
  const auto expect = [&](std::vector<std::string> arguments, int code, const char* part) {
    arguments.insert(arguments.begin(), {"simulate", scene});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  };
  expect({"--device", "mouse"}, 2, "haply=HOST:PORT");
  expect({"--device", "haply=:0"}, 2, "no address");
  expect({"--device", "haply", "--device-axes", "x,y"}, 2, "x,-z,y");
  expect({"--device", "haply", "--device-force", "50"}, 2, "--device-force");
  expect({"--device", "haply", "--ideal"}, 2, "--ideal");
  std::uint16_t port = 0;
  { port = FakeHaply(saw).port(); }
  expect({"--device", "haply=127.0.0.1:" + std::to_string(port)}, 1, "start Haply's Inverse Service");
}

}  // namespace

}  // namespace device_test
