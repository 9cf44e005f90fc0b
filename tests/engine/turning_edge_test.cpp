// SPDX-License-Identifier: Apache-2.0
// An edge that turns about a point between its ends sweeps one surface through that point, however far it turns.
#include <gtest/gtest.h>

#include "support/bodies.h"
#include "support/engines.h"
#include "support/strokes.h"

namespace incise::test::turning_edge_test {
namespace {

/// An edge through `pivot` that turns about the z-axis there; `rise` is its height per length in the plane: 0 sweeps a
/// disc, more a double cone.
Stroke turning(const Vec3& pivot, double rise, double turns, unsigned steps) {
  std::vector<std::vector<Vec3>> edges;
  for (unsigned i = 0; i <= steps; ++i) {
    const auto [x, y] = on_circle(0.02 + turns * i / steps);
    const Vec3 along(x, y, rise);
    const double below = rise > 0 ? 1.0 / rise : 1.6, above = rise > 0 ? 0.9 / rise : 1.3;
    edges.push_back({Vec3(pivot - below * along), Vec3(pivot + above * along)});
  }
  return stroke_of(std::move(edges));
}

Engine cut_by(const Stroke& stroke, Profile profile, bool is_whole) {
  Engine engine = make_engine(jittered_cube(5, 7), 0.2, profile);
  if (is_whole) {
    EXPECT_TRUE(engine.cut(stroke).ok());
  } else {
    EXPECT_TRUE(engine.begin_stroke({stroke.edges.front()}).ok());
    for (std::size_t i = 1; i < stroke.edges.size(); ++i) EXPECT_TRUE(engine.step({stroke.edges[i]}).ok());
    EXPECT_TRUE(engine.end_stroke().ok());
  }
  expect_valid(engine.mesh(), 1.0, 1e-9);
  return engine;
}

class TurningEdge : public testing::TestWithParam<std::tuple<Profile, bool>> {
 protected:
  [[nodiscard]] Engine cut(const Stroke& stroke) const {
    return cut_by(stroke, std::get<0>(GetParam()), std::get<1>(GetParam()));
  }
};

TEST_P(TurningEdge, parts_a_body_along_the_disc_that_it_sweeps) {
  for (const double turns : {0.55, 0.8, 1.3}) {
    for (const unsigned steps : {8U, 16U, 40U}) {
      SCOPED_TRACE(testing::Message() << turns << " turns in " << steps << " steps");
      const Engine engine = cut(turning({0.45, 0.52, 0.43}, 0.0, turns, steps));
      expect_pieces(engine.mesh(), {0.43, 0.57}, 2e-4);
      EXPECT_LT(engine.mesh().tet_count(), 1400U);
    }
  }
}

TEST_P(TurningEdge, takes_both_cones_out_that_it_sweeps) {
  for (const unsigned steps : {16U, 40U}) {
    SCOPED_TRACE(steps);
    const Engine engine = cut(turning({0.5, 0.5, 0.5}, 1.6, 1.0, steps));
    const std::vector<double> pieces = piece_volumes(engine.mesh());
    ASSERT_EQ(pieces.size(), 3U);
    double ground = 0;  // of a cone of unit radius
    for (unsigned i = 0; i < steps; ++i) {
      const auto [x, y] = on_circle(0.02 + 1.0 * i / steps);
      const auto [next_x, next_y] = on_circle(0.02 + 1.0 * (i + 1) / steps);
      ground += 0.5 * (x * next_y - y * next_x);
    }
    const double cone = ground * (0.5 / 1.6) * (0.5 / 1.6) * 0.5 / 3.0;  // of three elements' width
    for (const std::size_t i : {0U, 1U}) EXPECT_NEAR(pieces[i], cone, 0.2 * cone);
  }
}

TEST_P(TurningEdge, makes_no_layers_of_tets_where_it_comes_round_again) {
  for (const double turns : {1.1, 1.5, 2.2}) {
    for (const unsigned steps : {16U, 40U}) {
      SCOPED_TRACE(testing::Message() << turns << " turns in " << steps << " steps");
      EXPECT_LT(cut(turning({0.5, 0.5, 0.5}, 1.6, turns, steps)).mesh().tet_count(), 4500U);
    }
  }
}

TEST_P(TurningEdge, opens_faces_and_closes_no_older_ones) {
  for (const double turns : {0.8, 1.0, 1.5}) {
    SCOPED_TRACE(turns);
    Engine engine = make_engine(jittered_cube(5, 7), 0.2, std::get<0>(GetParam()));
    const auto report = engine.cut(turning({0.5, 0.5, 0.5}, 1.6, turns, 40));
    ASSERT_TRUE(report.ok());
    EXPECT_GT(report->cut.incision_faces, 100);
  }
}

/// What a stroke that came before by steps wanted is nothing to a stroke that is given as a whole.
TEST(WholeStroke, does_not_depend_on_a_stroke_before_that_missed) {
  const Stroke stroke = turning({0.5, 0.5, 0.5}, 1.6, 1.5, 16);
  std::vector<std::pair<std::size_t, std::vector<double>>> results;
  for (const bool has_missed : {false, true}) {
    Engine engine = Engine::create(build(jittered_cube(5, 7)), {}).value();
    if (has_missed) {
      ASSERT_TRUE(engine.begin_stroke({{Vec3(3, 0, 0), Vec3(3, 1, 0)}}).ok());
      ASSERT_TRUE(engine.step({{Vec3(3, 0, 1), Vec3(3, 1, 1)}}).ok());
      ASSERT_TRUE(engine.end_stroke().ok());
    }
    ASSERT_TRUE(engine.cut(stroke).ok());
    results.emplace_back(engine.mesh().tet_count(), piece_volumes(engine.mesh()));
  }
  EXPECT_EQ(results[0], results[1]);
}

INSTANTIATE_TEST_SUITE_P(All, TurningEdge,
                         testing::Combine(testing::Values(Profile::kIncise, Profile::kPaper), testing::Bool()),
                         [](const auto& cases) {
                           return std::string(std::get<0>(cases.param) == Profile::kPaper ? "paper" : "incise") +
                                  (std::get<1>(cases.param) ? "_whole" : "_by_steps");
                         });

}  // namespace
}  // namespace incise::test::turning_edge_test
