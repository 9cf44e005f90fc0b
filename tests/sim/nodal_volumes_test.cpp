// SPDX-License-Identifier: Apache-2.0
// Volumes averaged at vertices: what the descent makes of them, beside the energy as its definition says.
#include "sim/body/nodal_volumes.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <vector>

#include "moving_body.h"
#include "support/beam.h"
#include "support/campaign.h"
#include "support/random.h"

namespace incise::test::nodal_volumes_test {
namespace {

BodyOptions averaging() {
  BodyOptions options;
  options.average_volumes = true;
  options.gravity.setZero();
  options.sleep_below = 0;
  return options;
}

/// A cube of two materials whose vertices stand anywhere near their places.
struct Scene {
  explicit Scene(std::uint64_t seed) : random(seed) {
    TetSoup soup = kuhn_cube(3);
    jitter(soup, 0.15, seed);
    for (std::size_t i = 0; i < soup.regions.size(); ++i) soup.regions[i] = static_cast<std::int32_t>(i % 5 / 2);
    mesh = *TetMesh::build(std::move(soup));
    Materials materials{tissue(5e3, 0.49), {{1, tissue(50e3, 0.4)}, {2, tissue(20e3, 0.05)}}};
    body.emplace(DeformableBody::create(mesh, {}, materials, averaging()).value());
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) put(v, mesh.rest(VertexId(v)) + random.point(-0.05, 0.05));
  }
  void put(std::uint32_t v, const Vec3& place) { ASSERT_TRUE(body->place(VertexId(v), place).ok()); }
  /// The body's insides, ready for visits without inertia.
  DeformableBody::State& state() {
    auto& s = const_cast<DeformableBody::State&>(body->state());  // NOLINT: tests look inside
    s.order.refresh();
    s.list_awake_rows();
    s.find_resting();
    s.list_beside();
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
      s.motions[VertexId(v)].weight = 0;
      s.round_place(VertexId(v));
    }
    s.find_pressures();
    return s;
  }

  Random random;
  TetMesh mesh;
  std::optional<DeformableBody> body;
};

/// By row.
std::vector<float> pressures_of(const DeformableBody::State& s) {
  std::vector<float> result;
  for (std::size_t row = 0; row < s.places.size(); ++row) result.push_back(s.floats[4 * row + 3]);
  return result;
}

/// The energy as it stands, with the pressures that go with it, which are then as old again as they were.
double elastic_of(DeformableBody::State& s) {
  const std::vector<float> old = pressures_of(s);
  s.find_pressures();
  double energy = s.pressed_energy();
  std::vector<std::uint32_t> turned;
  for (const auto& part : s.awake_rows) energy += detail::energy_share(s.descent(), part, turned);
  for (std::size_t row = 0; row < old.size(); ++row) s.floats[4 * row + 3] = old[row];
  return energy;
}

/// Its curvature is more than that of the energy: pressures that it reads stand still.
TEST(NodalVolumes, AVisitSeesTheSlopeOfTheEnergyAndAtLeastItsCurvature) {
  Scene scene(1);
  DeformableBody::State& s = scene.state();
  ASSERT_TRUE(s.nodal.is_on);
  std::vector<float> slopes(std::size_t{4} * scene.mesh.vertex_slots());
  s.find_slopes(slopes.data());
  for (std::uint32_t v = 0; v < scene.mesh.vertex_slots(); v += 3) {
    const detail::Quadratic q = detail::quadratic_of(s.descent(), s.rows.of(VertexId(v)));
    const Mat3 stiffness = scene.body->local_stiffness(VertexId(v));
    const Vec3 place = s.places[v];
    for (int i = 0; i < 3; ++i) {
      constexpr double kStep = 1e-4;
      scene.put(v, place + kStep * Vec3::Unit(i));
      const double high = scene.body->energy().elastic;
      scene.put(v, place - kStep * Vec3::Unit(i));
      const double low = scene.body->energy().elastic;
      scene.put(v, place);
      const double here = scene.body->energy().elastic, slope = (high - low) / (2 * kStep);
      const double curvature = (high - 2 * here + low) / (kStep * kStep), scale = stiffness.norm() * 0.05;
      EXPECT_NEAR(q.slope[static_cast<std::size_t>(i)], slope, 1e-4 * scale);
      EXPECT_NEAR(static_cast<double>(slopes[std::size_t{4} * v + static_cast<std::size_t>(i)]), slope, 1e-4 * scale);
      EXPECT_NEAR(stiffness(i, i), curvature, 1e-4 * stiffness.norm());
    }
    const std::array<double, 6> upper = {stiffness(0, 0), stiffness(0, 1), stiffness(0, 2),
                                         stiffness(1, 1), stiffness(1, 2), stiffness(2, 2)};
    const auto at = [&](std::size_t i) { return q.curvature[i] - upper[i]; };
    Mat3 more;
    more << at(0), at(1), at(2), at(1), at(3), at(4), at(2), at(4), at(5);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Mat3>(more).eigenvalues().minCoeff(), -1e-4 * stiffness.norm());
  }
}

/// Visits read pressures that are up to a sweep old, and still go downhill: from any places, with several materials.
TEST(NodalVolumes, SweepsOnlyEverTakeEnergy) {
  for (std::uint64_t seed = 11; seed <= 16; ++seed) {
    Scene scene(seed);
    DeformableBody::State& s = scene.state();
    double before = elastic_of(s);
    for (unsigned i = 0; i < 40; ++i) {
      for (const auto& part : s.awake_rows) detail::sweep(s.descent(), part, i % 2 == 1);
      const double now = elastic_of(s);
      ASSERT_LE(now, before + 1e-6 * std::abs(before)) << seed << ", sweep " << i;
      before = now;
    }
  }
}

/// Rounded places leave some pressure in a body that has come to rest: little against what there was.
TEST(NodalVolumes, VisitsBringPressuresUpToDate) {
  Scene scene(2);
  DeformableBody::State& s = scene.state();
  float largest = 0;
  for (const float p : pressures_of(s)) largest = std::max(largest, std::abs(p));
  for (unsigned i = 0; i < 400; ++i) {
    for (const auto& part : s.awake_rows) detail::sweep(s.descent(), part, i % 2 == 1);
  }
  const std::vector<float> kept = pressures_of(s);
  s.find_pressures();
  const std::vector<float> found = pressures_of(s);
  for (std::size_t v = 0; v < kept.size(); ++v) EXPECT_NEAR(kept[v], found[v], 1e-3F * largest) << v;
}

TEST(NodalVolumes, HeldVerticesFeelThePressure) {
  Scene scene(3);
  const VertexId v(21);
  ASSERT_TRUE(scene.body->hold(v, std::numeric_limits<double>::infinity()).ok());
  const Vec3 place = scene.body->positions()[v.value], force = scene.body->force_on_holds();
  for (int i = 0; i < 3; ++i) {
    constexpr double kStep = 1e-6;
    scene.put(v.value, place + kStep * Vec3::Unit(i));
    const double high = scene.body->energy().elastic;
    scene.put(v.value, place - kStep * Vec3::Unit(i));
    EXPECT_NEAR(force[i], -(high - scene.body->energy().elastic) / (2 * kStep), 1e-5 * force.norm());
  }
}

TetSoup stiff_and_soft(std::uint32_t n, std::uint64_t seed) {
  TetSoup soup = jittered_cube(n, seed);
  soup.regions.clear();
  for (const auto& tet : soup.tets) {
    double x = 0;
    for (const std::uint32_t v : tet) x += soup.points[v].x();
    soup.regions.push_back(x < 2 ? 1 : 2);
  }
  return soup;
}

TEST(NodalVolumes, DataAreThoseOfABodyMadeAnewWhateverIsCut) {
  for (std::uint64_t seed = 31; seed <= of_campaign(32U, 34U); ++seed) {
    SCOPED_TRACE(seed);
    MovingBody moving(stiff_and_soft(4, seed), {tissue(5e3, 0.49), {{1, tissue(20e3, 0.3)}}}, averaging());
    moving.mesh().for_each_vertex(
        [&](VertexId v) { ASSERT_TRUE(moving.body().set_velocity(v, 0.05 * moving.mesh().rest(v)).ok()); });
    RandomCalls program(moving, seed);
    program.run(20, [&] {
      moving.expect_like_fresh();
      moving.advance();
      expect_sound_order(moving.state());
    });
    EXPECT_TRUE(moving.body().is_finite());
  }
}

TEST(NodalVolumes, TwoThreadsGiveTheSameBits) {
  std::array<std::uint64_t, 2> hashes = {};
  for (unsigned threads = 1; threads <= 2; ++threads) {
    BodyOptions options = averaging();
    options.threads = threads;
    options.gravity = Vec3(0, 0, -9.81);
    MovingBody moving(kuhn_box(Vec3::Zero(), Vec3(0.3, 0.1, 0.1), {12, 4, 4}), {tissue(5e3, 0.49), {}}, options);
    moving.hold_where(0);
    moving.advance(10);
    moving.cut_plane(Vec3(1, 0.3, 0.1), 0.15);
    moving.advance(10);
    hashes[threads - 1] = moving.body().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// By quadratic tets, mm: tests/sim/reference_python/cantilever.py.
struct Sag {
  double poisson, quadratic;
};

/// Of the tip of the body, mm. Strains of the reference are small: so is the weight here.
double sag_of(std::uint32_t across, double poisson) {
  constexpr double kLight = 0.1;
  const Beam beam{{5 * across, across, across}, Vec3(0.1, 0.02, 0.02)};
  const TetMesh mesh = make_beam(beam);
  BodyOptions options = averaging();
  options.gravity = kLight * Vec3(0, 0, -9.81);
  options.damping = 3;
  DeformableBody body = make_body(mesh, tissue(300e3, poisson), options);
  for (const VertexId v : vertices_at(mesh, 0)) {
    EXPECT_TRUE(body.hold(v, std::numeric_limits<double>::infinity()).ok());
  }
  for (int i = 0; i < 240; ++i) EXPECT_TRUE(body.advance(1.0 / 60).ok());
  return 1e3 / kLight * tip_sag(mesh, {body.positions().begin(), body.positions().end()}, beam);
}

TEST(NodalVolumes, ACantileverBendsAtAnyPoissonsRatio) {
  constexpr double kLinear = 9.954 / 12.510;  // what linear tets do at 0.3
  for (const Sag& c : {Sag{0.3, 12.510}, Sag{0.45, 12.165}, Sag{0.49, 11.964}}) {
    const double sag = sag_of(4, c.poisson);
    std::printf("  %.2f: %.3f mm, quadratic tets %.3f mm\n", c.poisson, sag, c.quadratic);
    EXPECT_GT(sag, kLinear * c.quadratic);
    EXPECT_LT(sag, c.quadratic);
  }
}

TEST(NodalVolumes, ACantileverOfEightCellsAcrossIsWithinATenth) {
  for (const Sag& c : of_campaign<std::vector<Sag>>({{0.49, 12.087}}, {{0.45, 12.235}, {0.49, 12.087}})) {
    const double sag = sag_of(8, c.poisson);
    std::printf("  %.2f: %.3f mm, quadratic tets %.3f mm\n", c.poisson, sag, c.quadratic);
    EXPECT_GT(sag, 0.9 * c.quadratic);
    EXPECT_LT(sag, c.quadratic);
  }
}

}  // namespace
}  // namespace incise::test::nodal_volumes_test
