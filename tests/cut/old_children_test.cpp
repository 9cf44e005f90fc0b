// SPDX-License-Identifier: Apache-2.0
// What stood where, before a rebuild.
#include "cut/old_children.h"

#include <gtest/gtest.h>

#include "incise/mesh/shapes.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random.h"

namespace incise::test {
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
}  // namespace incise::test
