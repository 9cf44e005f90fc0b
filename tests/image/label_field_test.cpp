// SPDX-License-Identifier: Apache-2.0
#include "image/label_field.h"

#include <gtest/gtest.h>

#include "image/made_images.h"

namespace incise::label_field_test {
namespace {

using image::LabelField;
using image::LabelVolume;
using image::Shares;

/// Label 1 where x < 10 mm, label 2 beyond; voxels of 1 × 1 × 2 mm.
image::LabelImage half_and_half() {
  incise_test::MadeImage made;
  made.truth = [](const Vec3& p) { return p.x() < 10 ? 1 : 2; };
  made.extent = 20;
  made.spacing = Vec3(1, 1, 2);
  made.labels = {1, 2};
  return to_image(made);
}

double difference(const LabelField& field, const Vec3& p, double width) {
  Shares shares;
  field.sample(p, width, shares);
  const auto *a = shares.find(1), *b = shares.find(2);
  return (a != nullptr ? a->value : 0) - (b != nullptr ? b->value : 0);
}

TEST(LabelField, shares_add_up_to_one) {
  const LabelVolume volume(to_image(incise_test::triple_junctions()));
  const LabelField field(volume, 0.7);
  Shares shares;
  for (int i = 0; i < 200; ++i) {
    field.sample(Vec3(10.3 + 0.5 * i, 20 + 0.4 * i, 100 - 0.35 * i), i % 3, shares);
    double sum = 0;
    Vec3 slope = Vec3::Zero();
    for (const auto& share : shares) {
      sum += share.value;
      slope += share.slope;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(slope.norm(), 0, 1e-12);
  }
}

TEST(LabelField, slopes_are_those_of_the_values) {
  const LabelVolume volume(to_image(incise_test::triple_junctions()));
  const LabelField field(volume, 0.9);
  Shares here, there;
  const Vec3 p(64.1, 63.9, 60.2);
  field.sample(p, 0, here);
  ASSERT_GE(here.size(), 3U);
  for (Eigen::Index a = 0; a < 3; ++a) {
    const double h = 1e-6;
    field.sample(p + h * Vec3::Unit(a), 0, there);
    for (const auto& share : here) {
      EXPECT_NEAR((there.find(share.label)->value - share.value) / h, share.slope[a], 1e-4);
    }
  }
}

TEST(LabelField, labels_are_alike_on_a_plane_between_them) {
  const LabelVolume volume(half_and_half());
  const LabelField field(volume, 0.7);
  // Voxels 0 to 9 have label 1: the plane lies between the middles of voxels 9 and 10.
  EXPECT_NEAR(difference(field, Vec3(9.5, 10.2, 9.1), 0), 0, 1e-12);
  EXPECT_NEAR(difference(field, Vec3(9.5, 10.2, 9.1), 3), 0, 0.15);  // it looks at every other voxel
  EXPECT_GT(difference(field, Vec3(9.4, 10.2, 9.1), 0), 0);
  const double slope = (difference(field, Vec3(9.3, 10, 9), 0) - difference(field, Vec3(9.7, 10, 9), 0)) / 0.4;
  EXPECT_NEAR(slope, 2 * field.plane_slope(0), 0.1);
}

TEST(LabelField, a_bias_moves_the_interface_outwards) {
  const LabelVolume volume(half_and_half());
  LabelField field(volume, 0.7);
  field.set_bias(1, 0.2);
  EXPECT_NEAR(difference(field, Vec3(9.5, 10, 9), 0), 0.2, 1e-12);
}

}  // namespace
}  // namespace incise::label_field_test
