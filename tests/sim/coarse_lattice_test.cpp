// SPDX-License-Identifier: Apache-2.0
#include "sim/body/coarse_lattice.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "incise/sim/body.h"
#include "sim/body/body_state.h"
#include "support/beam.h"
#include "support/random.h"

namespace incise::test::coarse_lattice_test {
namespace {

TEST(BandMatrix, SolvesWhatADenseMatrixSolves) {
  Random random(3);
  for (const auto& [size, reach] : {std::pair<std::size_t, std::size_t>(1, 0), {7, 0}, {7, 2}, {40, 11}, {12, 11}}) {
    detail::BandMatrix band(size, reach);
    const auto n = static_cast<Eigen::Index>(size);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t j = 0; j < size; ++j) {
      for (std::size_t i = j; i < std::min(size, j + reach + 1); ++i) {
        const double value = i == j ? 2.0 * static_cast<double>(reach) + 1 : random.real(-1, 1);
        band.add(i, j, value);
        dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value;
        dense(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = value;
      }
    }
    std::vector<double> x(size);
    for (double& value : x) value = random.real(-1, 1);
    const Eigen::VectorXd expected = dense.ldlt().solve(Eigen::Map<Eigen::VectorXd>(x.data(), n));
    ASSERT_TRUE(band.factor());
    band.solve(x);
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(x[i], expected[static_cast<Eigen::Index>(i)], 1e-12);
  }
}

TEST(BandMatrix, SaysWhereItIsNotPositiveDefinite) {
  detail::BandMatrix band(2, 1);
  band.add(0, 0, 1);
  band.add(1, 0, 2);
  band.add(1, 1, 1);
  EXPECT_FALSE(band.factor());
}

DeformableBody hung_beam(const TetMesh& mesh, const BodyOptions& options) {
  Materials materials;
  materials.fallback.young = 300e3;
  DeformableBody body = DeformableBody::create(mesh, {}, materials, options).value();
  for (const VertexId v : vertices_at(mesh, 0)) EXPECT_TRUE(body.hold(v, std::numeric_limits<double>::infinity()).ok());
  return body;
}

TEST(CoarseLattice, ThreadsDoNotChangeTheResult) {
  const TetMesh mesh = make_beam({});
  BodyOptions options;
  DeformableBody one = hung_beam(mesh, options);
  options.threads = 2;
  DeformableBody two = hung_beam(mesh, options);
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(one.advance(1.0 / 60).ok() && two.advance(1.0 / 60).ok());
  EXPECT_EQ(one.hash(), two.hash());
}

/// Without any sweep.
TEST(CoarseLattice, OneCorrectionBringsABendMostOfTheWay) {
  const TetMesh mesh = make_beam({});
  DeformableBody body = hung_beam(mesh, {});
  ASSERT_TRUE(body.advance(1e-9).ok());  // where it stands
  DeformableBody::State& s = const_cast<DeformableBody::State&>(body.state());
  const double h = 0.1;  // long enough for all of the sag
  s.begin_substep(h);
  s.lattice.prepare(s, h);
  const auto force_left = [&] {  // on the body as a whole
    std::vector<std::array<float, 4>> slopes(mesh.vertex_slots());
    s.find_slopes(slopes.data()->data());
    Vec3 sum = Vec3::Zero();
    for (const auto& [x, y, z, unused] : slopes) {
      sum += Vec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    }
    return sum.norm();
  };
  const double before = force_left();
  s.lattice.correct(s);
  EXPECT_LT(force_left(), 0.5 * before);
}

TEST(CoarseLattice, SmallBodiesDoWithout) {
  const TetMesh mesh = make_beam({{2, 1, 1}, Vec3(0.02, 0.01, 0.01)});
  BodyOptions options;
  DeformableBody with = hung_beam(mesh, options);
  options.coarse = false;
  DeformableBody without = hung_beam(mesh, options);
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(with.advance(1.0 / 60).ok() && without.advance(1.0 / 60).ok());
  EXPECT_EQ(with.hash(), without.hash());
}

/// Halves of a body that was cut in two have nodes of their own: one that falls does not drag the other along.
TEST(CoarseLattice, PiecesThatCameOffMoveByThemselves) {
  const Beam beam;
  EngineOptions engine_options;
  Engine engine = Engine::create(make_beam(beam), engine_options).value();
  ASSERT_TRUE(engine.cut(*plane_stroke({Vec3::Zero(), beam.size}, Vec3(1, 0, 0), 0.05)).ok());
  DeformableBody body = hung_beam(engine.mesh(), {});
  for (int i = 0; i < 12; ++i) ASSERT_TRUE(body.advance(1.0 / 60).ok());
  const std::vector<Vec3> positions(body.positions().begin(), body.positions().end());
  const double fallen = tip_sag(engine.mesh(), positions, beam);
  EXPECT_NEAR(fallen, 0.02 * 9.81, 0.005);  // 48 implicit steps in 0.2 s: a little further than in truth
  double held = 0;
  engine.mesh().for_each_vertex([&](VertexId v) {
    if (engine.mesh().rest(v).x() < 0.049) held = std::max(held, (positions[v.value] - engine.mesh().rest(v)).norm());
  });
  EXPECT_LT(held, 0.002);
}

}  // namespace
}  // namespace incise::test::coarse_lattice_test
