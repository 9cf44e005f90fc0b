// SPDX-License-Identifier: Apache-2.0
// Maintenance in the blade's wake: a long stroke is in shape at every frame, but for the band around its front.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "incise/mesh/quality_stats.h"
#include "support/bodies.h"
#include "support/engines.h"

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
