// SPDX-License-Identifier: Apache-2.0
// Maintenance in the blade's wake: a long stroke is in shape at every frame, but for the band around its front.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "incise/geom/quality.h"
#include "incise/mesh/quality_stats.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random.h"

namespace incise::test::wake_test {
namespace {

/// A blade across the whole section of a box that is 4 high and 4 deep.
BladePose pose_at(double x) {
  return {{Vec3(x, -1.0, 2.13), Vec3(x, 5.0, 2.21)}, Vec3(1, 0, 0)};
}

TEST(Wake, is_in_shape_while_the_blade_moves) {
  Engine engine = std::move(Engine::create(build(jittered_box(16, 4, 4, 5)))).value();
  ASSERT_TRUE(engine.begin_stroke(pose_at(-0.7)));
  std::uint64_t spent = 0;
  for (double x = -0.2; x < 14.0; x += 0.5) {
    const Result<StepReport> step = engine.step(pose_at(x));
    ASSERT_TRUE(step);
    spent += step->maintain.work_units;
    const QualityStats behind = measure_quality(engine.mesh(), [&](TetId tet) {
      const TetVertices& v = engine.mesh().vertices(tet);
      return std::all_of(v.begin(), v.end(), [&](VertexId p) { return engine.mesh().rest(p).x() < x - 5.0; });
    });
    if (behind.tets > 0) {
      EXPECT_LE(behind.lr_max, 60.0) << x;
    }
  }
  EXPECT_GT(spent, 0U);
  const Result<StrokeReport> report = engine.end_stroke();
  ASSERT_TRUE(report);
  EXPECT_GT(report->maintain.work_units, spent);
  EXPECT_FALSE(engine.has_maintenance());
  EXPECT_LE(measure_quality(engine.mesh(), [](TetId /*tet*/) { return true; }).lr_max, 60.0);
}

/// The tets with an L/r above 60.
std::size_t bad_tets(const TetMesh& mesh) {
  std::size_t count = 0;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const double lr = longest_edge_over_inradius(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3]));
    count += lr > 60.0 ? 1U : 0U;
  });
  return count;
}

Vec3 direction(Random& random) {
  return random.point(-1, 1).normalized();
}

/// A blade that winds about an axis comes near what it has cut before, while its end goes up and down inside the body:
/// what it makes there anew is maintained, too, though its surroundings were before.
TEST(Wake, leaves_nothing_behind_a_winding_blade_that_could_be_mended) {
  std::size_t bad = 0, mended = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Vec3 along = direction(random), across = along.cross(direction(random)).normalized();
    const Vec3 middle = random.point(0.25, 0.75);
    Engine engine = std::move(Engine::create(build(kuhn_cube(5)))).value();
    for (unsigned i = 0; i < 30; ++i) {
      const double angle = 7.0 * i / 29.0;
      const Vec3 out = std::cos(angle) * across + std::sin(angle) * along.cross(across);
      const Vec3 p = middle + (0.17 + 0.035 * angle) * out;
      const BladePose pose{{p - 1.7 * along, p + random.real(0, 0.17) * along}};
      ASSERT_TRUE(i == 0 ? engine.begin_stroke(pose).ok() : engine.step(pose).ok());
    }
    ASSERT_TRUE(engine.end_stroke());
    const std::size_t left = bad_tets(engine.mesh());
    ASSERT_TRUE(engine.improve());
    bad += left;
    mended += left - std::min(left, bad_tets(engine.mesh()));
  }
  EXPECT_LE(mended, 3U) << "of " << bad << " bad tets that 24 strokes left";
}

TEST(Wake, is_undone_with_the_stroke) {
  Engine engine = std::move(Engine::create(build(jittered_box(12, 4, 4, 5)))).value();
  const std::uint64_t before = engine.mesh().hash();
  ASSERT_TRUE(engine.begin_stroke(pose_at(-0.7)));
  for (double x = -0.2; x < 8.0; x += 0.5) ASSERT_TRUE(engine.step(pose_at(x)));
  const std::uint64_t cut = engine.mesh().hash();
  ASSERT_TRUE(engine.undo());
  EXPECT_EQ(engine.mesh().hash(), before);
  ASSERT_TRUE(engine.redo());
  EXPECT_EQ(engine.mesh().hash(), cut);
}

}  // namespace
}  // namespace incise::test::wake_test
