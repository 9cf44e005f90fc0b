// SPDX-License-Identifier: Apache-2.0
// Strips and their borders, and the sheet that they make together.
#include "cut/strip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cut/strips.h"

namespace incise::test::strip_test {
namespace {

TEST(Strip, ends_at_its_four_edges) {
  const Rows rows = {{Vec3(0, 0, 0), Vec3(0, 1, 0)}, {Vec3(1, 0, 0), Vec3(1, 1, 0)}};
  EXPECT_EQ(strip_of_all(rows)->border.size(), 4U);
}

TEST(Strip, does_not_end_where_it_goes_on_from_an_earlier_one) {
  const Rows rows = {{Vec3(0, 0, 0), Vec3(0, 1, 0)}, {Vec3(1, 0, 0), Vec3(1, 1, 0)}, {Vec3(2, 0, 0), Vec3(2, 1, 0)}};
  const auto border = keys_of(strip_to(rows, 2)->border);
  EXPECT_EQ(border.size(), 3U);
  EXPECT_EQ(border.count(keys_of(point_of(rows, 1, 0), point_of(rows, 1, 1))), 0U);
}

TEST(Strip, of_a_closed_edge_ends_in_two_rings) {
  SweptSurface surface = sweep(coring_stroke(Vec3(0, 0, 0), 1, 12, 0, 1));
  EXPECT_EQ(Strip(std::move(surface), {}).border.size(), 24U);
}

TEST(OwnSheet, ends_where_all_strips_together_do) {
  Random random(1);
  for (unsigned run = 0; run < 20; ++run) {
    const Rows rows = random_rows(random, 6, 4, 1.0);
    OwnSheet sheet;
    for (std::size_t r = 1; r < rows.size(); ++r) {
      sheet.add(strip_to(rows, r));
      const Rows so_far(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(r) + 1);
      EXPECT_EQ(keys_of(sheet.border()), keys_of(strip_of_all(so_far)->border));
    }
  }
}

TEST(OwnSheet, has_no_border_at_the_front_once_it_has_come_back_to_its_start) {
  // A blade that turns once about its lower end: rows 0, 1, 2, and 0 again.
  const Rows rows = {
      {Vec3(1, 0, 0), Vec3(2, 0, 0)}, {Vec3(-1, 1, 0), Vec3(-2, 2, 0)}, {Vec3(-1, -1, 0), Vec3(-2, -2, 0)}};
  OwnSheet sheet;
  sheet.add(strip_to(rows, 1));
  sheet.add(strip_to(rows, 2));
  const SosPoint a = point_of(rows, 2, 0), b = point_of(rows, 2, 1), c = point_of(rows, 0, 0), d = point_of(rows, 0, 1);
  SweptSurface last;
  last.points = {a, b, c, d};
  last.triangles = {{{0, 1, 3}, 0, 0}, {{0, 3, 2}, 0, 0}};
  sheet.add(std::make_unique<Strip>(std::move(last), std::vector<SegmentKeys>{keys_of(a, b), keys_of(c, d)}));
  EXPECT_EQ(sheet.border().size(), 6U);  // an inner and an outer triangle
  EXPECT_EQ(keys_of(sheet.border()).count(keys_of(c, d)), 0U);
}

TEST(OwnSheet, finds_the_closest_place_of_all_strips) {
  Random random(2);
  const Rows rows = random_rows(random, 8, 3, 1.0);
  OwnSheet sheet;
  for (std::size_t r = 1; r < rows.size(); ++r) sheet.add(strip_to(rows, r));
  const auto whole = strip_of_all(rows);
  for (unsigned run = 0; run < 500; ++run) {
    const Vec3 point = random.point(-0.5, 1.5);
    const double reach = random.real(0, 1);
    const auto expected = whole->sheet.tree().closest(point, reach);
    const SheetPlace place = sheet.closest(point, reach);
    ASSERT_EQ(place.is_valid(), expected.is_valid());
    if (!place.is_valid()) continue;
    EXPECT_NEAR(place.distance2, expected.distance2, 1e-14);
    EXPECT_NEAR((place.point - point).squaredNorm(), place.distance2, 1e-14);
    EXPECT_NEAR(place.normal.norm(), 1.0, 1e-14);
  }
}

TEST(OwnSheet, forgets_everything) {
  const Rows rows = {{Vec3(0, 0, 0), Vec3(0, 1, 0)}, {Vec3(1, 0, 0), Vec3(1, 1, 0)}};
  OwnSheet sheet;
  sheet.add(strip_to(rows, 1));
  sheet.clear();
  EXPECT_TRUE(sheet.border().empty());
  EXPECT_FALSE(sheet.closest(Vec3(0, 0, 0), 9).is_valid());
}

}  // namespace
}  // namespace incise::test::strip_test
