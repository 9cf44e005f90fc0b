// SPDX-License-Identifier: Apache-2.0
// The index of the body's surface, against a search of all boundary sides.
#include "cut/surface_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cut/flagged_body.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test {
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

void expect_finds_all(const TetMesh& mesh, const SurfaceIndex& index, Random& random) {
  for (unsigned run = 0; run < 100; ++run) {
    const Box box = random_box(random);
    EXPECT_EQ(found_in(mesh, index, box), sides_in(mesh, box));
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

}  // namespace
}  // namespace incise::test
