// SPDX-License-Identifier: Apache-2.0
// Scissors, punch, hooks that stay, and what tools say that cannot act.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/hands/grip.h"
#include "app/hands/punch.h"
#include "app/hands/scissors.h"
#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"

namespace incise::app::more_tools_test {
namespace {

using Kind = PointerEvent::Kind;

constexpr double kSide = TouchedCube::kSide;

Vec3 top(double x, double y) {
  return {x * kSide, y * kSide, kSide};
}

bool is_valid(const TetMesh& mesh) {
  return validate(mesh, ValidateLevel::kGeometry).ok;
}

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

/// Makes a stroke as sessions do: at its own times, in frames of a sixtieth of a second.
void follow(TouchedCube& cube, const Stroke& stroke) {
  ASSERT_TRUE(check(stroke).ok());
  const double seconds = stroke.times.back();
  const auto frames = static_cast<int>(std::ceil(seconds * 60));
  FrameInput input;
  for (int i = 0; i <= frames; ++i) {
    const double t = std::min(seconds, i / 60.0);
    std::size_t key = 1;
    while (key + 1 < stroke.times.size() && stroke.times[key] < t) ++key;
    const double share = (t - stroke.times[key - 1]) / (stroke.times[key] - stroke.times[key - 1]);
    input.blade.emplace();
    for (std::size_t p = 0; p < stroke.edges[key].size(); ++p) {
      input.blade->edge.emplace_back((1 - share) * stroke.edges[key - 1][p] + share * stroke.edges[key][p]);
    }
    const Result<FrameReport> report = cube.sim().frame(input);
    ASSERT_TRUE(report.ok()) << report.error().message;
  }
  cube.frame();
}

Stroke taken_stroke(TouchedCube& cube) {
  std::optional<Stroke> stroke = cube.tools().take_stroke();
  EXPECT_TRUE(stroke.has_value());
  return stroke.value_or(Stroke{});
}

TEST(ScissorsOnTissue, CloseOnTheSkinInAWedge) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kScissors);
  const double depth = cube.tools().settings().depth;
  cube.drag(cube.pixel(top(0.2, 0.45)), cube.pixel(top(0.7, 0.45)), 10);
  EXPECT_FALSE(cube.tools().hands().blade.has_value());  // they close at the end of the drag
  follow(cube, taken_stroke(cube));
  EXPECT_TRUE(cube.tools().take_refusal().empty());
  ASSERT_TRUE(is_valid(cube.mesh()));
  const Box walls = wall_box(cube.mesh());
  ASSERT_FALSE(walls.is_empty());
  EXPECT_NEAR(kSide - walls.lo.z(), depth, 0.35 * depth);
  EXPECT_LT(walls.hi.y() - walls.lo.y(), 0.05 * kSide);
  EXPECT_NEAR(walls.hi.x(), 0.7 * kSide, 0.5 * kSide / 6);
  EXPECT_EQ(find_components(cube.mesh()).count(), 1U);
}

TEST(ScissorsOnTissue, FromARimTheyCutToTheirDepthAllTheWay) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kScissors);
  const double depth = cube.tools().settings().depth;
  cube.drag(cube.pixel(top(-0.1, 0.45)), cube.pixel(top(0.6, 0.45)), 10);
  follow(cube, taken_stroke(cube));
  ASSERT_TRUE(is_valid(cube.mesh()));
  const Box walls = wall_box(cube.mesh());
  ASSERT_FALSE(walls.is_empty());
  EXPECT_NEAR(walls.lo.x(), 0, 1e-9);
  EXPECT_NEAR(walls.hi.x(), 0.6 * kSide, 0.5 * kSide / 6);
  // At the rim as deep as elsewhere.
  double deepest_at_rim = 0;
  cube.mesh().for_each_tet([&](TetId t) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!cube.mesh().links(t)[s].is_boundary() || cube.mesh().links(t)[s].tag() == 0) continue;
      for (const VertexId v : cube.mesh().vertices(Side(t, s))) {
        if (cube.mesh().rest(v).x() < 1e-6) deepest_at_rim = std::max(deepest_at_rim, kSide - cube.mesh().rest(v).z());
      }
    }
  });
  EXPECT_NEAR(deepest_at_rim, depth, 0.35 * depth);
}

TEST(ScissorsOnTissue, AreOneStrokeToTakeBack) {
  TouchedCube cube;
  const std::uint64_t before = cube.mesh().hash();
  cube.tools().choose(ToolKind::kScissors);
  cube.drag(cube.pixel(top(0.2, 0.5)), cube.pixel(top(0.7, 0.5)), 10);
  follow(cube, taken_stroke(cube));
  EXPECT_NE(cube.mesh().hash(), before);
  ASSERT_TRUE(cube.sim().undo());
  EXPECT_EQ(cube.mesh().hash(), before);
}

TEST(PunchOnTissue, ACoreComesOut) {
  for (const std::uint32_t cells : {6U, 10U}) {
    for (const Vec3& at : {top(0.5, 0.5), top(0.37, 0.61)}) {
      TouchedCube cube(cells);
      cube.tools().choose(ToolKind::kPunch);
      ToolSettings settings = cube.tools().settings();
      settings.depth = 0.5 * kSide;
      settings.punch_radius = 0.15 * kSide;
      cube.tools().set(settings);
      cube.drag(cube.pixel(at), cube.pixel(at), 0);
      follow(cube, taken_stroke(cube));
      ASSERT_TRUE(is_valid(cube.mesh()));
      const std::vector<double> volumes = find_components(cube.mesh()).volume;
      ASSERT_EQ(volumes.size(), 2U) << cells << " cells, at " << at.transpose();
      // A cylinder with a cone at its end, as a polygon of 16 corners has it.
      const double area = 8 * std::sin(M_PI / 8) * settings.punch_radius * settings.punch_radius;
      const double expected = area * settings.depth * (0.8 + 0.2 / 3);
      // A cell of the mesh is as wide as the ring, or half as wide: corners are cut off.
      EXPECT_NEAR(*std::min_element(volumes.begin(), volumes.end()), expected, 1.8 / cells * expected)
          << cells << " cells, at " << at.transpose();
      ASSERT_TRUE(cube.sim().undo());
      EXPECT_EQ(find_components(cube.mesh()).count(), 1U);
    }
  }
}

TEST(StayingHooks, HoldWhereTheyAreLetGo) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kRetractor);
  const Vec2 from = cube.pixel(top(0.5, 0.5));
  cube.drag(from, from + Vec2(60, 0), 10);
  ASSERT_EQ(cube.tools().hands().hooks.size(), 1U);
  EXPECT_EQ(cube.tools().hands().hooks[0].reach, HookReach::kSurface);
  const Vec3 held = cube.tools().hands().hooks[0].position;
  cube.tools().choose(ToolKind::kScalpel);
  for (int i = 0; i < 60; ++i) cube.frame();
  ASSERT_EQ(cube.tools().hands().hooks.size(), 1U);
  EXPECT_EQ(cube.tools().hands().hooks[0].position, held);
  double furthest = 0;
  cube.mesh().for_each_vertex(
      [&](VertexId v) { furthest = std::max(furthest, (cube.mesh().current(v) - cube.mesh().rest(v)).norm()); });
  EXPECT_GT(furthest, 0.3 * (held - top(0.5, 0.5)).norm());
  // It is taken up again, and let go of by a click.
  cube.tools().choose(ToolKind::kRetractor);
  cube.drag(from + Vec2(60, 0), from + Vec2(30, 0), 5);
  ASSERT_EQ(cube.tools().hands().hooks.size(), 1U);
  EXPECT_LT((cube.tools().hands().hooks[0].position - top(0.5, 0.5)).norm(), (held - top(0.5, 0.5)).norm());
  cube.drag(from + Vec2(30, 0), from + Vec2(30, 0), 0);
  EXPECT_TRUE(cube.tools().hands().hooks.empty());
}

TEST(StayingHooks, PullAlongTheSkinAndNotIntoIt) {
  for (const ToolKind tool : {ToolKind::kHook, ToolKind::kRetractor}) {
    TouchedCube cube;
    cube.tools().choose(tool);
    cube.drag(cube.pixel(top(0.5, 0.5)), cube.pixel(top(0.5, 0.2)), 10);
    ASSERT_EQ(cube.tools().hands().hooks.size(), 1U);
    EXPECT_LT((cube.tools().hands().hooks[0].position - top(0.5, 0.2)).norm(), 1e-3 * kSide);
  }
}

TEST(Forceps, LiftAndPullAlongTheSkinAndNeverIntoIt) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kGrasp);
  const Vec3 grasped = top(0.5, 0.5);
  const Vec2 from = cube.pixel(grasped);
  cube.press_and_move(from, from, 1);
  for (int turn = 0; turn < 24; ++turn) {
    const double angle = turn * std::numbers::pi / 12;
    const Vec2 pull = 70 * Vec2(std::cos(angle), std::sin(angle));
    cube.send(Kind::kMove, from + pull);
    const Vec3 held = cube.tools().hands().hooks[0].position;
    EXPECT_LT((cube.pixel(held) - from - pull).norm(), 1e-6) << turn;
    EXPECT_GE(held.z(), grasped.z() - 1e-6 * kSide) << turn;
    if (pull.y() < -20) {
      EXPECT_GT(held.z(), grasped.z() + 0.02 * kSide) << turn;
    }
    if (pull.y() > 20) {
      EXPECT_NEAR(held.z(), grasped.z(), 1e-6 * kSide) << turn;
    }
  }
  cube.send(Kind::kMove, from);
  EXPECT_LT((cube.tools().hands().hooks[0].position - grasped).norm(), 1e-6 * kSide);
}

TEST(Forceps, ShowBothArmsToTheViewer) {
  Camera camera;
  camera.elevation = 0.7;
  Hook hook;
  hook.radius = 1;
  const Instrument forceps = instrument_at(hook, hook.position, {}, camera);
  const Vec3 between_arms = forceps.up.cross(forceps.ahead).normalized();
  EXPECT_GT(std::abs(between_arms.dot(camera.upward())), 0.99);
  EXPECT_GT(forceps.up.dot(camera.backward()), 0.5);
  hook.closed = 0.5;
  EXPECT_LT(instrument_at(hook, hook.position, {}, camera).opening, 0.3 * forceps.opening);
}

TEST(Pins, StandOnTheSkinAndAreLetGoByTheirHeads) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kPin);
  cube.drag(cube.pixel(top(0.3, 0.5)), cube.pixel(top(0.3, 0.5)), 0);
  cube.drag(cube.pixel(top(0.7, 0.5)), cube.pixel(top(0.7, 0.5)), 0);
  ASSERT_EQ(cube.tools().hands().hooks.size(), 2U);
  Marks marks;
  cube.tools().draw(cube.context(), cube.camera(), marks);
  ASSERT_EQ(marks.balls.size(), 2U);
  ASSERT_EQ(marks.lines.size(), 2U);
  const Marks::Ball& head = marks.balls[0];
  EXPECT_FALSE(head.is_in_pixels);
  EXPECT_GT(head.centre.z(), kSide + head.radius);
  const Vec2 at = cube.pixel(head.centre.cast<double>());
  cube.drag(at, at, 0);
  ASSERT_EQ(cube.tools().hands().hooks.size(), 1U);
  EXPECT_NEAR(cube.tools().hands().hooks[0].position.x(), 0.7 * kSide, 1e-3 * kSide);
}

TEST(Pins, AreNeverSmallerThanAShareOfThePicture) {
  Camera camera;
  const Pin pin{{}, Vec3::UnitZ(), 1e-6};
  for (const double distance : {1.0, 50.0}) {
    camera.distance = distance;
    Marks marks;
    draw_pins({pin}, camera, marks);
    const double half_height = distance * std::tan(0.5 * camera.field_of_view);
    EXPECT_GT(marks.balls.at(0).radius, 0.01 * half_height);
    EXPECT_LT(marks.balls.at(0).radius, 0.02 * half_height);
  }
}

TEST(StayingHooks, GivenUpTheyAreGone) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kHook);
  cube.press_and_move(cube.pixel(top(0.5, 0.5)), cube.pixel(top(0.6, 0.5)), 5);
  ASSERT_EQ(cube.tools().hands().hooks.size(), 1U);
  EXPECT_TRUE(cube.tools().cancel());
  EXPECT_TRUE(cube.tools().hands().hooks.empty());
}

TEST(StayingHooks, AForcepsClosesAndLetsGo) {
  TouchedCube cube;
  cube.tools().choose(ToolKind::kGrasp);
  cube.press_and_move(cube.pixel(top(0.5, 0.5)), cube.pixel(top(0.6, 0.5)), 5);
  ASSERT_EQ(cube.tools().hands().hooks.size(), 1U);
  EXPECT_GT(cube.tools().hands().hooks[0].closed, 0);
  EXPECT_EQ(cube.tools().hands().hooks[0].reach, HookReach::kSurface);
  cube.send(Kind::kRelease, cube.pixel(top(0.6, 0.5)));
  EXPECT_TRUE(cube.tools().hands().hooks.empty());
}

TEST(Stitches, GoFromWhereADragBeginsToWhereItEnds) {
  for (const ToolKind kind : {ToolKind::kSuture, ToolKind::kStaple}) {
    TouchedCube cube;
    cube.tools().choose(kind);
    cube.drag(cube.pixel(top(0.4, 0.5)), cube.pixel(top(0.6, 0.5)), 5);
    const std::optional<Stitch> stitch = cube.tools().take_stitch();
    ASSERT_TRUE(stitch.has_value());
    EXPECT_LT((stitch->rest_places[0] - top(0.4, 0.5)).norm(), 1e-4 * kSide);
    EXPECT_LT((stitch->rest_places[1] - top(0.6, 0.5)).norm(), 1e-4 * kSide);
    EXPECT_EQ(stitch->suture.pushes, kind == ToolKind::kStaple);
    EXPECT_LE(stitch->suture.rest_length, 0.2001 * kSide);
    EXPECT_TRUE(cube.sim().add_suture(stitch->rest_places, stitch->suture).ok());
    EXPECT_FALSE(cube.tools().take_stitch().has_value());
  }
}

TEST(Tools, SayWhyTheyDidNothing) {
  for (int i = 0; i < static_cast<int>(ToolKind::kCount); ++i) {
    const auto kind = static_cast<ToolKind>(i);
    if (kTools[static_cast<std::size_t>(i)].make == nullptr) continue;
    TouchedCube cube(3);
    cube.tools().choose(kind);
    cube.drag({2, 2}, {2, 3}, 1);  // a click beside the body
    EXPECT_FALSE(cube.tools().take_refusal().empty()) << name_of(kind);
    EXPECT_TRUE(cube.tools().take_refusal().empty()) << name_of(kind);  // once
  }
}

}  // namespace
}  // namespace incise::app::more_tools_test
