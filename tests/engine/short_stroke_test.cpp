// SPDX-License-Identifier: Apache-2.0
// Strokes shorter than an element that go on from where another one ended.
#include <gtest/gtest.h>

#include <cmath>

#include "incise/engine/engine.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/validate.h"
#include "support/engines.h"

namespace incise::short_stroke_test {
namespace {

constexpr double kStep = 0.01;  // a twentieth of an element

/// A blade along z in the plane x = 0.43, at height y.
BladePose blade_at(double y) {
  return {{Vec3(0.43, y, -1), Vec3(0.43, y, 2)}, Vec3(0, 1, 0)};
}

/// A cube of 5³ cells that is cut to half its height.
Engine half_cut() {
  Engine engine = Engine::create(TetMesh::build(kuhn_cube(5)).value()).value();
  EXPECT_TRUE(engine.begin_stroke(blade_at(-0.2)));
  for (double y = -0.1; y < 0.55; y += 0.1) EXPECT_TRUE(engine.step(blade_at(y)));
  EXPECT_TRUE(engine.end_stroke());
  return engine;
}

StrokeReport go_on(Engine& engine, double from, double to) {
  EXPECT_TRUE(engine.begin_stroke(blade_at(from)));
  EXPECT_TRUE(engine.step(blade_at(to)));
  return engine.end_stroke().value();
}

/// The mean height of the front.
double front_height(const TetMesh& mesh) {
  double sum = 0;
  std::size_t count = 0;
  mesh.for_each_vertex([&](VertexId v) {
    if ((mesh.shape_of(v) & shape::kFront) == 0) return;
    sum += mesh.rest(v).y();
    ++count;
  });
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

double volume_of(const TetMesh& mesh) {
  double volume6 = 0;
  mesh.for_each_tet([&](TetId tet) { volume6 += mesh.rest_volume6(tet); });
  return volume6 / 6.0;
}

TEST(ShortStroke, moves_the_front_and_cuts_nothing) {
  Engine engine = half_cut();
  const double before = front_height(engine.mesh());
  std::uint64_t cut = 0;
  for (unsigned i = 0; i < 8; ++i) cut += go_on(engine, 0.5 + kStep * i, 0.5 + kStep * (i + 1)).cut.cut_tets;
  EXPECT_EQ(cut, 0U);
  EXPECT_NEAR(front_height(engine.mesh()), before + 8 * kStep, 0.02);
  EXPECT_NEAR(volume_of(engine.mesh()), 1.0, 1e-12);
  EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
}

TEST(ShortStroke, is_undone_redone_and_made_again_bit_for_bit) {
  Engine engine = half_cut();
  const std::uint64_t after = test::expect_undone_and_redone(engine, [&] { go_on(engine, 0.5, 0.5 + kStep); });
  EXPECT_TRUE(engine.undo());
  go_on(engine, 0.5, 0.5 + kStep);
  EXPECT_EQ(engine.mesh().hash(), after);
  EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
}

TEST(ShortStroke, that_starts_away_from_a_front_leaves_it_where_it_is) {
  Engine engine = half_cut();
  const double before = front_height(engine.mesh());
  go_on(engine, 0.6, 0.6 + kStep);  // half an element ahead
  EXPECT_NEAR(front_height(engine.mesh()), before, 0.1);
  EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
}

}  // namespace
}  // namespace incise::short_stroke_test
