// SPDX-License-Identifier: Apache-2.0
#include "incise/cut/region_guard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random.h"
#include "support/random_strokes.h"

namespace incise::region_guard_test {
namespace {

using namespace incise::test;

constexpr std::int32_t kSkin = 1, kFat = 2, kMuscle = 3;

/// A block of 8 × 6 × 6 whose layers lie across z: muscle up to 2, fat up to `fat`, skin above.
TetSoup layered_block(double fat = 4, std::uint64_t seed = 3) {
  TetSoup soup = jittered_box(8, 6, 6, seed);
  soup.regions.clear();
  for (const auto& tet : soup.tets) {
    double z = 0;
    for (const std::uint32_t v : tet) z += soup.points[v].z() / 4;
    soup.regions.push_back(z < 2 ? kMuscle : (z < fat ? kFat : kSkin));
  }
  return soup;
}

double volume_of_region(const TetMesh& mesh, std::int32_t region) {
  double sum = 0;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const Vec3 a = mesh.rest(v[0]);
    const double six = (mesh.rest(v[1]) - a).cross(mesh.rest(v[2]) - a).dot(mesh.rest(v[3]) - a);
    if (mesh.region(tet) == region) sum += six / 6;
  });
  return sum;
}

std::size_t count_walls(const TetMesh& mesh, std::int32_t region) {
  std::size_t count = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (const Link link : mesh.links(tet)) {
      count += mesh.region(tet) == region && link.is_boundary() && link.tag() > 0 ? 1U : 0U;
    }
  });
  return count;
}

/// A blade across the block that comes down from `from` to `to`, and is drawn along x to `end`.
Stroke blade(double from, double to, double x, double end) {
  Stroke stroke;
  stroke.times = {0, 1, 2, 3};
  const auto edge = [](double at, double low) {
    return std::vector<Vec3>{Vec3(at, 3.1, low), Vec3(at - 0.2, 3.05, low + 9)};
  };
  stroke.edges = {edge(x, from), edge(x, to), edge(end, to), edge(end, from)};
  return stroke;
}

TEST(RegionGuard, a_blade_that_is_pressed_down_stands_still_above_the_region) {
  const TetMesh mesh = build(layered_block());
  RegionGuard guard({kMuscle}, RegionGuard::Shape::kRest);
  const std::vector<Vec3> above = {{1, 3, 8}, {7, 3, 8}}, below = {{1, 3, -2}, {7, 3, -2}};
  const auto first = guard.begin(mesh, above);
  ASSERT_TRUE(first.ok());
  EXPECT_GT(first->size(), 10U);
  const std::vector<Vec3> held = guard.move(mesh, below);
  EXPECT_TRUE(guard.holds());
  for (const Vec3& p : held) {
    EXPECT_GT(p.z(), 2.0);
    EXPECT_LT(p.z(), 3.0);
  }
  EXPECT_EQ(guard.move(mesh, above), *first);
  EXPECT_FALSE(guard.holds());
}

TEST(RegionGuard, no_jump_passes_a_region_of_one_tet) {
  const TetMesh mesh = build(layered_block(3));  // fat from 2 to 3
  RegionGuard guard({kFat}, RegionGuard::Shape::kRest);
  ASSERT_TRUE(guard.begin(mesh, std::vector<Vec3>{{3, 3, 8}, {5, 3, 8}}).ok());
  for (const Vec3& p : guard.move(mesh, std::vector<Vec3>{{3, 3, -9}, {5, 3, -9}})) EXPECT_GT(p.z(), 2.9);
}

TEST(RegionGuard, what_begins_within_is_refused) {
  const TetMesh mesh = build(layered_block());
  RegionGuard guard({kMuscle}, RegionGuard::Shape::kRest);
  EXPECT_FALSE(guard.begin(mesh, std::vector<Vec3>{{3, 3, 1}, {3, 3, 8}}).ok());
  EXPECT_FALSE(guard.is_on());
  EXPECT_FALSE(hold_outside(mesh, blade(1, 0, 3, 5), {kMuscle}).ok());
}

TEST(RegionGuard, a_stroke_that_meets_no_region_stays_as_it_is) {
  const TetMesh mesh = build(layered_block());
  const Stroke given = blade(10, 4.5, -1, 9);
  const auto held = hold_outside(mesh, given, {kMuscle});
  ASSERT_TRUE(held.ok());
  EXPECT_EQ(held->times, given.times);
  EXPECT_EQ(held->edges.back().front(), given.edges.back().front());
  const auto nothing = hold_outside(mesh, given, {99});
  ASSERT_TRUE(nothing.ok());
  EXPECT_EQ(nothing->edges, given.edges);
}

TEST(RegionGuard, a_stroke_cuts_to_the_region_and_no_further) {
  Engine engine = make_engine(layered_block());
  const double before = volume_of_region(engine.mesh(), kMuscle), all = volume_of(engine.mesh());
  const auto held = hold_outside(engine.mesh(), blade(10, 0.3, -1, 9), {kMuscle});
  ASSERT_TRUE(held.ok()) << held.error().message;
  ASSERT_TRUE(engine.cut(*held).ok());
  const TetMesh& mesh = engine.mesh();
  expect_valid(mesh, all, 1e-9);
  EXPECT_EQ(count_walls(mesh, kMuscle), 0U);
  EXPECT_GT(count_walls(mesh, kFat), 20U);
  EXPECT_GT(count_walls(mesh, kSkin), 20U);
  EXPECT_NEAR(volume_of_region(mesh, kMuscle), before, 1e-9);
  EXPECT_EQ(piece_volumes(mesh).size(), 1U) << "the muscle holds both halves";
  double area = 0;  // of walls in the fat, both sides: from the margin above the muscle to 4
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.region(tet) != kFat || !mesh.links(tet)[s].is_boundary() || mesh.links(tet)[s].tag() == 0) continue;
      const auto v = mesh.vertices(Side(tet, s));
      area += 0.5 * (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).norm();
    }
  });
  EXPECT_NEAR(area, 2 * 8 * 1.6, 0.15 * 2 * 8 * 1.6);
}

TEST(RegionGuard, random_strokes_never_cut_what_they_stop_at) {
  Random random(11);
  std::size_t cut = 0;
  for (unsigned run = 0; run < 16; ++run) {
    Engine engine = make_engine(layered_block(4, 100 + run));
    const Box box = rest_bounds(engine.mesh());
    const Stroke stroke = random_stroke(random, box);
    const auto held = hold_outside(engine.mesh(), stroke, {kMuscle});
    if (!held.ok()) continue;  // it begins in the muscle
    const double before = volume_of_region(engine.mesh(), kMuscle), all = volume_of(engine.mesh());
    ASSERT_TRUE(engine.cut(*held).ok());
    SCOPED_TRACE(run);
    expect_valid(engine.mesh(), all, 1e-9);
    EXPECT_EQ(count_walls(engine.mesh(), kMuscle), 0U);
    EXPECT_NEAR(volume_of_region(engine.mesh(), kMuscle), before, 1e-9);
    cut += count_walls(engine.mesh(), kFat) > 0 ? 1U : 0U;
  }
  EXPECT_GT(cut, 4U);
}

}  // namespace
}  // namespace incise::region_guard_test
