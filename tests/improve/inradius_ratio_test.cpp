// SPDX-License-Identifier: Apache-2.0
#include "improve/inradius_ratio.h"

#include <gtest/gtest.h>

#include <cmath>

namespace incise::test::inradius_ratio_test {
namespace {

const Vec3 kA(0, 0, 0);

TEST(InradiusRatio, is_one_for_the_regular_tet_at_any_scale) {
  for (const double h : {1e-9, 1.0, 1e9}) {
    EXPECT_NEAR(inradius_ratio(kA, Vec3(h, h, 0), Vec3(0, h, h), Vec3(h, 0, h)), 1.0, 1e-12);
  }
}

TEST(InradiusRatio, is_less_than_nothing_for_an_inverted_tet) {
  EXPECT_LT(inradius_ratio(kA, Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)), 0);
}

TEST(InradiusRatio, is_nothing_for_a_tet_that_the_checks_of_a_mesh_call_flat) {
  EXPECT_EQ(inradius_ratio(kA, Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.3, 1e-12)), 0);
  EXPECT_GT(inradius_ratio(kA, Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.3, 1e-10)), 0);
}

TEST(InradiusRatio, is_nothing_for_a_needle_long_before_it_vanishes) {
  const auto needle = [](double width) {
    return inradius_ratio(kA, Vec3(width, 0, 0), Vec3(0, width, 0), Vec3(0.1 * width, 0.1 * width, 1));
  };
  EXPECT_GT(needle(1e-5), 1e-6);
  EXPECT_EQ(needle(1e-6), 0);
}

}  // namespace
}  // namespace incise::test::inradius_ratio_test
