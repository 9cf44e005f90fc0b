// SPDX-License-Identifier: Apache-2.0
#include "app/viewer/first_steps.h"

#include <gtest/gtest.h>

using incise::app::FirstSteps;

TEST(FirstSteps, tells_one_thing_after_another) {
  FirstSteps steps;
  steps.begin(true);
  EXPECT_TRUE(steps.text().starts_with("Press on the skin"));
  steps.see(1, true, true);  // what the demonstration does is not the person's
  EXPECT_TRUE(steps.text().starts_with("Press on the skin"));
  steps.take_over();
  steps.see(1, false, false);
  EXPECT_TRUE(steps.text().starts_with("Press on the skin"));
  steps.see(2, false, false);
  EXPECT_TRUE(steps.text().starts_with("Now open it"));
  steps.see(2, true, false);
  EXPECT_TRUE(steps.text().starts_with("Ctrl+Z"));
  steps.see(1, true, false);
  EXPECT_EQ(steps.text(), "");
}

TEST(FirstSteps, tells_nothing_of_a_body_that_was_chosen) {
  FirstSteps steps;
  steps.begin(false);
  steps.take_over();
  steps.see(0, false, false);
  steps.see(3, true, false);
  EXPECT_EQ(steps.text(), "");
}
