// SPDX-License-Identifier: Apache-2.0
// Algorithm 3: the average decides.
#include "paper/smart_laplacian.h"

#include <algorithm>
#include <map>
#include <set>

#include "incise/geom/quality.h"
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

/// What Algorithm 3 asks of one vertex, told from the corners of all tets alone.
struct Question {
  bool is_inside = true;  ///< the vertex lies on no face of a single tet
  Vec3 centre = Vec3::Zero();
  double before = 0, after = 0;  ///< the average of the tets around it, here and at the centre
};

Question ask(const TetMesh& mesh, VertexId v) {
  Question question;
  std::map<std::set<VertexId>, unsigned> faces;
  std::set<VertexId> neighbours;
  std::vector<TetId> star;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& corners = mesh.vertices(tet);
    if (std::find(corners.begin(), corners.end(), v) == corners.end()) return;
    star.push_back(tet);
    for (const VertexId left_out : corners) {
      std::set<VertexId> face(corners.begin(), corners.end());
      if (left_out != v) face.erase(left_out), ++faces[face];
    }
    neighbours.insert(corners.begin(), corners.end());
  });
  neighbours.erase(v);
  for (const auto& [face, tets] : faces) question.is_inside = question.is_inside && tets == 2;
  for (const VertexId other : neighbours) question.centre += mesh.rest(other) / static_cast<double>(neighbours.size());
  for (const TetId tet : star) {
    std::array<Vec3, 4> here, there;
    for (unsigned c = 0; c < 4; ++c) {
      here[c] = mesh.rest(mesh.vertices(tet)[c]);
      there[c] = mesh.vertices(tet)[c] == v ? question.centre : here[c];
    }
    const auto share = 1.0 / static_cast<double>(star.size());
    question.before += share * longest_edge_over_inradius(here[0], here[1], here[2], here[3]);
    question.after += share * longest_edge_over_inradius(there[0], there[1], there[2], there[3]);
  }
  return question;
}

/// "The Smart Laplacian Smoothing relocates the grid point only if the relocation improves the local mesh quality", and
/// by Algorithm 3, line 6, always then.
TEST(SmartLaplacian, moves_every_vertex_that_is_better_at_the_centre_of_its_neighbours) {
  unsigned moved = 0, kept = 0;
  for (const std::uint64_t seed : {5U, 6U}) {
    TetMesh mesh = cut_as_paper(jittered_cube(5, seed), {{Vec3(0.3, 0.5, 0.9), 0.8}}).mesh;
    for (const VertexId v : paper::find_all_vertices(mesh)) {
      SCOPED_TRACE(v.value);
      const Question question = ask(mesh, v);
      if (std::abs(question.after - question.before) < 1e-9 * question.before) continue;  // rounding decides
      const bool must_move = question.is_inside && question.after < question.before;
      const Vec3 place = must_move ? question.centre : Vec3(mesh.rest(v));
      EXPECT_EQ(smooth(mesh, v), must_move ? 1U : 0U);
      EXPECT_LT((mesh.rest(v) - place).norm(), 1e-15);
      moved += must_move ? 1U : 0U;
      kept += question.is_inside && !must_move ? 1U : 0U;
    }
    expect_valid(mesh, 1.0);
  }
  EXPECT_GT(moved, 100U);
  EXPECT_GT(kept, 20U);
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
