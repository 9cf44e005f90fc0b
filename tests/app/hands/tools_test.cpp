// SPDX-License-Identifier: Apache-2.0
#include "app/hands/tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "app/view/viewed_body.h"

namespace incise::app::tools_test {
namespace {

using Kind = PointerEvent::Kind;
using Button = PointerEvent::Button;

/// Tools over a cube that stands still, seen from above: +y is up in the picture or near it.
class Hand : public testing::Test {
 protected:
  void send(const PointerEvent& event) { tools_.handle(event, {kSquare, &surface_, kUnitBox}, camera_); }
  void send(Kind kind, const Vec2& pixel, Button button = Button::kLeft) {
    PointerEvent event;
    event.kind = kind;
    event.pixel = pixel;
    event.button = button;
    send(event);
  }
  void wheel(double notches, bool control = false, bool shift = false) {
    PointerEvent event;
    event.kind = Kind::kWheel;
    event.wheel = notches;
    event.control = control;
    event.shift = shift;
    send(event);
  }
  void click(const Vec2& pixel) {
    send(Kind::kPress, pixel);
    send(Kind::kRelease, pixel);
  }
  [[nodiscard]] Vec2 pixel(const Vec3& point) const { return to_pixel(camera_, kSquare, point).value(); }
  [[nodiscard]] Vec2 top(double x, double y) const { return pixel({x, y, 1}); }
  [[nodiscard]] const std::optional<BladePose>& blade() const { return tools_.hands().blade; }
  /// Where the blade is on the surface, as the edge starts half a depth above it and ends a depth below.
  [[nodiscard]] Vec3 blade_point() const {
    return blade()->edge.front() + (blade()->edge.back() - blade()->edge.front()) / 3;
  }
  [[nodiscard]] Marks marks() const {
    Marks marks;
    tools_.draw({kSquare, &surface_, kUnitBox}, camera_, marks);
    return marks;
  }
  [[nodiscard]] double depth_of(const Vec3& point) const { return (camera_.eye() - point).dot(camera_.backward()); }
  [[nodiscard]] static std::size_t lines_of(const Marks& marks, Ink ink) {
    return static_cast<std::size_t>(std::count_if(marks.lines.begin(), marks.lines.end(),
                                                  [&](const Marks::Line& line) { return line.ink == ink; }));
  }

  TetMesh mesh_ = cube_mesh(6);
  SurfaceFrame surface_ = surface_of(mesh_);
  Camera camera_ = camera_along({0.2, 0.3, -1});
  ToolMachine tools_{settings_for(kUnitBox, 1e4, 1)};
};

TEST_F(Hand, SettingsSuitTheBody) {
  const ToolSettings s = settings_for({{0, 0, 0}, {8, 16, 20}}, 5e3, 1e-3);
  EXPECT_DOUBLE_EQ(s.depth, 1);
  EXPECT_DOUBLE_EQ(s.grasp_radius, 2);
  EXPECT_GT(s.grasp_stiffness, 0);
  EXPECT_GT(s.pin_stiffness, s.grasp_stiffness);
  for (const ToolSettings& odd : {settings_for({}, 0, 0), settings_for({{0, 0, 0}, {1, 1, 0}}, -1, NAN)}) {
    for (const double length : {odd.depth, odd.grasp_radius, odd.grasp_stiffness, odd.pin_radius, odd.pin_stiffness}) {
      EXPECT_GT(length, 0);
      EXPECT_TRUE(std::isfinite(length));
    }
  }
}

TEST_F(Hand, SettingsAreBroughtIntoRange) {
  const ToolSettings before = tools_.settings();
  tools_.set({-1, 9, std::numeric_limits<double>::infinity(), NAN, 0, -3});
  EXPECT_EQ(tools_.settings().depth, before.depth);
  EXPECT_EQ(tools_.settings().angle, 1.2);
  EXPECT_EQ(tools_.settings().grasp_radius, before.grasp_radius);
  EXPECT_EQ(tools_.settings().pin_stiffness, before.pin_stiffness);
}

TEST_F(Hand, ToolsHaveNames) {
  std::set<std::string> names;
  for (int tool = 0; tool < static_cast<int>(ToolKind::kCount); ++tool)
    names.insert(name_of(static_cast<ToolKind>(tool)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(ToolKind::kCount));
  EXPECT_STREQ(name_of(ToolKind::kScalpel), "Scalpel");
}

TEST_F(Hand, APressOnTheBodyPutsTheBladeUprightAboveThePlace) {
  send(Kind::kPress, top(0.5, 0.5));
  ASSERT_TRUE(blade().has_value());
  const double depth = tools_.settings().depth;
  EXPECT_EQ(blade()->edge.size(), 5U);
  EXPECT_LT((blade()->edge.front() - Vec3(0.5, 0.5, 1 + 1.75 * depth)).norm(), 1e-5);
  EXPECT_LT((blade()->edge.back() - Vec3(0.5, 0.5, 1 + 0.25 * depth)).norm(), 1e-5);
  EXPECT_EQ(blade()->direction, Vec3(Vec3::Zero()));
  EXPECT_TRUE(tools_.is_busy());
}

TEST_F(Hand, TheBladeFollowsThePointer) {
  send(Kind::kPress, top(0.3, 0.3));
  for (int i = 1; i <= 20; ++i) {
    const double at = 0.3 + 0.02 * i;
    send(Kind::kMove, top(at, 0.3));
    EXPECT_LT((blade_point() - Vec3(at, 0.3, 1)).norm(), 1e-4);
    EXPECT_GT(blade()->direction.normalized().x(), 0.999);
  }
  send(Kind::kRelease, top(0.7, 0.3));
  EXPECT_FALSE(blade().has_value());
  EXPECT_FALSE(tools_.is_busy());
}

TEST_F(Hand, ATremblingPointerDoesNotMoveTheBlade) {
  send(Kind::kPress, top(0.5, 0.5));
  const std::vector<Vec3> edge = blade()->edge;
  for (int i = 0; i < 50; ++i) send(Kind::kMove, top(0.5, 0.5) + Vec2(i % 2 == 0 ? 0.2 : -0.2, 0.1));
  EXPECT_EQ(blade()->edge, edge);
}

TEST_F(Hand, TheBladeLeansToTheLeftOfItsWay) {
  ToolSettings settings = tools_.settings();
  settings.angle = 0.5;
  tools_.set(settings);
  send(Kind::kPress, top(0.5, 0.2));
  for (int i = 1; i <= 30; ++i) send(Kind::kMove, top(0.5, 0.2 + 0.02 * i));
  const Vec3 up = (blade()->edge.front() - blade()->edge.back()).normalized();
  EXPECT_NEAR(std::asin(-up.x()), 0.5, 0.02);  // along +y, left is −x
  EXPECT_NEAR(1 - blade()->edge.back().z(), settings.depth, 1e-3);
}

TEST_F(Hand, ADragOffTheBodyGoesOnInItsPlane) {
  send(Kind::kPress, top(0.5, 0.7));
  const Vec2 from = top(0.5, 0.7), to = top(0.5, 1.3);
  for (int i = 1; i <= 30; ++i) send(Kind::kMove, from + (to - from) * i / 30);
  EXPECT_GT(blade_point().y(), 1.1);
  EXPECT_NEAR(blade_point().z(), 1, 0.05);
}

TEST_F(Hand, ADragThatBeginsBesideTheBodyCutsInFromItsRim) {
  send(Kind::kPress, top(0.5, 1.2));
  EXPECT_FALSE(blade().has_value());
  const Vec2 from = top(0.5, 1.2), to = top(0.5, 0.5);
  std::optional<BladePose> first;
  for (int i = 1; i <= 30; ++i) {
    send(Kind::kMove, from + (to - from) * i / 30);
    if (!first && blade()) first = blade();
  }
  ASSERT_TRUE(first.has_value());
  EXPECT_GT(first->edge[2].y(), 1.05);
  EXPECT_LT(first->edge[2].y(), 1.2 + 3 * tools_.settings().depth);
  EXPECT_LT((blade_point() - Vec3(0.5, 0.5, 1)).norm(), 1e-2);
}

TEST_F(Hand, AWallUnderThePointerDoesNotDrawTheBladeIn) {
  // The skin ahead of the blade becomes a wall deep below: the blade keeps to the surface.
  auto topology = std::make_shared<SurfaceTopology>(*surface_.topology);
  for (std::size_t slot = 0; slot < topology->triangles.size(); ++slot) {
    for (const std::uint32_t corner : topology->triangles[slot]) {
      if (surface_.positions[corner].x() < 0.45F || surface_.positions[corner].z() < 1) continue;
      topology->looks[slot].flags = TriangleLook::kWall;
    }
  }
  surface_.topology = topology;
  for (Eigen::Vector3f& p : surface_.positions) {
    if (p.x() > 0.6F && p.z() > 0.99F) p.z() = 0.6F;
  }
  send(Kind::kPress, top(0.2, 0.5));
  for (int i = 1; i <= 30; ++i) {
    send(Kind::kMove, top(0.2 + 0.02 * i, 0.5));
    EXPECT_NEAR(blade_point().z(), 1, 0.01);
  }
}

TEST_F(Hand, AJumpInDepthIsNotFollowed) {
  for (Eigen::Vector3f& p : surface_.positions) {
    if (p.x() > 0.6F && p.z() > 0.99F) p.z() = 0.2F;
  }
  send(Kind::kPress, top(0.2, 0.5));
  for (int i = 1; i <= 30; ++i) send(Kind::kMove, top(0.2 + 0.02 * i, 0.5));
  EXPECT_GT(blade_point().z(), 0.7);
}

TEST_F(Hand, CancelEndsTheStroke) {
  EXPECT_FALSE(tools_.cancel());
  send(Kind::kPress, top(0.5, 0.5));
  EXPECT_TRUE(tools_.cancel());
  EXPECT_FALSE(blade().has_value());
  send(Kind::kMove, top(0.6, 0.5));
  send(Kind::kRelease, top(0.6, 0.5));
  EXPECT_FALSE(blade().has_value());
}

TEST_F(Hand, ChoosingAnotherToolEndsTheStroke) {
  send(Kind::kPress, top(0.5, 0.5));
  tools_.choose(ToolKind::kGrasp);
  EXPECT_FALSE(blade().has_value());
  EXPECT_FALSE(tools_.is_busy());
  EXPECT_EQ(tools_.tool(), ToolKind::kGrasp);
}

TEST_F(Hand, OtherButtonsDoNotDisturbADrag) {
  const Vec3 eye = camera_.eye();
  send(Kind::kPress, top(0.3, 0.5));
  send(Kind::kPress, top(0.3, 0.5), Button::kRight);
  send(Kind::kMove, top(0.5, 0.5));
  send(Kind::kRelease, top(0.5, 0.5), Button::kRight);
  EXPECT_TRUE(blade().has_value());
  EXPECT_EQ(camera_.eye(), eye);
  send(Kind::kRelease, top(0.5, 0.5));
  EXPECT_FALSE(blade().has_value());
  send(Kind::kPress, {400, 400}, Button::kMiddle);
  send(Kind::kPress, {400, 400});
  EXPECT_FALSE(blade().has_value());
  send(Kind::kMove, {450, 400});
  EXPECT_NE(camera_.eye(), eye);
}

struct ViewDrag {
  ToolKind tool;
  Button button;
  bool alt, shift;
  bool turns, moves;
};

TEST_F(Hand, DragsTurnOrMoveTheView) {
  const ViewDrag drags[] = {
      {ToolKind::kOrbit, Button::kLeft, false, false, true, false},
      {ToolKind::kScalpel, Button::kRight, false, false, true, false},
      {ToolKind::kScalpel, Button::kMiddle, false, false, true, false},
      {ToolKind::kScalpel, Button::kRight, false, true, false, true},
      {ToolKind::kGrasp, Button::kLeft, true, false, true, false},
      {ToolKind::kGrasp, Button::kLeft, true, true, false, true},
      {ToolKind::kOrbit, Button::kLeft, false, true, false, false},  // grasps
      {ToolKind::kScalpel, Button::kLeft, false, false, false, false},
  };
  for (const ViewDrag& drag : drags) {
    camera_ = camera_along({0.2, 0.3, -1});
    const Camera before = camera_;
    tools_.choose(drag.tool);
    PointerEvent event;
    event.button = drag.button;
    event.alt = drag.alt;
    event.shift = drag.shift;
    event.pixel = {400, 400};
    event.kind = Kind::kPress;
    send(event);
    event.kind = Kind::kMove;
    event.pixel = {430, 420};
    send(event);
    event.kind = Kind::kRelease;
    send(event);
    EXPECT_EQ(camera_.azimuth != before.azimuth, drag.turns);
    EXPECT_EQ(camera_.target != before.target, drag.moves);
    EXPECT_FALSE(tools_.is_busy());
  }
}

TEST_F(Hand, TheWheelZoomsOrChangesTheScalpel) {
  const ToolSettings before = tools_.settings();
  const double distance = camera_.distance;
  wheel(1);
  EXPECT_LT(camera_.distance, distance);
  wheel(-1);
  EXPECT_NEAR(camera_.distance, distance, 1e-9);
  wheel(1, true);
  EXPECT_NEAR(tools_.settings().depth, 1.1 * before.depth, 1e-12);
  wheel(2, false, true);
  EXPECT_NEAR(tools_.settings().angle, 10 * M_PI / 180, 1e-12);
  wheel(1000, false, true);
  EXPECT_EQ(tools_.settings().angle, 1.2);
}

TEST_F(Hand, APlaneCutGoesFromOutsideTheBodyToOutside) {
  tools_.choose(ToolKind::kPlaneCut);
  send(Kind::kPress, {300, 420});
  send(Kind::kMove, {500, 380});
  EXPECT_EQ(lines_of(marks(), Ink::kPreview), 1U);
  EXPECT_EQ(marks().triangles.size(), 2U);
  const Marks::Line line = marks().lines.front();
  for (const Vec3& corner : corners_of(kUnitBox)) {
    EXPECT_LT(depth_of(line.from.cast<double>()), depth_of(corner)) << "the body would hide it";
    EXPECT_LT(depth_of(line.to.cast<double>()), depth_of(corner));
  }
  send(Kind::kRelease, {500, 380});
  const std::optional<Stroke> stroke = tools_.take_stroke();
  ASSERT_TRUE(stroke.has_value());
  EXPECT_TRUE(check(*stroke).ok());
  const std::vector<Vec3>& first = stroke->edges.front();
  const std::vector<Vec3>& last = stroke->edges.back();
  const Vec3 along = (last[0] - first[0]).normalized(), inwards = (first[1] - first[0]).normalized();
  EXPECT_GT(along.dot(camera_.right()), 0.9);
  for (const Vec3& corner : corners_of(kUnitBox)) {
    EXPECT_GT((corner - first[0]).dot(along), 0);
    EXPECT_LT((corner - last[0]).dot(along), 0);
    EXPECT_GT((corner - first[0]).dot(inwards), 0);
    EXPECT_LT((corner - first[1]).dot(inwards), 0);
  }
  const Vec3 normal = along.cross(inwards);
  EXPECT_NEAR((camera_.eye() - first[0]).dot(normal), 0, 1e-9);
  EXPECT_NEAR(ray_through(camera_, kSquare, {300, 420}).direction.dot(normal), 0, 1e-9);
  EXPECT_TRUE(marks().triangles.empty());
}

TEST_F(Hand, ADegenerateLineCutsNothing) {
  tools_.choose(ToolKind::kPlaneCut);
  send(Kind::kPress, {300, 420});
  send(Kind::kMove, {500, 380});
  send(Kind::kMove, {303, 424});
  send(Kind::kRelease, {303, 424});
  EXPECT_FALSE(tools_.take_stroke().has_value());
  send(Kind::kPress, {300, 420});
  send(Kind::kMove, {500, 380});
  tools_.cancel();
  EXPECT_FALSE(tools_.take_stroke().has_value());
}

TEST_F(Hand, AGraspMovesAcrossTheViewAndGoesWithTheRelease) {
  tools_.choose(ToolKind::kGrasp);
  send(Kind::kPress, top(0.5, 0.5));
  ASSERT_EQ(tools_.hands().hooks.size(), 1U);
  const Hook first = tools_.hands().hooks[0];
  EXPECT_LT((first.position - Vec3(0.5, 0.5, 1)).norm(), 1e-5);
  EXPECT_EQ(first.radius, tools_.settings().grasp_radius);
  send(Kind::kMove, {100, 200});
  const Hook moved = tools_.hands().hooks[0];
  EXPECT_EQ(moved.id, first.id);
  EXPECT_NEAR((moved.position - first.position).dot(camera_.backward()), 0, 1e-9);
  EXPECT_LT((pixel(moved.position) - Vec2(100, 200)).norm(), 1e-6);
  const double distance = camera_.distance;
  wheel(-1);
  EXPECT_EQ(camera_.distance, distance);
  EXPECT_GT((tools_.hands().hooks[0].position - moved.position).dot(camera_.backward()), 0);
  EXPECT_LT((pixel(tools_.hands().hooks[0].position) - Vec2(100, 200)).norm(), 1e-6);
  EXPECT_EQ(lines_of(marks(), Ink::kHook), 0U);  // nothing across the wound; the jaws are drawn as bodies
  send(Kind::kRelease, {100, 200});
  EXPECT_TRUE(tools_.hands().hooks.empty());
  send(Kind::kPress, top(0.5, 0.5));
  EXPECT_NE(tools_.hands().hooks[0].id, first.id);
}

TEST_F(Hand, WhatPullsIsNoPin) {
  tools_.choose(ToolKind::kPin);
  send(Kind::kPress, top(0.5, 0.5));
  send(Kind::kRelease, top(0.5, 0.5));
  EXPECT_EQ(tools_.hands().hooks.size(), 1U);
  EXPECT_FALSE(tools_.is_pulling());
  for (const ToolKind kind : {ToolKind::kGrasp, ToolKind::kHook, ToolKind::kRetractor}) {
    tools_.choose(kind);
    send(Kind::kPress, top(0.3, 0.5));
    EXPECT_TRUE(tools_.is_pulling()) << name_of(kind);
    tools_.cancel();
    tools_.reset(tools_.settings());
  }
}

TEST_F(Hand, AGraspBesideTheBodyHoldsNothing) {
  tools_.choose(ToolKind::kGrasp);
  send(Kind::kPress, {2, 2});
  send(Kind::kMove, top(0.5, 0.5));
  EXPECT_TRUE(tools_.hands().hooks.empty());
}

TEST_F(Hand, ShiftGraspsWhateverTheTool) {
  PointerEvent event;
  event.kind = Kind::kPress;
  event.shift = true;
  event.pixel = top(0.5, 0.5);
  send(event);
  EXPECT_EQ(tools_.hands().hooks.size(), 1U);
  EXPECT_FALSE(blade().has_value());
}

TEST_F(Hand, AClickPinsAndAClickNearItLetsGo) {
  tools_.choose(ToolKind::kPin);
  click(top(0.3, 0.5));
  click(top(0.7, 0.5));
  ASSERT_EQ(tools_.hands().hooks.size(), 2U);
  EXPECT_NE(tools_.hands().hooks[0].id, tools_.hands().hooks[1].id);
  EXPECT_EQ(tools_.hands().hooks[0].stiffness, tools_.settings().pin_stiffness);
  EXPECT_EQ(marks().balls.size(), 2U);
  click(top(0.3, 0.5) + Vec2(8, 8));
  ASSERT_EQ(tools_.hands().hooks.size(), 1U);
  EXPECT_NEAR(tools_.hands().hooks[0].position.x(), 0.7, 1e-5);
  click({2, 2});
  EXPECT_EQ(tools_.hands().hooks.size(), 1U);
  send(Kind::kPress, top(0.2, 0.2));
  send(Kind::kMove, top(0.5, 0.2));
  send(Kind::kRelease, top(0.5, 0.2));  // a drag is no click
  EXPECT_EQ(tools_.hands().hooks.size(), 1U);
  tools_.cancel();
  EXPECT_EQ(tools_.hands().hooks.size(), 1U);
  tools_.reset(tools_.settings());
  EXPECT_TRUE(tools_.hands().hooks.empty());
  EXPECT_EQ(tools_.tool(), ToolKind::kPin);
}

TEST_F(Hand, AProbeTellsWhatIsThereOnce) {
  tools_.choose(ToolKind::kProbe);
  click(top(0.3, 0.6));
  const std::optional<SurfaceHit> hit = tools_.take_probe();
  ASSERT_TRUE(hit.has_value());
  EXPECT_LT((hit->point - Vec3(0.3, 0.6, 1)).norm(), 1e-5);
  EXPECT_FALSE(tools_.take_probe().has_value());
  click({2, 2});
  EXPECT_FALSE(tools_.take_probe().has_value());
}

TEST_F(Hand, HoveringShowsWhereAndHowDeepItWouldCut) {
  EXPECT_TRUE(marks().lines.empty());
  send(Kind::kMove, top(0.5, 0.5));
  EXPECT_GT(lines_of(marks(), Ink::kPreview), 4U);
  float lowest = 2;
  for (const Marks::Line& line : marks().lines) lowest = std::min({lowest, line.from.z(), line.to.z()});
  EXPECT_NEAR(lowest, 1 - tools_.settings().depth, 1e-5);
  send(Kind::kPress, top(0.5, 0.5));
  send(Kind::kMove, top(0.6, 0.5));
  EXPECT_GT(lines_of(marks(), Ink::kBlade), 4U);  // edge and back
  EXPECT_EQ(lines_of(marks(), Ink::kPreview), 0U);
  send(Kind::kRelease, top(0.6, 0.5));
  send(Kind::kMove, {2, 2});
  EXPECT_TRUE(marks().lines.empty());
}

TEST_F(Hand, WithoutASurfaceToolsDoNothing) {
  surface_ = {};
  for (int tool = 0; tool < static_cast<int>(ToolKind::kCount); ++tool) {
    tools_.choose(static_cast<ToolKind>(tool));
    click({400, 400});
    EXPECT_FALSE(blade().has_value());
    EXPECT_TRUE(tools_.hands().hooks.empty());
  }
}

PointerEvent random_event(std::mt19937& random) {
  const auto one_in = [&](unsigned n) { return random() % n == 0; };
  PointerEvent event;
  event.kind = one_in(3) ? static_cast<Kind>(random() % 4) : Kind::kMove;
  event.button = one_in(4) ? static_cast<Button>(random() % 3) : Button::kLeft;
  event.pixel = Vec2(static_cast<double>(random() % 900) - 50, static_cast<double>(random() % 900) - 50);
  event.shift = one_in(6);
  event.control = one_in(6);
  event.alt = one_in(8);
  event.wheel = static_cast<double>(random() % 7) - 3;
  event.pressure = static_cast<double>(random() % 5) / 4;
  if (one_in(200)) event.pixel.x() = one_in(2) ? NAN : 1e9;
  if (one_in(200)) event.wheel = 1e300;
  if (one_in(200)) event.pressure = NAN;
  return event;
}

void expect_sound(const HandState& hands) {
  std::set<std::uint32_t> ids;
  if (hands.blade) {
    ASSERT_EQ(hands.blade->edge.size(), 5U);
    for (const Vec3& p : hands.blade->edge) ASSERT_TRUE(p.allFinite());
    ASSERT_TRUE(hands.blade->direction.allFinite());
  }
  for (const Hook& hook : hands.hooks) {
    ASSERT_TRUE(hook.position.allFinite());
    ASSERT_TRUE(ids.insert(hook.id).second);
  }
}

TEST(Tools, RandomEventsNeverLeadToUnsoundHands) {
  TouchedCube cube(3);
  std::mt19937 random(7);
  Vec2 at(400, 400);
  unsigned strokes = 0, planes = 0;
  for (int i = 0; i < 20000; ++i) {
    if (random() % 40 == 0) cube.tools().choose(static_cast<ToolKind>(random() % 7));
    if (random() % 300 == 0) cube.tools().cancel();
    if (random() % 3000 == 0) cube.tools().reset(cube.tools().settings());
    if (random() % 50 == 0) cube.camera() = camera_along({0.3, 0.4, -1}, bounds_of(cube.surface()));
    PointerEvent event = random_event(random);
    // Half of the events go on from where the pointer was, as hands do.
    if (random() % 2 == 0) event.pixel = at + Vec2(static_cast<double>(random() % 41) - 20, 3);
    if (event.pixel.allFinite()) at = event.pixel.cwiseMax(-50).cwiseMin(850);
    cube.send(event);
    expect_sound(cube.tools().hands());
    Marks marks;
    cube.tools().draw(cube.context(), cube.camera(), marks);
    for (const Marks::Line& line : marks.lines) ASSERT_TRUE(line.from.allFinite() && line.to.allFinite());
    if (const std::optional<Stroke> plane = cube.tools().take_stroke()) {
      ASSERT_TRUE(check(*plane).ok());
      ++planes;
    }
    strokes += cube.tools().hands().blade ? 1U : 0U;
    if (i % 100 < 4) cube.frame();
    if (::testing::Test::HasFatalFailure()) FAIL() << "event " << i;
  }
  EXPECT_GT(strokes, 300U);
  EXPECT_GT(planes, 20U);
}

}  // namespace
}  // namespace incise::app::tools_test
