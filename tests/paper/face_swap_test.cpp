// SPDX-License-Identifier: Apache-2.0
// Figure 8: two tets or three, whichever are better by their worst.
#include "paper/face_swap.h"

#include <algorithm>

#include "incise/mesh/quality_stats.h"
#include "paper/paper_quality.h"
#include "paper/paper_region.h"
#include "paper/paper_support.h"

namespace incise::test::face_swap_test {
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

/// The third configuration: two tets (0 1 | 2 3 4) whose outer faces 0 1 3 and 0 1 4 lie in the plane z = 0. The line
/// 3 4 meets the edge 0 1; `reach` is how far 3 and 4 lie from it, half the edge's length 1, and 2 lies below.
TetSoup flat_pair(double reach) {
  return {{Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, -0.8), Vec3(0.1, -reach, 0), Vec3(0, reach, 0)},
          {{0, 1, 2, 4}, {1, 0, 2, 3}},
          {}};
}
/// The same with its mirror image above the plane: four tets around the edge 0 1.
TetSoup two_flat_pairs(double reach) {
  TetSoup soup = flat_pair(reach);
  soup.points.emplace_back(0, 0, 0.8);
  soup.tets.push_back({1, 0, 5, 4});
  soup.tets.push_back({0, 1, 5, 3});
  return soup;
}
TetSoup made_positive(TetSoup soup) {
  for (auto& tet : soup.tets) {
    const Vec3 &a = soup.points[tet[0]], &b = soup.points[tet[1]], &c = soup.points[tet[2]], &d = soup.points[tet[3]];
    if ((b - a).cross(c - a).dot(d - a) < 0) std::swap(tet[2], tet[3]);
  }
  return soup;
}

TEST(FaceSwap, turns_a_flat_pair_on_the_boundary) {
  TetMesh mesh = build(made_positive(flat_pair(0.2)));
  const double volume = volume_of(mesh), before = worst(mesh);
  const MaintainStatistics done = swap_all(mesh);
  EXPECT_EQ(done.removed_edges, 1U);
  EXPECT_EQ(done.removed_faces, 0U);
  EXPECT_EQ(mesh.tet_count(), 2U);
  EXPECT_LT(worst(mesh), before);
  mesh.for_each_tet([&](TetId tet) {  // both have the edge 3 4 now
    EXPECT_LT(mesh.corner_of(tet, VertexId(3)), 4U);
    EXPECT_LT(mesh.corner_of(tet, VertexId(4)), 4U);
  });
  expect_valid(mesh, volume);
}

TEST(FaceSwap, turns_two_flat_pairs_inside_four_into_four) {
  TetMesh mesh = build(made_positive(two_flat_pairs(0.2)));
  const double volume = volume_of(mesh), before = worst(mesh);
  EXPECT_EQ(swap_all(mesh).removed_edges, 1U);
  EXPECT_EQ(mesh.tet_count(), 4U);
  EXPECT_LT(worst(mesh), before);
  expect_valid(mesh, volume);
}

TEST(FaceSwap, leaves_a_flat_pair_that_is_better_as_it_is_or_not_flat_or_of_two_surfaces) {
  TetSoup bent = flat_pair(0.2);
  bent.points[3].z() = -0.01;
  TetSoup cut = flat_pair(0.2);
  cut.walls.push_back({{0, 1, 3}, 1});
  for (const TetSoup& soup : {flat_pair(2.0), bent, cut}) {
    TetMesh mesh = build(made_positive(soup));
    const std::uint64_t hash = mesh.hash();
    EXPECT_EQ(swap_all(mesh).removed_edges, 0U);
    EXPECT_EQ(mesh.hash(), hash);
  }
}

TEST(FaceSwap, leaves_no_flat_pair_that_would_get_better_where_planes_cross) {
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(1, 0.1, 0), 0.5}, {Vec3(0, 1, 0.1), 0.52}, {Vec3(0.1, 0, 1), 0.54}});
  const std::vector<double> volumes = piece_volumes(body.mesh);
  const double area = wall_area(body.mesh), worst_before = worst(body.mesh);
  unsigned rounds = 0;
  std::uint64_t turned = 0;
  for (std::uint64_t more = 1; more > 0 && rounds < 20; ++rounds) {
    const MaintainStatistics done = swap_all(body.mesh);
    more = done.removed_edges + done.removed_faces;
    turned += done.removed_edges;
  }
  EXPECT_LT(rounds, 20U);
  EXPECT_GT(turned, 100U);
  EXPECT_LE(worst(body.mesh), worst_before);
  EXPECT_NEAR(wall_area(body.mesh), area, 1e-9);
  expect_valid(body.mesh, 1.0);
  expect_pieces(body.mesh, volumes, 1e-12);
}

TEST(FaceSwap, is_judged_by_the_worst_tet_and_not_by_the_average) {
  Random random(4);
  unsigned swapped = 0, average_alone = 0;
  for (unsigned i = 0; i < 2000; ++i) {
    TetSoup soup = two_tets(random.real(0.1, 1.5));
    for (Vec3& p : soup.points) p += random.point(-0.3, 0.3);
    const auto is_positive = [&](const TetSoup& of) {
      return std::all_of(of.tets.begin(), of.tets.end(), [&](const auto& t) {
        const Vec3 &a = of.points[t[0]], &b = of.points[t[1]], &c = of.points[t[2]], &d = of.points[t[3]];
        return (b - a).cross(c - a).dot(d - a) > 0;
      });
    };
    TetSoup other = soup;
    other.tets = made_positive(three_tets(1)).tets;
    if (!is_positive(soup) || !is_positive(other)) continue;
    TetMesh mesh = build(soup);
    const QualityStats before = measure_quality(mesh), after = measure_quality(build(other));
    swap_all(mesh);
    EXPECT_EQ(mesh.tet_count(), after.lr_max < before.lr_max ? 3U : 2U);
    swapped += mesh.tet_count() == 3 ? 1U : 0U;
    average_alone += after.lr_mean < before.lr_mean && !(after.lr_max < before.lr_max) ? 1U : 0U;
  }
  EXPECT_GT(swapped, 20U);
  EXPECT_GT(average_alone, 5U);
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
}  // namespace incise::test::face_swap_test
