// SPDX-License-Identifier: Apache-2.0
// What the paper claims against the methods that it cites (its sections 1 and 4.5): all cut along the same planes, the
// first ones of docs/benchmark.md and some others.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/geom/quality.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/tet_tables.h"
#include "lab/lab_support.h"

namespace incise::test::discussion_test {
namespace {

/// What one way to cut left of the paper's cube.
struct Outcome {
  std::size_t tets = 0, pieces = 0;
  double mean = 0, worst = 0, volume_off = 0;  // L/r; share of the body
};

Outcome measure(const TetMesh& mesh) {
  const QualityStats quality = measure_quality(mesh);
  return {mesh.tet_count(), find_components(mesh).count(), quality.lr_mean, quality.lr_max,
          std::abs(volume_of(mesh) - 1.0)};
}

std::vector<Stroke> random_planes(std::uint64_t seed, unsigned count) {
  Random random(seed);
  std::vector<Stroke> strokes;
  for (unsigned k = 0; k < count; ++k) {
    const Vec3 normal = random_direction(random);
    strokes.push_back(plane_through(normal, normal.dot(Vec3(0.5, 0.5, 0.5)) + 0.07 * (k % 3)));
  }
  return strokes;
}

/// Sets of `count` planes: the benchmark's, and those of some seeds.
std::vector<std::vector<Stroke>> sets_of_planes(unsigned count, const std::vector<std::uint64_t>& seeds) {
  std::vector<std::vector<Stroke>> sets = {benchmark_planes(count)};
  for (const std::uint64_t seed : seeds) sets.push_back(random_planes(seed, count));
  return sets;
}

TetMesh cut_cube_by(LabMethod method, const std::vector<Stroke>& strokes) {
  LabCut body{build(kuhn_cube(5)), {}, {}};
  for (std::uint32_t k = 0; k < strokes.size(); ++k) cut_on(body, method, strokes[k], k + 1);
  expect_sound(body.mesh);
  return std::move(body.mesh);
}
Outcome cut_by_lab(LabMethod method, const std::vector<Stroke>& strokes) {
  return measure(cut_cube_by(method, strokes));
}

Outcome cut_by_paper(const std::vector<Stroke>& strokes) {
  EngineOptions options;
  options.cut.profile = Profile::kPaper;
  Result<Engine> created = Engine::create(build(kuhn_cube(5)), options);
  Engine& engine = *created;
  for (const Stroke& stroke : strokes) EXPECT_TRUE(engine.cut(stroke).ok());
  EXPECT_TRUE(engine.maintain().ok());
  return measure(engine.mesh());
}

/// Profile `incise` without snapping and maintenance, which separates all that the planes do: by none of the paper's
/// code.
Outcome cut_exactly(const std::vector<Stroke>& strokes) {
  EngineOptions options;
  options.cut.snap = 0;
  options.maintain.improve = options.maintain.merge = false;
  Result<Engine> created = Engine::create(build(kuhn_cube(5)), options);
  for (const Stroke& stroke : strokes) EXPECT_TRUE(created->cut(stroke).ok());
  return measure(created->mesh());
}

/// The rows of docs/benchmark.md: these are its planes.
TEST(Discussion, asks_of_the_planes_of_the_benchmark) {
  EXPECT_EQ(cut_by_lab(LabMethod::kMinimal, benchmark_planes(1)).tets, 750U + 580U);
  EXPECT_EQ(cut_by_lab(LabMethod::kMinimal, benchmark_planes(5)).tets, 750U + 9217U);
  EXPECT_EQ(cut_by_lab(LabMethod::kMoving, benchmark_planes(5)).tets, 750U + 989U);
}

/// "Unlike the scheme proposed by D. Bielser [11] …, our scheme consider more about mesh quality and complexity".
TEST(Discussion, beside_the_subdivisions_of_11_and_12_the_paper_has_fewer_tets_in_better_shape) {
  for (const std::vector<Stroke>& plane : sets_of_planes(1, {1, 2, 3, 4, 5})) {
    const Outcome ours = cut_by_paper(plane);
    for (const LabMethod method : {LabMethod::kAdaptive, LabMethod::kSeventeen}) {
      SCOPED_TRACE(name_of(method));
      const Outcome theirs = cut_by_lab(method, plane);
      EXPECT_EQ(ours.pieces, theirs.pieces);
      EXPECT_LT(2 * (ours.tets - 750), theirs.tets - 750);
      EXPECT_LT(1.2 * ours.mean, theirs.mean);
    }
  }
}

/// "When compared to schemes that preserve the mesh complexity by moving vertexes … [10], our incision scheme
/// demonstrates more flexibility in dealing with complicated incision": crossing planes, whose pieces are known.
TEST(Discussion, beside_the_moved_vertices_of_9_and_10_the_paper_keeps_bodies_through_many_incisions) {
  for (const std::vector<Stroke>& planes : sets_of_planes(5, {1, 2, 3})) {
    const Outcome exact = cut_exactly(planes), ours = cut_by_paper(planes);
    EXPECT_EQ(ours.pieces, exact.pieces);
    EXPECT_EQ(cut_by_lab(LabMethod::kMinimal, planes).pieces, exact.pieces);
    EXPECT_LT(ours.volume_off, 2e-3);
    for (const LabMethod method : {LabMethod::kSnapping, LabMethod::kMoving}) {
      SCOPED_TRACE(name_of(method));
      const Outcome theirs = cut_by_lab(method, planes);
      EXPECT_GT(theirs.volume_off, 10 * ours.volume_off);
      EXPECT_GT(theirs.volume_off, 5e-3);
    }
  }
}

/// How many tets are worse than Table 3's bad-shaped ones though none of their edges is short: flat.
std::size_t count_slivers(const TetMesh& mesh) {
  constexpr double kShortShare = 0.2;
  std::size_t count = 0;
  mesh.for_each_tet([&](TetId tet) {
    std::array<Vec3, 4> p;
    for (unsigned c = 0; c < 4; ++c) p[c] = mesh.rest(mesh.vertices(tet)[c]);
    double longest = 0, shortest = 1e300;
    for (const auto& [i, j] : kEdgeCorners) {
      longest = std::max(longest, (p[i] - p[j]).norm());
      shortest = std::min(shortest, (p[i] - p[j]).norm());
    }
    const bool is_bad = longest_edge_over_inradius(p[0], p[1], p[2], p[3]) > kBadRatio;
    count += is_bad && shortest > kShortShare * longest ? 1U : 0U;
  });
  return count;
}

/// "… moves the vertexes along the cutting trajectory … which may create sliver elements [9, 10]" (section 1).
TEST(Discussion, moved_vertices_leave_slivers) {
  ASSERT_EQ(count_slivers(build(kuhn_cube(5))), 0U);
  for (const std::vector<Stroke>& planes : sets_of_planes(20, {1, 2, 3})) {
    for (const LabMethod method : {LabMethod::kSnapping, LabMethod::kMoving}) {
      SCOPED_TRACE(name_of(method));
      EXPECT_GT(count_slivers(cut_cube_by(method, planes)), 0U);
    }
  }
}

/// Of the minimal set [13]: "it still creates ill-conditioned tetrahedral" (section 1).
TEST(Discussion, the_minimal_set_leaves_bad_shaped_tets) {
  for (const std::vector<Stroke>& planes : sets_of_planes(5, {1, 2, 3})) {
    const QualityStats quality = measure_quality(cut_cube_by(LabMethod::kMinimal, planes));
    EXPECT_GT(quality.lr_over_200_pct, 2.6);  // more than Table 3's "no optimization"
    EXPECT_GT(quality.lr_mean, 38.27);
  }
}

/// "… and the ability to conduct multiple incisions is required": the complexity that the methods leave.
TEST(Discussion, after_three_incisions_the_paper_has_a_fraction_of_the_tets_of_the_subdivisions) {
  EXPECT_EQ(cut_by_paper(benchmark_planes(3)).pieces, 7U);
  for (const std::vector<Stroke>& planes : sets_of_planes(3, {9, 10, 11})) {
    const Outcome ours = cut_by_paper(planes);
    EXPECT_LT(2 * (ours.tets - 750), cut_by_lab(LabMethod::kMinimal, planes).tets - 750);
    EXPECT_LT(5 * (ours.tets - 750), cut_by_lab(LabMethod::kAdaptive, planes).tets - 750);
    EXPECT_LT(10 * (ours.tets - 750), cut_by_lab(LabMethod::kSeventeen, planes).tets - 750);
  }
}

}  // namespace
}  // namespace incise::test::discussion_test
