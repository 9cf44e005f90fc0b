// SPDX-License-Identifier: Apache-2.0
// What hooks take hold of beside a wound.
#include "engine/hook_grip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "incise/engine/simulation.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/validate.h"

namespace incise::hook_grip_test {
namespace {

constexpr double kCut = 0.0203;    // where the slit is, along x
constexpr double kBottom = 0.007;  // how far down it goes, of 0.02
constexpr double kRadius = 0.006;

/// A slab of 40 × 20 × 20 mm, held at its bottom, with a slit across it from side to side. Its lips touch.
class SlitSlab {
 public:
  SlitSlab() {
    SimulationOptions options;
    options.body.gravity = Vec3::Zero();
    options.engine.maintain.work_units = 20000;
    options.materials.fallback.young = 20e3;
    Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), {0.04, 0.02, 0.02}, {16, 8, 8}));
    simulation_.emplace(Simulation::create(std::move(mesh).value(), options).value());
    each_vertex([&](VertexId v) {
      if (mesh_now().rest(v).z() < 1e-9) {
        EXPECT_TRUE(sim().body().hold(v, std::numeric_limits<double>::infinity()).ok());
      }
    });
    FrameInput input;
    for (int i = 0; i <= 6; ++i) {
      const double z = 0.021 + (kBottom - 0.021) * i / 6;
      input.blade = BladePose{{{kCut, -0.001, z}, {kCut, 0.021, z}}, -Vec3::UnitZ()};
      frame(input);
    }
    for (int i = 0; i < 10; ++i) frame({});
  }

  [[nodiscard]] Simulation& sim() { return *simulation_; }
  [[nodiscard]] const TetMesh& mesh_now() const { return simulation_->mesh(); }
  FrameReport frame(const FrameInput& input) { return sim().frame(input).value(); }
  template <class Visit>
  void each_vertex(const Visit& visit) const {
    mesh_now().for_each_vertex([&](VertexId v) {
      if (mesh_now().tet_of(v).is_valid()) visit(v);
    });
  }

  /// Pulls at a place for a second, by `pull` at the end.
  void pull(Hook hook, const Vec3& pull) {
    const Vec3 from = hook.position;
    FrameInput input;
    for (int i = 0; i <= 60; ++i) {
      hook.position = from + pull * i / 60;
      input.hooks = {hook};
      frame(input);
    }
  }
  /// How far the skin beside the slit has moved, at most and on average over its vertices: on the side of lower x, or
  /// on the other one.
  [[nodiscard]] double moved(bool is_low) const {
    double most = 0;
    each_vertex([&](VertexId v) {
      const Vec3& rest = mesh_now().rest(v);
      if (rest.z() < 0.02 - 1e-6 || std::abs(rest.x() - kCut) > 0.004 || side_of(v) != is_low) return;
      most = std::max(most, (mesh_now().current(v) - rest).norm());
    });
    return most;
  }

 private:
  /// On which side of the slit the tets of a vertex are.
  [[nodiscard]] bool side_of(VertexId v) const {
    const TetVertices& corners = mesh_now().vertices(mesh_now().tet_of(v));
    double x = 0;
    for (const VertexId w : corners) x += 0.25 * mesh_now().rest(w).x();
    return x < kCut;
  }

  std::optional<Simulation> simulation_;
};

/// Just beside the lip.
Hook hook_beside(HookReach reach) {
  return {1, {kCut - 0.001, 0.0098, 0.02}, kRadius, 100, reach, 0};
}

TEST(HookGrip, GrownOverTheSurfaceMovesItsOwnSideAlone) {
  SlitSlab slab;
  slab.pull(hook_beside(HookReach::kSurface), {-0.003, 0, 0.003});
  EXPECT_GT(slab.moved(true), 0.002);
  EXPECT_LT(slab.moved(false), 0.2 * slab.moved(true));
  EXPECT_TRUE(validate(slab.mesh_now(), ValidateLevel::kGeometry).ok);
}

TEST(HookGrip, ABallTakesBothSides) {
  SlitSlab slab;
  slab.pull(hook_beside(HookReach::kBall), {-0.003, 0, 0.003});
  EXPECT_GT(slab.moved(false), 0.5 * slab.moved(true));
}

TEST(HookGrip, OnAWallTakesThatWallAlone) {
  SlitSlab slab;
  // Opened by a hand first, so that the wall can be reached.
  Hook first = hook_beside(HookReach::kSurface);
  slab.pull(first, {-0.004, 0, 0});
  VertexId wall;
  slab.each_vertex([&](VertexId v) {
    const Vec3& rest = slab.mesh_now().rest(v);
    const bool is_wall = (slab.mesh_now().shape_of(v) & shape::kWall) != 0;
    const bool is_near = std::abs(rest.z() - 0.0165) < 0.002 && std::abs(rest.y() - 0.0098) < 0.003;
    if (!is_wall || !is_near) return;
    if (!wall.is_valid() || slab.mesh_now().current(v).x() > slab.mesh_now().current(wall).x()) wall = v;
  });
  ASSERT_TRUE(wall.is_valid());
  const double other_before = slab.moved(true);
  Hook hook{2, slab.mesh_now().current(wall), 0.004, 100, HookReach::kSurface, 0};
  FrameInput input;
  const Vec3 from = hook.position, first_at = first.position - Vec3(0.004, 0, 0);
  for (int i = 0; i <= 60; ++i) {
    hook.position = from + Vec3(0.002, 0, 0) * i / 60;
    first.position = first_at;
    input.hooks = {first, hook};
    slab.frame(input);
  }
  EXPECT_GT(slab.moved(false), 0.0007);
  EXPECT_NEAR(slab.moved(true), other_before, 0.2 * other_before);
}

TEST(HookGrip, FindsTheNearestVertexWhereTheRadiusIsSmall) {
  SlitSlab slab;
  Hook hook = hook_beside(HookReach::kSurface);
  hook.radius = 1e-5;
  slab.pull(hook, {0, 0, 0.002});
  EXPECT_GT(slab.moved(true), 1e-4);
}

TEST(HookGrip, JawsGatherWhatTheyHold) {
  const auto width = [](double closed) {
    SlitSlab slab;
    Hook hook{1, {0.01, 0.01, 0.02}, 0.005, 200, HookReach::kSurface, closed};
    slab.pull(hook, Vec3::Zero());
    double low = 1, high = 0;
    slab.each_vertex([&](VertexId v) {
      if ((slab.mesh_now().rest(v) - Vec3(0.01, 0.01, 0.02)).norm() > 0.0051) return;
      if (slab.mesh_now().rest(v).z() < 0.02 - 1e-6) return;
      low = std::min(low, slab.mesh_now().current(v).x());
      high = std::max(high, slab.mesh_now().current(v).x());
    });
    return high - low;
  };
  EXPECT_LT(width(0.5), 0.8 * width(0));
}

/// Drawn up by more than it bears a hook slips, so that it bears just that, or tears out and bears nothing.
TEST(HookGrip, SlipsOrTearsOutBeyondItsStrength) {
  for (const bool tears : {false, true}) {
    SlitSlab slab;
    Hook hook{1, {0.01, 0.01, 0.02}, 0.005, 200, HookReach::kSurface};
    hook.strength = 0.05;
    hook.tears = tears;
    std::size_t torn = 0;
    double force = 0, most = 0;
    for (int i = 0; i < 60; ++i) {
      FrameInput input;
      hook.position.z() = 0.02 + 0.006 * std::min(1.0, i / 40.0);
      input.hooks = {hook};
      const FrameReport report = slab.frame(input);
      torn += report.torn_hooks.size();
      force = report.hook_forces[0].norm();
      most = std::max(most, force);
    }
    EXPECT_EQ(most > 0.05 * (1 + 1e-9), tears);  // what tears out bears more in the frame in which it does
    EXPECT_EQ(torn, tears ? 1U : 0U);
    EXPECT_NEAR(force, tears ? 0 : 0.05, tears ? 0 : 0.005);
  }
  SlitSlab slab;
  FrameInput input;
  input.hooks = {Hook{1, {0.01, 0.01, 0.02}, 0.005, 200}};
  input.hooks[0].strength = 0;
  EXPECT_FALSE(slab.sim().frame(input).ok());
}

TEST(HookGrip, LetsGoOfWhatAnUndoTakesAway) {
  SlitSlab slab;
  const std::vector<Vec3> positions(slab.sim().solver().positions().begin(), slab.sim().solver().positions().end());
  // The lip that the cut made as a copy: its vertices are gone without it.
  Hook hook = hook_beside(HookReach::kSurface);
  std::size_t held = 0;
  std::optional<detail::HookGrip> grip;
  std::vector<Pull> pulls;
  for (const double beside : {-0.001, 0.001}) {
    hook.position.x() = kCut + beside;
    detail::HookGrip taken(slab.mesh_now(), positions, hook);
    pulls.clear();
    taken.add_to(slab.mesh_now(), hook, pulls);
    const std::size_t all = pulls.size();
    ASSERT_TRUE(slab.sim().undo());
    pulls.clear();
    taken.add_to(slab.mesh_now(), hook, pulls);
    if (pulls.size() < all) {
      held = pulls.size();
      grip = taken;
    }
    ASSERT_TRUE(slab.sim().redo());
  }
  ASSERT_TRUE(grip.has_value());
  // Another cut takes the slots that have become free.
  ASSERT_TRUE(slab.sim().undo());
  const std::uint32_t slots = slab.mesh_now().vertex_slots();
  FrameInput input;
  for (int i = 0; i <= 6; ++i) {
    const double z = 0.021 + (kBottom - 0.021) * i / 6;
    input.blade = BladePose{{{0.0353, -0.001, z}, {0.0353, 0.021, z}}, -Vec3::UnitZ()};
    slab.frame(input);
  }
  slab.frame({});
  pulls.clear();
  grip->add_to(slab.mesh_now(), hook, pulls);
  EXPECT_EQ(pulls.size(), held) << "of " << slots << " slots";
}

TEST(HookGrip, JawsThatAreClosedAltogetherAreRefused) {
  SlitSlab slab;
  FrameInput input;
  Hook hook = hook_beside(HookReach::kSurface);
  hook.closed = 1;
  input.hooks = {hook};
  EXPECT_NE(slab.sim().frame(input).error().message.find("closed"), std::string::npos);
}

}  // namespace
}  // namespace incise::hook_grip_test
