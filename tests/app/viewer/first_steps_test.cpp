// SPDX-License-Identifier: Apache-2.0
#include "app/viewer/first_steps.h"

#include <gtest/gtest.h>

using incise::app::FirstSteps;
using Hold = FirstSteps::Hold;
using incise::app::ToolKind;

TEST(FirstSteps, tells_one_thing_after_another) {
  FirstSteps steps;
  steps.begin(true);
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("Press on the skin"));
  steps.see(1, Hold::kStays, true);  // what the demonstration does is not the person's
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("Press on the skin"));
  steps.take_over();
  steps.see(1, Hold::kNone, false);
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("Press on the skin"));
  steps.see(2, Hold::kNone, false);
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("Now open it"));
  steps.see(2, Hold::kDrag, false);
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("Now open it"));
  steps.see(2, Hold::kStays, false);
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("It stays open. Ctrl+Z"));
  steps.see(1, Hold::kStays, false);
  EXPECT_EQ(steps.text(ToolKind::kScalpel), "A click on a hook lets it go");
  steps.see(1, Hold::kNone, false);
  EXPECT_EQ(steps.text(ToolKind::kScalpel), "");
}

TEST(FirstSteps, tells_of_the_hook_where_forceps_let_the_wound_close) {
  FirstSteps steps;
  steps.begin(true);
  steps.take_over();
  steps.see(0, Hold::kNone, false);
  steps.see(1, Hold::kNone, false);
  steps.see(1, Hold::kDrag, false);
  steps.see(1, Hold::kNone, false);
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("It closes when you let go. The hook (7) stays"));
  steps.see(2, Hold::kNone, false);  // another cut meanwhile
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("It closes"));
  steps.see(2, Hold::kStays, false);
  EXPECT_TRUE(steps.text(ToolKind::kScalpel).starts_with("It stays open"));
}

TEST(FirstSteps, tells_nothing_of_a_body_that_was_chosen) {
  FirstSteps steps;
  steps.begin(false);
  steps.take_over();
  steps.see(0, Hold::kNone, false);
  steps.see(3, Hold::kStays, false);
  EXPECT_EQ(steps.text(ToolKind::kScalpel), "");
}

TEST(FirstSteps, tells_what_another_tool_does) {
  FirstSteps steps;
  steps.begin(true);
  EXPECT_TRUE(steps.text(ToolKind::kPlaneCut).starts_with("Press on the skin"));  // while it is shown
  steps.take_over();
  EXPECT_TRUE(steps.text(ToolKind::kPlaneCut).starts_with("Plane cut: a drag"));
  steps.see(0, Hold::kNone, false);
  steps.see(1, Hold::kNone, false);
  EXPECT_TRUE(steps.text(ToolKind::kProbe).starts_with("Probe: a click"));
  EXPECT_TRUE(steps.text(ToolKind::kHook).starts_with("Now open it"));
  steps.see(1, Hold::kStays, false);
  EXPECT_TRUE(steps.text(ToolKind::kProbe).starts_with("It stays open"));
}
