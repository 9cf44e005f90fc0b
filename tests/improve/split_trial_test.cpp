// SPDX-License-Identifier: Apache-2.0
// Splits for trial: what they make is mended as a whole, or taken back.
#include "improve/split_trial.h"

#include "improve/support.h"

namespace incise::test::split_trial_test {
namespace {

/// Tries the edges of a tet in turn; what does not help is rolled back. Returns the vertices put in.
std::vector<VertexId> try_edges(TetMesh& mesh, TetId tet) {
  SplitTrial trial;
  for (unsigned edge = 0; edge < kEdgeCorners.size(); ++edge) {
    CareOf care(mesh);
    if (!trial.improve(care.care, tet, edge)) continue;
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

TEST(SplitTrial, refines_along_an_edge_of_surfaces_that_must_stay) {
  TetMesh mesh = long_crease();
  const double volume = volume_of(mesh), before = ratio_of(mesh, TetId(0));
  ASSERT_FALSE(try_edges(mesh, TetId(0)).empty());
  EXPECT_GT(worst_ratio(mesh, tets_of(mesh)), 1.1 * before);
  expect_valid(mesh, volume);
}

TEST(SplitTrial, is_taken_back_where_it_does_not_help) {
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

TEST(SplitTrial, keeps_the_front_one_line_where_it_is_split) {
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
}  // namespace incise::test::split_trial_test
