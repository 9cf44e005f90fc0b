// SPDX-License-Identifier: Apache-2.0
// Swapping edges and faces away: the best triangulation of a ring, flat boundaries, and fronts.
#include "improve/edge_removal.h"

#include <vector>

#include "improve/maintainer_cases.h"
#include "incise/geom/quality.h"
#include "support/campaign.h"
#include "support/random_strokes.h"

namespace incise::test::edge_removal_test {
namespace {

/// The tets around the edge from (0, 0, -1) to (0, 0, 1), vertices 0 and 1; the others follow in order.
TetSoup ring_soup(const std::vector<Vec3>& around, bool is_closed) {
  TetSoup soup;
  soup.points = {Vec3(0, 0, -1), Vec3(0, 0, 1)};
  soup.points.insert(soup.points.end(), around.begin(), around.end());
  const auto n = static_cast<std::uint32_t>(around.size());
  for (std::uint32_t i = 0; i + (is_closed ? 0 : 1) < n; ++i) soup.tets.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
  return soup;
}

/// A bumpy ring of n vertices.
std::vector<Vec3> random_ring(Random& random, std::uint32_t n) {
  std::vector<Vec3> around;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto [x, y] = on_circle((i + random.real(-0.2, 0.2)) / n);
    const double radius = random.real(0.3, 0.8);
    around.emplace_back(radius * x, radius * y, random.real(-0.3, 0.3));
  }
  return around;
}

/// A fan of n vertices that begins and ends in the plane y = 0.
std::vector<Vec3> random_fan(Random& random, std::uint32_t n) {
  std::vector<Vec3> around;
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool is_end = i == 0 || i == n - 1;
    const auto [x, y] = on_circle(0.5 * (i + (is_end ? 0.0 : random.real(-0.2, 0.2))) / (n - 1));
    const double radius = random.real(0.3, 0.8);
    around.emplace_back(radius * x, is_end ? 0.0 : radius * y, random.real(-0.3, 0.3));
  }
  return around;
}

/// The best worst ratio over all triangulations of the polygon i..k of a ring.
double best_by_force(const TetMesh& mesh, std::uint32_t i, std::uint32_t k) {
  double best = k - i < 2 ? 1.0 : 0.0;
  for (std::uint32_t j = i + 1; j < k; ++j) {
    const VertexId p(2 + i), q(2 + j), r(2 + k);
    const double here =
        std::min(inradius_ratio(mesh, {VertexId(0), p, q, r}), inradius_ratio(mesh, {p, q, r, VertexId(1)}));
    best = std::max(best, std::min({here, best_by_force(mesh, i, j), best_by_force(mesh, j, k)}));
  }
  return best;
}

struct Tally {
  unsigned accepted = 0, refused = 0;
};

/// Tries the edge from 0 to 1: accepted where the best triangulation is better than what is there, and then it is that.
void try_ring(const TetSoup& soup, Tally& tally) {
  TetMesh mesh = build(soup);
  const auto n = static_cast<std::uint32_t>(soup.points.size() - 2);
  const double before = worst_ratio(mesh, tets_of(mesh)), best = best_by_force(mesh, 0, n - 1);
  const double volume = volume_of(mesh);
  const std::uint64_t hash = mesh.hash();
  CareOf care(mesh);
  const bool is_done = EdgeRemover().improve(care.care, TetId(0));
  care.commit();
  EXPECT_EQ(is_done, best > before * (1 + kLeastGain)) << best << " after " << before;
  ++(is_done ? tally.accepted : tally.refused);
  if (is_done) {
    EXPECT_EQ(worst_ratio(mesh, tets_of(mesh)), best);
    EXPECT_EQ(mesh.tet_count(), 2U * (n - 2));
    EXPECT_EQ(care.statistics.removed_edges, 1U);
    EXPECT_EQ(care.changed.size(), mesh.tet_count());
  } else {
    EXPECT_EQ(mesh.hash(), hash);
  }
  expect_valid(mesh, volume);
}

bool is_positive(const TetSoup& soup) {
  return std::all_of(soup.tets.begin(), soup.tets.end(), [&](const auto& t) {
    return signed_volume6(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]], soup.points[t[3]]) > 1e-6;
  });
}

TEST(EdgeRemoval, finds_the_best_of_all_triangulations_of_a_ring) {
  Random random(1);
  for (std::uint32_t n = 3; n <= 8; ++n) {
    SCOPED_TRACE(n);
    Tally tally;
    for (unsigned i = 0; i < 100; ++i) {
      TetSoup soup = ring_soup(random_ring(random, n), true);
      for (unsigned v = 0; v < 2; ++v) soup.points[v] *= random.real(0.2, 1.5);
      if (is_positive(soup)) try_ring(soup, tally);
    }
    EXPECT_GT(tally.accepted, 5U);
    EXPECT_GT(tally.refused, 5U);
  }
}

TEST(EdgeRemoval, finds_the_best_of_all_triangulations_at_a_flat_boundary) {
  Random random(2);
  for (std::uint32_t n = 3; n <= 8; ++n) {
    SCOPED_TRACE(n);
    Tally tally;
    for (unsigned i = 0; i < 100; ++i) {
      TetSoup soup = ring_soup(random_fan(random, n), false);
      for (unsigned v = 0; v < 2; ++v) soup.points[v] *= random.real(0.2, 1.5);
      if (is_positive(soup)) try_ring(soup, tally);
    }
    EXPECT_GT(tally.accepted, 5U);
    EXPECT_GT(tally.refused, 5U);
  }
}

TEST(EdgeRemoval, leaves_rings_that_are_too_large) {
  Random random(3);
  for (unsigned i = 0; i < 20; ++i) {
    TetSoup soup = ring_soup(random_ring(random, 9), true);
    if (!is_positive(soup)) continue;
    TetMesh mesh = build(soup);
    CareOf care(mesh);
    EXPECT_FALSE(EdgeRemover().improve(care.care, TetId(0)));
    care.commit();
    expect_valid(mesh, volume_of(mesh));
  }
}

/// A fan of three vertices at a flat boundary that is better without its edge.
TetSoup long_fan() {
  return ring_soup({Vec3(0.4, 0, 0), Vec3(0, 0.5, 0), Vec3(-0.4, 0, 0)}, false);
}

bool removes_edge(TetMesh mesh) {
  CareOf care(mesh);
  const bool is_done = EdgeRemover().improve(care.care, TetId(0));
  care.commit();
  expect_valid(mesh, volume_of(mesh));
  return is_done;
}

TEST(EdgeRemoval, at_the_boundary_asks_for_one_plane) {
  EXPECT_TRUE(removes_edge(build(long_fan())));
  for (const double height : {1e-6, -1e-6, 0.1, -0.1}) {
    TetSoup bent = long_fan();
    bent.points[2].y() = height;
    EXPECT_FALSE(removes_edge(build(std::move(bent)))) << height;
  }
}

TEST(EdgeRemoval, at_the_boundary_asks_for_one_tag) {
  TetMesh mesh = build(long_fan());
  Transaction transaction(mesh);
  transaction.set_link({TetId(0), mesh.corner_of(TetId(0), VertexId(3))}, Link::boundary(4));
  transaction.commit();
  EXPECT_FALSE(removes_edge(mesh));
}

TEST(EdgeRemoval, leaves_borders_between_regions) {
  TetSoup soup = ring_soup({Vec3(0.4, 0, 0), Vec3(-0.2, 0.4, 0), Vec3(-0.2, -0.4, 0)}, true);
  EXPECT_TRUE(removes_edge(build(soup)));
  soup.regions = {1, 1, 2};
  EXPECT_FALSE(removes_edge(build(std::move(soup))));
}

// --- faces
// -----------------------------------------------------------------------------------------------------------------

/// Two tets on the triangle 0 1 2, with apexes at ±height.
TetSoup two_tets(double height) {
  return {{Vec3(1, 0, 0), Vec3(-0.5, 0.75, 0), Vec3(-0.5, -0.75, 0), Vec3(0, 0, height), Vec3(0, 0, -height)},
          {{0, 1, 2, 3}, {0, 2, 1, 4}},
          {}};
}

TEST(FaceRemoval, turns_two_flat_tets_into_three) {
  TetMesh mesh = build(two_tets(0.3));
  const double before = worst_ratio(mesh, tets_of(mesh)), volume = volume_of(mesh);
  CareOf care(mesh);
  ASSERT_TRUE(FaceRemover().improve(care.care, TetId(0)));
  care.commit();
  EXPECT_EQ(care.statistics.removed_faces, 1U);
  EXPECT_EQ(mesh.tet_count(), 3U);
  EXPECT_GT(worst_ratio(mesh, tets_of(mesh)), before);
  expect_valid(mesh, volume);
}

TEST(FaceRemoval, and_edge_removal_agree_on_what_is_better) {
  for (const double height : {0.1, 0.3, 0.5, 0.7, 0.9, 1.2, 2.0}) {
    TetMesh mesh = build(two_tets(height));
    const auto shapes = shape_list(mesh);
    CareOf care(mesh);
    EdgeRemover edges;
    FaceRemover faces;
    unsigned swaps = 0;
    while (swaps < 5 && (faces.improve(care.care, tets_of(mesh)[0]) || edges.improve(care.care, tets_of(mesh)[0]))) {
      ++swaps;
    }
    EXPECT_LE(swaps, 1U) << "back and forth at height " << height;
    care.commit();
    EXPECT_TRUE(swaps > 0 || shape_list(mesh) == shapes);
    expect_valid(mesh, volume_of(mesh));
  }
}

TEST(FaceRemoval, leaves_borders_and_lines_that_miss_the_face) {
  TetSoup soup = two_tets(0.3);
  soup.regions = {1, 2};
  TetSoup skew = two_tets(0.3);
  skew.points[3].x() = 3;
  for (const TetSoup& each : {soup, skew}) {
    TetMesh mesh = build(each);
    CareOf care(mesh);
    EXPECT_FALSE(FaceRemover().improve(care.care, TetId(0)));
    care.commit();
    expect_valid(mesh, volume_of(mesh));
  }
}

// --- fronts
// ----------------------------------------------------------------------------------------------------------------

/// A flat rectangle in a random pose in the unit cube.
Stroke random_patch(Random& random, double width) {
  const Vec3 centre = random.point(0, 1), u = random_direction(random);
  const Vec3 v = 0.5 * width * u.cross(random_direction(random)).normalized(), w = 0.5 * width * u;
  return quad_stroke(centre - w - v, centre - w + v, centre + w - v, centre + w + v);
}

/// Where a cut ends inside, both lips share the vertices of its front: what a swap makes on one lip may be there
/// already, on the other.
TEST(SwapsAtFronts, make_no_edge_or_face_of_the_other_lip) {
  Random random(11);
  Engine engine = make_engine(kuhn_cube(5), 0.0);
  for (unsigned i = 0; i < 40; ++i) cut(engine, random_patch(random, 0.35));
  TetMesh mesh = engine.mesh();
  EdgeRemover edges;
  FaceRemover faces;
  unsigned swaps = 0;
  for (unsigned round = 0; round < 5; ++round) {
    CareOf care(mesh);
    for (const TetId tet : tets_of(mesh)) {
      if (mesh.is_live(tet) && (edges.improve(care.care, tet) || faces.improve(care.care, tet))) ++swaps;
    }
    care.commit();
    expect_valid(mesh, 1.0);
  }
  EXPECT_GT(swaps, 500U);
}

/// Seeds 2, 4 and 5 are where a swap once made a face of the other lip: a later cut had split the front's edges.
TEST(SwapsAtFronts, of_random_patches_leave_a_valid_mesh_after_every_stroke) {
  for (const std::uint64_t seed : of_campaign<std::vector<std::uint64_t>>({2, 4, 5}, {1, 2, 3, 4, 5})) {
    for (const double snap : {0.0, 0.2}) {
      SCOPED_TRACE(seed);
      Random random(seed);
      Engine engine = maintaining_engine(seed == 3 ? jittered_cube(5, 1) : kuhn_cube(5), snap);
      for (unsigned i = 0; i < 25; ++i) {
        cut_and_maintain(engine, random_patch(random, 0.4));
        expect_valid(engine.mesh(), 1.0, 1e-10);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace incise::test::edge_removal_test
