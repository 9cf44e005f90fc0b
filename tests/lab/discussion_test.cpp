// SPDX-License-Identifier: Apache-2.0
// What the paper claims against the methods that it cites (its section 4.5), asked of the same strokes.
#include "incise/engine/engine.h"
#include "incise/mesh/quality_stats.h"
#include "lab/lab_support.h"
#include "support/random_strokes.h"

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

Outcome cut_by_lab(LabMethod method, const std::vector<Stroke>& strokes) {
  LabCut body{build(kuhn_cube(5)), {}, {}};
  for (std::uint32_t k = 0; k < strokes.size(); ++k) cut_on(body, method, strokes[k], k + 1);
  expect_sound(body.mesh);
  return measure(body.mesh);
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

/// "Unlike the scheme proposed by D. Bielser [11] …, our scheme consider more about mesh quality and complexity".
TEST(Discussion, beside_the_subdivisions_of_11_and_12_the_paper_has_fewer_tets_in_better_shape) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Stroke> plane = random_planes(seed, 1);
    const Outcome ours = cut_by_paper(plane);
    for (const LabMethod method : {LabMethod::kAdaptive, LabMethod::kSeventeen}) {
      const Outcome theirs = cut_by_lab(method, plane);
      EXPECT_EQ(ours.pieces, theirs.pieces) << name_of(method) << seed;
      EXPECT_LT(2 * (ours.tets - 750), theirs.tets - 750) << name_of(method) << seed;
      EXPECT_LT(1.2 * ours.mean, theirs.mean) << name_of(method) << seed;
    }
  }
}

/// "When compared to schemes that preserve the mesh complexity by moving vertexes … [10], our incision scheme
/// demonstrates more flexibility in dealing with complicated incision": crossing planes, whose pieces are known.
TEST(Discussion, beside_the_moved_vertices_of_9_and_10_the_paper_keeps_bodies_through_many_incisions) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const std::vector<Stroke> planes = random_planes(seed, 5);
    const Outcome exact = cut_by_lab(LabMethod::kMinimal, planes), ours = cut_by_paper(planes);
    EXPECT_EQ(ours.pieces, exact.pieces) << seed;
    EXPECT_LT(ours.volume_off, 2e-3) << seed;
    for (const LabMethod method : {LabMethod::kSnapping, LabMethod::kMoving}) {
      const Outcome theirs = cut_by_lab(method, planes);
      EXPECT_GT(theirs.volume_off, 10 * ours.volume_off) << name_of(method) << seed;
      EXPECT_GT(theirs.volume_off, 5e-3) << name_of(method) << seed;
    }
  }
}

/// "… moves the vertexes along the cutting trajectory … which may create sliver elements [9, 10]", and of the minimal
/// set [13] "it still creates ill-conditioned tetrahedral" (section 1): worse than Table 3's bad-shaped ones, L/r above
/// 200.
TEST(Discussion, moved_vertices_and_the_minimal_set_leave_slivers) {
  for (const LabMethod method : {LabMethod::kSnapping, LabMethod::kMoving, LabMethod::kMinimal}) {
    double worst = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      worst = std::max(worst, cut_by_lab(method, random_planes(seed, 5)).worst);
    }
    EXPECT_GT(worst, 100) << name_of(method);
  }
}

/// "… and the ability to conduct multiple incisions is required": the complexity that the methods leave.
TEST(Discussion, after_three_incisions_the_paper_has_a_fraction_of_the_tets_of_the_subdivisions) {
  const std::vector<Stroke> planes = random_planes(9, 3);
  const Outcome ours = cut_by_paper(planes);
  EXPECT_LT(2 * (ours.tets - 750), cut_by_lab(LabMethod::kMinimal, planes).tets - 750);
  EXPECT_LT(5 * (ours.tets - 750), cut_by_lab(LabMethod::kAdaptive, planes).tets - 750);
  EXPECT_LT(10 * (ours.tets - 750), cut_by_lab(LabMethod::kSeventeen, planes).tets - 750);
}

}  // namespace
}  // namespace incise::test::discussion_test
