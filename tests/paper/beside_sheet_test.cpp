// SPDX-License-Identifier: Apache-2.0
// Places beside a sheet: what it passes, and what may lie on it once it goes on.
#include "paper/beside_sheet.h"

#include <gtest/gtest.h>

#include "paper/constants.h"
#include "paper_support.h"

namespace incise::test::beside_sheet_test {
namespace {

/// The plane x = 0.5 for z below 0.5, moved by an offset, and the cube's vertices beside it; its mean edge is 0.29
/// there.
class BesideSheetTest : public ::testing::Test {
 protected:
  BesideSheetTest() : mesh_(build(kuhn_cube(4))) {}
  static SweptSurface at(double x) {
    return sweep(quad_stroke({x, -0.2, -0.2}, {x, 1.2, -0.2}, {x, 1.2, 0.5}, {x, -0.2, 0.5}));
  }
  [[nodiscard]] bool passes(double offset, const Vec3& place) {
    const SweptSurface surface = at(0.5 + offset);
    return passing_normal(mesh_, Sheet(surface), place, vertex_at(mesh_, place), walker_).has_value();
  }
  [[nodiscard]] bool may_lie(double offset, const Vec3& place) {
    const SweptSurface surface = at(0.5 + offset);
    return may_lie_on(mesh_, Sheet(surface), vertex_at(mesh_, place), kMostBend, walker_);
  }

  TetMesh mesh_;
  StarWalker walker_;
};

TEST_F(BesideSheetTest, is_within_a_tenth_of_an_edge) {
  EXPECT_TRUE(passes(0, {0.5, 0.5, 0.25}));
  EXPECT_TRUE(passes(0.02, {0.5, 0.5, 0.25}));
  EXPECT_FALSE(passes(0.04, {0.5, 0.5, 0.25}));
  EXPECT_FALSE(passes(0, {0.5, 0.5, 0.75})) << "beyond its border";
}

TEST_F(BesideSheetTest, goes_on_in_a_cone_beyond_its_border) {
  EXPECT_TRUE(may_lie(0.02, {0.5, 0.5, 0.25}));
  EXPECT_FALSE(may_lie(0.04, {0.5, 0.5, 0.25}));
  EXPECT_TRUE(may_lie(0.12, {0.5, 0.5, 0.75}));
  EXPECT_FALSE(may_lie(0.13, {0.5, 0.5, 0.75}));
}

}  // namespace
}  // namespace incise::test::beside_sheet_test
