// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/step_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "incise/engine/engine.h"
#include "mesh/random_step.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::step_check_test {
namespace {

/// What the check says of one step that `edit` makes.
Status check_after(TetMesh& mesh, const std::function<void(Transaction&)>& edit) {
  Journal journal;
  Transaction transaction(mesh);
  edit(transaction);
  journal.append(transaction.commit());
  return TouchedCheck()(mesh, journal, 0);
}

void expect_broken(const Status& status, const std::string& kind) {
  ASSERT_FALSE(status.ok()) << kind;
  EXPECT_EQ(status.error().code, ErrorCode::kInternal);
  EXPECT_NE(status.error().message.find(kind), std::string::npos) << status.error().message;
}

/// A side with a neighbour.
Side inner_side(const TetMesh& mesh) {
  Side found;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) found = Side(tet, s);
    }
  });
  return found;
}

TEST(TouchedCheck, is_what_engines_ask_by_default_in_builds_with_assertions) {
#ifdef NDEBUG
  EXPECT_FALSE(static_cast<bool>(default_step_check()));
#else
  ASSERT_TRUE(static_cast<bool>(default_step_check()));
  TetMesh mesh = build(kuhn_cube(1));
  Journal journal;
  EXPECT_TRUE(default_step_check()(mesh, journal, 0).ok());
#endif
}

TEST(TouchedCheck, passes_what_verbs_make) {
  Random random(1);
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  TouchedCheck check;
  for (unsigned i = 0; i < 20; ++i) {
    journal.append(random_step(mesh, random));
    EXPECT_TRUE(check(mesh, journal, i).ok());
  }
  EXPECT_TRUE(check(mesh, journal, 0).ok());
  expect_valid(mesh, 1.0);
}

TEST(TouchedCheck, passes_every_step_of_cuts_and_maintenance) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    EngineOptions options;
    options.cut.profile = profile;
    std::size_t calls = 0;
    options.check_step = [&calls, check = TouchedCheck()](const TetMesh& mesh, const Journal& journal,
                                                          std::size_t first) mutable {
      ++calls;
      return check(mesh, journal, first);
    };
    Engine engine = Engine::create(build(kuhn_cube(4)), options).value();
    ASSERT_TRUE(engine.begin_stroke({{Vec3(-0.1, -0.1, 1.2), Vec3(0.6, 0.7, 1.2)}}).ok());
    for (unsigned i = 1; i <= 10; ++i) {
      const double z = 1.2 - 0.09 * i;
      ASSERT_TRUE(engine.step({{Vec3(-0.1, -0.1, z), Vec3(0.6, 0.7, z)}}).ok());
    }
    ASSERT_TRUE(engine.end_stroke().ok());
    ASSERT_TRUE(engine.cut(*plane_stroke({Vec3(0, 0, 0), Vec3(1, 1, 1)}, Vec3(0.2, 1, 0.1), 0.6)).ok());
    ASSERT_TRUE(engine.improve().ok());
    EXPECT_GE(calls, 4U);
    expect_valid(engine.mesh(), 1.0, profile == Profile::kPaper ? 1e-2 : 1e-9);
  }
}

TEST(TouchedCheck, finds_a_link_that_is_not_returned) {
  TetMesh mesh = build(kuhn_cube(2));
  expect_broken(check_after(mesh,
                            [&](Transaction& t) {
                              const Side side = inner_side(mesh), other = mesh.link(side).side();
                              t.set_link(side, Link(Side(other.tet(), (other.side() + 1) % 4)));
                            }),
                "bad_link");
}

TEST(TouchedCheck, finds_a_tet_that_is_gone_from_its_neighbours) {
  TetMesh mesh = build(kuhn_cube(2));
  expect_broken(check_after(mesh, [&](Transaction& t) { t.remove_tet(inner_side(mesh).tet()); }), "bad_link");
}

TEST(TouchedCheck, finds_a_face_that_was_opened_without_vertices_of_its_own) {
  TetMesh mesh = build(kuhn_cube(2));
  expect_broken(check_after(mesh,
                            [&](Transaction& t) {
                              const Side side = inner_side(mesh);
                              t.open(side, mesh.link(side).side(), 1);
                            }),
                "unseparated_face");
}

TEST(TouchedCheck, finds_tets_turned_over_by_a_vertex_that_moved) {
  TetMesh mesh = build(kuhn_cube(2));
  expect_broken(check_after(mesh,
                            [&](Transaction& t) {
                              t.move(VertexId(0), Vec3(2, 2, 2), mesh.vertices(mesh.tet_of(VertexId(0))), {1, 0, 0, 0});
                            }),
                "not_positive");
}

TEST(TouchedCheck, finds_vertices_without_tets) {
  TetMesh mesh = build(kuhn_cube(1));
  expect_broken(check_after(mesh, [](Transaction& t) { t.add_vertex_on_edge(VertexId(0), VertexId(7), 0.5); }),
                "orphan_vertex");
}

TEST(TouchedCheck, finds_a_vertex_that_names_a_tet_without_it) {
  TetMesh mesh = build(kuhn_cube(2));
  TetId far;
  mesh.for_each_tet([&](TetId tet) { far = mesh.corner_of(tet, VertexId(0)) == 4 ? tet : far; });
  expect_broken(check_after(mesh, [&](Transaction& t) { t.set_tet_of(VertexId(0), far); }), "bad_tet_of");
}

TEST(TouchedCheck, asks_nothing_of_what_no_step_touched) {
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  Transaction broken(mesh);
  broken.set_link(inner_side(mesh), Link::boundary(0));
  journal.append(broken.commit());
  EXPECT_FALSE(TouchedCheck()(mesh, journal, 0).ok());
  EXPECT_TRUE(TouchedCheck()(mesh, journal, 1).ok());
}

}  // namespace
}  // namespace incise::test::step_check_test
