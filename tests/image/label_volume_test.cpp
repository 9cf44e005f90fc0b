// SPDX-License-Identifier: Apache-2.0
#include "image/label_volume.h"

#include <gtest/gtest.h>

namespace incise::label_volume_test {
namespace {

using image::kMixed;
using image::LabelImage;
using image::LabelVolume;

/// 12 × 10 × 9 voxels of label 4, with some others; no voxel has label 0 unless asked for.
LabelImage box() {
  LabelImage image;
  image.size = {12, 10, 9};
  image.step = {Vec3(2, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  image.labels = {-3, 0, 4, 9};
  image.voxels.assign(12 * 10 * 9, 2);
  return image;
}

TEST(LabelVolume, background_is_first_and_all_around) {
  const LabelVolume volume(box());
  EXPECT_EQ(volume.labels(), (std::vector<std::int32_t>{0, -3, 4, 9}));
  EXPECT_EQ(volume.at(0, 0, 0), 2);
  EXPECT_EQ(volume.at(-1, 0, 0), 0);
  EXPECT_EQ(volume.at(0, 10, 0), 0);
  EXPECT_EQ(volume.at(Vec3(2.9, 0, 0)), 2);
  EXPECT_EQ(volume.at(Vec3(-1.1, 0, 0)), 0);
}

TEST(LabelVolume, tells_where_one_label_is_alone) {
  LabelImage image = box();
  image.voxels[image.index(6, 5, 4)] = 3;
  const LabelVolume volume(image);
  EXPECT_EQ(volume.uniform_label(Vec3(2, 1, 1), Vec3(4, 3, 3)), 2);
  EXPECT_EQ(volume.uniform_label(Vec3(8, 4, 3), Vec3(14, 7, 6)), kMixed);
  EXPECT_EQ(volume.uniform_label(Vec3(-4, 1, 1), Vec3(4, 3, 3)), kMixed);
  EXPECT_EQ(volume.uniform_label(Vec3(-40, 1, 1), Vec3(-30, 3, 3)), 0);
}

TEST(LabelVolume, finds_what_is_no_background) {
  LabelImage image = box();
  std::fill(image.voxels.begin(), image.voxels.end(), std::uint16_t{1});
  Vec3 low, high;
  EXPECT_FALSE(LabelVolume(image).find_extent(low, high));
  image.voxels[image.index(3, 4, 5)] = 2;
  image.voxels[image.index(7, 2, 5)] = 3;
  ASSERT_TRUE(LabelVolume(image).find_extent(low, high));
  EXPECT_EQ(low, Vec3(6, 2, 5));
  EXPECT_EQ(high, Vec3(14, 4, 5));
}

TEST(LabelVolume, islands_join_what_is_around_them) {
  LabelImage image = box();
  image.voxels[image.index(6, 5, 4)] = 3;  // an island
  image.voxels[image.index(6, 5, 5)] = 3;
  image.voxels[image.index(2, 2, 2)] = 1;                                       // a hole
  for (std::size_t i = 0; i < 12; ++i) image.voxels[image.index(i, 9, 8)] = 3;  // larger than an island
  LabelVolume volume(image);
  EXPECT_EQ(volume.join_islands(4), 3U);
  EXPECT_EQ(volume.at(6, 5, 4), 2);
  EXPECT_EQ(volume.at(2, 2, 2), 2);
  EXPECT_EQ(volume.count_voxels(), (std::vector<std::uint64_t>{0, 0, 12 * 10 * 9 - 12, 12}));
  EXPECT_EQ(volume.uniform_label(Vec3(2, 1, 1), Vec3(14, 6, 6)), 2);
}

TEST(LabelVolume, voxels_that_touch_in_an_edge_are_two_islands) {
  LabelImage image = box();
  image.voxels[image.index(6, 5, 4)] = 3;
  image.voxels[image.index(7, 6, 4)] = 3;
  LabelVolume volume(image);
  EXPECT_EQ(volume.join_islands(2), 2U);
}

}  // namespace
}  // namespace incise::label_volume_test
