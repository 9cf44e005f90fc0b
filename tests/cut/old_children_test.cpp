// SPDX-License-Identifier: Apache-2.0
// What stood where, before a rebuild.
#include "cut/old_children.h"

#include <gtest/gtest.h>

#include "incise/mesh/shapes.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random.h"

namespace incise::test::old_children_test {
namespace {

/// A cube that is stretched and sheared.
struct Deformed {
  TetMesh mesh = build(jittered_cube(2, 1));
  OldChildren old;

  Deformed() {
    std::vector<Vec3> current;
    mesh.for_each_vertex([&](VertexId v) { current.push_back(place(mesh.rest(v))); });
    mesh.set_current(current);
    mesh.for_each_tet([&](TetId tet) { old.add(mesh, tet); });
  }
  static Vec3 place(const Vec3& p) { return {2 * p.x() + p.y(), p.y() - 0.3 * p.z(), p.z() + 5}; }
};

TEST(OldChildren, find_the_tet_that_holds_a_place) {
  const Deformed body;
  Random random(1);
  for (unsigned run = 0; run < 200; ++run) {
    const Vec3 rest = random.point(0.2, 0.8);
    EXPECT_GE(body.old.place_in(body.old.holding(rest, 0, body.old.size()), rest).inside, -1e-12);
  }
}

TEST(OldChildren, tell_where_the_body_stood) {
  const Deformed body;
  Random random(2);
  for (unsigned run = 0; run < 200; ++run) {
    const Vec3 rest = random.point(0.2, 0.8);
    const MaterialPlace place = body.old.place_in(body.old.holding(rest, 0, body.old.size()), rest);
    EXPECT_LT((place.current - Deformed::place(rest)).norm(), 1e-12);
  }
}

TEST(OldChildren, give_corners_back_bit_for_bit) {
  const Deformed body;
  for (std::uint32_t i = 0; i < body.old.size(); ++i) {
    for (const VertexId v : body.old.vertices(i)) {
      EXPECT_EQ(body.old.place_in(i, body.mesh.rest(v)).current, body.mesh.current(v));
    }
  }
}

TEST(OldChildren, flat_tets_hold_nothing) {
  TetMesh mesh = build(kuhn_cube(2));
  const TetId tet(0);
  const TetVertices corners = mesh.vertices(tet);
  Vec3 flat = mesh.rest(corners[0]);
  for (unsigned axis = 0; axis < 3; ++axis) {  // the face across the first corner lies in a plane of the grid
    const double at = mesh.rest(corners[1])[axis];
    if (mesh.rest(corners[2])[axis] == at && mesh.rest(corners[3])[axis] == at) flat[axis] = at;
  }
  ASSERT_NE(flat, mesh.rest(corners[0]));
  Transaction transaction(mesh);
  transaction.move(corners[0], flat, corners, {0, 0.5, 0.25, 0.25});
  for (const Vec3& place : {Vec3(0.3, 0.2, 0.1), Vec3(0.5, 0.5, 0.5), Vec3(0.25, 0.25, 0.25)}) {
    if (place == mesh.rest(corners[1]) || place == mesh.rest(corners[2]) || place == mesh.rest(corners[3])) continue;
    EXPECT_LT(place_in(mesh, tet, place).inside, -1e200);
  }
  OldChildren old;
  mesh.for_each_tet([&](TetId t) { old.add(mesh, t); });
  const Vec3 inside(0.8, 0.7, 0.6);
  EXPECT_GE(old.place_in(old.holding(inside, 0, old.size()), inside).inside, -1e-12);
}

TEST(OldChildren, at_rest_give_the_place_itself) {
  const TetMesh mesh = build(jittered_cube(2, 1));
  Random random(3);
  for (unsigned run = 0; run < 50; ++run) {
    const Vec3 rest = random.point(0, 1);
    EXPECT_EQ(place_in(mesh, TetId(3), rest).current, rest);
  }
}

TEST(OldChildren, stay_as_they_were_when_the_mesh_changes) {
  Deformed body;
  const Vec3 before = body.old.place_in(0, Vec3(0.1, 0.1, 0.1)).current;
  body.mesh.set_current(std::vector<Vec3>(body.mesh.vertex_slots(), Vec3(7, 7, 7)));
  EXPECT_EQ(body.old.place_in(0, Vec3(0.1, 0.1, 0.1)).current, before);
  EXPECT_EQ(place_in(body.mesh, TetId(0), Vec3(0.1, 0.1, 0.1)).current, Vec3(7, 7, 7));
}

}  // namespace
}  // namespace incise::test::old_children_test
