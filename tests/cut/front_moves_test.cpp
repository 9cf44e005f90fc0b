// SPDX-License-Identifier: Apache-2.0
// A blade that goes on through the same tets moves the points of the front; the tets around them stay.
#include <gtest/gtest.h>

#include <cstdint>

#include "support/bodies.h"
#include "support/engines.h"
#include "support/mirror_checks.h"

namespace incise::test::front_moves_test {
namespace {

/// What steps of a stroke did, by their reports and the journal.
struct Counts {
  std::uint64_t cut = 0, made = 0, moved = 0;
};

/// A blade through a cube of 8³ cells, in steps of a quarter cell, as deep as 3/4.
Counts cut_in_steps(Engine& engine, JournalMirror& mirror) {
  const auto pose = [](unsigned i) {
    const double z = 1.05 - i / 32.0;
    return BladePose{{Vec3(0.47, -0.2, z), Vec3(0.52, 1.2, z - 0.02)}, Vec3::Zero()};
  };
  Counts sum;
  EXPECT_TRUE(engine.begin_stroke(pose(0)).ok());
  for (unsigned i = 1; i <= 26; ++i) {
    const std::size_t from = engine.journal().position();
    const auto report = engine.step(pose(i));
    EXPECT_TRUE(report.ok());
    if (!report.ok()) break;
    sum.cut += report->cut.cut_tets;
    for (std::size_t k = from; k < engine.journal().position(); ++k) {
      sum.made += engine.journal().step(k).produced.size();
      sum.moved += engine.journal().step(k).moved.size();
    }
    expect_follows(mirror, engine.journal(), engine.mesh());
  }
  EXPECT_TRUE(engine.end_stroke().ok());
  expect_follows(mirror, engine.journal(), engine.mesh());
  return sum;
}

class FrontMoves : public ::testing::TestWithParam<double> {};

TEST_P(FrontMoves, take_the_tets_of_a_front_along) {
  Engine engine = make_engine(kuhn_cube(8), GetParam());
  JournalMirror mirror = mirror_of(engine.mesh());
  const Counts sum = cut_in_steps(engine, mirror);
  ASSERT_GT(sum.cut, 200U);
  EXPECT_GT(sum.moved, sum.cut / 2);
  EXPECT_LT(static_cast<double>(sum.made), 22.0 * static_cast<double>(sum.cut));  // all made anew: 26
  expect_affine_velocity(mirror, 1e-9);
  expect_valid(engine.mesh(), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Snaps, FrontMoves, ::testing::Values(0.0, 0.2));

}  // namespace
}  // namespace incise::test::front_moves_test
