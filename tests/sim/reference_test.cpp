// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "sim/reference/elastic_body.h"
#include "sim/reference/neo_hookean.h"
#include "support/beam.h"
#include "support/random.h"

namespace incise::reference_test {
namespace {

using test::Beam;
using test::Random;

constexpr double kG = 9.81;  // m/s²

Mat3 random_matrix(Random& random, double size) {
  Mat3 m;
  for (Eigen::Index i = 0; i < 3; ++i) m.col(i) = random.point(-size, size);
  return m;
}

Material soft_tissue(double young, double poisson) {
  Material material;
  material.young = young;
  material.poisson = poisson;
  return material;
}

ReferenceSolver make_solver(const ReferenceProblem& problem) {
  Result<ReferenceSolver> solver = ReferenceSolver::create(problem);
  EXPECT_TRUE(solver.ok());
  return std::move(*solver);
}

std::vector<Vec3> scrambled(std::vector<Vec3> positions, double size, std::uint64_t seed) {
  Random random(seed);
  for (Vec3& p : positions) p += random.point(-size, size);
  return positions;
}

double greatest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
  return greatest;
}

/// A small mesh of tets of many shapes, 1 mm each way per unit.
TetMesh jittered_block() {
  TetSoup soup = kuhn_box(Vec3::Zero(), Vec3(30, 20, 20), {3, 2, 2});
  jitter(soup, 0.12, 7);
  return std::move(*TetMesh::build(std::move(soup)));
}

// --- the energy of one tet

TEST(NeoHookean, EnergyIsThatOfItsDefinition) {
  Random random(1);
  const Material material = soft_tissue(30e3, 0.3);
  const double mu = material.mu(), lambda = material.lambda() + mu, alpha = 1 + mu / lambda;
  const auto by_definition = [&](const Mat3& f) {
    return mu / 2 * (f.squaredNorm() - 3) + lambda / 2 * (f.determinant() - alpha) * (f.determinant() - alpha);
  };
  for (int i = 0; i < 50; ++i) {
    const Mat3 h = random_matrix(random, 1.5);
    const double expected = by_definition(h + Mat3::Identity()) - by_definition(Mat3::Identity());
    EXPECT_NEAR(NeoHookean(material, 1).energy(h), expected, 1e-12 * (std::abs(expected) + mu));
  }
}

TEST(NeoHookean, StressIsTheSlopeOfTheEnergyAndStiffnessThatOfTheStress) {
  Random random(2);
  const NeoHookean tissue(soft_tissue(30e3, 0.45), 1);
  const double step = 1e-5;
  for (int i = 0; i < 30; ++i) {
    const Mat3 h = random_matrix(random, 1.2);
    const Mat3 stress = tissue.stress(h);
    const Mat9 stiffness = tissue.stiffness(h);
    for (Eigen::Index k = 0; k < 9; ++k) {
      Mat3 more = h, less = h;
      more.data()[k] += step;
      less.data()[k] -= step;
      const double slope = (tissue.energy(more) - tissue.energy(less)) / (2 * step);
      EXPECT_NEAR(stress.data()[k], slope, 1e-8 * stiffness.norm());
      const Mat3 bend = (tissue.stress(more) - tissue.stress(less)) / (2 * step);
      const Eigen::Map<const Eigen::Matrix<double, 9, 1>> column(bend.data());
      EXPECT_LT((stiffness.col(k) - column).norm(), 1e-8 * stiffness.norm());
    }
  }
}

TEST(NeoHookean, ProjectionTakesNegativeEigenvaluesAwayAndNothingElse) {
  Random random(3);
  const NeoHookean tissue(soft_tissue(30e3, 0.45), 1);
  int indefinite = 0;
  for (int i = 0; i < 50; ++i) {
    const Mat9 exact = tissue.stiffness(random_matrix(random, 1.2));
    const Mat9 projected = without_negative_part(exact);
    const Eigen::VectorXd before = Eigen::SelfAdjointEigenSolver<Mat9>(exact).eigenvalues();
    const Eigen::VectorXd after = Eigen::SelfAdjointEigenSolver<Mat9>(projected).eigenvalues();
    EXPECT_LT((after - before.cwiseMax(0.0)).norm(), 1e-12 * exact.norm());
    if (before[0] < 0) ++indefinite;
  }
  EXPECT_GT(indefinite, 10);
}

TEST(NeoHookean, RestIsALeastEnergyFromPoissonsRatio0On) {
  for (const double poisson : {0.0, 0.1, 0.3, 0.499}) {
    const NeoHookean tissue(soft_tissue(10e3, poisson), 1);
    EXPECT_EQ(tissue.energy(Mat3::Zero()), 0);
    EXPECT_EQ(tissue.stress(Mat3::Zero()).norm(), 0);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Mat9>(tissue.stiffness(Mat3::Zero())).eigenvalues();
    EXPECT_NEAR(values[0], 0, 1e-9 * values[8]);  // three rotations, and then strains
    EXPECT_GT(values[3], 0.1 * tissue.mu);
  }
}

// --- a whole body

TEST(ElasticBody, GradientAndHessianAreTheSlopesOfTheEnergy) {
  const TetMesh mesh = jittered_block();
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.length_unit = 1e-3;
  problem.materials.fallback = soft_tissue(30e3, 0.45);
  problem.held = test::vertices_at(mesh, 0);
  const ElasticBody body(problem);
  Random random(4);
  std::vector<Vec3> u(mesh.vertex_slots()), direction(mesh.vertex_slots(), Vec3::Zero());
  VecX reals(3 * static_cast<Eigen::Index>(body.unknown_count()));
  for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) {
    u[slot] = random.point(-2e-3, 2e-3);
    if (body.unknown(slot) == kInvalidIndex) continue;
    direction[slot] = random.point(-1, 1);
    reals.segment<3>(3 * static_cast<Eigen::Index>(body.unknown(slot))) = direction[slot];
  }
  const double step = 1e-8;  // m
  std::vector<Vec3> more = u, less = u;
  for (std::size_t i = 0; i < u.size(); ++i) {
    more[i] += step * direction[i];
    less[i] -= step * direction[i];
  }
  const std::vector<Vec3> gradient = body.gradient(u), after = body.gradient(more), before = body.gradient(less);
  const VecX bend = body.hessian(u, false) * reals;
  double slope = 0;
  for (std::uint32_t slot = 0; slot < u.size(); ++slot) {
    slope += gradient[slot].dot(direction[slot]);
    if (body.unknown(slot) == kInvalidIndex) continue;
    const Vec3 expected = (after[slot] - before[slot]) / (2 * step);
    const Vec3 found = bend.segment<3>(3 * static_cast<Eigen::Index>(body.unknown(slot)));
    EXPECT_LT((found - expected).norm(), 1e-6 * bend.norm());
  }
  EXPECT_NEAR((body.energy(more) - body.energy(less)) / (2 * step), slope, 1e-6 * std::abs(slope));
}

TEST(ElasticBody, MassIsThatOfTheVolume) {
  const TetMesh mesh = jittered_block();
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.length_unit = 1e-3;
  problem.materials.fallback.density = 1060;
  double sum = 0;
  for (const double mass : make_solver(problem).masses()) sum += mass;
  EXPECT_NEAR(sum, 1060 * 12e-6, 1e-15);
}

TEST(ElasticBody, ThinTetsAreSoftenedInProportion) {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.2, 0.2, 0.01)};
  soup.tets = {{0, 1, 2, 3}};
  const TetMesh mesh = std::move(*TetMesh::build(std::move(soup)));
  ReferenceProblem problem;
  problem.mesh = &mesh;
  const std::vector<Vec3> pulled = scrambled(test::rest_positions(mesh), 0.1, 5);
  const double whole = make_solver(problem).elastic_energy(pulled);
  problem.thinnest = 0.05;
  EXPECT_NEAR(make_solver(problem).elastic_energy(pulled) / whole, 0.01 / (0.05 * std::sqrt(2.0)), 1e-12);
  problem.thinnest = 0.005;
  EXPECT_EQ(make_solver(problem).elastic_energy(pulled), whole);
}

TEST(ReferenceSolver, RigidMotionCostsNothing) {
  const TetMesh mesh = jittered_block();
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.length_unit = 1e-3;
  const ReferenceSolver solver = make_solver(problem);
  const Mat3 turn = Eigen::AngleAxisd(2.0, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Vec3> positions = test::rest_positions(mesh);
  EXPECT_EQ(solver.elastic_energy(positions), 0);
  for (Vec3& p : positions) p = turn * p + Vec3(10, -20, 5);
  EXPECT_LT(solver.elastic_energy(positions), 1e-16);  // J; a strain of 1 stores about 0.1
  for (const Vec3& force : solver.elastic_forces(positions)) EXPECT_LT(force.norm(), 1e-13);
}

// --- a stretched bar

/// A bar stretched along x that may thin freely: F = diag(stretch, thin, thin).
struct Uniaxial {
  double thin = 1;
  double stress = 0;  // first Piola–Kirchhoff, along x, Pa
};

/// Finds by bisection the thinning at which the sides carry nothing, from the energy as it is defined.
Uniaxial stretch_uniaxially(const Material& material, double stretch) {
  const double mu = material.mu(), lambda = material.lambda() + mu, alpha = 1 + mu / lambda;
  const auto side_stress = [&](double s) { return mu * s + lambda * (stretch * s * s - alpha) * stretch * s; };
  double low = 0.2, high = 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (side_stress(middle) < 0 ? low : high) = middle;
  }
  return {low, mu * stretch + lambda * (stretch * low * low - alpha) * low * low};
}

struct StretchedBar {
  TetMesh mesh = jittered_block();
  Material material;
  double stretch;
  Uniaxial exact;

  StretchedBar(double poisson, double by)
      : material(soft_tissue(30e3, poisson)), stretch(by), exact(stretch_uniaxially(material, by)) {}

  [[nodiscard]] std::vector<Vec3> expected() const {
    std::vector<Vec3> result = test::rest_positions(mesh);
    for (Vec3& p : result) p = p.cwiseProduct(Vec3(stretch, exact.thin, exact.thin));
    return result;
  }
  [[nodiscard]] ReferenceProblem problem() const {
    ReferenceProblem result;
    result.mesh = &mesh;
    result.length_unit = 1e-3;
    result.gravity = Vec3::Zero();
    result.materials.fallback = material;
    result.held = test::vertices_at(mesh, 0);
    return result;
  }
};

TEST(ReferenceSolver, BarBetweenGripsStretchesUniformly) {
  for (const double poisson : {0.0, 0.3, 0.45}) {
    for (const double stretch : {0.7, 1.01, 1.5}) {
      const StretchedBar bar(poisson, stretch);
      ReferenceProblem problem = bar.problem();
      const std::vector<VertexId> grip = test::vertices_at(bar.mesh, 30);
      problem.held.insert(problem.held.end(), grip.begin(), grip.end());
      std::vector<Vec3> positions = scrambled(bar.expected(), 0.5, 6);
      for (const VertexId v : problem.held) positions[v.value] = bar.expected()[v.value];
      const ReferenceSolver solver = make_solver(problem);
      const Result<ReferenceReport> report = solver.solve_statics(positions, {1e-12, 100});
      ASSERT_TRUE(report.ok());
      EXPECT_TRUE(report->converged) << report->residual;
      EXPECT_LT(greatest_distance(positions, bar.expected()), 1e-6);  // of 30 long
      double pull = 0;
      for (const VertexId v : grip) pull -= solver.elastic_forces(positions)[v.value].x();
      EXPECT_NEAR(pull, bar.exact.stress * 400e-6, 1e-10);
    }
  }
}

TEST(ReferenceSolver, DeadLoadsStretchTheBarAsFarAsTheirStressAsks) {
  const StretchedBar bar(0.4, 1.3);
  ReferenceProblem problem = bar.problem();
  problem.loads.assign(bar.mesh.vertex_slots(), Vec3::Zero());
  bar.mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const auto corners = bar.mesh.vertices(Side(tet, s));
      const Vec3 &a = bar.mesh.rest(corners[0]), &b = bar.mesh.rest(corners[1]), &c = bar.mesh.rest(corners[2]);
      if (!(a.x() == 30 && b.x() == 30 && c.x() == 30)) continue;
      const double area = 0.5e-6 * (b - a).cross(c - a).norm();
      for (const VertexId v : corners) problem.loads[v.value].x() += bar.exact.stress * area / 3;
    }
  });
  std::vector<Vec3> positions = test::rest_positions(bar.mesh);
  for (const VertexId v : problem.held) positions[v.value] = bar.expected()[v.value];
  const Result<ReferenceReport> report = make_solver(problem).solve_statics(positions, {1e-12, 100});
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report->converged);
  EXPECT_LT(greatest_distance(positions, bar.expected()), 1e-6);
}

TEST(ReferenceSolver, SmallStrainsHaveYoungsModulusAndPoissonsRatio) {
  for (const double poisson : {0.0, 0.25, 0.45}) {
    const double strain = 1e-6;
    const Material material = soft_tissue(30e3, poisson);
    const Uniaxial exact = stretch_uniaxially(material, 1 + strain);
    EXPECT_NEAR(exact.stress / strain, material.young, 0.001 * material.young);
    EXPECT_NEAR((1 - exact.thin) / strain, material.poisson, 0.001);
  }
}

// --- motion

TEST(ReferenceSolver, FreeFallIsThatOfImplicitEuler) {
  const TetMesh mesh = jittered_block();
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.length_unit = 1e-3;
  problem.gravity = Vec3(0.5, 0, -kG);
  const ReferenceSolver solver = make_solver(problem);
  const std::vector<Vec3> rest = test::rest_positions(mesh);
  std::vector<Vec3> positions = rest, velocities(rest.size(), Vec3(0, 1, 0));
  const double dt = 1.0 / 60;
  const int steps = 30;
  for (int i = 0; i < steps; ++i) {
    const Result<ReferenceReport> report = solver.step(positions, velocities, dt, {1e-10, 20});
    ASSERT_TRUE(report.ok() && report->converged);
  }
  const Vec3 fall = dt * dt * 0.5 * steps * (steps + 1) * problem.gravity + Vec3(0, steps * dt, 0);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_LT((positions[i] - rest[i] - fall * 1000).norm(), 1e-7);
    EXPECT_LT((velocities[i] - Vec3(0, 1, 0) - steps * dt * problem.gravity).norm(), 1e-9);
  }
}

TEST(ReferenceSolver, LongStepsComeToRestInTheEquilibrium) {
  const Beam beam{{6, 2, 2}, Vec3(90, 30, 30)};
  const TetMesh mesh = test::make_beam(beam);
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.length_unit = 1e-3;
  problem.materials.fallback = soft_tissue(10e3, 0.45);
  problem.held = test::vertices_at(mesh, 0);
  const ReferenceSolver solver = make_solver(problem);
  std::vector<Vec3> statics = test::rest_positions(mesh);
  ASSERT_TRUE(solver.solve_statics(statics)->converged);
  std::vector<Vec3> positions = test::rest_positions(mesh), velocities(positions.size(), Vec3::Zero());
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(solver.step(positions, velocities, 0.5)->converged);
  EXPECT_GT(test::tip_sag(mesh, statics, beam), 5);
  EXPECT_LT(greatest_distance(positions, statics), 1e-3);
}

// --- bending

/// The sag of a light cantilever, as a share of Timoshenko's, for cubic cells, `n` across.
double relative_sag(std::uint32_t n, double poisson) {
  const Beam beam{{4 * n, n, n}, Vec3(0.2, 0.05, 0.05)};
  const TetMesh mesh = test::make_beam(beam);
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.materials.fallback = soft_tissue(100e3, poisson);
  problem.gravity = Vec3(0, 0, -1e-4 * kG);
  problem.held = test::vertices_at(mesh, 0);
  std::vector<Vec3> positions = test::rest_positions(mesh);
  const Result<ReferenceReport> report = make_solver(problem).solve_statics(positions, {1e-14, 20});
  EXPECT_TRUE(report.ok() && report->converged);
  const double width = beam.size.y(), length = beam.size.x(), area = width * width;
  const double line_load = 1000 * area * 1e-4 * kG, inertia = width * width * width * width / 12;
  const double shear_share = 10 * (1 + poisson) / (12 + 11 * poisson);  // Cowper 1966, rectangle
  const double shear_modulus = 100e3 / (2 * (1 + poisson));
  const double bending = line_load * std::pow(length, 4) / (8 * 100e3 * inertia);
  const double shear = line_load * length * length / (2 * shear_share * shear_modulus * area);
  return test::tip_sag(mesh, positions, beam) / (bending + shear);
}

TEST(ReferenceSolver, CantileverSagsAsTimoshenkosBeamOnceItsCellsAreSmall) {
  // The wall keeps the held end from thinning, which the formula ignores: exact for Poisson's ratio 0 alone.
  for (const auto& [poisson, tolerance] : {std::pair(0.0, 0.01), std::pair(0.3, 0.04)}) {
    const double coarse = relative_sag(2, poisson), middle = relative_sag(4, poisson), fine = relative_sag(8, poisson);
    EXPECT_LT(coarse, middle);  // linear tets are too stiff, the less the smaller they are
    EXPECT_LT(middle, fine);
    EXPECT_LT(fine, 1);
    const double stiffness = 1 / fine - (1 / middle - 1 / fine) / 3;  // Richardson: errors of second order
    EXPECT_NEAR(stiffness, 1, tolerance) << coarse << " " << middle << " " << fine;
  }
}

TEST(ReferenceSolver, ConjugateGradientsAndCholeskyFindTheSameEquilibrium) {
  const test::CutBeam cut = test::cut_beam({{9, 3, 3}, Vec3(0.09, 0.03, 0.03)}, 0.1);
  ReferenceProblem problem;
  problem.mesh = &cut.mesh;
  problem.materials.fallback = soft_tissue(30e3, 0.45);
  problem.held = test::vertices_at(cut.mesh, 0);
  problem.linear = LinearSolver::kCholesky;
  std::vector<Vec3> direct = test::rest_positions(cut.mesh), iterative = direct;
  const Result<ReferenceReport> first = make_solver(problem).solve_statics(direct);
  problem.linear = LinearSolver::kConjugateGradients;
  const Result<ReferenceReport> second = make_solver(problem).solve_statics(iterative);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_TRUE(first->converged && second->converged);
  EXPECT_EQ(first->linear_iterations, 0U);
  EXPECT_GT(second->linear_iterations, 100U);
  EXPECT_LT(greatest_distance(direct, iterative), 1e-8);
}

TEST(ReferenceSolver, FindsItsWayOutOfAScramble) {
  const Beam beam{{6, 2, 2}, Vec3(90, 30, 30)};
  const TetMesh mesh = test::make_beam(beam);
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.length_unit = 1e-3;
  problem.materials.fallback = soft_tissue(30e3, 0.45);
  problem.held = test::vertices_at(mesh, 0);
  const ReferenceSolver solver = make_solver(problem);
  std::vector<Vec3> plain = test::rest_positions(mesh);
  std::vector<Vec3> lost = scrambled(plain, 10, 8);
  for (const VertexId v : problem.held) lost[v.value] = mesh.rest(v);
  ASSERT_TRUE(solver.solve_statics(plain)->converged);
  const Result<ReferenceReport> report = solver.solve_statics(lost, {1e-9, 300});
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report->converged);
  EXPECT_LT(greatest_distance(plain, lost), 1e-3);
}

// --- the incised beam

TEST(CutBeam, SliversGetThinnerAsTheCutNearsTheLattice) {
  EXPECT_NEAR(test::worst_aspect(test::make_beam({})), 8.36, 0.01);
  for (const double eps : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    const double worst = test::cut_beam({}, eps).worst_aspect;
    EXPECT_GT(worst, 3.6 / eps);
    EXPECT_LT(worst, 12 / eps);
  }
}

TEST(CutBeam, OpenedFromAboveItSagsFurtherWhateverItsSlivers) {
  const auto sag = [](const TetMesh& mesh, double thinnest) {
    ReferenceProblem problem;
    problem.mesh = &mesh;
    problem.materials.fallback = soft_tissue(30e3, 0.45);
    problem.held = test::vertices_at(mesh, 0);
    problem.thinnest = thinnest;
    std::vector<Vec3> positions = test::rest_positions(mesh);
    const Result<ReferenceReport> report = make_solver(problem).solve_statics(positions, {1e-7, 100});
    EXPECT_TRUE(report.ok() && report->converged) << report->residual;
    return test::tip_sag(mesh, positions, {});
  };
  const double whole = sag(test::make_beam({}), 0);
  const double opened = sag(test::cut_beam({}, 0.1).mesh, 0);
  const double finer = sag(test::cut_beam({}, 1e-5).mesh, 0);
  EXPECT_GT(opened, 1.1 * whole);
  EXPECT_NEAR(finer, opened, 0.05 * opened);
  EXPECT_NEAR(sag(test::cut_beam({}, 1e-5).mesh, 0.05), finer, 0.03 * finer);
}

// --- bad input

TEST(ReferenceSolver, ArgumentsOutOfRangeAreNamed) {
  const TetMesh mesh = jittered_block();
  ReferenceProblem problem;
  const auto refusal = [&] { return ReferenceSolver::create(problem).error().message; };
  EXPECT_NE(refusal().find("mesh"), std::string::npos);
  problem.mesh = &mesh;
  problem.length_unit = 0;
  EXPECT_NE(refusal().find("length unit"), std::string::npos);
  problem.length_unit = 1;
  problem.thinnest = 1;
  EXPECT_NE(refusal().find("thinnest"), std::string::npos);
  problem.thinnest = 0;
  problem.held = {VertexId(mesh.vertex_slots())};
  EXPECT_NE(refusal().find("held"), std::string::npos);
  problem.held.clear();
  problem.loads.assign(1, Vec3::Zero());
  EXPECT_NE(refusal().find("loads"), std::string::npos);
}

TEST(ReferenceSolver, LoosePartsHaveNoEquilibrium) {
  const TetMesh mesh = jittered_block();
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.held = {VertexId(0), VertexId(0), VertexId(0), VertexId(1)};
  const ReferenceSolver solver = make_solver(problem);
  std::vector<Vec3> positions = test::rest_positions(mesh);
  EXPECT_NE(solver.solve_statics(positions).error().message.find("three held"), std::string::npos);
  positions[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(solver.solve_statics(positions).error().message.find("vertex 3"), std::string::npos);
  std::vector<Vec3> velocities(positions.size(), Vec3::Zero());
  EXPECT_FALSE(solver.step(positions, velocities, 0).ok());
}

}  // namespace
}  // namespace incise::reference_test
