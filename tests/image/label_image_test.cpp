// SPDX-License-Identifier: Apache-2.0
#include "incise/image/label_image.h"

#include <gtest/gtest.h>

namespace incise::label_image_test {
namespace {

using image::LabelImage;

LabelImage three_labels() {
  LabelImage image;
  image.size = {2, 2, 1};
  image.labels = {0, 3, 9};
  image.voxels = {0, 1, 2, 2};
  return image;
}

TEST(LabelImage, counts_voxels_of_each_label) {
  EXPECT_EQ(three_labels().count_voxels(), (std::vector<std::uint64_t>{1, 1, 2}));
  EXPECT_EQ(three_labels().find_label(9), 2U);
  EXPECT_EQ(three_labels().find_label(4), 3U);
}

TEST(LabelImage, merges_one_label_into_another) {
  LabelImage image = three_labels();
  image::merge_label(image, 9, 3);
  EXPECT_EQ(image.labels, (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(image.voxels, (std::vector<std::uint16_t>{0, 1, 1, 1}));
}

TEST(LabelImage, merges_into_a_label_that_was_not_there) {
  LabelImage image = three_labels();
  image::merge_label(image, 3, 20);
  EXPECT_EQ(image.labels, (std::vector<std::int32_t>{0, 9, 20}));
  EXPECT_EQ(image.label(1, 0, 0), 20);
  EXPECT_EQ(image.label(0, 1, 0), 9);
}

TEST(LabelImage, keeps_some_labels_and_gives_the_rest_to_the_background) {
  LabelImage image = three_labels();
  image::keep_labels(image, {3});
  EXPECT_EQ(image.labels, (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(image.voxels, (std::vector<std::uint16_t>{0, 1, 0, 0}));
}

TEST(LabelImage, measures_voxels_of_slanted_axes) {
  LabelImage image = three_labels();
  image.step = {Vec3(2, 0, 0), Vec3(0, 0, 3), Vec3(0, -1, 0)};
  EXPECT_EQ(image.voxel_volume(), 6);
  EXPECT_EQ(image.spacing(), Vec3(2, 3, 1));
}

}  // namespace
}  // namespace incise::label_image_test
