// SPDX-License-Identifier: Apache-2.0
// Where the cut meets the sides of one master, by hand: edges 0, 1 and 2 leave corner 0; edge 3 joins 1 and 2, edge 4
// 1 and 3, edge 5 2 and 3.
#include "cut/incision_lines.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "cut/split_template.h"

namespace incise::test::incision_lines_test {
namespace {

using Line = std::array<std::uint8_t, 2>;

constexpr std::uint8_t split(unsigned edge) {
  return static_cast<std::uint8_t>(SplitTemplate::kFirstSplit + edge);
}
constexpr std::uint8_t point(unsigned side) {
  return static_cast<std::uint8_t>(SplitTemplate::kFirstPoint + side);
}

/// A master with these edges flagged and these corners taking part in the cut, both as bits.
Master master_with(unsigned flagged, unsigned on) {
  Master master;
  for (unsigned c = 0; c < 4; ++c) master.vertices[c] = VertexId(10 + c);
  master.points.fill(Master::kNone);
  master.flagged = static_cast<std::uint8_t>(flagged);
  master.on = static_cast<std::uint8_t>(on);
  return master;
}

/// All its lines, ascending.
std::vector<Line> lines_of(const Master& master) {
  SplitTemplates templates;
  const ClosedComplex complex(templates);
  const IncisionLines lines(master, complex);
  std::vector<Line> found;
  for (std::uint8_t a = 0; a < SplitTemplate::kCodes; ++a) {
    for (auto b = static_cast<std::uint8_t>(a + 1); b < SplitTemplate::kCodes; ++b) {
      EXPECT_EQ(lines.contains(a, b), lines.contains(b, a));
      if (lines.contains(a, b)) found.push_back({a, b});
    }
  }
  return found;
}

TEST(IncisionLines, run_from_split_point_to_split_point_in_even_sides) {
  const std::vector<Line> around_corner_0 = {{split(0), split(1)}, {split(0), split(2)}, {split(1), split(2)}};
  EXPECT_EQ(lines_of(master_with(0b000111, 0)), around_corner_0);
}

TEST(IncisionLines, run_from_split_points_to_the_front_point_in_odd_sides) {
  Master master = master_with(0b000001, 0);
  master.points[2] = master.points[3] = 0;
  const std::vector<Line> to_points = {{split(0), point(2)}, {split(0), point(3)}};
  EXPECT_EQ(lines_of(master), to_points);
}

TEST(IncisionLines, end_at_split_points_where_an_odd_side_has_no_front_point) {
  EXPECT_TRUE(lines_of(master_with(0b000001, 0)).empty());
}

TEST(IncisionLines, run_to_a_corner_that_takes_part_in_the_cut) {
  const std::vector<Line> to_corner_1 = {{1, split(1)}, {1, split(2)}, {split(1), split(2)}};
  EXPECT_EQ(lines_of(master_with(0b000111, 0b0010)), to_corner_1);
}

TEST(IncisionLines, are_none_where_one_corner_absorbed_all_crossings) {
  EXPECT_TRUE(lines_of(master_with(0b000111, 0b0001)).empty());
}

TEST(IncisionLines, are_none_along_an_edge_that_two_sides_have_them_on) {
  const std::vector<Line> once = {{1, 2}};
  EXPECT_EQ(lines_of(master_with(0b000011, 0b0110)), once);
  EXPECT_TRUE(lines_of(master_with(0b110011, 0b0110)).empty());
}

TEST(IncisionLines, let_the_end_of_lower_rank_stand_for_an_edge_between_two_corners_of_the_cut) {
  Master master = master_with(0b001001, 0b0110);
  EXPECT_TRUE(lines_of(master).empty());  // corner 1 stands for edges 0 and 3
  std::swap(master.vertices[1], master.vertices[2]);
  const std::vector<Line> between = {{1, 2}};
  EXPECT_EQ(lines_of(master), between);
}

}  // namespace
}  // namespace incise::test::incision_lines_test
