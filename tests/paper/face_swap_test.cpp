// SPDX-License-Identifier: Apache-2.0
// Figure 8: two tets or three, whichever are better by their worst.
#include "paper/face_swap.h"

#include "incise/mesh/quality_stats.h"
#include "paper/paper_quality.h"
#include "paper/paper_region.h"
#include "paper/paper_support.h"

namespace incise::test {
namespace {

MaintainStatistics swap_all(TetMesh& mesh) {
  std::vector<TetId> tets;
  mesh.for_each_tet([&](TetId tet) { tets.push_back(tet); });
  Transaction transaction(mesh, true);
  const MaintainStatistics done = paper::swap_faces(transaction, tets);
  transaction.commit();
  return done;
}

double worst(const TetMesh& mesh) {
  return measure_quality(mesh).lr_max;
}

/// Two tets on the triangle 0 1 2, with apexes at ±height.
TetSoup two_tets(double height) {
  return {{Vec3(1, 0, 0), Vec3(-0.5, 0.75, 0), Vec3(-0.5, -0.75, 0), Vec3(0, 0, height), Vec3(0, 0, -height)},
          {{0, 1, 2, 3}, {0, 2, 1, 4}},
          {}};
}
/// The same hull, filled with three tets around the line between the apexes.
TetSoup three_tets(double height) {
  TetSoup soup = two_tets(height);
  soup.tets = {{0, 1, 3, 4}, {1, 2, 3, 4}, {2, 0, 3, 4}};
  for (auto& tet : soup.tets) {
    const Vec3 &a = soup.points[tet[0]], &b = soup.points[tet[1]], &c = soup.points[tet[2]], &d = soup.points[tet[3]];
    if ((b - a).cross(c - a).dot(d - a) < 0) std::swap(tet[2], tet[3]);
  }
  return soup;
}

TEST(FaceSwap, turns_two_flat_tets_into_three) {
  TetMesh mesh = build(two_tets(0.3));
  const double volume = volume_of(mesh), before = worst(mesh), other = worst(build(three_tets(0.3)));
  ASSERT_LT(other, before);
  const MaintainStatistics done = swap_all(mesh);
  EXPECT_EQ(done.removed_faces, 1U);
  EXPECT_EQ(done.removed_edges, 0U);
  EXPECT_GE(done.work_units, 5U);
  EXPECT_EQ(mesh.tet_count(), 3U);
  EXPECT_DOUBLE_EQ(worst(mesh), other);
  expect_valid(mesh, volume);
  EXPECT_EQ(swap_all(mesh).removed_edges, 0U);
}

TEST(FaceSwap, turns_three_long_tets_into_two) {
  TetMesh mesh = build(three_tets(2.0));
  const double volume = volume_of(mesh), other = worst(build(two_tets(2.0)));
  ASSERT_LT(other, worst(mesh));
  const MaintainStatistics done = swap_all(mesh);
  EXPECT_EQ(done.removed_faces, 0U);
  EXPECT_EQ(done.removed_edges, 1U);
  EXPECT_EQ(mesh.tet_count(), 2U);
  EXPECT_DOUBLE_EQ(worst(mesh), other);
  expect_valid(mesh, volume);
}

TEST(FaceSwap, keeps_what_is_better_as_it_is) {
  for (const TetSoup& soup : {two_tets(2.0), three_tets(0.3)}) {
    TetMesh mesh = build(soup);
    const std::uint64_t hash = mesh.hash();
    const MaintainStatistics done = swap_all(mesh);
    EXPECT_EQ(done.removed_faces + done.removed_edges, 0U);
    EXPECT_EQ(mesh.hash(), hash);
  }
}

TEST(FaceSwap, does_not_touch_tets_whose_outer_faces_are_coplanar) {
  // The third configuration: the line between the apexes meets an edge of the face.
  TetMesh mesh = build({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0.5), Vec3(0.5, 0, 1), Vec3(0.5, 0, -1)},
                        {{0, 1, 2, 3}, {0, 2, 1, 4}},
                        {}});
  EXPECT_EQ(swap_all(mesh).removed_faces, 0U);
}

TEST(FaceSwap, leaves_boundaries_and_borders_between_regions) {
  TetSoup soup = two_tets(0.3);
  soup.regions = {1, 2};
  TetMesh mesh = build(std::move(soup));
  EXPECT_EQ(swap_all(mesh).removed_faces, 0U);
}

TEST(FaceSwap, beside_a_cut_keeps_volumes_and_walls) {
  TetMesh mesh = cut_as_paper(jittered_cube(6, 8), {{Vec3(0.3, 0.5, 0.9), 0.8}, {Vec3(1, 0.2, 0.1), 0.6}}).mesh;
  const double worst_before = worst(mesh), area = wall_area(mesh);
  const std::vector<double> volumes = piece_volumes(mesh);
  const MaintainStatistics done = swap_all(mesh);
  EXPECT_GT(done.removed_faces, 0U);
  EXPECT_GT(done.removed_edges, 0U);
  EXPECT_LE(worst(mesh), worst_before);
  EXPECT_NEAR(wall_area(mesh), area, 1e-12);
  expect_valid(mesh, 1.0);
  expect_pieces(mesh, volumes, 1e-13);
}

}  // namespace
}  // namespace incise::test
