// SPDX-License-Identifier: Apache-2.0
// Which borders of a sheet lie inside the body, where they begin, end or merely pass through it.
#include "cut/open_border.h"

#include <gtest/gtest.h>

#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::open_border_test {
namespace {

class OpenBorder : public ::testing::Test {
 protected:
  OpenBorder() { surface_.follow(mesh_, Journal()); }
  [[nodiscard]] bool is_in_body(const Vec3& from, const Vec3& to) const {
    const Strip::Segment segment = {SosPoint{from, kFirstBladeKey}, SosPoint{to, kFirstBladeKey + 1}};
    return lies_in_body(mesh_, surface_, std::span(&segment, 1));
  }

  TetMesh mesh_ = build(kuhn_cube(3));
  SurfaceIndex surface_;
};

TEST_F(OpenBorder, lies_in_the_body_wherever_a_part_of_it_does) {
  EXPECT_TRUE(is_in_body(Vec3(0.4, 0.41, 0.3), Vec3(0.5, 0.52, 0.35))) << "all of it";
  EXPECT_TRUE(is_in_body(Vec3(-0.5, 0.41, 0.3), Vec3(0.5, 0.52, 0.35))) << "its end";
  EXPECT_TRUE(is_in_body(Vec3(0.5, 0.52, 0.35), Vec3(-0.5, 0.41, 0.3))) << "its beginning";
  EXPECT_TRUE(is_in_body(Vec3(-0.5, 0.41, 0.3), Vec3(1.5, 0.52, 0.35))) << "its middle";
  EXPECT_TRUE(is_in_body(Vec3(-0.05, 0.41, 0.1), Vec3(0.05, 0.52, -0.02))) << "a corner of the body alone";
}

TEST_F(OpenBorder, does_not_lie_in_a_body_that_it_passes_by) {
  EXPECT_FALSE(is_in_body(Vec3(-0.5, 0.41, -0.01), Vec3(1.5, 0.52, -0.01)));
  EXPECT_FALSE(is_in_body(Vec3(-0.5, 0.41, 0.3), Vec3(-0.1, 0.52, 0.35)));
  EXPECT_FALSE(is_in_body(Vec3(-1, 0.5, 0.5), Vec3(0.5, 2, 0.5)));
  EXPECT_FALSE(lies_in_body(mesh_, surface_, {}));
}

}  // namespace
}  // namespace incise::test::open_border_test
