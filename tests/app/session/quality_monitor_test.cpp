// SPDX-License-Identifier: Apache-2.0
#include "app/session/quality_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "app/view/surface_view.h"
#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"
#include "incise/geom/quality.h"
#include "incise/mesh/quality_stats.h"

namespace incise::app::quality_monitor_test {
namespace {

float ratio_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return static_cast<float>(
      longest_edge_over_inradius(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])));
}

/// The worst tets, found without a monitor.
std::vector<TetId> worst_of(const TetMesh& mesh, std::size_t count) {
  std::vector<TetId> tets;
  mesh.for_each_tet([&](TetId t) { tets.push_back(t); });
  std::stable_sort(tets.begin(), tets.end(), [&](TetId a, TetId b) { return ratio_of(mesh, a) > ratio_of(mesh, b); });
  tets.resize(std::min(count, tets.size()));
  return tets;
}

void expect_equal(const QualityMonitor& monitor, const TetMesh& mesh) {
  const QualityStats expected = measure_quality(mesh);
  const QualityFigures& found = monitor.now();
  EXPECT_EQ(found.tets, expected.tets);
  EXPECT_NEAR(found.lr_min, expected.lr_min, 1e-6 * expected.lr_min);
  EXPECT_NEAR(found.lr_mean, expected.lr_mean, 1e-6 * expected.lr_mean);
  EXPECT_NEAR(found.lr_max, expected.lr_max, 1e-6 * expected.lr_max);
  EXPECT_NEAR(found.lr_over_200_pct, expected.lr_over_200_pct, 1e-9);
  EXPECT_EQ(std::accumulate(found.histogram.begin(), found.histogram.end(), std::uint64_t{0}), found.tets);
  EXPECT_EQ(monitor.worst(7), worst_of(mesh, 7));
}

class QualityMonitorTest : public testing::Test {
 protected:
  void cut(const Vec3& normal, double offset) {
    const Box around{Vec3::Constant(-0.5), Vec3::Constant(1.5)};
    EXPECT_TRUE(engine_.cut(plane_stroke(around, normal, offset).value()).ok());
  }
  void cut_at_random() {
    const auto number = [&] { return std::uniform_real_distribution<>(-1, 1)(random_); };
    const Vec3 normal(number(), number(), number());
    cut(normal, normal.dot(Vec3(0.5, 0.5, 0.5)) + 0.2 * number());
  }
  bool follow() { return monitor_.follow(engine_.mesh(), engine_.journal()); }
  void check() {
    follow();
    expect_equal(monitor_, engine_.mesh());
  }
  static EngineOptions options() {
    EngineOptions options;
    options.maintain.work_units = 0;
    return options;
  }

  std::mt19937 random_{3};
  Engine engine_ = Engine::create(cube_mesh(4), options()).value();
  QualityMonitor monitor_{engine_.mesh(), engine_.journal()};
};

TEST_F(QualityMonitorTest, MeasuresTheMeshAtFirst) {
  expect_equal(monitor_, engine_.mesh());
  EXPECT_EQ(monitor_.before().tets, engine_.mesh().tet_count());
  EXPECT_FALSE(follow());
}

TEST_F(QualityMonitorTest, FollowsRandomCutsMaintenanceUndoAndRedo) {
  for (int round = 0; round < 30; ++round) {
    switch (random_() % 5) {
      case 0:
      case 1:
        if (engine_.mesh().tet_count() < 20000) cut_at_random();
        break;
      case 2:
        EXPECT_TRUE(engine_.maintain(50000).ok());
        break;
      case 3:
        engine_.undo();
        break;
      default:
        engine_.redo();
        break;
    }
    if (random_() % 3 > 0) check();
  }
  check();
  EXPECT_EQ(monitor_.before().tets, 384U);
}

TEST_F(QualityMonitorTest, SaysWhetherAnythingChanged) {
  cut(Vec3::UnitX(), 0.47);
  EXPECT_TRUE(follow());
  EXPECT_FALSE(follow());
  engine_.undo();
  EXPECT_TRUE(follow());
  EXPECT_FALSE(follow());
  expect_equal(monitor_, engine_.mesh());
}

TEST_F(QualityMonitorTest, AShallowerCutAfterAnUndoIsSeen) {
  cut(Vec3::UnitX(), 0.47);
  follow();
  engine_.undo();
  cut(Vec3::UnitY(), 0.31);
  check();
}

TEST_F(QualityMonitorTest, WorstIsSortedAndNoMoreThanThereAre) {
  cut_at_random();
  follow();
  const std::size_t count = engine_.mesh().tet_count();
  EXPECT_EQ(monitor_.worst(count + 10), worst_of(engine_.mesh(), count));
  EXPECT_TRUE(monitor_.worst(0).empty());
}

TEST_F(QualityMonitorTest, BinsAreThoseOfTheByte) {
  for (int i = 0; i < 3; ++i) cut_at_random();
  follow();
  std::array<std::uint32_t, QualityFigures::kBins> expected{};
  engine_.mesh().for_each_tet([&](TetId t) {
    ++expected[quality_byte(static_cast<double>(ratio_of(engine_.mesh(), t))) / (256 / QualityFigures::kBins)];
  });
  EXPECT_EQ(monitor_.now().histogram, expected);
}

TEST(QualityMonitorOf, AnEmptyMeshIsAllZero) {
  const TetMesh mesh;
  const Journal journal;
  QualityMonitor monitor(mesh, journal);
  EXPECT_EQ(monitor.now().tets, 0U);
  EXPECT_EQ(monitor.now().lr_min, 0);
  EXPECT_TRUE(monitor.worst(5).empty());
}

TEST(QualityMonitorOf, FlatTetsAreBadAndStayOutOfTheMean) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, 0.3, -1e-14}};
  soup.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  const Result<TetMesh> mesh = TetMesh::build(soup);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const QualityMonitor monitor(*mesh, Journal());
  const QualityStats expected = measure_quality(*mesh);
  EXPECT_EQ(expected.flat_tets, 1U);
  EXPECT_EQ(monitor.now().tets, 2U);
  EXPECT_NEAR(monitor.now().lr_max, expected.lr_max, 1e-5);
  EXPECT_EQ(monitor.now().lr_over_200_pct, 50);
  EXPECT_EQ(monitor.now().histogram.back(), 1U);
  EXPECT_EQ(monitor.worst(1).at(0), TetId(1));
}

}  // namespace
}  // namespace incise::app::quality_monitor_test
