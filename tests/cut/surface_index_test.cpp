// SPDX-License-Identifier: Apache-2.0
// The index of the body's surface, against a search of all boundary sides.
#include "cut/surface_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cut/flagged_body.h"
#include "incise/geom/closest.h"
#include "incise/mesh/bounds.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::surface_index_test {
namespace {

Box box_of(const TetMesh& mesh, Side side) {
  const auto v = mesh.vertices(side);
  return {mesh.rest(v[0]).cwiseMin(mesh.rest(v[1])).cwiseMin(mesh.rest(v[2])),
          mesh.rest(v[0]).cwiseMax(mesh.rest(v[1])).cwiseMax(mesh.rest(v[2]))};
}

template <class Visit>
void for_each_boundary_side(const TetMesh& mesh, Visit&& visit) {
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.links(tet)[s].is_boundary()) visit(Side(tet, s));
    }
  });
}

std::set<Side> sides_in(const TetMesh& mesh, const Box& box) {
  std::set<Side> found;
  for_each_boundary_side(mesh, [&](Side side) {
    if (box_of(mesh, side).overlaps(box)) found.insert(side);
  });
  return found;
}

/// What the index finds in a box, without the neighbours in its cells.
std::set<Side> found_in(const TetMesh& mesh, const SurfaceIndex& index, const Box& box) {
  std::set<Side> found;
  index.for_each_near(mesh, box, [&](Side side) {
    EXPECT_TRUE(mesh.link(side).is_boundary());
    if (box_of(mesh, side).overlaps(box)) found.insert(side);
  });
  return found;
}

Box random_box(Random& random) {
  const Vec3 a = random.point(-0.2, 1.2), b = a + random.real(0, 0.4) * random.point(0, 1);
  return {a, b};
}

Side nearest_of_all(const TetMesh& mesh, const Vec3& place, double most) {
  Side best;
  double least = most * most;
  for_each_boundary_side(mesh, [&](Side side) {
    const auto v = mesh.vertices(side);
    const double away = closest_on_triangle(place, mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2])).distance2;
    if (away > least || (away == least && best < side)) return;
    least = away;
    best = side;
  });
  return best;
}

void expect_finds_all(const TetMesh& mesh, const SurfaceIndex& index, Random& random) {
  for (unsigned run = 0; run < 100; ++run) {
    const Box box = random_box(random);
    EXPECT_EQ(found_in(mesh, index, box), sides_in(mesh, box));
    const Vec3 place = random.point(-1, 2);
    for (const double most : {0.1, 10.0}) {
      EXPECT_EQ(index.nearest(mesh, place, most).side, nearest_of_all(mesh, place, most)) << place.transpose();
    }
  }
}

TEST(SurfaceIndex, finds_the_boundary_sides_in_a_box) {
  Random random(1);
  for (const TetSoup& soup : {kuhn_cube(1), jittered_cube(6, 3), ball(6)}) {
    const TetMesh mesh = build(soup);
    SurfaceIndex index;
    index.follow(mesh, Journal());
    expect_finds_all(mesh, index, random);
  }
}

TEST(SurfaceIndex, follows_cuts_undo_and_redo) {
  Random random(2);
  FlaggedBody body(jittered_cube(4, 1));
  SurfaceIndex index;
  index.follow(body.mesh(), body.journal());
  for (unsigned round = 0; round < 5; ++round) {
    body.toggle_some(random, 0.1);
    body.place_points(random, 0.2);
    body.rebuild();
    index.follow(body.mesh(), body.journal());
    expect_finds_all(body.mesh(), index, random);
  }
  for (unsigned round = 0; round < 3; ++round) {
    body.undo();
    if (round == 1) body.redo();
    index.follow(body.mesh(), body.journal());
    expect_finds_all(body.mesh(), index, random);
  }
}

TEST(SurfaceIndex, follows_cuts_and_maintenance) {
  EngineOptions options;
  Result<Engine> engine = Engine::create(build(jittered_cube(5, 2)), options);
  ASSERT_TRUE(engine.ok());
  Random random(3);
  SurfaceIndex index;
  index.follow(engine->mesh(), engine->journal());
  for (const double x : {0.31, 0.52, 0.55}) {
    ASSERT_TRUE(engine->cut(plane(*engine, Vec3(1, 0.2, 0.1), x)).ok());
    index.follow(engine->mesh(), engine->journal());
    expect_finds_all(engine->mesh(), index, random);
  }
}

TEST(SurfaceIndex, is_as_fine_as_what_cuts_have_made) {
  Engine engine = make_engine(kuhn_cube(3));
  SurfaceIndex index;
  index.follow(engine.mesh(), engine.journal());
  Random random(6);
  for (unsigned cut = 0; cut < 60; ++cut) {
    ASSERT_TRUE(engine.cut(plane(engine, random.point(-1, 1).normalized(), 0.1 * random.real(-1, 1))).ok());
    index.follow(engine.mesh(), engine.journal());
  }
  const auto near_in = [&](const SurfaceIndex& grid) {
    std::size_t near = 0;
    grid.for_each_near(engine.mesh(), {Vec3::Constant(0.2), Vec3::Constant(0.2)}, [&](Side) { ++near; });
    return near;
  };
  std::size_t all = 0;
  for_each_boundary_side(engine.mesh(), [&](Side) { ++all; });
  EXPECT_GT(all, 5000U);
  SurfaceIndex anew;
  anew.follow(engine.mesh(), engine.journal());
  EXPECT_LT(near_in(index), 4 * near_in(anew));  // the cells of the uncut body would have nearly all
  expect_finds_all(engine.mesh(), index, random);
}

TEST(SurfaceIndex, finds_the_sides_along_a_long_triangle_without_asking_for_its_box) {
  const TetMesh mesh = build(kuhn_cube(12));
  SurfaceIndex index;
  index.follow(mesh, Journal());
  const std::array<Vec3, 3> triangle = {Vec3(-1, -1, 0.99), Vec3(2, 2, 0.99), Vec3(2, 2.05, 0.99)};
  std::set<Side> all, found;
  for_each_boundary_side(mesh, [&](Side side) { all.insert(side); });
  for_each_side_near(mesh, index, {triangle[0], triangle[1], triangle[2]}, [&](Side side) { found.insert(side); });
  for (const Side side : all) {  // those on the diagonal of the lid
    const auto v = mesh.vertices(side);
    const Vec3 middle = (mesh.rest(v[0]) + mesh.rest(v[1]) + mesh.rest(v[2])) / 3.0;
    const bool is_near = middle.z() > 0.999 && std::abs(middle.x() - middle.y()) < 0.03;
    EXPECT_TRUE(!is_near || found.count(side) == 1);
  }
  EXPECT_LT(found.size(), all.size() / 4);
}

TEST(SurfaceIndex, goes_back_and_forth_as_often_as_strokes_are_undone_and_made_again) {
  Random random(5);
  Engine engine = make_engine(jittered_cube(5, 4));
  SurfaceIndex index;
  index.follow(engine.mesh(), engine.journal());
  EXPECT_FALSE(index.has_walls());
  for (unsigned round = 0; round < 6; ++round) {
    const Vec3 normal = random.point(-1, 1).normalized();
    ASSERT_TRUE(
        engine.cut(plane_stroke(rest_bounds(engine.mesh()), normal, normal.dot(Vec3(0.5, 0.5, 0.5))).value()).ok());
    if (round % 2 == 0) index.follow(engine.mesh(), engine.journal());
    if (round == 3) continue;
    ASSERT_TRUE(engine.undo());
    index.follow(engine.mesh(), engine.journal());
    EXPECT_EQ(index.has_walls(), round > 3);
    expect_finds_all(engine.mesh(), index, random);
    if (round == 1) continue;
    ASSERT_TRUE(engine.redo());
    index.follow(engine.mesh(), engine.journal());
    EXPECT_TRUE(index.has_walls());
    expect_finds_all(engine.mesh(), index, random);
    ASSERT_TRUE(engine.undo());
  }
}

TEST(SurfaceIndex, walls_that_are_the_sheets_own_wait_until_they_are_let_go) {
  Random random(11);
  Engine engine = make_engine(kuhn_cube(4));
  SurfaceIndex index;
  index.follow(engine.mesh(), engine.journal());
  cut(engine, plane(engine, Vec3::UnitX(), 0.45));
  const TetMesh& mesh = engine.mesh();
  const auto is_wall = [&](Side side) { return mesh.link(side).tag() != 0; };
  index.follow(mesh, engine.journal(), is_wall);
  EXPECT_TRUE(index.has_walls());
  const Box all = rest_bounds(mesh);
  std::set<Side> skin, walls, waiting;
  for_each_boundary_side(mesh, [&](Side side) { (is_wall(side) ? walls : skin).insert(side); });
  ASSERT_FALSE(walls.empty());
  EXPECT_EQ(found_in(mesh, index, all), skin);
  std::size_t visits = 0;
  index.for_each_waiting(mesh, [&](Side side) {
    waiting.insert(side);
    ++visits;
  });
  EXPECT_EQ(waiting, walls);
  EXPECT_EQ(visits, walls.size());  // each once
  index.take_in(mesh, [](Side) { return false; });
  expect_finds_all(mesh, index, random);
  index.for_each_waiting(mesh, [](Side) { FAIL(); });
}

}  // namespace
}  // namespace incise::test::surface_index_test
