// SPDX-License-Identifier: Apache-2.0
#include "app/view/color_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace incise::app::color_map_test {
namespace {

/// As a grey picture has it.
double lightness(const Color& color) {
  return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

TEST(QualityColor, GoesFromDarkBlueToYellow) {
  const Color good = quality_color(0), bad = quality_color(255);
  EXPECT_GT(good[2], good[1]);
  EXPECT_LT(lightness(good), 40);
  EXPECT_GT(std::min(bad[0], bad[1]), 200);
  EXPECT_LT(bad[2], 100);
}

TEST(QualityColor, ItsLightnessGrowsSteadily) {
  for (int byte = 4; byte < 256; byte += 4) {
    EXPECT_GT(lightness(quality_color(static_cast<std::uint8_t>(byte))),
              lightness(quality_color(static_cast<std::uint8_t>(byte - 4))));
  }
}

TEST(LabelColor, EightThatDifferThenAgainFromTheFirst) {
  std::set<Color> colors;
  for (std::uint32_t label = 0; label < 8; ++label) {
    colors.insert(label_color(label));
    EXPECT_EQ(label_color(label + 8), label_color(label));
  }
  EXPECT_EQ(colors.size(), 8U);
}

}  // namespace
}  // namespace incise::app::color_map_test
