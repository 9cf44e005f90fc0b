// SPDX-License-Identifier: Apache-2.0
#include "render/ink_style.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ink_style_test {
namespace app = incise::app;
using namespace incise::render;

namespace {

constexpr std::array<app::Theme, 2> kThemes = {app::Theme::kDark, app::Theme::kLight};

float distance(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

TEST(InkStyle, no_two_inks_share_all_shapes) {
  const auto styles = ink_styles(app::Theme::kDark);
  for (std::size_t i = 0; i < kInks; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool is_same =
          styles[i].line == styles[j].line && styles[i].ball == styles[j].ball && styles[i].fill == styles[j].fill;
      EXPECT_FALSE(is_same) << i << " and " << j;
    }
  }
}

TEST(InkStyle, casings_stand_out_from_their_inks) {
  for (const app::Theme theme : kThemes) {
    const auto styles = ink_styles(theme);
    for (std::size_t i = 0; i < styles.size(); ++i) {
      if (i == kContourStyle) continue;  // it is as if drawn on the skin
      EXPECT_GT(distance(styles[i].color, styles[i].casing), 0.4F);
    }
  }
}

TEST(InkStyle, lone_wires_stand_out_from_the_background) {
  for (const app::Theme theme : kThemes) {
    const Grounds grounds = grounds_of(theme);
    EXPECT_GT(distance(grounds.lone_wire, grounds.top), 0.6F);
    EXPECT_GT(distance(grounds.lone_wire, grounds.bottom), 0.6F);
  }
}

}  // namespace ink_style_test
