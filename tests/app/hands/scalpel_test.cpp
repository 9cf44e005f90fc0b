// SPDX-License-Identifier: Apache-2.0
// The tools on tissue: what a person draws is what is cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"

namespace incise::app::scalpel_test {
namespace {

using Kind = PointerEvent::Kind;

constexpr double kSide = TouchedCube::kSide;
constexpr double kNear = 0.5 * kSide / 6;  // half a cell: cuts end inside elements only about where the blade does

/// The box of all walls at rest.
Box wall_box(const TetMesh& mesh) {
  Box box;
  mesh.for_each_tet([&](TetId t) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(t)[s].is_boundary() || mesh.links(t)[s].tag() == 0) continue;
      for (const VertexId v : mesh.vertices(Side(t, s))) box.extend(mesh.rest(v));
    }
  });
  return box;
}

bool is_valid(const TetMesh& mesh) {
  return validate(mesh, ValidateLevel::kGeometry).ok;
}

Vec3 top(double x, double y) {
  return {x * kSide, y * kSide, kSide};
}

VertexId vertex_nearest(const TetMesh& mesh, const Vec3& rest) {
  VertexId nearest(0);
  mesh.for_each_vertex([&](VertexId v) {
    if ((mesh.rest(v) - rest).norm() < (mesh.rest(nearest) - rest).norm()) nearest = v;
  });
  return nearest;
}

TEST(ScalpelOnTissue, ADragAcrossTheTopCutsToItsDepth) {
  TouchedCube cube;
  const double depth = cube.tools().settings().depth;
  cube.drag(cube.pixel(top(0.3, 0.2)), cube.pixel(top(0.3, 0.8)), 30);
  EXPECT_FALSE(cube.tools().hands().blade.has_value());
  ASSERT_TRUE(is_valid(cube.mesh()));
  const Box walls = wall_box(cube.mesh());
  ASSERT_FALSE(walls.is_empty());
  EXPECT_NEAR(kSide - walls.lo.z(), depth, 0.25 * depth);
  EXPECT_NEAR(walls.lo.y(), 0.2 * kSide, kNear);
  EXPECT_NEAR(walls.hi.y(), 0.8 * kSide, kNear);
  EXPECT_LT(walls.hi.x() - walls.lo.x(), 0.05 * kSide);  // straight, though the wound opens under the pointer
}

TEST(ScalpelOnTissue, CutsAlikeWhereverItIsSeenFrom) {
  for (const Vec3& view : {Vec3(0, 0, -1), Vec3(1, 0.2, -0.5), Vec3(-0.3, 1, -0.3), Vec3(0.2, -1, -0.4)}) {
    for (const int moves : {8, 30, 200}) {
      TouchedCube cube(6, view);
      const double depth = cube.tools().settings().depth;
      cube.drag(cube.pixel(top(0.3, 0.2)), cube.pixel(top(0.6, 0.8)), moves);
      ASSERT_TRUE(is_valid(cube.mesh()));
      const Box walls = wall_box(cube.mesh());
      EXPECT_NEAR(kSide - walls.lo.z(), depth, 0.3 * depth) << view.transpose() << ", moves: " << moves;
      EXPECT_NEAR(walls.lo.y(), 0.2 * kSide, kNear) << view.transpose() << ", moves: " << moves;
      EXPECT_NEAR(walls.hi.y(), 0.8 * kSide, kNear) << view.transpose() << ", moves: " << moves;
      EXPECT_NEAR(walls.lo.x(), 0.3 * kSide, kNear) << view.transpose() << ", moves: " << moves;
      EXPECT_NEAR(walls.hi.x(), 0.6 * kSide, kNear) << view.transpose() << ", moves: " << moves;
    }
  }
}

TEST(ScalpelOnTissue, PressureScalesTheDepth) {
  TouchedCube cube;
  PointerEvent event;
  event.pressure = 0.5;
  for (int i = 0; i <= 30; ++i) {
    event.kind = i == 0 ? Kind::kPress : Kind::kMove;
    event.pixel = cube.pixel(top(0.4, 0.2 + 0.02 * i));
    cube.send(event);
    cube.frame();
  }
  const double depth = cube.tools().settings().depth;
  cube.tools().cancel();
  cube.frame();
  EXPECT_NEAR(kSide - wall_box(cube.mesh()).lo.z(), 0.5 * depth, 0.25 * depth);
}

TEST(ScalpelOnTissue, ALeaningBladeUndercutsToItsSide) {
  for (const double angle : {0.6, -0.6}) {
    TouchedCube cube;
    ToolSettings settings = cube.tools().settings();
    settings.angle = angle;
    cube.tools().set(settings);
    cube.drag(cube.pixel(top(0.5, 0.1)), cube.pixel(top(0.5, 0.9)), 40);
    ASSERT_TRUE(is_valid(cube.mesh()));
    const Box walls = wall_box(cube.mesh());
    // Along y, left is −x: a handle that leans left has its tip on the right.
    const double reach = settings.depth * std::tan(std::abs(angle));
    const double tip = angle > 0 ? walls.hi.x() - 0.5 * kSide : 0.5 * kSide - walls.lo.x();
    EXPECT_NEAR(tip, reach, 0.35 * reach);
    EXPECT_NEAR(kSide - walls.lo.z(), settings.depth, 0.25 * settings.depth);
  }
}

TEST(ScalpelOnTissue, ADragFromSideToSideCutsBothRims) {
  TouchedCube cube;
  cube.drag(cube.pixel(top(0.5, -0.1)), cube.pixel(top(0.5, 1.15)), 60);
  ASSERT_TRUE(is_valid(cube.mesh()));
  const Box walls = wall_box(cube.mesh());
  EXPECT_NEAR(walls.lo.y(), 0, 1e-9);
  EXPECT_NEAR(walls.hi.y(), kSide, 1e-9);
}

TEST(ScalpelOnTissue, CuttingDeepTakesAPieceOff) {
  TouchedCube cube(6, -Vec3::UnitZ());
  ToolSettings settings = cube.tools().settings();
  settings.depth = 1.2 * kSide;
  cube.tools().set(settings);
  cube.drag(cube.pixel(top(0.45, -0.1)), cube.pixel(top(0.45, 1.1)), 40);
  ASSERT_TRUE(is_valid(cube.mesh()));
  EXPECT_EQ(find_components(cube.mesh()).count(), 2U);
}

TEST(ScalpelOnTissue, CrossingAWoundGoesOnBeyondIt) {
  TouchedCube cube;
  const double depth = cube.tools().settings().depth;
  cube.drag(cube.pixel(top(0.5, 0.2)), cube.pixel(top(0.5, 0.8)), 30);
  cube.drag(cube.pixel(top(0.2, 0.45)), cube.pixel(top(0.8, 0.45)), 30);
  ASSERT_TRUE(is_valid(cube.mesh()));
  const Box walls = wall_box(cube.mesh());
  EXPECT_NEAR(walls.lo.x(), 0.2 * kSide, kNear);
  EXPECT_NEAR(walls.hi.x(), 0.8 * kSide, kNear);
  EXPECT_NEAR(kSide - walls.lo.z(), depth, 0.3 * depth);
}

TEST(PlaneCutOnTissue, ALineAcrossTheMiddleLeavesTwoPieces) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kPlaneCut);
  const Vec2 middle = cube.pixel(Vec3::Constant(0.5 * kSide));
  cube.drag(middle - Vec2(11, 40), middle + Vec2(9, 35), 10);  // the line need not reach across the body
  const std::optional<Stroke> stroke = cube.tools().take_stroke();
  ASSERT_TRUE(stroke.has_value());
  EXPECT_FALSE(cube.tools().take_stroke().has_value());
  ASSERT_TRUE(check(*stroke).ok());
  EXPECT_EQ(stroke->times, (std::vector<double>{0, 1}));
  Result<Engine> engine = Engine::create(TetMesh(cube.mesh()));
  ASSERT_TRUE(engine.ok());
  ASSERT_TRUE(engine->cut(*stroke).ok());
  EXPECT_EQ(find_components(engine->mesh()).count(), 2U);
  EXPECT_TRUE(is_valid(engine->mesh()));
}

TEST(GraspOnTissue, PullsTheSurfaceTowardsThePointerAndLetsGo) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kGrasp);
  const Vec3 grasped = top(0.5, 0.5);
  const Vec2 from = cube.pixel(grasped);
  cube.press_and_move(from, from + Vec2(60, 0), 10);
  ASSERT_EQ(cube.tools().hands().hooks.size(), 1U);
  const Vec3 pull = cube.tools().hands().hooks[0].position - grasped;
  for (int i = 0; i < 60; ++i) cube.frame();
  const VertexId nearest = vertex_nearest(cube.mesh(), grasped);
  const double followed = (cube.mesh().current(nearest) - cube.mesh().rest(nearest)).dot(pull) / pull.squaredNorm();
  EXPECT_GT(followed, 0.3);
  EXPECT_LT(followed, 1.1);
  cube.send(Kind::kRelease, from + Vec2(60, 0));
  EXPECT_TRUE(cube.tools().hands().hooks.empty());
  cube.frame();
}

/// How far the middle of the top goes where it is pulled beside.
double moved_by_a_pull(bool is_pinned) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kPin);
  const Vec2 at = cube.pixel(top(0.5, 0.5));
  if (is_pinned) cube.drag(at, at, 0);
  cube.tools().choose(ToolKind::kGrasp);
  const Vec2 from = cube.pixel(top(0.8, 0.5));
  cube.press_and_move(from, from + Vec2(60, 0), 10);
  EXPECT_EQ(cube.tools().hands().hooks.size(), is_pinned ? 2U : 1U);
  for (int i = 0; i < 60; ++i) cube.frame();
  const VertexId middle = vertex_nearest(cube.mesh(), top(0.5, 0.5));
  return (cube.mesh().current(middle) - cube.mesh().rest(middle)).norm();
}

TEST(PinOnTissue, HoldsItAgainstAPull) {
  EXPECT_LT(moved_by_a_pull(true), 0.5 * moved_by_a_pull(false));
}

}  // namespace
}  // namespace incise::app::scalpel_test
