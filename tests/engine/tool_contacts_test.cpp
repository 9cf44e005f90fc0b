// SPDX-License-Identifier: Apache-2.0
// Tools stop tissue without throwing it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "incise/engine/simulation.h"
#include "incise/mesh/shapes.h"

namespace incise::tool_contacts_test {
namespace {

/// A slab of 60 × 40 × 16 mm and 10 kPa.
Simulation make_slab(double damping = 0) {
  SimulationOptions options;
  options.body.damping = damping;
  return Simulation::create(TetMesh::build(kuhn_box(Vec3::Zero(), {0.06, 0.04, 0.016}, {12, 8, 4})).value(), options)
      .value();
}

/// Above a table at `height`, and without what is stored in tools.
double energy_above(const DeformableBody& body, double height) {
  return body.energy().total() - body.mass() * 9.81 * height;
}

TEST(ToolContacts, AFreeSlabThatFallsOnATableComesToRest) {
  Simulation simulation = make_slab();
  FrameInput input;
  input.tools = {PlaneTool{Vec3::UnitZ(), -0.001}};
  const double start = energy_above(simulation.body(), -0.001);
  double most = start;
  for (unsigned i = 0; i < 600; ++i) {
    ASSERT_TRUE(simulation.frame(input).ok());
    most = std::max(most, energy_above(simulation.body(), -0.001));
  }
  std::printf("energy at most %.4f of the start, kinetic after 10 s %.2e J\n", most / start,
              simulation.body().energy().kinetic);
  EXPECT_LT(most, 1.1 * start);
  EXPECT_LT(simulation.body().energy().kinetic, 1e-5);
}

/// The faster it comes, the further ahead it is found.
TEST(ToolContacts, ASlabThatFallsFarIsStoppedAtTheTable) {
  Simulation simulation = make_slab();
  FrameInput input;
  input.tools = {PlaneTool{Vec3::UnitZ(), -0.1}};  // it arrives with 1.4 m/s: 23 mm per frame
  const double start = energy_above(simulation.body(), -0.1);
  double lowest = 0, most = start;
  for (unsigned i = 0; i < 120; ++i) {
    ASSERT_TRUE(simulation.frame(input).ok());
    most = std::max(most, energy_above(simulation.body(), -0.1));
    for (const Vec3& p : simulation.body().positions()) lowest = std::min(lowest, p.z());
  }
  EXPECT_GT(lowest, -0.1 - 0.005);
  EXPECT_LT(most, 1.01 * start);
}

/// A ball that appears in the tissue dents it bit by bit; one that moves into it at once.
TEST(ToolContacts, AToolThatAppearsInTheTissueBeginsWithoutAForce) {
  Simulation simulation = make_slab(2);
  simulation.mesh().for_each_vertex([&](VertexId v) {
    if (simulation.mesh().rest(v).z() < 1e-9) {
      ASSERT_TRUE(simulation.body().hold(v, std::numeric_limits<double>::infinity()).ok());
    }
  });
  for (unsigned i = 0; i < 60; ++i) ASSERT_TRUE(simulation.frame({}).ok());
  const double start = simulation.body().energy().total();
  FrameInput input;
  input.tools = {BallTool{{0.03, 0.02, 0.022}, 0.01}};  // 4 mm deep
  ASSERT_TRUE(simulation.frame(input).ok());
  EXPECT_GT(simulation.body().pulls().size(), 5U);
  EXPECT_LT(simulation.body().energy().total(), start + 1e-9);
  for (unsigned i = 0; i < 90; ++i) ASSERT_TRUE(simulation.frame(input).ok());
  double deepest = 0;
  for (const Vec3& p : simulation.body().positions()) {
    deepest = std::max(deepest, 0.01 - (p - Vec3(0.03, 0.02, 0.022)).norm());
  }
  EXPECT_LT(deepest, 0.001);
  EXPECT_GT(simulation.body().energy().elastic, 1e-5);
}

}  // namespace
}  // namespace incise::tool_contacts_test
