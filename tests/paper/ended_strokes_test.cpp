// SPDX-License-Identifier: Apache-2.0
// Where strokes have ended: a blade that stands there goes on from the latest.
#include "paper/ended_strokes.h"

#include <gtest/gtest.h>

#include "paper/constants.h"

namespace incise::test::ended_strokes_test {
namespace {

std::vector<Vec3> row_at(double x) {
  return {Vec3(x, 0, 0), Vec3(x, 1, 0)};
}
EndedStroke ended_at(double x) {
  EndedStroke ended;
  ended.row = row_at(x);
  return ended;
}

TEST(EndedStrokes, are_found_where_all_points_of_a_blade_stand) {
  EndedStrokes strokes;
  EXPECT_EQ(strokes.find(row_at(0), 1), nullptr);
  strokes.add(ended_at(0));
  strokes.add(ended_at(1));
  const EndedStroke* first = strokes.find(row_at(0.01), 0.05);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->row.front().x(), 0);
  EXPECT_FALSE(strokes.is_last(*first));
  EXPECT_TRUE(strokes.is_last(*strokes.find(row_at(1), 0.05)));
  EXPECT_EQ(strokes.find(row_at(0.1), 0.05), nullptr);
  EXPECT_EQ(strokes.find(std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 1, 0)}, 0.05), nullptr) << "one point of two";
  EXPECT_EQ(strokes.find(std::vector<Vec3>{Vec3(0, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 1, 0)}, 0.05), nullptr);
}

TEST(EndedStrokes, give_the_latest_of_several_at_one_place) {
  EndedStrokes strokes;
  strokes.add(ended_at(0));
  strokes.add(ended_at(0.02));
  EXPECT_EQ(strokes.find(row_at(0), 0.05)->row.front().x(), 0.02);
}

TEST(EndedStrokes, tell_that_others_have_cut_since_that_are_not_found) {
  EndedStrokes strokes;
  strokes.add(ended_at(0));
  ASSERT_TRUE(strokes.is_last(*strokes.find(row_at(0), 0.05)));
  strokes.add({});
  const EndedStroke* ended = strokes.find(row_at(0), 0.05);
  ASSERT_NE(ended, nullptr);
  EXPECT_FALSE(strokes.is_last(*ended));
}

TEST(EndedStrokes, forget_the_oldest) {
  EndedStrokes strokes;
  for (std::size_t i = 0; i <= kEndsKept; ++i) strokes.add(ended_at(static_cast<double>(i)));
  EXPECT_EQ(strokes.find(row_at(0), 0.05), nullptr);
  EXPECT_NE(strokes.find(row_at(1), 0.05), nullptr);
  strokes.clear();
  EXPECT_EQ(strokes.find(row_at(1), 0.05), nullptr);
}

TEST(EndedStrokes, forget_those_first_from_which_none_will_go_on) {
  EndedStrokes strokes;
  strokes.add(ended_at(-1));
  for (std::size_t i = 0; i < 3 * kEndsKept; ++i) {
    const double x = static_cast<double>(i);
    strokes.add(ended_at(x));
    strokes.go_on_from(*strokes.find(row_at(x), 0.05));
  }
  strokes.add({});
  const EndedStroke* open = strokes.find(row_at(-1), 0.05);
  ASSERT_NE(open, nullptr) << "however many strokes another incision took";
  EXPECT_FALSE(strokes.is_last(*open));
  strokes.go_on_from(*open);
  EXPECT_EQ(strokes.find(row_at(-1), 0.05), nullptr) << "no tissue waits there any more";
}

}  // namespace
}  // namespace incise::test::ended_strokes_test
