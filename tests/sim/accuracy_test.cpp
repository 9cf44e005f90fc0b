// SPDX-License-Identifier: Apache-2.0
// How near the body in real time comes to the reference solver, which takes its time, and to the theory of beams.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "incise/sim/body.h"
#include "incise/sim/reference.h"
#include "support/beam.h"
#include "support/campaign.h"

namespace incise::test::accuracy_test {
namespace {

constexpr double kG = 9.81;

Materials tissue(double young, double poisson = 0.45) {
  Materials materials;
  materials.fallback.young = young;
  materials.fallback.poisson = poisson;
  return materials;
}

/// What all of these tests have: 20 iterations a frame, as scenes in real time.
BodyOptions in_real_time(double damping) {
  BodyOptions options;
  options.substeps = 4;
  options.iterations = 5;
  options.damping = damping;
  return options;
}

DeformableBody hung_body(const TetMesh& mesh, const Materials& materials, const BodyOptions& options) {
  DeformableBody body = DeformableBody::create(mesh, {}, materials, options).value();
  for (const VertexId v : vertices_at(mesh, 0)) {
    EXPECT_TRUE(body.hold(v, std::numeric_limits<double>::infinity()).ok());
  }
  return body;
}

double sag_of(const DeformableBody& body, const TetMesh& mesh, const Beam& beam) {
  return tip_sag(mesh, {body.positions().begin(), body.positions().end()}, beam);
}

/// The sag at the end of `seconds` of 60 frames each.
double sag_after(double seconds, const TetMesh& mesh, const Beam& beam, const Materials& materials,
                 const BodyOptions& options) {
  DeformableBody body = hung_body(mesh, materials, options);
  const auto frames = static_cast<int>(std::lround(60 * seconds));
  for (int i = 0; i < frames; ++i) EXPECT_TRUE(body.advance(1.0 / 60).ok());
  return sag_of(body, mesh, beam);
}

ReferenceProblem problem_of(const TetMesh& mesh, const Materials& materials) {
  ReferenceProblem problem;
  problem.mesh = &mesh;
  problem.materials = materials;
  problem.held = vertices_at(mesh, 0);
  return problem;
}

/// In equilibrium, nothing softened.
double true_sag(const TetMesh& mesh, const Beam& beam, const Materials& materials) {
  const ReferenceSolver solver = ReferenceSolver::create(problem_of(mesh, materials)).value();
  std::vector<Vec3> positions = rest_positions(mesh);
  const Result<ReferenceReport> report = solver.solve_statics(positions, {1e-7, 200});
  EXPECT_TRUE(report.ok() && report->converged) << report->residual;
  return tip_sag(mesh, positions, beam);
}

// --- statics

/// Share by which the sag after 2 s is off, with damping 5/s in which the swing dies.
double sag_error(const TetMesh& mesh, double young) {
  const Beam beam;
  const Materials materials = tissue(young);
  const double sag = true_sag(mesh, beam, materials);
  const double damped = sag_after(2, mesh, beam, materials, in_real_time(5)) / sag - 1;
  std::printf("  %3.0f kPa, worst L/r %7.2g, %zu tets: sag %8.4f mm, after 2 s %+.2f %%", 1e-3 * young,
              worst_aspect(mesh), mesh.tet_count(), 1e3 * sag, 100 * damped);
  if (is_whole_campaign()) {  // nothing is asked of it
    std::printf(" (undamped %+.2f %%)", 100 * (sag_after(2, mesh, beam, materials, in_real_time(0)) / sag - 1));
  }
  std::printf("\n");
  return damped;
}

TEST(Accuracy, SagOfAWholeBeamIsWithinAPercentOfTheReference) {
  const TetMesh mesh = make_beam({});
  for (const double young : {3e3, 30e3, 300e3}) EXPECT_LT(std::abs(sag_error(mesh, young)), 0.01) << young;
}

TEST(Accuracy, SagOfAnIncisedBeamIsWithinThreePercentWhateverItsSlivers) {
  using Values = std::vector<double>;
  for (const double eps : of_campaign<Values>({1e-1, 1e-4}, {1e-1, 1e-2, 1e-3, 1e-4})) {
    const TetMesh mesh = cut_beam({}, eps).mesh;
    for (const double young : of_campaign<Values>({3e3, 300e3}, {3e3, 30e3, 300e3})) {
      EXPECT_LT(std::abs(sag_error(mesh, young)), 0.03) << young << " Pa, " << eps;
    }
  }
}

TEST(Accuracy, AStiffBodyComesToRestByItselfOnceItMovesAsAWhole) {
  const TetMesh mesh = make_beam({});
  const double sag = true_sag(mesh, {}, tissue(300e3));
  BodyOptions options = in_real_time(0);
  EXPECT_NEAR(sag_after(2, mesh, {}, tissue(300e3), options), sag, 0.01 * sag);
  options.coarse = false;  // sweeps alone let it swing slowly
  options.sleep_below = 0;
  const double early = sag_after(0.1, mesh, {}, tissue(300e3), options);
  EXPECT_LT(early, 0.5 * sag);
}

/// A light cantilever's sag, as a share of Timoshenko's; `n` cubic cells across, under `load` hundredths of gravity.
double relative_sag(std::uint32_t n, double load = 1, bool sleeps = true) {
  const Beam beam{{4 * n, n, n}, Vec3(0.2, 0.05, 0.05)};
  constexpr double kYoung = 100e3;
  const double pull = 0.01 * load * kG;
  BodyOptions options = in_real_time(15);
  options.gravity = Vec3(0, 0, -pull);
  if (!sleeps) options.sleep_below = 0;
  const double sag = sag_after(3, make_beam(beam), beam, tissue(kYoung, 0), options);
  const double width = beam.size.y(), length = beam.size.x(), area = width * width;
  const double line_load = 1000 * area * pull, inertia = width * width * width * width / 12;
  const double shear_share = 10.0 / 12;  // Cowper 1966, rectangle, Poisson's ratio 0
  const double bending = line_load * std::pow(length, 4) / (8 * kYoung * inertia);
  const double shear = line_load * length * length / (2 * shear_share * kYoung / 2 * area);
  return sag / (bending + shear);
}

TEST(Accuracy, ALightCantileverSagsAsTimoshenkosOnceItsCellsAreSmall) {
  const double coarse = relative_sag(2), middle = relative_sag(4), fine = relative_sag(8);
  std::printf("  2, 4, 8 cells across: %.4f %.4f %.4f of Timoshenko's sag\n", coarse, middle, fine);
  EXPECT_LT(coarse, middle);  // linear tets are too stiff, the less the smaller they are
  EXPECT_LT(middle, fine);
  const double stiffness = 1 / fine - (1 / middle - 1 / fine) / 3;  // Richardson: errors of second order
  EXPECT_NEAR(stiffness, 1, 0.02) << coarse << " " << middle << " " << fine;
}

/// What single precision rounds off an energy is no gain that has to be taken back: it held light loads up.
TEST(Accuracy, ALightLoadBendsABeamByItsShareOfAGreaterOne) {
  const double light = relative_sag(8, 1, false), greater = relative_sag(8, 4, false);
  std::printf("  a hundredth of gravity and four: %.4f and %.4f of Timoshenko's sag\n", light, greater);
  EXPECT_NEAR(light, greater, 0.02 * greater);
}

TEST(Accuracy, FallingAsleepChangesNextToNothing) {
  const TetMesh mesh = make_beam({});
  for (const double young : of_campaign<std::vector<double>>({30e3}, {3e3, 30e3, 300e3})) {
    BodyOptions options = in_real_time(5);
    const double asleep = sag_after(6, mesh, {}, tissue(young), options);
    options.sleep_below = 0;
    const double awake = sag_after(6, mesh, {}, tissue(young), options);
    std::printf("  %3.0f kPa: %.6f mm, never asleep %.6f mm\n", 1e-3 * young, 1e3 * asleep, 1e3 * awake);
    EXPECT_NEAR(asleep, awake, 1e-3 * awake);
  }
}

// --- motion

/// The reference takes the same implicit steps, each to its end.
TEST(Accuracy, ABeamSwingsAsTheReferenceDoes) {
  const Beam beam{{9, 3, 3}, Vec3(0.09, 0.03, 0.03)};
  const TetMesh mesh = make_beam(beam);
  for (const bool coarse : {true, false}) {
    for (const double young : {10e3, 100e3}) {
      const ReferenceSolver solver = ReferenceSolver::create(problem_of(mesh, tissue(young))).value();
      std::vector<Vec3> positions = rest_positions(mesh), velocities(positions.size(), Vec3::Zero());
      BodyOptions options = in_real_time(0);
      options.coarse = coarse;
      DeformableBody body = hung_body(mesh, tissue(young), options);
      double off2 = 0, farthest = 0;
      for (int frame = 0; frame < 40; ++frame) {
        for (int i = 0; i < 4; ++i) ASSERT_TRUE(solver.step(positions, velocities, 1.0 / 240, {1e-6, 30}).ok());
        ASSERT_TRUE(body.advance(1.0 / 60).ok());
        const double sag = tip_sag(mesh, positions, beam);
        off2 += std::pow(sag_of(body, mesh, beam) - sag, 2);
        farthest = std::max(farthest, sag);
      }
      const double off = std::sqrt(off2 / 40) / farthest;
      std::printf("  %3.0f kPa, %s: off by %.1f %% of the swing\n", 1e-3 * young,
                  coarse ? "on the lattice first" : "sweeps alone", 100 * off);
      if (coarse) {
        EXPECT_LT(off, 0.15);
      }
    }
  }
}

TEST(Accuracy, ABodyLeftAloneNeverGainsEnergy) {
  for (const bool coarse : {true, false}) {
    for (const double eps : of_campaign<std::vector<double>>({1e-3}, {0.0, 1e-3})) {
      const TetMesh mesh = eps > 0 ? cut_beam({}, eps).mesh : make_beam({});
      BodyOptions options = in_real_time(0);
      options.coarse = coarse;
      DeformableBody body = hung_body(mesh, tissue(3e3), options);
      double energy = body.energy().total();
      for (int frame = 0; frame < 120; ++frame) {
        ASSERT_TRUE(body.advance(1.0 / 60).ok());
        const double now = body.energy().total();
        EXPECT_LT(now - energy, 1e-5) << frame;  // J, of about 0.03 that gravity has done
        energy = now;
      }
    }
  }
}

}  // namespace
}  // namespace incise::test::accuracy_test
