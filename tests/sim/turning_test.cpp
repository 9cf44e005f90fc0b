// SPDX-License-Identifier: Apache-2.0
#include "sim/body/turning.h"

#include <gtest/gtest.h>

namespace incise::turning_test {
namespace {

TEST(Turning, IsARotationWhateverTheAngle) {
  for (const Vec3& angle : {Vec3(0, 0, 0), Vec3(1e-3, -2e-3, 5e-4), Vec3(2, -3, 1), Vec3(0, 40, 0)}) {
    const Mat3 turning = detail::turning_by(angle);
    EXPECT_LT((turning * turning.transpose() - Mat3::Identity()).norm(), 1e-12) << angle.transpose();
    EXPECT_NEAR(turning.determinant(), 1, 1e-12) << angle.transpose();
  }
}

TEST(Turning, IsThatOfItsAxisWhereTheAngleIsSmall) {
  const Vec3 angle(0.01, -0.02, 0.015);
  const Mat3 exact = Eigen::AngleAxisd(angle.norm(), angle.normalized()).toRotationMatrix();
  EXPECT_LT((detail::turning_by(angle) - exact).norm(), 1e-5);
}

}  // namespace
}  // namespace incise::turning_test
