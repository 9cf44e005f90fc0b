// SPDX-License-Identifier: Apache-2.0
// The size of the elements that a body came with is known wherever it was cut.
#include "improve/original_sizes.h"

#include <gtest/gtest.h>

#include "improve/maintainer_cases.h"
#include "incise/mesh/edge_length.h"
#include "support/random_strokes.h"

namespace incise::test::original_sizes_test {
namespace {

TEST(OriginalSizes, are_unknown_before_anything_was_measured) {
  const OriginalSizes sizes;
  EXPECT_EQ(sizes.at(Vec3(0.5, 0.5, 0.5)), 0.0);
}

TEST(OriginalSizes, are_about_the_mean_edge_everywhere_in_a_body) {
  const TetMesh mesh = build(kuhn_cube(5));
  OriginalSizes sizes;
  sizes.measure(mesh);
  const double edge = mean_edge_length(mesh);
  Random random(1);
  for (unsigned i = 0; i < 500; ++i) EXPECT_NEAR(sizes.at(random.point(0, 1)), edge, 0.15 * edge);
}

TEST(OriginalSizes, are_known_a_rounding_error_outside_of_the_body) {
  const TetMesh mesh = build(kuhn_cube(3));
  OriginalSizes sizes;
  sizes.measure(mesh);
  const double edge = mean_edge_length(mesh);
  for (const Vec3& place : {Vec3(-1e-18, 0.5, 0.5), Vec3(0.5, -1e-18, -1e-18), Vec3(-1e-18, -1e-18, -1e-18)}) {
    EXPECT_NEAR(sizes.at(place), edge, 0.15 * edge);
  }
}

TEST(OriginalSizes, of_a_graded_body_are_its_own_in_each_place) {
  TetSoup soup = kuhn_cube(16);
  for (Vec3& p : soup.points) p = Vec3(p.x() * p.x() * p.x() * p.x(), 0.01 * p.y(), 0.01 * p.z());
  const TetMesh mesh = build(soup);
  OriginalSizes sizes;
  sizes.measure(mesh);
  EXPECT_LT(sizes.at(Vec3(0.001, 0.005, 0.005)), 0.01);
  EXPECT_GT(sizes.at(Vec3(0.9, 0.005, 0.005)), 0.05);
}

TEST(OriginalSizes, grow_with_the_body) {
  OriginalSizes sizes, larger;
  TetSoup soup = ball(5);
  sizes.measure(build(soup));
  for (Vec3& p : soup.points) p *= 1024.0;
  larger.measure(build(soup));
  Random random(2);
  for (unsigned i = 0; i < 100; ++i) {
    const Vec3 p = random.point(-0.5, 0.5);
    EXPECT_EQ(larger.at(1024.0 * p), 1024.0 * sizes.at(p));
  }
}

}  // namespace
}  // namespace incise::test::original_sizes_test
