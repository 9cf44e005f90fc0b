// SPDX-License-Identifier: Apache-2.0
#include "app/view/cut_marks.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"

namespace incise::app::cut_marks_test {
namespace {

using Place = std::tuple<float, float, float>;

Place place_of(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

/// A blade across y that goes down at x = 0.5 to a depth of the unit cube.
Stroke stroke_down_to(double z) {
  Stroke stroke;
  stroke.times = {0, 1};
  stroke.edges = {{{0.5, -0.2, 1.2}, {0.5, 1.2, 1.2}}, {{0.5, -0.2, z}, {0.5, 1.2, z}}};
  return stroke;
}

Engine cut_cube(const Stroke& stroke) {
  Engine engine = Engine::create(cube_mesh(4), EngineOptions()).value();
  EXPECT_TRUE(engine.cut(stroke).ok());
  return engine;
}

TEST(CutMarks, TrajectoryIsTheSweepOfAllStrokes) {
  Marks marks;
  mark_trajectory({stroke_down_to(0), stroke_down_to(0.5)}, marks);
  ASSERT_EQ(marks.triangles.size(), 4U);
  for (const Marks::Triangle& triangle : marks.triangles) {
    EXPECT_EQ(triangle.ink, Ink::kTrajectory);
    for (const Eigen::Vector3f& corner : triangle.corners) EXPECT_EQ(corner.x(), 0.5F);
  }
}

TEST(CutMarks, IncisionTakesEveryWallOnceAndNoSkin) {
  const Engine engine = cut_cube(stroke_down_to(-0.2));
  SurfaceFrame frame = surface_of(engine.mesh());
  const std::size_t seen = frame.topology->used;
  Marks marks;
  mark_incision(frame, marks);
  std::size_t walls = 0;
  engine.mesh().for_each_tet([&](TetId t) {
    for (const Link link : engine.mesh().links(t)) walls += link.is_boundary() && link.tag() > 0 ? 1U : 0U;
  });
  EXPECT_GT(walls, 0U);
  EXPECT_EQ(marks.triangles.size(), walls / 2);  // the lips lie on each other
  EXPECT_EQ(marks.lines.size(), 3 * marks.triangles.size());
  EXPECT_EQ(frame.topology->used, seen - walls);
}

TEST(CutMarks, TouchingLipsShareTheirBalls) {
  const Engine engine = cut_cube(stroke_down_to(-0.2));
  std::set<Place> expected;
  engine.mesh().for_each_vertex([&](VertexId v) {
    if ((engine.mesh().shape_of(v) & shape::kWall) != 0)
      expected.insert(place_of(engine.mesh().current(v).cast<float>()));
  });
  Marks marks;
  mark_cut_vertices(engine.mesh(), surface_of(engine.mesh()), marks);
  std::set<Place> seen;
  for (const Marks::Ball& ball : marks.balls) {
    EXPECT_EQ(ball.ink, Ink::kVertex);
    EXPECT_TRUE(seen.insert(place_of(ball.centre)).second);
  }
  EXPECT_EQ(seen, expected);
}

TEST(CutMarks, TheFrontIsNotDivided) {
  const Engine engine = cut_cube(stroke_down_to(0.4));
  Marks marks;
  mark_cut_vertices(engine.mesh(), surface_of(engine.mesh()), marks);
  EXPECT_FALSE(marks.balls.empty());
  std::set<Place> front;
  engine.mesh().for_each_vertex([&](VertexId v) {
    if ((engine.mesh().shape_of(v) & shape::kFront) != 0)
      front.insert(place_of(engine.mesh().current(v).cast<float>()));
  });
  EXPECT_FALSE(front.empty());
  for (const Marks::Ball& ball : marks.balls) EXPECT_FALSE(front.contains(place_of(ball.centre)));
}

TEST(CutMarks, NothingIsMarkedWhereNothingIsSeen) {
  const TetMesh mesh = cube_mesh(1);
  Marks marks;
  SurfaceFrame empty, whole = surface_of(mesh);
  mark_incision(empty, marks);
  mark_incision(whole, marks);
  mark_cut_vertices(mesh, empty, marks);
  mark_cut_vertices(mesh, whole, marks);
  EXPECT_TRUE(marks.triangles.empty() && marks.balls.empty());
}

}  // namespace
}  // namespace incise::app::cut_marks_test
