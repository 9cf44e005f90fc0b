// SPDX-License-Identifier: Apache-2.0
#include "app/hands/haply_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

namespace haply_messages_test {
namespace {

using namespace incise;
using app::haply_force;
using app::parse_haply;

const std::string kState =
    R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0.01,"y":-0.2,"z":0.15},)"
    R"("cursor_velocity":{"x":0,"y":0.5,"z":-1e-3}}},{"device_id":"1234","state":{"cursor_position":)"
    R"({"x":1,"y":2,"z":3}}}],"wireless_verse_grip":[{"device_id":"9A","state":{"orientation":)"
    R"({"x":0,"y":0,"z":2,"w":0},"buttons":{"a":true,"b":false,"c":true}}}]})";

TEST(HaplyMessages, AStateHasPlaceSpeedTurnAndButtons) {
  const auto reading = parse_haply(kState, "");
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->device, "\"049D\"");
  EXPECT_EQ(reading->state.position, Vec3(0.01, -0.2, 0.15));
  EXPECT_EQ(reading->state.velocity, Vec3(0, 0.5, -1e-3));
  EXPECT_TRUE(reading->state.orientation.isApprox(Eigen::Quaterniond(0, 0, 0, 1)));
  EXPECT_EQ(reading->state.buttons, 5U);
  EXPECT_TRUE(reading->has_grip);
  const auto other = parse_haply(kState, "\"1234\"");
  ASSERT_TRUE(other);
  EXPECT_EQ(other->state.position, Vec3(1, 2, 3));
  EXPECT_EQ(other->state.velocity, Vec3(0, 0, 0));
  EXPECT_FALSE(parse_haply(kState, "\"5678\""));
}

TEST(HaplyMessages, WhatIsMissingOrOfAnotherKindIsNoState) {
  for (const char* text :
       {"", "{", "null", "[]", "3", R"({"inverse3":{}})", R"({"inverse3":[]})", R"({"inverse3":[7]})",
        R"({"inverse3":[{"device_id":"a"}]})", R"({"inverse3":[{"device_id":"a","state":[]}]})",
        R"({"inverse3":[{"device_id":"a","state":{"cursor_position":{"x":0,"y":0}}}]})",
        R"({"inverse3":[{"device_id":"a","state":{"cursor_position":{"x":0,"y":0,"z":"0"}}}]})",
        R"({"inverse3":[{"device_id":"a","state":{"cursor_position":{"x":0,"y":0,"z":1e999}}}]})",
        R"({"inverse3":[{"state":{"cursor_position":{"x":0,"y":0,"z":0}}}]})",
        R"({"inverse3":[{"device_id":"","state":{"cursor_position":{"x":0,"y":0,"z":0}}}]})",
        R"({"inverse3":[{"device_id":null,"state":{"cursor_position":{"x":0,"y":0,"z":0}}}]})",
        R"({"inverse3":[{"device_id":[7],"state":{"cursor_position":{"x":0,"y":0,"z":0}}}]})"}) {
    EXPECT_FALSE(parse_haply(text, "")) << text;
  }
}

TEST(HaplyMessages, AGripThatMakesNoSenseTurnsNothing) {
  for (const char* grip :
       {"{}", R"({"state":7})", R"({"state":{"orientation":{"x":0,"y":0,"z":0,"w":0}}})",
        R"({"state":{"orientation":"up","buttons":[true]}})", R"({"state":{"buttons":{"a":1,"b":"yes"}}})"}) {
    const std::string text =
        R"({"inverse3":[{"device_id":7,"state":{"cursor_position":{"x":0,"y":0,"z":0}}}],"verse_grip":[)" +
        std::string(grip) + "]}";
    const auto reading = parse_haply(text, "");
    ASSERT_TRUE(reading) << grip;
    EXPECT_EQ(reading->device, "7");
    EXPECT_TRUE(reading->state.orientation.isApprox(Eigen::Quaterniond::Identity())) << grip;
    EXPECT_EQ(reading->state.buttons, 0U) << grip;
  }
}

TEST(HaplyMessages, StatesThatAreCutOffOrSpoiledAreReadOrRefused) {
  for (std::size_t end = 0; end < kState.size(); ++end) EXPECT_FALSE(parse_haply(kState.substr(0, end), "")) << end;
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text = kState;
    for (int i = 0; i < 1 + round % 4; ++i) text[random() % text.size()] = static_cast<char>(random());
    const auto reading = parse_haply(text, "");
    refused += reading ? 0 : 1;
    if (!reading) continue;
    ASSERT_TRUE(reading->state.position.allFinite() && reading->state.velocity.allFinite()) << text;
    ASSERT_NEAR(reading->state.orientation.norm(), 1, 1e-9) << text;
    ASSERT_FALSE(haply_force(reading->device, Vec3::Zero()).empty());
  }
  EXPECT_GT(refused, 5000);
}

TEST(HaplyMessages, ForcesAreNumbersAlways) {
  const auto force = nlohmann::json::parse(haply_force("\"049D\"", Vec3(1.5, -2, 1e-9)));
  const auto& arm = force.at("inverse3").at(0);
  EXPECT_EQ(arm.at("device_id"), "049D");
  EXPECT_EQ(arm.at("commands").at("set_cursor_force").at("values"),
            nlohmann::json({{"x", 1.5}, {"y", -2.0}, {"z", 1e-9}}));
  const auto none = nlohmann::json::parse(haply_force(R"("a\"b")", Vec3(std::nan(""), 1, 1)));
  EXPECT_EQ(none.at("inverse3").at(0).at("device_id"), "a\"b");
  EXPECT_EQ(none.at("inverse3").at(0).at("commands").at("set_cursor_force").at("values").at("y"), 0);
  // To whom an id is a number a text is nobody.
  EXPECT_EQ(nlohmann::json::parse(haply_force("7", Vec3::Zero())).at("inverse3").at(0).at("device_id"), 7);
  EXPECT_TRUE(nlohmann::json::parse(haply_force("", Vec3::Zero())).at("inverse3").at(0).at("device_id").is_null());
}

}  // namespace

}  // namespace haply_messages_test
