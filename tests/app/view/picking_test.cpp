// SPDX-License-Identifier: Apache-2.0
#include "app/view/picking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"

namespace incise::app::picking_test {
namespace {

Vec3 random_point(std::mt19937& random, double low, double high) {
  std::uniform_real_distribution<double> in(low, high);
  const double x = in(random), y = in(random), z = in(random);
  return {x, y, z};
}

/// Where a ray from outside enters the unit cube; infinity where it misses.
double entry_of_cube(const Ray& ray) {
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (Vec3::Index i = 0; i < 3; ++i) {
    const double a = -ray.origin[i] / ray.direction[i], b = (1 - ray.origin[i]) / ray.direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

TEST(Pick, FindsWhereRaysEnterACube) {
  const SurfaceFrame cube = surface_of(cube_mesh(5));
  std::mt19937 random(1);
  unsigned hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from = random_point(random, -1, 1).normalized() * 4 + Vec3::Constant(0.5);
    const Ray ray{from, (random_point(random, -0.5, 1.5) - from).normalized()};
    const double expected = entry_of_cube(ray);
    const std::optional<SurfaceHit> hit = pick(cube, ray);
    ASSERT_EQ(hit.has_value(), expected < 100) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->distance, expected, 1e-6);
    EXPECT_LT((hit->point - ray.origin - expected * ray.direction).norm(), 1e-6);
    EXPECT_LT(hit->normal.dot(ray.direction), 0);
    EXPECT_NEAR(hit->normal.cwiseAbs().maxCoeff(), 1, 1e-6);
    EXPECT_EQ(cube.topology->sides[hit->triangle], hit->side);
  }
  EXPECT_GT(hits, 500U);
}

TEST(Pick, NoRaySlipsThroughEdgesAndCorners) {
  const SurfaceFrame cube = surface_of(cube_mesh(4));
  for (const Vec3& from : {Vec3(0.5, 0.5, 3), Vec3(0.3, 0.9, 7), Vec3(0.37, 0.41, 2.9)}) {
    for (int x = 1; x < 16; ++x) {
      for (int y = 1; y < 16; ++y) {
        const Vec3 to(x / 16.0, y / 16.0, 1);
        EXPECT_TRUE(pick(cube, {from, (to - from).normalized()}).has_value()) << to.transpose();
      }
    }
  }
}

TEST(Pick, WhatIsSeenFromBehindDoesNotCount) {
  const SurfaceFrame cube = surface_of(cube_mesh(3));
  EXPECT_FALSE(pick(cube, {Vec3(0.4, 0.45, 0.5), Vec3::UnitZ()}).has_value());  // from inside
  EXPECT_FALSE(pick(cube, {Vec3(0.4, 0.45, 1.5), Vec3::UnitZ()}).has_value());  // away from it
  EXPECT_TRUE(pick(cube, {Vec3(0.4, 0.45, 1.5), -Vec3::UnitZ()}).has_value());
}

TEST(Pick, WithoutASurfaceNothingIsHit) {
  EXPECT_FALSE(pick({}, {}).has_value());
}

TEST(Pick, FreeSlotsAreIgnored) {
  Result<Engine> engine = Engine::create(cube_mesh(4));
  ASSERT_TRUE(engine.ok());
  SurfaceView view(engine->mesh(), engine->journal());
  ASSERT_TRUE(engine->cut(plane_stroke({Vec3::Constant(-1), Vec3::Constant(2)}, Vec3(1, 0.2, 0), 0.6).value()).ok());
  view.follow(engine->mesh(), engine->journal());
  SurfaceFrame frame;
  view.fill(engine->mesh(), frame);
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    const Vec3 from = random_point(random, -1, 1).normalized() * 4 + Vec3::Constant(0.5);
    const Ray ray{from, (random_point(random, 0, 1) - from).normalized()};
    const std::optional<SurfaceHit> hit = pick(frame, ray);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(frame.topology->looks[hit->triangle].flags & TriangleLook::kUnused, 0);
    EXPECT_NEAR(hit->distance, entry_of_cube(ray), 1e-5);  // a closed cut shows nothing of its walls
  }
}

}  // namespace
}  // namespace incise::app::picking_test
