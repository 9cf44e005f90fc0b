// SPDX-License-Identifier: Apache-2.0
#include "render/surface_normals.h"

#include <gtest/gtest.h>

using Eigen::Vector3f;
using incise::render::SurfaceNormals;

TEST(SurfaceNormals, are_weighted_by_area) {
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 0, 0}};
  const std::vector<Vector3f> positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.8F, 0, 1}};
  SurfaceNormals averages;
  static_cast<void>(averages.average(triangles, std::vector<Vector3f>(9, {9, 9, 9})));
  const std::vector<Vector3f>& normals = averages.average(triangles, positions);
  ASSERT_EQ(normals.size(), 4U);
  EXPECT_EQ(normals[1], Vector3f(0, 0, 4));
  EXPECT_EQ(normals[3], Vector3f(2, 0, -1.6F));
  EXPECT_EQ(normals[0], Vector3f(2, 0, 2.4F));
}

TEST(SurfaceNormals, are_zero_at_creases_alone) {
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  SurfaceNormals averages;
  const auto at_ridge = [&](const Vector3f& beyond) {
    const std::vector<Vector3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, beyond};
    averages.find_creases(triangles, positions);
    return averages.average(triangles, positions)[0];
  };
  EXPECT_EQ(at_ridge({-1, 0, 0}), Vector3f(0, 0, 2));
  EXPECT_EQ(at_ridge({-1, 0, -0.5F}), Vector3f(-0.5F, 0, 2));  // bent by 27 degrees
  EXPECT_EQ(at_ridge({0, 0, -1}), Vector3f(0, 0, 0));          // by 90
}

TEST(SurfaceNormals, points_without_triangles_have_none) {
  SurfaceNormals averages;
  const std::vector<Vector3f>& normals = averages.average({}, std::vector<Vector3f>{{1, 2, 3}});
  ASSERT_EQ(normals.size(), 1U);
  EXPECT_EQ(normals[0], Vector3f(0, 0, 0));
}
