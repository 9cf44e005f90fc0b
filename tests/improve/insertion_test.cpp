// SPDX-License-Identifier: Apache-2.0
// Vertices put in where nothing else helps: inside, and on the edges of surfaces.
#include "improve/insertion.h"

#include "improve/support.h"

namespace incise::test::insertion_test {
namespace {

/// One insertion around the worst tet; returns the vertex, invalid where none was put in.
VertexId insert_at(TetMesh& mesh, TetId tet) {
  CareOf care(mesh);
  const bool is_done = VertexInserter().improve(care.care, tet);
  const Step step = care.commit();
  EXPECT_EQ(care.statistics.inserted_vertices, is_done ? 1U : 0U);
  if (!is_done) return {};
  EXPECT_EQ(step.edits.size(), 1U);
  EXPECT_EQ(step.born.size(), 1U);
  for (const TetId t : care.changed) EXPECT_LT(mesh.corner_of(t, step.born[0].id), 4U);
  return step.born[0].id;
}

/// A regular tet that a vertex right beside one of its faces splits into four.
TetMesh badly_split_tet() {
  TetMesh mesh = build({{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}, {{0, 1, 3, 2}}, {}});
  Transaction transaction(mesh);
  apply(transaction, plan_split_tet(mesh, TetId(0), {0.01, 0.33, 0.33, 0.33}));
  transaction.commit();
  return mesh;
}

TEST(Insertion, replaces_a_vertex_that_its_cavity_encloses) {
  TetMesh mesh = badly_split_tet();
  const double volume = volume_of(mesh), before = worst_ratio(mesh, tets_of(mesh));
  const VertexId old = nearest_vertex(mesh, Vec3(-0.3, -0.3, -0.3));
  ASSERT_EQ(star_of(mesh, old).size(), 4U);
  const VertexId born = insert_at(mesh, tets_of(mesh).back());
  ASSERT_TRUE(born.is_valid());
  EXPECT_EQ(mesh.vertex_count(), 5U);
  EXPECT_EQ(mesh.tet_count(), 4U);
  EXPECT_EQ(mesh.shape_of(born), 0);
  EXPECT_LT(mesh.rest(born).norm(), 0.1);
  EXPECT_GT(worst_ratio(mesh, tets_of(mesh)), 5 * before);
  expect_valid(mesh, volume);
}

TEST(Insertion, leaves_a_good_mesh_alone) {
  TetMesh mesh = build(kuhn_cube(2));
  const std::uint64_t hash = mesh.hash();
  for (const TetId tet : tets_of(mesh)) EXPECT_FALSE(insert_at(mesh, tet).is_valid());
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

/// Puts vertices in around all bad tets; checks each.
struct Tally {
  unsigned inside = 0, on_skin = 0, on_wall = 0;
};
Tally insert_everywhere(TetMesh& mesh, double below) {
  Tally tally;
  const double volume = volume_of(mesh);
  for (const TetId tet : tets_of(mesh)) {
    if (!mesh.is_live(tet) || !(ratio_of(mesh, tet) < below)) continue;
    const std::size_t vertices = mesh.vertex_count();
    const TetMesh old = mesh;
    CareOf care(mesh);
    const bool is_done = VertexInserter().improve(care.care, tet);
    const Step step = care.commit();
    if (!is_done) continue;
    double before = 1;
    for (const ConsumedTet& gone : step.edit_consumed) before = std::min(before, ratio_of(old, gone.id));
    EXPECT_GT(worst_ratio(mesh, care.changed), before);
    EXPECT_EQ(mesh.vertex_count(), vertices + 1 - step.died.size());
    const std::uint8_t bits = mesh.shape_of(step.born[0].id);
    ++(bits == 0 ? tally.inside : bits == shape::kSkin ? tally.on_skin : tally.on_wall);
    EXPECT_TRUE(bits == 0 || bits == shape::kSkin || bits == shape::kWall);
    expect_valid(mesh, volume);
  }
  return tally;
}

TEST(Insertion, beside_plane_cuts_keeps_tags_areas_and_volumes) {
  TetMesh mesh = cut_mesh(jittered_cube(4, 5), {{Vec3(1, 0.2, 0.1), 0.6}, {Vec3(0.1, 1, 0.2), 0.6}});
  const std::array<double, 3> areas = {boundary_area(mesh, 0), boundary_area(mesh, 1), boundary_area(mesh, 2)};
  const std::vector<double> volumes = piece_volumes(mesh);
  const Tally tally = insert_everywhere(mesh, 0.25);
  EXPECT_GT(tally.inside, 0U);
  EXPECT_GT(tally.on_skin, 0U);
  EXPECT_GT(tally.on_wall, 0U);
  for (std::uint32_t tag = 0; tag < 3; ++tag) EXPECT_NEAR(boundary_area(mesh, tag), areas[tag], 1e-12);
  expect_pieces(mesh, volumes, 1e-13);
  expect_valid(mesh, 1.0);
}

TEST(Insertion, on_curved_skin_and_walls_keeps_the_volume_of_every_piece) {
  TetMesh mesh = cut_mesh(ball(6), {{Vec3(0.3, 0.5, 0.9), 0.1}});
  const std::vector<double> volumes = piece_volumes(mesh);
  const Tally tally = insert_everywhere(mesh, 0.25);
  EXPECT_GT(tally.on_skin, 0U);
  expect_pieces(mesh, volumes, 1e-12);
  expect_valid(mesh, volume_of(mesh));
}

TEST(Insertion, leaves_borders_between_regions) {
  TetSoup soup = kuhn_box(Vec3(0, 0, 0), Vec3(8, 1, 1), {2, 1, 1});
  for (std::size_t i = 0; i < soup.tets.size(); ++i) soup.regions.push_back(i < 6 ? 1 : 2);
  TetMesh mesh = build(std::move(soup));
  insert_everywhere(mesh, 0.5);
  double first = 0;
  mesh.for_each_tet([&](TetId tet) { first += mesh.region(tet) == 1 ? mesh.rest_volume(tet) : 0.0; });
  EXPECT_NEAR(first, 4.0, 1e-12);
  expect_valid(mesh, 8.0);
}

}  // namespace
}  // namespace incise::test::insertion_test
