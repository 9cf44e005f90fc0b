// SPDX-License-Identifier: Apache-2.0
// Whole strokes that begin where others end: the pieces of one stroke, in both profiles, however many there are.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "incise/mesh/quality_stats.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/strokes.h"

namespace incise::test::whole_strokes_test {
namespace {

using Rows = std::vector<std::vector<Vec3>>;

constexpr std::size_t kSteps = 28;

Engine engine_of(TetSoup body, Profile profile) {
  EngineOptions options;
  options.cut.profile = profile;
  return Engine::create(build(std::move(body)), options).value();
}

void cut_whole(Engine& engine, const Stroke& stroke) {
  const Result<StrokeReport> report = engine.cut(stroke);
  ASSERT_TRUE(report.ok()) << report.error().message;
}

/// A sheet through the unit cube that bends by a height over its path and turns about that, oblique to the body.
Rows bent_rows(double bend, double turn) {
  const Vec3 u = Vec3(0.9, 0.3, 0.1).normalized(), w = u.cross(Vec3(0.1, 1, 0.2)).normalized(), n = w.cross(u);
  Rows rows;
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double s = 2.0 * static_cast<double>(k) / kSteps - 1.0;
    const Vec3 middle = Vec3(0.52, 0.49, 0.51) + 1.3 * s * u + bend * s * (1 - s * s) * n;
    const Vec3 along = (w + turn * s * n).normalized();
    rows.push_back({middle - 1.6 * along, middle + 1.6 * along});
  }
  return rows;
}

/// The rows in `count` strokes of as many steps each; each begins where the one before ended.
std::vector<Stroke> abutting(const Rows& rows, std::size_t count) {
  const std::size_t steps = kSteps / count;
  std::vector<Stroke> strokes;
  for (std::size_t first = 0; first + steps <= kSteps; first += steps) {
    const auto from = rows.begin() + static_cast<std::ptrdiff_t>(first);
    strokes.push_back(stroke_of({from, from + static_cast<std::ptrdiff_t>(steps + 1)}));
  }
  return strokes;
}

class WholeStrokes : public ::testing::TestWithParam<Profile> {
 protected:
  static void are_one_cut(const Engine& engine, std::size_t most_tets) {
    EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
    EXPECT_LE(engine.mesh().tet_count(), most_tets);
    expect_valid(engine.mesh(), volume_of(engine.mesh()));
  }
  static std::size_t tets_of_one(const TetSoup& body, const Rows& rows) {
    Engine engine = engine_of(body, GetParam());
    cut_whole(engine, stroke_of(rows));
    EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
    return engine.mesh().tet_count();
  }
};

INSTANTIATE_TEST_SUITE_P(profiles, WholeStrokes, ::testing::Values(Profile::kIncise, Profile::kPaper),
                         [](const auto& profile) { return profile.param == Profile::kPaper ? "paper" : "incise"; });

TEST_P(WholeStrokes, that_abut_on_a_curved_sheet_part_the_body) {
  for (const auto& [bend, turn] : {std::pair(0.3, 0.0), std::pair(0.0, 0.3), std::pair(0.15, 0.15)}) {
    const Rows rows = bent_rows(bend, turn);
    for (const std::uint64_t seed : {0U, 1U}) {
      const TetSoup body = seed == 0 ? kuhn_cube(5) : jittered_cube(5, seed);
      const std::size_t tets = tets_of_one(body, rows);
      for (const std::size_t count : {2U, 7U, 14U, 28U}) {
        SCOPED_TRACE(testing::Message() << bend << ", " << turn << ", seed " << seed << ", " << count << " strokes");
        Engine engine = engine_of(body, GetParam());
        for (const Stroke& stroke : abutting(rows, count)) cut_whole(engine, stroke);
        are_one_cut(engine, 3 * tets / 2);
      }
    }
  }
}

TEST_P(WholeStrokes, go_on_after_steps_and_steps_after_them) {
  const Rows rows = bent_rows(0.15, 0.15);
  Engine engine = engine_of(jittered_cube(5, 2), GetParam());
  bool is_whole = false;
  for (const Stroke& stroke : abutting(rows, 7)) {
    is_whole = !is_whole;
    if (is_whole) {
      cut_whole(engine, stroke);
      continue;
    }
    ASSERT_TRUE(engine.begin_stroke(BladePose{stroke.edges.front()}).ok());
    for (std::size_t k = 1; k < stroke.edges.size(); ++k) ASSERT_TRUE(engine.step(BladePose{stroke.edges[k]}).ok());
    ASSERT_TRUE(engine.end_stroke().ok());
  }
  are_one_cut(engine, 3 * tets_of_one(jittered_cube(5, 2), rows) / 2);
}

TEST_P(WholeStrokes, go_on_once_others_have_cut_elsewhere) {
  const std::vector<Stroke> strokes = abutting(bent_rows(0.15, 0.15), 4);
  Engine engine = engine_of(kuhn_cube(5), GetParam());
  cut_whole(engine, strokes[0]);
  cut_whole(engine, strokes[1]);
  cut_whole(engine,
            quad_stroke(Vec3(0.1, -0.2, -0.2), Vec3(0.1, -0.2, 0.15), Vec3(0.1, 1.2, -0.2), Vec3(0.1, 1.2, 0.15)));
  cut_whole(engine, strokes[2]);
  cut_whole(engine, strokes[3]);
  EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
  expect_valid(engine.mesh(), volume_of(engine.mesh()));
}

TEST_P(WholeStrokes, that_abut_are_undone_redone_and_made_again_bit_for_bit) {
  const std::vector<Stroke> strokes = abutting(bent_rows(0.15, 0.15), 4);
  Engine engine = engine_of(kuhn_cube(5), GetParam());
  cut_whole(engine, strokes[0]);
  cut_whole(engine, strokes[1]);
  expect_undone_and_redone(engine, [&] { cut_whole(engine, strokes[2]); });
  cut_whole(engine, strokes[3]);
  EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
}

/// A pass along a plane across x, in so many strokes; the edge goes down to z = `depth`.
std::vector<Stroke> pass_in_x(double x, double depth, std::size_t count) {
  Rows rows;
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double y = -0.5 + 2.0 * static_cast<double>(k) / kSteps;
    rows.push_back({Vec3(x, y, -0.5), Vec3(x, y, depth)});
  }
  return abutting(rows, count);
}

TEST(WholeStrokesOfIncise, deeper_in_passes_of_several_strokes_are_one_cut) {
  for (const std::size_t count : {1U, 2U, 7U, 14U}) {
    for (const double first : {0.3, 0.62}) {
      SCOPED_TRACE(testing::Message() << count << " strokes, first to " << first);
      Engine engine = engine_of(kuhn_cube(5), Profile::kIncise);
      for (const Stroke& stroke : pass_in_x(0.47, first, count)) cut_whole(engine, stroke);
      EXPECT_EQ(piece_volumes(engine.mesh()).size(), 1U);
      for (const Stroke& stroke : pass_in_x(0.47, 1.5, count)) cut_whole(engine, stroke);
      EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
      expect_valid(engine.mesh(), volume_of(engine.mesh()));
    }
  }
}

// Profile paper may leave a crumb there, by steps as well (docs/limits.md).
TEST(WholeStrokesOfIncise, that_go_back_over_the_last_one_and_on_again_leave_no_crumbs) {
  for (const std::uint64_t seed : {0U, 1U, 2U}) {
    SCOPED_TRACE(seed);
    const Rows rows = bent_rows(0.15, 0.15);
    Engine engine = engine_of(seed == 0 ? kuhn_cube(5) : jittered_cube(5, seed), Profile::kIncise);
    cut_whole(engine, stroke_of({rows.begin(), rows.begin() + 17}));
    cut_whole(engine, stroke_of({rows[16], rows[14], rows[12]}));
    cut_whole(engine, stroke_of({rows.begin() + 16, rows.end()}));
    EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
    expect_valid(engine.mesh(), volume_of(engine.mesh()));
  }
}

}  // namespace
}  // namespace incise::test::whole_strokes_test
