// SPDX-License-Identifier: Apache-2.0
// Fibres and stresses that relax, against closed forms of homogeneous stretch.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "incise/mesh/shapes.h"
#include "moving_body.h"
#include "sim/body/element.h"
#include "support/random.h"

namespace incise::fibres_test {
namespace {

using test::make_body;
using test::MovingBody;
using test::Random;
using test::tissue;
using Corners = std::array<Vec3, 4>;

// --- of one tet

Corners any_tet(Random& random) {
  while (true) {
    const Corners p = {random.point(-1, 1), random.point(-1, 1), random.point(-1, 1), random.point(-1, 1)};
    if (detail::six_volumes(p) > 0.1) return p;
  }
}

Corners mapped(const Corners& p, const Mat3& f) {
  return {Vec3(f * p[0]), Vec3(f * p[1]), Vec3(f * p[2]), Vec3(f * p[3])};
}

TEST(Fibres, have_the_slopes_and_the_curvature_of_their_energy) {
  Random random(3);
  unsigned taut = 0;
  for (int i = 0; i < 60; ++i) {
    const Corners rest = any_tet(random);
    Corners p = rest;
    for (Vec3& x : p) x += random.point(-0.4, 0.4);
    detail::Element element = detail::element_of(rest, 3, 2, 0, 0, 0, i % 2 == 0 ? 0.0 : 3.0);
    detail::add_fibres(rest, random.point(-1, 1), 40, 0, element);
    EXPECT_NEAR(detail::energy_of(element, rest), 0, 1e-12);
    taut += detail::soft_energy_of(element, p) > 0 ? 1U : 0U;
    for (unsigned c = 0; c < 4; ++c) {
      const Vec3 slope = detail::slope_of(element, p, c);
      const Mat3 stiffness = detail::stiffness_at(element, p, c);
      for (int axis = 0; axis < 3; ++axis) {
        const double step = 1e-6;
        Corners up = p, down = p;
        up[c][axis] += step, down[c][axis] -= step;
        const double size = 1 + slope.norm();
        EXPECT_NEAR((detail::energy_of(element, up) - detail::energy_of(element, down)) / (2 * step), slope[axis],
                    1e-6 * size * (1 + stiffness.norm()));
        const Vec3 bend = (detail::slope_of(element, up, c) - detail::slope_of(element, down, c)) / (2 * step);
        EXPECT_LT((stiffness.col(axis) - bend).norm(), 1e-4 * (1 + stiffness.norm())) << i;
      }
    }
  }
  EXPECT_GT(taut, 20U);
}

/// F a is what the fibres are seen from, however the tet lies.
TEST(Fibres, store_what_their_own_stretch_says) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Corners rest = any_tet(random);
    const Vec3 along = random.point(-1, 1).normalized();
    Mat3 f = Mat3::Identity();
    for (double& x : f.reshaped()) x += random.real(-0.3, 0.3);
    detail::Element plain = detail::element_of(rest, 3, 2, 0), fibrous = plain;
    detail::add_fibres(rest, 7 * along, 40, 0, fibrous);
    const double over = std::max(0.0, (f * along).norm() - 1), volume = detail::six_volumes(rest) / 6;
    EXPECT_NEAR(detail::energy_of(fibrous, mapped(rest, f)) - detail::energy_of(plain, mapped(rest, f)),
                volume * 20 * over * over, 1e-10);
  }
}

TEST(Relaxing, decays_as_the_exponential_does) {
  for (const double x : {0.0, 1e-6, 0.01, 0.3, 1.0, 7.0, 40.0}) {
    EXPECT_NEAR(detail::decay(x), std::exp(-x), 1e-12 + 1e-10 * std::exp(-x)) << x;
  }
}

/// What a flow takes from the energy, and that there is nothing left of it once it has gone on for long.
TEST(Relaxing, only_ever_lowers_the_energy_of_a_tet) {
  Random random(7);
  for (int i = 0; i < 40; ++i) {
    const Corners rest = any_tet(random);
    Mat3 f = Mat3::Identity();
    for (double& x : f.reshaped()) x += random.real(-0.3, 0.3);
    if (!(f.determinant() > 0.2)) continue;
    const Corners p = mapped(rest, f);
    const detail::Metric to = detail::relaxed_metric(rest, p);
    const auto energy = [&](const detail::Metric& metric) {
      detail::Element element = detail::element_of(rest, 3, 2, 0);
      detail::set_metric(rest, 2, 0, metric, element);
      return detail::energy_of(element, p);
    };
    detail::Metric metric = {1, 0, 0, 1, 0, 1};
    double last = energy(metric);
    for (int k = 0; k < 30; ++k) {
      metric = detail::flowed(metric, to, 0.2);
      EXPECT_LE(energy(metric), last + 1e-12);
      last = energy(metric);
    }
    EXPECT_NEAR(last, energy(to), 0.01 * std::abs(energy(to)) + 1e-3);
  }
}

// --- of a body

/// A cube of tissue between a face that is held and one that is pulled, both drawn in as the closed form has it.
class Drawn {
 public:
  Drawn(const Material& material, double stretch, double across, bool holds_sides = false, double stiffness = 1e7)
      : mesh_(TetMesh::build(kuhn_cube(3)).value()), body_(make_body(mesh_, material, weightless())) {
    std::vector<Pull> pulls;
    mesh_.for_each_vertex([&](VertexId v) {
      const Vec3 p = mesh_.rest(v), place(stretch * p.x(), across * p.y(), across * p.z());
      EXPECT_TRUE(body_.place(v, place).ok());
      const auto is_side = [](double x) { return x < 1e-9 || x > 1 - 1e-9; };
      if (p.x() < 1e-9 || (holds_sides && p.x() < 1 - 1e-9 && (is_side(p.y()) || is_side(p.z())))) {
        EXPECT_TRUE(body_.hold(v, std::numeric_limits<double>::infinity()).ok());
      }
      if (p.x() < 1 - 1e-9) return;
      Pull pull;
      pull.vertices[0] = v;
      pull.target = place;
      pull.stiffness = stiffness;
      pulls.push_back(pull);
    });
    EXPECT_TRUE(body_.set_pulls(pulls).ok());
  }

  static BodyOptions weightless() {
    BodyOptions options;
    options.gravity = Vec3::Zero();
    options.damping = 30;
    options.sleep_below = 0;
    return options;
  }
  DeformableBody& body() { return body_; }
  void advance(unsigned steps) {
    for (unsigned i = 0; i < steps; ++i) ASSERT_TRUE(body_.advance(1.0 / 60).ok());
  }
  /// N, of the pulls along x.
  [[nodiscard]] double force() const {
    double sum = 0;
    for (std::size_t i = 0; i < body_.pulls().size(); ++i) sum += body_.pull_force(i).x();
    return sum;
  }

 private:
  TetMesh mesh_;
  DeformableBody body_;
};

/// By the neo-Hookean energy with λ = Lamé's + μ: J, and the stretch across, where nothing presses from the side.
struct Uniaxial {
  explicit Uniaxial(const Material& m, double s) : mu(m.mu()), lambda(m.lambda() + m.mu()), stretch(s) {
    volume = 1 + (mu - mu / s) / lambda;
    across = std::sqrt(volume / s);
  }
  [[nodiscard]] double stress() const { return mu * stretch + (lambda * (volume - 1) - mu) * across * across; }
  double mu, lambda, stretch, volume = 1, across = 1;
};

TEST(Fibres, pull_as_the_closed_form_has_it_and_do_not_push) {
  Material material = tissue(1e4, 0.3);
  material.fibre = {2, 0, 0};
  material.fibre_young = 5e4;
  for (const double s : {1.05, 1.2, 0.9}) {
    const Uniaxial expected(material, s);
    Drawn drawn(material, s, expected.across);
    drawn.advance(60);
    const double stress = expected.stress() + 5e4 * std::max(0.0, s - 1);
    EXPECT_NEAR(drawn.force(), stress, 5e-3 * std::abs(stress)) << s;
  }
  material.fibre = {0, 1, 0};  // across they are slack where the bar is drawn out
  const Uniaxial expected(material, 1.2);
  Drawn drawn(material, 1.2, expected.across);
  drawn.advance(60);
  EXPECT_NEAR(drawn.force(), expected.stress(), 5e-3 * expected.stress());
}

TEST(Fibres, hold_a_hanging_body_without_a_gain_of_energy) {
  Material material = tissue(5e3);
  material.fibre = {0, 0, 1};
  material.fibre_young = 2e5;
  BodyOptions options;
  MovingBody moving(test::jittered_box(2, 2, 6, 3), {material, {}}, options);
  moving.mesh().for_each_vertex([&](VertexId v) {
    if (moving.mesh().rest(v).z() < 6 - 1e-9) return;
    ASSERT_TRUE(moving.body().hold(v, std::numeric_limits<double>::infinity()).ok());
  });
  double last = moving.body().energy().total(), peak = 0;
  for (int i = 0; i < 120; ++i) {
    moving.advance();
    const double now = moving.body().energy().total();
    peak = std::max(peak, moving.body().energy().elastic);
    EXPECT_LE(now, last + 1e-3 * peak + 1e-9) << i;
    last = now;
  }
  EXPECT_TRUE(moving.body().is_finite());
}

TEST(Relaxing, stress_falls_as_the_prony_series_does) {
  Material material = tissue(1e4, 0.3);
  material.prony = {PronyTerm{0.5, 0.1}, PronyTerm{1.0, 0.6}, {}};
  const double s = 1.02;
  const Uniaxial at_rest(material, s);
  Material stiff = material;
  stiff.prony = {};
  Drawn drawn(material, s, at_rest.across, true, 1e6);  // places are single precision
  // Small strains: what relaxes bears 2 μ dev ε alone.
  const double e = s - 1, side = at_rest.across - 1, deviator = e - (e + 2 * side) / 3;
  for (unsigned frame = 1; frame <= 90; ++frame) {
    drawn.advance(1);
    // Each frame's stress is that of the metric that the one before has left.
    const double t = (frame - 1) / 60.0;
    const double more = 2 * material.mu() * deviator * (0.5 * std::exp(-t / 0.1) + std::exp(-t / 0.6));
    const double expected = at_rest.stress() + more;
    if (frame <= 5) continue;
    EXPECT_NEAR(drawn.force(), expected, 0.03 * expected) << frame;
  }
  drawn.advance(400);
  EXPECT_NEAR(drawn.force(), at_rest.stress(), 0.01 * at_rest.stress());
}

TEST(Relaxing, a_swinging_body_loses_energy_and_never_gains_any) {
  Material material = tissue(2e4), springy = material;
  material.prony = {PronyTerm{1.0, 0.05}, {}, {}};
  double left[2] = {};
  BodyOptions options;
  options.length_unit = 0.01;
  for (int k = 0; k < 2; ++k) {
    MovingBody moving(test::jittered_box(6, 2, 2, 3), {k == 0 ? springy : material, {}}, options);
    moving.hold_where(0);
    double last = moving.body().energy().total(), peak = 0;
    for (int i = 0; i < 120; ++i) {
      moving.advance();
      const double now = moving.body().energy().total();
      peak = std::max(peak, moving.body().energy().elastic);
      EXPECT_LE(now, last + 1e-3 * peak) << i;
      last = now;
      if (i >= 60) left[k] = std::max(left[k], moving.body().energy().kinetic);
    }
  }
  EXPECT_LT(left[1], 0.3 * left[0]);
}

/// A metric goes with the material: spin is no strain.
TEST(Relaxing, a_spinning_body_keeps_its_spin) {
  Material material = tissue(2e4);
  material.prony = {PronyTerm{1.0, 0.1}, {}, {}};
  BodyOptions options;
  options.length_unit = 0.01;
  options.gravity = Vec3::Zero();
  MovingBody moving(kuhn_box(Vec3::Zero(), Vec3(4, 2, 2), {4, 2, 2}), {material, {}}, options);
  moving.mesh().for_each_vertex([&](VertexId v) {
    const Vec3 arm = 0.01 * (moving.mesh().rest(v) - Vec3(2, 1, 1));
    ASSERT_TRUE(moving.body().set_velocity(v, Vec3(0, 0, 10).cross(arm)).ok());
  });
  const double before = moving.body().angular_momentum().z(), spin = moving.body().energy().kinetic;
  moving.advance(120);
  EXPECT_NEAR(moving.body().angular_momentum().z(), before, 1e-6 * before);
  EXPECT_GT(moving.body().energy().kinetic, 0.9 * spin);
}

/// Stars and laplacians are those that the metrics say, and cuts, undo and threads change nothing of that.
TEST(Relaxing, follows_cuts_and_undo_and_gives_the_same_on_two_threads) {
  std::uint64_t hashes[2] = {};
  for (unsigned threads = 1; threads <= 2; ++threads) {
    Material material = tissue(1e4);
    material.prony = {PronyTerm{1.0, 0.2}, PronyTerm{0.3, 2}, {}};
    material.fibre = {1, 0.3, 0};
    material.fibre_young = 3e4;
    BodyOptions options;
    options.length_unit = 0.1;
    options.threads = threads;
    MovingBody moving(test::jittered_box(6, 3, 3, 4), {material, {}}, options);
    moving.hold_where(0);
    moving.advance(10);
    moving.cut_plane(Vec3(0, 0.1, 1), 1.6);
    moving.advance(10);
    const DeformableBody::State& s = moving.state();
    for (std::uint32_t t = 0; t < s.tets.size(); ++t) {
      if (!s.tets[TetId(t)][0].is_valid()) continue;
      const detail::Metric m = s.metric(TetId(t), 0);
      EXPECT_NEAR(
          m[0] * (m[3] * m[5] - m[4] * m[4]) - m[1] * (m[1] * m[5] - m[4] * m[2]) + m[2] * (m[1] * m[4] - m[3] * m[2]),
          1, 1e-9);
    }
    ASSERT_TRUE(moving.engine().undo());
    moving.follow();
    moving.advance(10);
    ASSERT_TRUE(moving.engine().redo());
    moving.follow();
    moving.advance(10);
    EXPECT_TRUE(moving.body().is_finite());
    EXPECT_EQ(moving.body().count_inverted(), 0U);
    hashes[threads - 1] = moving.body().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace incise::fibres_test
