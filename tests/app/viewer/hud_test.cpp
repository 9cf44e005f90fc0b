// SPDX-License-Identifier: Apache-2.0
#include "app/viewer/hud.h"

#include <gtest/gtest.h>

#include <limits>

namespace incise::app::hud_test {
namespace {

SessionFigures figures(std::uint64_t frames, double collision, double relax, double cut) {
  SessionFigures figures;
  figures.frames = frames;
  figures.times[Stage::kCollision] = collision * static_cast<double>(frames);
  figures.times[Stage::kRelax] = relax * static_cast<double>(frames);
  figures.times[Stage::kSubdivide] = cut * static_cast<double>(frames);
  return figures;
}

double percent_of(const Hud& hud) {
  double sum = 0;
  for (const StageRow& row : hud.stages()) sum += row.percent;
  return sum;
}

TEST(Hud, SaysNothingAtFirst) {
  Hud hud;
  EXPECT_EQ(hud.pictures_per_second(), 0);
  EXPECT_EQ(percent_of(hud), 0);
  hud.add(1, 5, 1, {});
  EXPECT_EQ(hud.pictures_per_second(), 0);
  EXPECT_EQ(percent_of(hud), 0);
}

TEST(Hud, CountsPicturesOfTheLastSecond) {
  Hud hud;
  for (int i = 0; i <= 100; ++i) hud.add(0.02 * i, 1, 1, figures(10, 1, 1, 1));
  EXPECT_NEAR(hud.pictures_per_second(), 50, 1e-6);
  for (int i = 1; i <= 20; ++i) hud.add(2 + 0.1 * i, 1, 1, figures(10, 1, 1, 1));
  EXPECT_NEAR(hud.pictures_per_second(), 10, 1e-6);
}

TEST(Hud, PicturesAtTheSameTimeAreNoRate) {
  Hud hud;
  for (int i = 0; i < 3; ++i) hud.add(1, 1, 1, {});
  EXPECT_EQ(hud.pictures_per_second(), 0);
}

TEST(Hud, SharesOfTheStagesSumToAHundred) {
  Hud hud;
  for (unsigned i = 0; i <= 60; ++i) hud.add(i / 60.0, 8, 1, figures(2 * i, 1, 4, 3));
  const auto stages = hud.stages();
  EXPECT_STREQ(stages[0].label, "CD");
  EXPECT_NEAR(stages[0].ms, 1, 1e-9);
  EXPECT_STREQ(stages[1].label, "GM");
  EXPECT_NEAR(stages[1].ms, 3, 1e-9);
  EXPECT_STREQ(stages[2].label, "RLX");
  EXPECT_NEAR(stages[2].ms, 4, 1e-9);
  EXPECT_STREQ(stages[3].label, "RD");
  EXPECT_NEAR(stages[3].ms, 8, 1e-9);
  EXPECT_NEAR(percent_of(hud), 100, 1e-9);
  EXPECT_NEAR(stages[3].percent, 50, 1e-9);
}

TEST(Hud, ASimulationThatStandsTakesNoTime) {
  Hud hud;
  for (int i = 0; i <= 60; ++i) hud.add(i / 60.0, 8, 1, figures(100, 1, 4, 3));
  EXPECT_EQ(hud.stages()[0].ms, 0);
  EXPECT_NEAR(hud.stages()[3].percent, 100, 1e-9);
}

TEST(Hud, AnotherSessionOrTheSameFromItsStartBeginsAnew) {
  Hud hud;
  for (unsigned i = 0; i <= 60; ++i) hud.add(i / 60.0, 8, 1, figures(i, 1, 4, 3));
  hud.add(1.1, 8, 2, figures(100, 9, 9, 9));
  EXPECT_EQ(hud.pictures_per_second(), 0);
  hud.add(1.2, 8, 2, figures(110, 9, 9, 9));
  EXPECT_NEAR(hud.stages()[0].ms, 9, 1e-9);
  hud.add(1.3, 8, 2, figures(3, 1, 1, 1));
  EXPECT_EQ(percent_of(hud), 0);
  EXPECT_EQ(hud.pictures_per_second(), 0);
}

TEST(Hud, NumbersHaveCommas) {
  EXPECT_EQ(with_commas(0), "0");
  EXPECT_EQ(with_commas(999), "999");
  EXPECT_EQ(with_commas(1000), "1,000");
  EXPECT_EQ(with_commas(12345), "12,345");
  EXPECT_EQ(with_commas(123456), "123,456");
  EXPECT_EQ(with_commas(1234567), "1,234,567");
  EXPECT_EQ(with_commas(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
}

TEST(HudRows, TellWhetherTheSimulationKeepsUp) {
  SessionView view;
  view.steps_per_second = 59.6;
  view.real_time = 1;
  std::vector<HudRow> rows = rate_rows(Hud(), view);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].value, "60 steps/s");
  EXPECT_EQ(rows[1].remark, "");
  view.real_time = 0.5;
  EXPECT_EQ(rate_rows(Hud(), view)[1].remark, "slow: 0.50 of real time");
  view.is_paused = true;
  EXPECT_EQ(rate_rows(Hud(), view)[1].value, "paused");
}

TEST(HudRows, TellHowTheMeshGrew) {
  SessionView view;
  view.figures.tets_at_start = 1000;
  view.figures.tets = 1250;
  view.figures.vertices = 300;
  view.figures.strokes = 2;
  view.figures.cut.cut_tets = 4321;
  const std::vector<HudRow> rows = mesh_rows(view);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].value, "1,250");
  EXPECT_EQ(rows[0].remark, "1.25 x the start");
  EXPECT_EQ(rows[1].value, "300");
  EXPECT_EQ(rows[2].value, "2");
  EXPECT_EQ(rows[2].remark, "4,321 tets cut");
  EXPECT_EQ(mesh_rows(SessionView())[0].remark, "0.00 x the start");
}

TEST(HudRows, TellTheQualityBeforeAndNow) {
  SessionView view;
  view.quality_before.lr_min = 4.9;
  view.quality.lr_max = 12345;
  view.quality.lr_over_200_pct = 0.5;
  const std::vector<QualityRow> rows = quality_rows(view);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].before, "4.90");
  EXPECT_EQ(rows[2].now, "1.23e+04");
  EXPECT_EQ(rows[3].now, "0.50 %");
}

TEST(HudRows, TellTheForceOnTheBlade) {
  SessionView view;
  view.figures.blade.force = {0, 3, 4};
  view.figures.blade.touches = true;
  view.figures.blade.engaged_length = 0.0123;
  view.figures.peak_force = 7;
  const std::vector<HudRow> rows = force_rows(view);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].value, "5.00 N");
  EXPECT_EQ(rows[0].remark, "touches");
  EXPECT_EQ(rows[1].value, "7.00 N");
  EXPECT_EQ(rows[2].value, "12.3 mm");
}

}  // namespace
}  // namespace incise::app::hud_test
