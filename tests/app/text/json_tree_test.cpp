// SPDX-License-Identifier: Apache-2.0
#include "app/text/json_tree.h"

#include <gtest/gtest.h>

namespace json_tree_test {
namespace {

using namespace incise;
using app::JsonLimits;
using app::parse_json;

std::string error_of(std::string_view text, const JsonLimits& limits = {}) {
  const auto parsed = parse_json(text, "f.json", limits);
  return parsed.ok() ? "" : parsed.error().message;
}

TEST(JsonTree, keeps_values_keys_and_lines) {
  const auto parsed = parse_json("{\"a\":\n [1, -2.5e3, true, null],\n\n \"b\": \"x\"}", "f.json");
  ASSERT_TRUE(parsed.ok());
  ASSERT_NE(parsed->find("a"), nullptr);
  EXPECT_EQ(parsed->find("a")->items[1].number, -2500);
  EXPECT_EQ(parsed->find("a")->items.size(), 4U);
  EXPECT_EQ(parsed->find("b")->text, "x");
  EXPECT_EQ(parsed->find("b")->line, 4U);
  EXPECT_EQ(parsed->find("c"), nullptr);
}

TEST(JsonTree, names_file_and_line_of_what_it_cannot_read) {
  EXPECT_EQ(error_of("").substr(0, 9), "f.json:1:");
  EXPECT_EQ(error_of("  \n ").substr(0, 9), "f.json:1:");
  EXPECT_EQ(error_of("[1,\n2,\n}").substr(0, 9), "f.json:3:");
  EXPECT_NE(error_of("[NaN]"), "");
  EXPECT_NE(error_of("[1e999]"), "");
  EXPECT_NE(error_of("[1] 2"), "");
  EXPECT_NE(error_of("\"\xff\""), "");
  EXPECT_NE(error_of("{\"a\":1,\n\"a\":2}").find("f.json:2: the key \"a\" occurs twice"), std::string::npos);
}

TEST(JsonTree, keeps_its_limits) {
  JsonLimits limits;
  limits.max_values = 3;
  EXPECT_EQ(error_of("[1,2]", limits), "");
  EXPECT_NE(error_of("[1,2,3]", limits), "");
  limits = {};
  limits.max_bytes = 4;
  EXPECT_NE(error_of("[1,2]", limits), "");
  EXPECT_NE(error_of(std::string(100000, '[')), "");
}

}  // namespace

}  // namespace json_tree_test
