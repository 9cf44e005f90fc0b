// SPDX-License-Identifier: Apache-2.0
#include "sim/body/element.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "incise/mesh/shapes.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/body.h"
#include "incise/sim/reference.h"
#include "sim/body/body_state.h"
#include "support/random.h"

namespace incise::element_test {
namespace {

using detail::Element;
using test::Random;
using Corners = std::array<Vec3, 4>;

/// A tet of size about 1 and any shape but a flat one.
Corners any_tet(Random& random) {
  while (true) {
    const Corners p = {random.point(-1, 1), random.point(-1, 1), random.point(-1, 1), random.point(-1, 1)};
    if (detail::six_volumes(p) > 0.1) return p;
  }
}

Corners moved(Corners p, Random& random, double size) {
  for (Vec3& x : p) x += random.point(-size, size);
  return p;
}

constexpr double kLambda = 3, kMu = 2;

TEST(Element, VolumeSlopesAreThoseOfSixVolumes) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Corners p = any_tet(random);
    for (unsigned c = 0; c < 4; ++c) {
      Corners q = p;
      const Vec3 step = random.point(-1, 1);
      q[c] += step;
      EXPECT_NEAR(detail::six_volumes(q) - detail::six_volumes(p), detail::volume_slope(p, c).dot(step), 1e-13);
    }
  }
}

TEST(Element, RestHasNoEnergyAndNoSlope) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Corners p = any_tet(random);
    const Element element = detail::element_of(p, kLambda, kMu, 0.05);
    EXPECT_EQ(detail::energy_of(element, p), 0);
    for (unsigned c = 0; c < 4; ++c) EXPECT_LT(detail::slope_of(element, p, c).norm(), 1e-12);
  }
}

TEST(Element, RigidMotionCostsNothing) {
  Random random(3);
  const Corners p = any_tet(random);
  const Element element = detail::element_of(p, kLambda, kMu, 0.05);
  Corners q;
  for (unsigned c = 0; c < 4; ++c)
    q[c] = Vec3(0.6 * p[c].x() - 0.8 * p[c].y(), 0.8 * p[c].x() + 0.6 * p[c].y(), p[c].z() + 5);
  EXPECT_NEAR(detail::energy_of(element, q), 0, 1e-13);
}

TEST(Element, SlopesAreTheFiniteDifferencesOfTheEnergy) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Corners rest = any_tet(random), p = moved(rest, random, 0.8);  // some turn inside out
    const Element element = detail::element_of(rest, kLambda, kMu, i % 2 == 0 ? 0.05 : 0.4);
    for (unsigned c = 0; c < 4; ++c) {
      const Vec3 slope = detail::slope_of(element, p, c);
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double kStep = 1e-5;
        Corners low = p, high = p;
        low[c][axis] -= kStep;
        high[c][axis] += kStep;
        const double difference = (detail::energy_of(element, high) - detail::energy_of(element, low)) / (2 * kStep);
        EXPECT_NEAR(slope[axis], difference, 1e-8 * (1 + slope.norm()));
      }
    }
  }
}

TEST(Element, TissueThatStiffensHasTheSlopesAndTheCurvatureOfItsEnergy) {
  Random random(14);
  double stiffest = 0;
  for (int i = 0; i < 50; ++i) {
    const Corners rest = any_tet(random), p = moved(rest, random, 0.4);
    const Element element = detail::element_of(rest, kLambda, kMu, 0.05, 0, 0, 5);
    stiffest = std::max(stiffest, detail::stiffened(element, detail::soft_energy_of(element, p)).factor);
    for (unsigned c = 0; c < 4; ++c) {
      const Vec3 slope = detail::slope_of(element, p, c);
      const Mat3 stiffness = detail::stiffness_at(element, p, c);
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double kStep = 1e-6;
        Corners low = p, high = p;
        low[c][axis] -= kStep;
        high[c][axis] += kStep;
        const double difference = (detail::energy_of(element, high) - detail::energy_of(element, low)) / (2 * kStep);
        EXPECT_NEAR(slope[axis], difference, 1e-6 * (1 + slope.norm()));
        const Vec3 bend = (detail::slope_of(element, high, c) - detail::slope_of(element, low, c)) / (2 * kStep);
        EXPECT_LT((stiffness.col(axis) - bend).norm(), 1e-5 * (1 + stiffness.norm()));
      }
    }
  }
  EXPECT_GT(stiffest, 100);
}

TEST(Element, TissueThatStiffensIsTheSameAtSmallStrainsAndEndsToStiffenSomewhere) {
  Random random(15);
  const Corners rest = any_tet(random);
  const Element soft = detail::element_of(rest, kLambda, kMu, 0),
                stiff = detail::element_of(rest, kLambda, kMu, 0, 0, 0, 5);
  const Corners near = moved(rest, random, 1e-4);
  EXPECT_NEAR(detail::energy_of(stiff, near) / detail::energy_of(soft, near), 1, 1e-5);
  EXPECT_EQ(detail::energy_of(stiff, rest), 0);
  const double most = (detail::kStiffest - 1) / stiff.stiffening;
  const detail::Stiffened below = detail::stiffened(stiff, most * (1 - 1e-9));
  const detail::Stiffened beyond = detail::stiffened(stiff, 3 * most);
  EXPECT_NEAR(below.factor, 2097152, 1);
  EXPECT_NEAR(beyond.factor, 2097152, 1);
  EXPECT_EQ(beyond.growth, 0);
  EXPECT_NEAR(beyond.energy, below.energy + 2 * most * beyond.factor, 1e-6 * beyond.energy);
}

/// Seen from one corner the energy is quadratic, with the curvature that the descent uses.
TEST(Element, EnergyIsQuadraticInOneCorner) {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Corners rest = any_tet(random), p = moved(rest, random, 0.8);
    const Element element = detail::element_of(rest, kLambda, kMu, 0.05);
    for (unsigned c = 0; c < 4; ++c) {
      const Vec3 step = random.point(-1, 1), n = detail::volume_slope(p, c);
      double diagonal = 0;
      for (unsigned j = 0; j < 4; ++j) diagonal -= j == c ? 0.0 : element.laplacian[kEdgeOfCorners[c][j]];
      const double bend = diagonal * step.squaredNorm() + element.bulk * n.dot(step) * n.dot(step);
      Corners q = p;
      q[c] += step;
      const double expected = detail::energy_of(element, p) + detail::slope_of(element, p, c).dot(step) + 0.5 * bend;
      EXPECT_NEAR(detail::energy_of(element, q), expected, 1e-11 * (1 + std::abs(expected)));
    }
  }
}

TEST(Element, SliversAreAsSoftAsThickerLayers) {
  const auto softened = [](double height, double thinnest) {
    const Corners p = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, height)};
    return detail::element_of(p, kLambda, kMu, thinnest).bulk / detail::element_of(p, kLambda, kMu, 0).bulk;
  };
  EXPECT_EQ(softened(0.5, 0.05), 1);
  const double height = 1e-3, least_altitude = height / std::sqrt(1 + 2 * height * height);
  EXPECT_NEAR(softened(height, 0.05), least_altitude / (0.05 * std::sqrt(2.0)), 1e-12);
}

// --- with materials

DeformableBody make_body(const TetMesh& mesh, const Material& material, double unit = 1) {
  BodyOptions options;
  options.length_unit = unit;
  return DeformableBody::create(mesh, {}, {material, {}}, options).value();
}

TetMesh jittered_block() {
  TetSoup soup = kuhn_box(Vec3::Zero(), Vec3(30, 20, 20), {3, 2, 2});
  jitter(soup, 0.12, 7);
  return *TetMesh::build(std::move(soup));
}

TEST(Element, CrumbsOnlyResistStretch) {
  const std::array<Vec3, 4> p = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const detail::Element whole = detail::element_of(p, 3, 2, 0, 1), crumb = detail::element_of(p, 3, 2, 0, 1.1);
  EXPECT_GT(whole.bulk, 0);
  EXPECT_EQ(crumb.bulk, 0);
  EXPECT_EQ(crumb.pressure, 0);
  EXPECT_EQ(crumb.laplacian, whole.laplacian);
}

TEST(Element, EnergyOfABodyIsThatOfTheReferenceSolver) {
  const TetMesh mesh = jittered_block();
  for (const double poisson : {0.0, 0.2, 0.45, 0.499}) {
    SCOPED_TRACE(poisson);
    Material material;
    material.poisson = poisson;
    DeformableBody body = make_body(mesh, material, 1e-3);
    ReferenceProblem problem;
    problem.mesh = &mesh;
    problem.materials.fallback = material;
    problem.length_unit = 1e-3;
    problem.thinnest = body.options().thinnest;
    const ReferenceSolver reference = *ReferenceSolver::create(problem);
    Random random(6);
    std::vector<Vec3> places(body.positions().begin(), body.positions().end());
    for (std::uint32_t v = 0; v < places.size(); ++v) {
      places[v] += random.point(-2, 2);
      ASSERT_TRUE(body.place(VertexId(v), places[v]).ok());
    }
    const double expected = reference.elastic_energy(places);
    EXPECT_NEAR(body.energy().elastic, expected, 1e-10 * expected);
  }
}

/// Whatever Poisson's ratio: a body at rest is where its energy is least.
TEST(Element, RestIsStableForEveryPoissonRatio) {
  const TetMesh mesh = jittered_block();
  for (const double poisson : {0.0, 0.1, 0.3, 0.499}) {
    SCOPED_TRACE(poisson);
    Material material;
    material.poisson = poisson;
    DeformableBody body = make_body(mesh, material, 1e-3);
    for (const double stretch : {0.9, 0.99, 1.01, 1.1, 2.0}) {
      mesh.for_each_vertex([&](VertexId v) { ASSERT_TRUE(body.place(v, stretch * mesh.rest(v)).ok()); });
      EXPECT_GT(body.energy().elastic, 0) << stretch;
    }
  }
}

}  // namespace
}  // namespace incise::element_test
