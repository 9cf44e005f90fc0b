// SPDX-License-Identifier: Apache-2.0
// What maintenance asks of the body as it stands.
#include "improve/standing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"
#include "incise/mesh/verbs.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random.h"

namespace incise::test::standing_test {
namespace {

VertexId vertex_near(const TetMesh& mesh, const Vec3& place) {
  VertexId found;
  mesh.for_each_vertex([&](VertexId v) {
    if ((mesh.rest(v) - place).norm() < 1e-9) found = v;
  });
  return found;
}

/// A cube that stands as `stands` takes it.
template <class Stands>
TetMesh cube_that(Stands&& stands) {
  TetMesh mesh = build(kuhn_cube(2));
  std::vector<Vec3> positions(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { positions[v.value] = stands(mesh.rest(v)); });
  mesh.set_current(positions);
  return mesh;
}

TEST(Standing, every_tet_is_sound_at_rest_and_none_in_a_body_turned_inside_out) {
  const TetMesh rest = cube_that([](const Vec3& p) { return p; });
  const TetMesh turned = cube_that([](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); });
  rest.for_each_tet([&](TetId tet) {
    EXPECT_TRUE(is_sound_now(rest, rest.vertices(tet)));
    EXPECT_FALSE(is_sound_now(turned, turned.vertices(tet)));
  });
}

TEST(Standing, a_vertex_may_move_where_no_tet_turns_over_as_the_body_stands) {
  Random random(5);
  StarWalker walker;
  unsigned refused = 0;
  for (unsigned i = 0; i < 200; ++i) {
    TetMesh mesh = cube_that([&](const Vec3& p) { return Vec3(p + random.point(-0.2, 0.2)); });
    const VertexId v = vertex_near(mesh, {0.5, 0.5, 0.5});
    const std::vector<TetId> star = walker.star(mesh, v);
    const Vec3 place = mesh.rest(v) + random.point(-0.15, 0.15);
    const auto sound = [&] {
      std::vector<TetId> tets;
      for (const TetId tet : star) {
        if (is_sound_now(mesh, mesh.vertices(tet))) tets.push_back(tet);
      }
      std::sort(tets.begin(), tets.end());
      return tets;
    };
    const std::vector<TetId> before = sound();
    const bool may = may_move(mesh, v, place, star);
    Transaction transaction(mesh);
    apply(transaction, plan_move_vertex(mesh, v, place));
    const std::vector<TetId> after = sound();
    EXPECT_EQ(may, std::includes(after.begin(), after.end(), before.begin(), before.end()));
    refused += may ? 0U : 1U;
    transaction.rollback();
  }
  EXPECT_GT(refused, 10U);
  EXPECT_LT(refused, 190U);
}

TEST(Standing, a_material_point_goes_where_its_tet_has_gone) {
  StarWalker walker;
  const TetMesh mesh = cube_that([](const Vec3& p) { return Vec3(2 * p.x(), p.y() + p.z(), p.z() - 1); });
  const VertexId v = vertex_near(mesh, {0.5, 0.5, 0.5});
  const Vec3 place(0.6, 0.55, 0.45), expected(1.2, 1.0, -0.55);
  EXPECT_LT((current_at(mesh, locate(mesh, place, walker.star(mesh, v))) - expected).norm(), 1e-14);
}

}  // namespace
}  // namespace incise::test::standing_test
