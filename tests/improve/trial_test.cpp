// SPDX-License-Identifier: Apache-2.0
// Splits and merges for trial: what they make is mended as a whole, or taken back.
#include "improve/trial.h"

#include "improve/support.h"

namespace incise::test::trial_test {
namespace {

/// Tries the edges of a tet in turn; what does not help is rolled back. Returns the vertices put in.
std::vector<VertexId> try_edges(TetMesh& mesh, TetId tet) {
  Trial trial;
  for (unsigned edge = 0; edge < kEdgeCorners.size(); ++edge) {
    CareOf care(mesh);
    if (!trial.split(care.care, tet, edge)) continue;
    for (const TetId t : care.changed) EXPECT_TRUE(mesh.is_live(t));
    EXPECT_GE(care.statistics.inserted_vertices, 1U);
    care.commit();
    return trial.born();
  }
  return {};
}

/// A tet that is long along one crease: every other operation keeps creases as they are.
TetMesh long_crease() {
  return build({{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(1.5, 0.3, 0), Vec3(1.5, 0.1, 0.3)}, {{0, 1, 2, 3}}, {}});
}

TEST(Trial, refines_along_an_edge_of_surfaces_that_must_stay) {
  TetMesh mesh = long_crease();
  const double volume = volume_of(mesh), before = ratio_of(mesh, TetId(0));
  ASSERT_FALSE(try_edges(mesh, TetId(0)).empty());
  EXPECT_GT(worst_ratio(mesh, tets_of(mesh)), 1.1 * before);
  expect_valid(mesh, volume);
}

TEST(Trial, is_taken_back_where_it_does_not_help) {
  TetMesh mesh = build(kuhn_cube(2));
  const std::uint64_t hash = mesh.hash();
  for (const TetId tet : tets_of(mesh)) {
    EXPECT_TRUE(try_edges(mesh, tet).empty());
    ASSERT_EQ(mesh.hash(), hash);
  }
  expect_valid(mesh, 1.0);
}

std::size_t front_vertices(const TetMesh& mesh) {
  std::size_t count = 0;
  mesh.for_each_vertex([&](VertexId v) { count += (mesh.shape_of(v) & shape::kFront) != 0 ? 1U : 0U; });
  return count;
}

/// Tries to merge along the edges of tets that are worse than an L/r, in a body whose first shape is `uncut`. Each
/// merge is looked at from all sides.
unsigned merge_for_trial(TetMesh& mesh, const TetMesh& uncut, double worst_lr) {
  unsigned merged = 0;
  Trial trial;
  for (const TetId tet : tets_of(mesh)) {
    for (unsigned i = 0; i < 2 * kEdgeCorners.size(); ++i) {
      if (!mesh.is_live(tet) || ratio_of(mesh, tet) > kRegularLr / worst_lr) break;
      const auto& ends = kEdgeCorners[i / 2];
      const TetVertices& v = mesh.vertices(tet);
      if ((mesh.rest(v[ends[0]]) - mesh.rest(v[ends[1]])).norm() > 0.05) continue;  // a fifth of an edge
      const double before = ratio_of(mesh, tet), volume = volume_of(mesh);
      const std::uint64_t hash = mesh.hash();
      CareOf care(mesh);
      care.references.set_original(uncut);
      const bool is_better = trial.merge(care.care, tet, i / 2, i % 2 != 0);
      if (!is_better) continue;  // rolled back
      EXPECT_GT(worst_ratio(mesh, care.changed), 1.1 * before);
      EXPECT_NEAR(volume_of(mesh), volume, 1e-12 * volume);
      EXPECT_NE(mesh.hash(), hash);
      care.commit();
      ++merged;
      break;
    }
  }
  return merged;
}

TEST(Trial, merges_what_walls_left_beside_each_other_and_gives_the_volume_back) {
  unsigned merged = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    const TetMesh uncut = build(jittered_cube(4, seed));
    TetMesh mesh = cut_mesh(jittered_cube(4, seed), {{Vec3(1, 0.2, 0.1), 0.6}, {Vec3(1.02, 0.19, 0.1), 0.6}});
    const double skin = boundary_area(mesh, 0);
    merged += merge_for_trial(mesh, uncut, 60);
    EXPECT_NEAR(boundary_area(mesh, 0), skin, 5e-3 * skin);
    expect_valid(mesh, 1.0);
  }
  EXPECT_GT(merged, 0U);
}

TEST(Trial, merges_nothing_where_tets_are_good_enough) {
  const TetMesh uncut = build(kuhn_cube(3));
  TetMesh mesh = cut_mesh(kuhn_cube(3), {{Vec3(1, 0.2, 0.1), 0.6}});
  const std::uint64_t hash = mesh.hash();
  Trial trial;
  for (const TetId tet : tets_of(mesh)) {
    if (ratio_of(mesh, tet) < kTriedHard) continue;
    for (unsigned edge = 0; edge < kEdgeCorners.size(); ++edge) {
      CareOf care(mesh);
      EXPECT_FALSE(trial.merge(care.care, tet, edge, false));
    }
  }
  EXPECT_EQ(mesh.hash(), hash);
}

TEST(Trial, keeps_the_front_one_line_where_it_is_split) {
  const Stroke stroke{
      "half",
      {0, 1},
      {{Vec3(-0.5, -0.5, 0.47), Vec3(-0.5, 1.5, 0.47)}, {Vec3(0.53, -0.5, 0.47), Vec3(0.53, 1.5, 0.47)}}};
  TetMesh mesh = cut_mesh(kuhn_cube(3), stroke);
  const std::size_t before = front_vertices(mesh);
  ASSERT_GT(before, 0U);
  const double volume = volume_of(mesh);
  std::size_t born_on_front = 0;
  for (const TetId tet : tets_of(mesh)) {
    if (!mesh.is_live(tet) || ratio_of(mesh, tet) > kRegularLr / 22.0) continue;
    for (const VertexId v : try_edges(mesh, tet)) {
      born_on_front += mesh.is_live(v) && (mesh.shape_of(v) & shape::kFront) != 0 ? 1U : 0U;
    }
  }
  EXPECT_EQ(front_vertices(mesh), before + born_on_front);
  expect_valid(mesh, volume);
}

}  // namespace
}  // namespace incise::test::trial_test
