// SPDX-License-Identifier: Apache-2.0
// The lips of an incision that is drawn open meet again, and do not pass through each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "incise/engine/simulation.h"
#include "incise/mesh/edge_length.h"
#include "incise/mesh/shapes.h"
#include "sim/body/body_state.h"

namespace incise::wound_closes_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A slab of 60 × 40 × 16 mm, held below and at two sides, with an incision of 36 mm along x, 8 mm deep.
Simulation cut_slab() {
  SimulationOptions options;
  options.body.damping = 2;
  options.body.self.on = true;
  Simulation simulation =
      Simulation::create(TetMesh::build(kuhn_box(Vec3::Zero(), {0.06, 0.04, 0.016}, {18, 12, 6})).value(), options)
          .value();
  simulation.mesh().for_each_vertex([&](VertexId v) {
    const Vec3& r = simulation.mesh().rest(v);
    if (r.z() > 1e-9 && r.x() > 1e-9 && r.x() < 0.06 - 1e-9) return;
    EXPECT_TRUE(simulation.body().hold(v, kInfinity).ok());
  });
  for (unsigned i = 0; i < 30; ++i) EXPECT_TRUE(simulation.frame({}).ok());
  for (unsigned i = 0; i <= 30; ++i) {
    FrameInput input;
    const double x = 0.012 + 0.036 * i / 30;
    input.blade = BladePose{{Vec3(x, 0.0203, 0.018), Vec3(x, 0.0203, 0.008)}, Vec3::Zero()};
    EXPECT_TRUE(simulation.frame(input).ok());
  }
  for (unsigned i = 0; i < 30; ++i) EXPECT_TRUE(simulation.frame({}).ok());
  return simulation;
}

/// How deep any vertex is in a face, and the share of the wall's area whose vertices are in contact; those at and
/// beside the front, which hang together with the other lip, left out.
struct Closing {
  double overlap = 0, share = 0;
};
Closing closing_of(const Simulation& simulation) {
  Closing closing;
  const DeformableBody::State& body = simulation.body().state();
  double wall = 0, touching = 0;
  simulation.mesh().for_each_vertex([&](VertexId v) {
    const auto& vertex = body.contact.surface().vertex(v.value);
    if ((simulation.mesh().shape_of(v) & shape::kWall) != 0 && !vertex.is_beside_front) wall += vertex.area;
  });
  for (const detail::Contact& contact : body.contact.contacts()) {
    closing.overlap = std::max(closing.overlap, -contact.gap);
    const auto& vertex = body.contact.surface().vertex(contact.vertex);
    if (std::abs(contact.gap) < 1e-4 && !vertex.is_beside_front) touching += vertex.area;
  }
  closing.share = touching / wall;
  return closing;
}

TEST(Wound, LipsThatWereDrawnApartMeetAgain) {
  Simulation simulation = cut_slab();
  for (unsigned i = 0; i < 60; ++i) {
    FrameInput input;
    const double drawn = 0.006 * std::min(1.0, i / 40.0);
    input.hooks = {{1, Vec3(0.03, 0.0223 + drawn, 0.016), 0.003, 50},
                   {2, Vec3(0.03, 0.0183 - drawn, 0.016), 0.003, 50}};
    ASSERT_TRUE(simulation.frame(input).ok());
  }
  EXPECT_LT(closing_of(simulation).share, 0.6);
  double last = kInfinity, rise = 0;
  const double stored = simulation.body().energy().elastic;
  for (unsigned i = 0; i < 120; ++i) {
    ASSERT_TRUE(simulation.frame({}).ok());
    double energy = simulation.body().energy().total();
    for (const detail::ContactTerm& term : simulation.body().state().contact.terms()) {
      energy +=
          detail::contact_energy(term, simulation.body().state().floats.data(), simulation.body().state().rows.rows());
    }
    rise = std::max(rise, energy - last);
    last = energy;
  }
  const Closing closed = closing_of(simulation);
  const double edge = mean_edge_length(simulation.mesh());
  std::printf(
      "overlap %.4f of an edge, %.0f %% of the wall in contact, energy rose by at most %.1e of what was stored\n",
      closed.overlap / edge, 100 * closed.share, rise / stored);
  EXPECT_LT(closed.overlap, 0.02 * edge);
  EXPECT_GT(closed.share, 0.8);
  EXPECT_LT(rise, 1e-3 * stored);
  EXPECT_EQ(simulation.body().active_vertices(), 0U);
}

}  // namespace
}  // namespace incise::wound_closes_test
