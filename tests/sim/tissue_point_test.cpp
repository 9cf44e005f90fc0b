// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/tissue_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "incise/geom/closest.h"
#include "incise/mesh/shapes.h"
#include "support/bodies.h"
#include "support/random.h"

namespace incise::test::tissue_point_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// From a place outside to the nearest face of the boundary.
double distance_to_surface(const TetMesh& mesh, const Vec3& place) {
  double least = kInfinity;
  mesh.for_each_tet([&](TetId t) {
    for (unsigned side = 0; side < 4; ++side) {
      if (!mesh.links(t)[side].is_boundary()) continue;
      const auto v = mesh.vertices(Side(t, side));
      least = std::min(least, closest_on_triangle(place, mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2])).distance2);
    }
  });
  return std::sqrt(least);
}

TEST(FindNearest, is_the_place_itself_inside_and_on_the_surface_outside) {
  const TetMesh mesh = TetMesh::build(jittered_box(3, 3, 2, 7)).value();
  Random random(5);
  unsigned inside = 0, outside = 0;
  for (unsigned i = 0; i < 300; ++i) {
    const Vec3 place = random.point(-1, 4);
    const auto found = find_nearest(mesh, BodyShape::kRest, place, kInfinity);
    ASSERT_TRUE(found.has_value());
    ASSERT_TRUE(found->holds(mesh));
    const double distance = (found->place(mesh, BodyShape::kRest) - place).norm();
    double sum = 0;
    for (const double weight : found->weights) {
      EXPECT_GE(weight, -1e-12);
      sum += weight;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    const auto holding = find_tissue(mesh, BodyShape::kRest, {{place}})[0];
    ++(holding ? inside : outside);
    if (holding) {
      EXPECT_TRUE(*found == *holding) << "the first tet that holds it";
      EXPECT_NEAR(distance, 0, 1e-12);
      continue;
    }
    const double least = distance_to_surface(mesh, place);
    EXPECT_NEAR(distance, least, 1e-12);
    EXPECT_TRUE(find_nearest(mesh, BodyShape::kRest, place, least + 1e-9).has_value());
    EXPECT_FALSE(find_nearest(mesh, BodyShape::kRest, place, least - 1e-9).has_value());
  }
  EXPECT_GT(inside, 20U);
  EXPECT_GT(outside, 20U);
}

TEST(FindNearest, looks_at_the_shape_that_is_asked_for) {
  TetMesh mesh = TetMesh::build(kuhn_cube(1)).value();
  std::vector<Vec3> places;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) places.push_back(mesh.rest(VertexId(v)) + Vec3(5, 0, 0));
  mesh.set_current(places);
  const Vec3 place(5.25, 0.5, 0.75);
  const auto found = find_nearest(mesh, BodyShape::kCurrent, place, 0);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT((found->place(mesh, BodyShape::kCurrent) - place).norm(), 1e-12);
  EXPECT_FALSE(find_nearest(mesh, BodyShape::kRest, place, 4).has_value());
}

}  // namespace
}  // namespace incise::test::tissue_point_test
