// SPDX-License-Identifier: Apache-2.0
// Vertices that nothing tells apart but a hair's breadth.
#include "improve/close_merge.h"

#include <set>

#include "improve/maintainer_cases.h"

namespace incise::test::close_merge_test {
namespace {

/// Two walls that cross all over the body at a small angle: corners beside corners.
TetMesh nearly_parallel_cuts(std::uint64_t seed) {
  return cut_mesh(jittered_cube(4, seed), {{Vec3(1, 0.2, 0.1), 0.6}, {Vec3(1.002, 0.199, 0.1), 0.6}});
}

/// Merges at all tets that are worse than an L/r, and looks at each merge from all sides.
unsigned merge_all(TetMesh& mesh, double worst_lr) {
  unsigned merged = 0;
  CloseMerger merger;
  for (const TetId tet : tets_of(mesh)) {
    if (!mesh.is_live(tet) || ratio_of(mesh, tet) > kRegularLr / worst_lr) continue;
    const double volume = volume_of(mesh);
    double before = 1.0;
    for (const VertexId v : mesh.vertices(tet)) before = std::min(before, worst_ratio(mesh, star_of(mesh, v)));
    const std::uint64_t hash = mesh.hash();
    CareOf care(mesh);
    const bool is_done = merger.improve(care.care, tet);
    const std::vector<TetId> changed = care.changed;
    const Step step = care.commit();
    EXPECT_EQ(care.statistics.collapsed_edges, is_done ? 1U : 0U);
    if (!is_done) {
      EXPECT_EQ(mesh.hash(), hash) << "nothing happens without a merge";
      continue;
    }
    ++merged;
    EXPECT_EQ(step.died.size(), 1U);
    EXPECT_NEAR(volume_of(mesh), volume, 1e-12 * volume);
    EXPECT_GT(worst_ratio(mesh, changed), before);
    const std::set<TetId> known(changed.begin(), changed.end());
    for (const MovedVertex& moved : step.moved) {
      for (const TetId around : star_of(mesh, moved.id)) EXPECT_EQ(known.count(around), 1U) << "to be judged anew";
    }
  }
  return merged;
}

TEST(CloseMerge, takes_corners_of_nearly_parallel_walls_together) {
  unsigned merged = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    TetMesh mesh = nearly_parallel_cuts(seed);
    const double skin = boundary_area(mesh, 0);
    merged += merge_all(mesh, 60);
    EXPECT_NEAR(boundary_area(mesh, 0), skin, 1e-3 * skin);
    expect_valid(mesh, 1.0);
  }
  EXPECT_GT(merged, 10U);
}

TEST(CloseMerge, keeps_the_skin_of_a_round_body_and_its_volume) {
  TetMesh mesh = cut_mesh(ball(6), {{Vec3(0.3, 0.5, 0.9), 0.1}, {Vec3(0.301, 0.5, 0.9), 0.1}});
  const double volume = volume_of(mesh), skin = boundary_area(mesh, 0);
  EXPECT_GT(merge_all(mesh, 60), 0U);
  EXPECT_NEAR(boundary_area(mesh, 0), skin, 1e-3 * skin);
  expect_valid(mesh, volume);
}

TEST(CloseMerge, leaves_a_good_mesh_alone) {
  TetMesh mesh = build(kuhn_cube(3));
  EXPECT_EQ(merge_all(mesh, 0.0), 0U) << "no edge is short";
}

TEST(CloseMerge, leaves_borders_between_regions_alone) {
  TetSoup soup = kuhn_cube(2);
  for (const auto& tet : soup.tets) {
    soup.regions.push_back(soup.points[tet[0]].x() + soup.points[tet[3]].x() < 1 ? 1 : 2);
  }
  TetMesh mesh = build(std::move(soup));
  split_edge_at(mesh, Vec3(0.5, 0.5, 0.5), Vec3(0.5, 0.5, 0), 0.02);
  EXPECT_EQ(merge_all(mesh, 0.0), 0U);
  expect_valid(mesh, 1.0);
}

TEST(CloseMerge, does_nothing_to_tets_that_are_locked) {
  TetMesh mesh = nearly_parallel_cuts(1);
  CareOf care(mesh);
  const IsLocked all = [](TetId) { return true; };
  care.care.is_locked = &all;
  EXPECT_FALSE(CloseMerger().improve(care.care, worst_tet(mesh)));
  EXPECT_TRUE(care.commit().is_empty());
}

}  // namespace
}  // namespace incise::test::close_merge_test
