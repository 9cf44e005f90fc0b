// SPDX-License-Identifier: Apache-2.0
// The skin stays where it was, however often the mesh is cut and maintained.
#include "improve/original_skin.h"

#include <cstdio>

#include "improve/maintainer_cases.h"
#include "improve/skin_drift.h"
#include "support/random_strokes.h"

namespace incise::test::original_skin_test {
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
    EXPECT_LE(by_new_edges[by_new_edges.size() * 99 / 100], 0.045);
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

TEST(OriginalSkin, is_the_surface_of_the_mesh_that_was_measured) {
  TetMesh mesh = build(ball(6));
  const TriangleTree was = Skin(mesh).tree();
  OriginalSkin skin;
  EXPECT_TRUE(skin.is_empty());
  skin.measure(mesh);
  EXPECT_FALSE(skin.is_empty());
  Random random(7);
  for (unsigned i = 0; i < 200; ++i) {
    const Vec3 p = random.point(-1.1, 1.1);
    EXPECT_EQ(skin.distance2(p, 10.0), was.closest(p).distance2);
  }
  EXPECT_GT(skin.distance2(Vec3(3, 0, 0), 1.0), 1e300) << "beyond the greatest distance asked for";
}

TEST(OriginalSkin, has_no_walls_of_older_cuts) {
  Engine engine = make_engine(ball(6), 0.2);
  cut(engine, plane(engine, Vec3(0, 0, 1), 0.0));
  OriginalSkin skin;
  skin.measure(engine.mesh());
  EXPECT_GT(skin.distance2(Vec3(0, 0, 0), 10.0), 0.5);
}

TEST(OriginalSkin, lets_nothing_that_was_cut_and_undone_change_what_comes_after) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    const std::array<Stroke, 3> strokes = {plane_through_ball(random), plane_through_ball(random),
                                           plane_through_ball(random)};
    Engine fresh = maintaining_engine(ball(6), 0.2);
    Engine used = maintaining_engine(ball(6), 0.2);
    cut_and_maintain(used, strokes[0]);
    while (used.undo()) {
    }
    for (Engine* engine : {&fresh, &used}) {
      cut_and_maintain(*engine, strokes[1]);
      cut_and_maintain(*engine, strokes[2]);
    }
    EXPECT_EQ(fresh.mesh().hash(), used.mesh().hash()) << seed;
  }
}

TEST(OriginalSkin, lets_pieces_give_way_only_near_to_it) {
  OriginalSkin skin;
  const auto piece = [](double height) {
    const Vec3 a(0.5, 0.5, 1 + height), b(0.75, 0.5, 1), c(0.5, 0.75, 1);
    return Piece{{{a, b, c}}, {a, 0.5 * (a + b)}};
  };
  EXPECT_TRUE(skin.keeps(piece(0), piece(1))) << "nothing is known yet";
  skin.measure(build(kuhn_cube(2)));
  EXPECT_TRUE(skin.keeps(piece(0), piece(0.5 * kSkinTolerance * 0.25)));
  EXPECT_FALSE(skin.keeps(piece(0), piece(4 * kSkinTolerance)));
  EXPECT_TRUE(skin.keeps(piece(2 * kSkinTolerance * 0.25), piece(1.9 * kSkinTolerance * 0.25))) << "comes nearer";
  EXPECT_TRUE(skin.keeps_vertex(Vec3(0.5, 0.5, 1), Vec3(0.6, 0.6, 1), 0.5)) << "along the skin";
  EXPECT_FALSE(skin.keeps_vertex(Vec3(0.5, 0.5, 1), Vec3(0.5, 0.5, 1.1), 0.5));
}

}  // namespace
}  // namespace incise::test::original_skin_test
