// SPDX-License-Identifier: Apache-2.0
// Algorithm 3: the average decides.
#include "paper/smart_laplacian.h"

#include <algorithm>

#include "incise/mesh/star.h"
#include "paper/paper_quality.h"
#include "paper/paper_region.h"
#include "paper/paper_support.h"

namespace incise::test::smart_laplacian_test {
namespace {

struct StarQuality {
  double average = 0, worst = 0;
};

StarQuality quality_around(const TetMesh& mesh, VertexId v) {
  StarQuality quality;
  paper::QualityMeter meter(mesh);
  StarWalker walker;
  const std::vector<TetId>& star = walker.star(mesh, v);
  for (const TetId tet : star) {
    quality.average += meter.of(tet) / static_cast<double>(star.size());
    quality.worst = std::max(quality.worst, meter.of(tet));
  }
  return quality;
}

std::uint64_t smooth(TetMesh& mesh, VertexId v) {
  Transaction transaction(mesh, true);
  const std::uint64_t moved = paper::smooth_inside(transaction, {v}).moved_vertices;
  transaction.commit();
  return moved;
}

TEST(SmartLaplacian, brings_a_vertex_back_to_the_middle_of_its_neighbours) {
  TetSoup soup = kuhn_cube(2);
  soup.points[13] = Vec3(0.6, 0.45, 0.58);
  TetMesh mesh = build(std::move(soup));
  EXPECT_EQ(smooth(mesh, VertexId(13)), 1U);
  EXPECT_LT((mesh.rest(VertexId(13)) - Vec3(0.5, 0.5, 0.5)).norm(), 1e-15);
  EXPECT_EQ(smooth(mesh, VertexId(13)), 0U);
  expect_valid(mesh, 1.0);
}

TEST(SmartLaplacian, moves_exactly_where_the_average_gets_better_even_if_a_tet_gets_worse) {
  TetMesh mesh = cut_as_paper(jittered_cube(6, 5), {{Vec3(0.3, 0.5, 0.9), 0.8}}).mesh;
  unsigned moved = 0, kept = 0, worse = 0;
  for (const VertexId v : paper::find_all_vertices(mesh)) {
    const StarQuality before = quality_around(mesh, v);
    const Vec3 place = mesh.rest(v);
    const bool has_moved = smooth(mesh, v) == 1;
    const StarQuality after = quality_around(mesh, v);
    ASSERT_EQ(has_moved, mesh.rest(v) != place);
    EXPECT_TRUE(!has_moved || after.average < before.average);
    moved += has_moved ? 1U : 0U;
    kept += has_moved ? 0U : 1U;
    worse += has_moved && after.worst > before.worst ? 1U : 0U;
  }
  EXPECT_GT(moved, 10U);
  EXPECT_GT(kept, 10U);
  EXPECT_GT(worse, 0U);
  expect_valid(mesh, 1.0);
}

TEST(SmartLaplacian, leaves_boundaries_and_borders_between_regions) {
  TetSoup soup = jittered_cube(4, 6);
  for (const auto& tet : soup.tets) {
    const Vec3 centre = (soup.points[tet[0]] + soup.points[tet[1]] + soup.points[tet[2]] + soup.points[tet[3]]) / 4;
    soup.regions.push_back(centre.z() < 0.5 ? 1 : 2);
  }
  TetMesh mesh = build(std::move(soup));
  StarWalker walker;
  for (const VertexId v : paper::find_all_vertices(mesh)) {
    const std::vector<TetId> star = walker.star(mesh, v);
    const bool is_border =
        std::any_of(star.begin(), star.end(), [&](TetId t) { return mesh.region(t) != mesh.region(star.front()); });
    if (is_border || mesh.shape_of(v) != 0) {
      EXPECT_EQ(smooth(mesh, v), 0U);
    }
  }
}

}  // namespace
}  // namespace incise::test::smart_laplacian_test
