// SPDX-License-Identifier: Apache-2.0
#include "app/viewer/key_bindings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "app/hands/tools.h"

namespace incise::app::key_bindings_test {
namespace {

constexpr std::size_t kActions = static_cast<std::size_t>(Action::kCount);

TEST(KeyBindings, EveryActionHasOne) {
  std::set<Action> bound;
  for (const KeyBinding& binding : key_bindings()) bound.insert(binding.action);
  EXPECT_EQ(bound.size(), kActions);
  for (std::size_t i = 0; i < kActions; ++i) EXPECT_NE(key_of(static_cast<Action>(i)), "") << i;
}

TEST(KeyBindings, NoKeyIsBoundTwice) {
  std::set<std::string> keys;
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_TRUE(keys.insert(to_text(binding.press)).second) << to_text(binding.press);
    EXPECT_EQ(action_of(binding.press), binding.action);
  }
}

TEST(KeyBindings, KeyOfIsTheFirstThatDoesIt) {
  EXPECT_EQ(key_of(Action::kRedo), "Ctrl+Shift+Z");
  EXPECT_EQ(key_of(Action::kPause), "Space");
  EXPECT_EQ(to_text({"Y", true, false}), "Ctrl+Y");
  EXPECT_EQ(to_text({"S", false, true}), "Shift+S");
}

TEST(KeyBindings, OtherKeysAskForNothing) {
  EXPECT_EQ(action_of({""}), std::nullopt);
  EXPECT_EQ(action_of({"F12"}), std::nullopt);
  EXPECT_EQ(action_of({"1", true}), std::nullopt);
  EXPECT_EQ(action_of({"Z"}), std::nullopt);
  EXPECT_EQ(action_of({"Space", false, true}), std::nullopt);
}

TEST(KeyBindings, ToolsAreTheFirstActionsInTheirOrder) {
  for (int tool = 0; tool < static_cast<int>(ToolKind::kCount); ++tool) {
    const std::string name = name_of(static_cast<ToolKind>(tool));
    EXPECT_EQ(key_bindings()[static_cast<std::size_t>(tool)].text.substr(0, name.size()), name);
    EXPECT_EQ(key_bindings()[static_cast<std::size_t>(tool)].action, static_cast<Action>(tool));
  }
}

TEST(KeyBindings, RowsJoinTheKeysOfAnAction) {
  const std::vector<KeyRow> rows = key_rows();
  EXPECT_EQ(rows.size(), kActions);
  const auto redo =
      std::find_if(rows.begin(), rows.end(), [](const KeyRow& row) { return row.text == "Make it again"; });
  ASSERT_NE(redo, rows.end());
  EXPECT_EQ(redo->keys, "Ctrl+Shift+Z, Ctrl+Y");
  for (const KeyRow& row : rows) EXPECT_FALSE(row.group.empty() || row.keys.empty() || row.text.empty());
}

TEST(KeyBindings, GroupsAreTogetherInTheList) {
  std::set<std::string_view> done;
  std::string_view group;
  for (const KeyRow& row : key_rows()) {
    if (row.group != group) {
      EXPECT_TRUE(done.insert(row.group).second) << row.group;
    }
    group = row.group;
  }
  const std::string list = list_of_keys();
  for (const KeyRow& row : key_rows()) {
    EXPECT_NE(list.find("  " + row.keys + " "), std::string::npos) << row.keys;
    EXPECT_NE(list.find(row.text), std::string::npos) << row.text;
  }
  EXPECT_EQ(static_cast<std::size_t>(std::count(list.begin(), list.end(), '\n')), kActions + done.size());
}

}  // namespace
}  // namespace incise::app::key_bindings_test
