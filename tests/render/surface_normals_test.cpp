// SPDX-License-Identifier: Apache-2.0
#include "render/surface_normals.h"

#include <gtest/gtest.h>

using Eigen::Vector3f;
using incise::render::SurfaceNormals;

TEST(SurfaceNormals, are_weighted_by_area) {
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 0, 0}};
  const std::vector<Vector3f> positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}};
  SurfaceNormals averages;
  static_cast<void>(averages.average(triangles, std::vector<Vector3f>(9, {9, 9, 9})));
  const std::vector<Vector3f>& normals = averages.average(triangles, positions);
  ASSERT_EQ(normals.size(), 4U);
  EXPECT_EQ(normals[1], Vector3f(0, 0, 4));
  EXPECT_EQ(normals[3], Vector3f(2, 0, 0));
  EXPECT_EQ(normals[0], Vector3f(2, 0, 4));
  EXPECT_EQ(normals[2], Vector3f(2, 0, 4));
}

TEST(SurfaceNormals, points_without_triangles_have_none) {
  SurfaceNormals averages;
  const std::vector<Vector3f>& normals = averages.average({}, std::vector<Vector3f>{{1, 2, 3}});
  ASSERT_EQ(normals.size(), 1U);
  EXPECT_EQ(normals[0], Vector3f(0, 0, 0));
}
