// SPDX-License-Identifier: Apache-2.0
// The skin stays where it was, however often the mesh is cut and maintained.
#include "improve/original_skin.h"

#include <cstdio>

#include "improve/maintainer_cases.h"
#include "improve/skin_drift.h"
#include "support/random_strokes.h"

namespace incise::test {
namespace {

Stroke plane_through_ball(Random& random) {
  const Vec3 normal = random_direction(random);
  return *plane_stroke({Vec3(-1, -1, -1), Vec3(1, 1, 1)}, normal, normal.dot(0.35 * random.point(-1, 1)));
}

/// The greatest distances between the skin as it was and as it is, as shares of the edges that it had, both ways.
double greatest_drift(const Engine& engine, const Skin& was) {
  const Skin is(engine.mesh());
  const TriangleTree old_skin = was.tree();
  double greatest = shares_off(was, is.tree()).back();
  for (std::size_t i = 0; i < is.points.size(); ++i) {
    if (is.edge[i] == 0) continue;
    const TriangleTree::Hit near = old_skin.closest(is.points[i]);
    double edge = 0;
    for (const std::uint32_t v : was.faces[near.triangle]) edge += was.edge[v] / 3;
    greatest = std::max(greatest, std::sqrt(near.distance2) / edge);
  }
  return greatest;
}

TEST(SkinOfManyCuts, stays_where_it_was) {
  for (const std::uint32_t n : {10U, 16U}) {
    SCOPED_TRACE(n);
    Engine engine = maintaining_engine(ball(n), 0.2);
    const Skin was(engine.mesh());
    Random random(n);
    for (unsigned i = 0; i < 20; ++i) cut_and_maintain(engine, plane_through_ball(random));
    const double drift = greatest_drift(engine, was);
    const std::vector<double> by_new_edges = shares_off(Skin(engine.mesh()), was.tree());
    std::printf("ball of %u cells, 20 cuts: skin %.4f of the old edges off; of the new ones %.4f (99 %%), %.4f (all)\n",
                n, drift, by_new_edges[by_new_edges.size() * 99 / 100], by_new_edges.back());
    EXPECT_LE(drift, 0.04);
    EXPECT_LE(by_new_edges[by_new_edges.size() * 99 / 100], 0.05);
    EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
  }
}

TEST(SkinOfManyCuts, stays_where_it_was_with_strokes_undone_in_between) {
  Engine engine = maintaining_engine(ball(8), 0.2);
  const Skin was(engine.mesh());
  Random random(3);
  for (unsigned i = 0; i < 16; ++i) {
    cut_and_maintain(engine, plane_through_ball(random));
    if (i % 3 == 1) {
      EXPECT_TRUE(engine.undo());
    }
    if (i % 6 == 1) {
      EXPECT_TRUE(engine.redo());
    }
  }
  EXPECT_LE(greatest_drift(engine, was), 0.04);
  EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
}

TEST(SkinOfManyCuts, stays_where_it_was_where_steps_are_left_to_later_maintenance) {
  Engine engine = maintaining_engine(ball(8), 0.2, 0);
  const Skin was(engine.mesh());
  Random random(4);
  for (unsigned i = 0; i < 4; ++i) cut_and_maintain(engine, plane_through_ball(random));
  EXPECT_TRUE(engine.maintain().ok());
  EXPECT_TRUE(engine.undo());
  cut_and_maintain(engine, plane_through_ball(random));
  EXPECT_TRUE(engine.maintain().ok());
  EXPECT_TRUE(engine.improve().ok());
  EXPECT_TRUE(engine.maintain().ok());
  EXPECT_LE(greatest_drift(engine, was), 0.04);
}

TEST(OriginalSkin, is_noted_where_cuts_have_changed_the_mesh_alone) {
  Engine engine = make_engine(ball(10), 0.2);
  const TriangleTree was = Skin(engine.mesh()).tree();
  cut(engine, plane(engine, Vec3(0.3, 0.5, 0.9), 0.1));
  OriginalSkin skin;
  skin.follow(engine.mesh(), engine.journal());
  EXPECT_FALSE(skin.is_empty());
  std::size_t noted = 0, all = 0;
  engine.mesh().for_each_vertex([&](VertexId v) {
    if ((engine.mesh().shape_of(v) & shape::kSkin) == 0) return;
    const Vec3& p = engine.mesh().rest(v);
    const double distance2 = skin.distance2(p, 0.01);
    ++all;
    if (distance2 > 1) return;
    ++noted;
    EXPECT_NEAR(std::sqrt(distance2), std::sqrt(was.closest(p).distance2), 1e-12);
  });
  EXPECT_GT(noted, 50U);
  EXPECT_LT(noted, all / 2) << "only what the cut touched";
}

TEST(OriginalSkin, is_what_was_there_before_vertices_moved) {
  TetMesh mesh = build(ball(6));
  OriginalSkin skin;
  Journal journal;
  skin.follow(mesh, journal);
  const VertexId vertex = nearest_vertex(mesh, Vec3(0, 0, 1));
  const Vec3 place = mesh.rest(vertex);
  StarWalker walker;
  const TetId tet = walker.star(mesh, vertex).front();
  Transaction transaction(mesh);
  transaction.move(vertex, place - Vec3(0, 0, 0.05), mesh.vertices(tet), {0.25, 0.25, 0.25, 0.25});
  journal.append(transaction.commit());
  skin.follow(mesh, journal);
  EXPECT_EQ(skin.distance2(place, 0.01), 0.0);
  EXPECT_NEAR(std::sqrt(skin.distance2(mesh.rest(vertex), 0.1)), 0.05, 0.02);
  journal.undo(mesh);
  skin.rewind(journal.position());
  skin.follow(mesh, journal);
  EXPECT_EQ(skin.distance2(place, 0.01), 0.0);
}

TEST(OriginalSkin, lets_pieces_give_way_only_near_to_it) {
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  OriginalSkin skin;
  skin.follow(mesh, journal);
  const auto piece = [](double height) {
    const Vec3 a(0.5, 0.5, 1 + height), b(0.75, 0.5, 1), c(0.5, 0.75, 1);
    return Piece{{{a, b, c}}, {a, 0.5 * (a + b)}};
  };
  EXPECT_TRUE(skin.keeps(piece(0), piece(1))) << "nothing is known yet";
  skin.note(mesh, tets_of(mesh));
  EXPECT_TRUE(skin.keeps(piece(0), piece(0.5 * kSkinTolerance * 0.25)));
  EXPECT_FALSE(skin.keeps(piece(0), piece(4 * kSkinTolerance)));
  EXPECT_TRUE(skin.keeps(piece(2 * kSkinTolerance * 0.25), piece(1.9 * kSkinTolerance * 0.25))) << "comes nearer";
  EXPECT_TRUE(skin.keeps_vertex(Vec3(0.5, 0.5, 1), Vec3(0.6, 0.6, 1), 0.5)) << "along the skin";
  EXPECT_FALSE(skin.keeps_vertex(Vec3(0.5, 0.5, 1), Vec3(0.5, 0.5, 1.1), 0.5));
}

}  // namespace
}  // namespace incise::test
