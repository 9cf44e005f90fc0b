// SPDX-License-Identifier: Apache-2.0
// A straight edge that is led round a polygon, to where it began, takes the core out, however long its steps are.
#include <gtest/gtest.h>

#include <numbers>

#include "support/bodies.h"
#include "support/engines.h"
#include "support/strokes.h"

namespace incise::test::closing_ring_test {
namespace {

constexpr double kRadius = 0.31;
const Vec3 kMiddle(0.47, 0.53, 0.0);

/// An upright edge that is led round a polygon with as many steps along each side, and on along the first one by a
/// share of it. It begins at a share of its first side.
Stroke led_round(unsigned corners, unsigned steps, double begins_at, double overlap) {
  std::vector<Vec3> turns;
  for (unsigned k = 0; k <= corners; ++k) {
    const auto [x, y] = on_circle(0.07 + 1.0 * (k % corners) / corners);
    turns.push_back(kMiddle + kRadius * Vec3(x, y, 0));
  }
  std::vector<Vec3> way;
  const Vec3 start = turns[0] + begins_at * (turns[1] - turns[0]);
  if (begins_at > 0) way.push_back(start);
  for (unsigned k = begins_at > 0 ? 1 : 0; k < corners; ++k) {
    for (unsigned i = 0; i < steps; ++i) way.push_back(turns[k] + (1.0 * i / steps) * (turns[k + 1] - turns[k]));
  }
  way.push_back(turns[0]);
  if (begins_at > 0) way.push_back(start);
  if (overlap > 0) way.push_back(turns[0] + (begins_at + overlap) * (turns[1] - turns[0]));
  std::vector<std::vector<Vec3>> edges;
  for (const Vec3& p : way) edges.push_back({p - Vec3(0, 0, 0.2), p + Vec3(0, 0, 1.2)});
  return stroke_of(std::move(edges));
}

void expect_core(const Stroke& stroke, unsigned corners, Profile profile, bool is_whole) {
  Engine engine = make_engine(jittered_cube(10, 3), 0.2, profile);
  if (is_whole) {
    EXPECT_TRUE(engine.cut(stroke).ok());
  } else {
    EXPECT_TRUE(engine.begin_stroke({stroke.edges.front()}).ok());
    for (std::size_t i = 1; i < stroke.edges.size(); ++i) EXPECT_TRUE(engine.step({stroke.edges[i]}).ok());
    EXPECT_TRUE(engine.end_stroke().ok());
  }
  const double core = 0.5 * corners * kRadius * kRadius * std::sin(2 * std::numbers::pi / corners);
  expect_pieces(engine.mesh(), {core, 1 - core}, 0.05 * core);
  expect_valid(engine.mesh(), 1.0, 1e-9);
}

class ClosingRing : public testing::TestWithParam<std::tuple<Profile, unsigned, unsigned>> {};

TEST_P(ClosingRing, is_closed_at_the_corner_where_it_began) {
  const auto [profile, corners, steps] = GetParam();
  for (const double overlap : {0.0, 0.3}) {
    expect_core(led_round(corners, steps, 0.0, overlap), corners, profile, false);
  }
}

TEST_P(ClosingRing, is_closed_within_a_side) {
  const auto [profile, corners, steps] = GetParam();
  for (const double overlap : {0.0, 0.2}) {
    expect_core(led_round(corners, steps, 0.5, overlap), corners, profile, false);
  }
}

TEST_P(ClosingRing, is_closed_as_a_whole_stroke) {
  const auto [profile, corners, steps] = GetParam();
  expect_core(led_round(corners, steps, 0.0, 0.0), corners, profile, true);
}

INSTANTIATE_TEST_SUITE_P(Incise, ClosingRing,
                         testing::Combine(testing::Values(Profile::kIncise), testing::Values(3U, 4U, 6U),
                                          testing::Values(1U, 2U, 5U)));
INSTANTIATE_TEST_SUITE_P(Paper, ClosingRing,
                         testing::Combine(testing::Values(Profile::kPaper), testing::Values(4U, 6U),
                                          testing::Values(1U, 2U, 5U)));

}  // namespace
}  // namespace incise::test::closing_ring_test
