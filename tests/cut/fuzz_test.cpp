// SPDX-License-Identifier: Apache-2.0
// Random planes against convex clipping, and random strokes against the validity contract.
// INCISE_FUZZ_RUNS is the number of runs per case: 5 by day and 10 at night unless told, 100 for the whole campaign.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "incise/io/mesh_file.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/defects.h"
#include "oracle/convex_arrangement.h"
#include "support/bodies.h"
#include "support/campaign.h"
#include "support/engines.h"
#include "support/random_strokes.h"

namespace incise::test::fuzz_test {
namespace {

unsigned runs() {
  const char* text = std::getenv("INCISE_FUZZ_RUNS");
  return text == nullptr ? of_campaign(5U, 10U) : static_cast<unsigned>(std::atoi(text));
}

/// The bunny takes longer; the whole campaign gives it as many.
unsigned bunny_runs() {
  return runs() >= 100 ? runs() : std::max(1U, runs() / 3);
}

std::vector<oracle::Plane> random_planes(Random& random, const Box& box, std::size_t count) {
  std::vector<oracle::Plane> planes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 normal = random_direction(random);
    const Vec3 point = box.lo + (box.hi - box.lo).cwiseProduct(random.point(0.1, 0.9));
    planes.push_back({normal, normal.dot(point)});
  }
  return planes;
}

/// The plane that the blade really sweeps: that of its triangle, which rounding has moved.
oracle::Plane swept_plane(const Stroke& stroke) {
  const Vec3 &a = stroke.edges[0][0], &b = stroke.edges[0][1], &c = stroke.edges[1][1];
  const Vec3 normal = (b - a).cross(c - a).normalized();
  return {normal, normal.dot((a + b + c) / 3.0)};
}

void compare_with_oracle(const TetSoup& soup, std::uint64_t seed, unsigned n_runs) {
  for (unsigned run = 0; run < n_runs; ++run) {
    for (std::size_t n_planes = 1; n_planes <= 4; ++n_planes) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", run " << run << ", planes " << n_planes);
      Random random(seed * 100000 + run * 10 + n_planes);
      Engine engine = make_engine(soup, 0.0);
      std::vector<oracle::Plane> planes = random_planes(random, rest_bounds(engine.mesh()), n_planes);
      for (oracle::Plane& p : planes) {
        const Stroke stroke = plane(engine, p.normal, p.offset);
        p = swept_plane(stroke);
        cut(engine, stroke);
      }
      const oracle::Arrangement expected = oracle::arrange({soup.points, soup.tets}, planes);
      const std::vector<double> found = piece_volumes(engine.mesh());
      ASSERT_EQ(found.size(), expected.volumes.size());
      double worst = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        worst = std::max(worst, std::abs(found[i] - expected.volumes[i]) / expected.total);
      }
      EXPECT_LE(worst, 1e-12);
      if (testing::Test::HasFailure()) return;
    }
  }
}

void cut_at_the_default(const TetSoup& soup, std::uint64_t seed, unsigned n_runs) {
  double spacing = 0;
  for (const auto& tet : soup.tets) spacing += (soup.points[tet[0]] - soup.points[tet[1]]).norm();
  spacing /= static_cast<double>(soup.tets.size());
  std::size_t large = 0, present = 0;
  for (unsigned run = 0; run < n_runs; ++run) {
    for (std::size_t n_planes = 1; n_planes <= 4; ++n_planes) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", run " << run << ", planes " << n_planes);
      Random random(seed * 100000 + run * 10 + n_planes);
      Engine engine = make_engine(soup);
      const double volume = volume_of(engine.mesh());
      std::vector<oracle::Plane> planes = random_planes(random, rest_bounds(engine.mesh()), n_planes);
      for (const oracle::Plane& p : planes) cut(engine, plane(engine, p.normal, p.offset));
      expect_valid(engine.mesh(), volume);
      const oracle::Arrangement expected = oracle::arrange({soup.points, soup.tets}, planes);
      const double bound = std::pow(0.4 * spacing, 3);
      const auto is_large = [&](double v) { return v > bound; };
      const std::vector<double> found = piece_volumes(engine.mesh());
      large += static_cast<std::size_t>(std::count_if(expected.volumes.begin(), expected.volumes.end(), is_large));
      present += static_cast<std::size_t>(std::count_if(found.begin(), found.end(), is_large));
      if (testing::Test::HasFailure()) return;
    }
  }
  std::printf("  pieces above (2 δ h)³: %zu, of the oracle %zu\n", present, large);
  EXPECT_GE(static_cast<double>(present), 0.9 * static_cast<double>(large));
}

std::filesystem::path bunny_path() {
  const char* corpus = std::getenv("INCISE_CORPUS");
  const std::filesystem::path real =
      std::filesystem::path(corpus == nullptr ? "" : corpus) / "tets/paper_bunny_10668.ele";
  return corpus != nullptr && std::filesystem::exists(real) ? real : std::filesystem::path("models/bunny.mesh");
}

/// The bunny where there is one, else nothing.
TetSoup bunny() {
  for (const std::filesystem::path& path :
       {bunny_path(), std::filesystem::path(INCISE_SOURCE_DIR) / "models/bunny.mesh"}) {
    if (!std::filesystem::exists(path)) continue;
    Result<io::MeshFile> file = io::read_mesh(path);
    if (!file.ok()) continue;
    normalise(file->data.soup);
    return std::move(file->data.soup);
  }
  return {};
}

// T7
TEST(PlaneFuzz, on_a_kuhn_cube_gives_the_oracles_pieces_without_snapping) {
  compare_with_oracle(kuhn_cube(5), 1, runs());
}
TEST(PlaneFuzz, on_an_unstructured_cube_gives_the_oracles_pieces_without_snapping) {
  compare_with_oracle(jittered_cube(5, 7), 2, runs());
}
TEST(PlaneFuzz, on_the_bunny_gives_the_oracles_pieces_without_snapping) {
  const TetSoup soup = bunny();
  if (soup.tets.empty()) GTEST_SKIP() << "no models/bunny.mesh and no INCISE_CORPUS: the bunny is not cut";
  compare_with_oracle(soup, 3, bunny_runs());
}
// T8
TEST(PlaneFuzz, on_a_kuhn_cube_is_valid_at_the_default) {
  cut_at_the_default(kuhn_cube(5), 1, runs());
}
TEST(PlaneFuzz, on_an_unstructured_cube_is_valid_at_the_default) {
  cut_at_the_default(jittered_cube(5, 7), 2, runs());
}
TEST(PlaneFuzz, on_the_bunny_is_valid_at_the_default) {
  const TetSoup soup = bunny();
  if (soup.tets.empty()) GTEST_SKIP() << "no models/bunny.mesh and no INCISE_CORPUS: the bunny is not cut";
  cut_at_the_default(soup, 3, bunny_runs());
}

// T9
TEST(PlaneFuzz, fifty_planes_after_another_stay_valid) {
  for (const TetSoup& soup : {kuhn_cube(3), jittered_cube(3, 9)}) {
    Random random(50);
    Engine engine = make_engine(soup);
    const double volume = volume_of(engine.mesh());
    for (unsigned i = 0; i < 50; ++i) {
      SCOPED_TRACE(testing::Message() << "plane " << i);
      const oracle::Plane p = random_planes(random, {Vec3(0, 0, 0), Vec3(1, 1, 1)}, 1)[0];
      ASSERT_TRUE(engine.cut(plane(engine, p.normal, p.offset)).ok());
      expect_valid(engine.mesh(), volume);
      if (testing::Test::HasFailure()) return;
    }
    std::printf("  %zu tets, %zu pieces after fifty planes\n", engine.mesh().tet_count(),
                find_components(engine.mesh()).count());
  }
}

void cut_with_random_strokes(const TetSoup& soup, CutOptions options, std::uint64_t seed, unsigned n_bodies) {
  for (unsigned run = 0; run < n_bodies; ++run) {
    Random random(seed * 1000 + run);
    Engine engine = make_engine(soup, options.snap, options.profile);
    const double volume = volume_of(engine.mesh());
    for (unsigned i = 0; i < 6; ++i) {
      const Stroke stroke = random_stroke(random, rest_bounds(engine.mesh()));
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", run " << run << ", stroke " << i << ", " << stroke.name);
      ASSERT_TRUE(engine.cut(stroke).ok());
      expect_valid(engine.mesh(), volume);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(StrokeFuzz, is_valid_at_the_default) {
  cut_with_random_strokes(jittered_cube(5, 3), {Profile::kIncise, 0.2}, 1, 3 * runs());
  cut_with_random_strokes(ball(6), {Profile::kIncise, 0.2}, 2, runs());
  cut_with_random_strokes(kuhn_cube(4), {Profile::kIncise, 0.3}, 3, runs());
}
TEST(StrokeFuzz, is_valid_without_snapping) {
  cut_with_random_strokes(jittered_cube(4, 3), {Profile::kIncise, 0.0}, 4, 2 * runs());
  cut_with_random_strokes(ball(6), {Profile::kIncise, 0.0}, 5, runs());
}
TEST(StrokeFuzz, is_valid_in_the_paper_profile) {
  cut_with_random_strokes(jittered_cube(4, 3), {Profile::kPaper, 0.0}, 6, runs());
}

TEST(StrokeFuzz, does_not_make_overlapping_bodies_worse) {
  for (const double snap : {0.0, 0.2}) {
    for (unsigned run = 0; run < 2 * runs(); ++run) {
      Random random(run + 77);
      TetSoup soup = doubled_cube(static_cast<std::uint32_t>(random.integer(1, 4)));
      normalise(soup);
      Engine engine = make_engine(soup, snap);
      const ValidityReport before = validate(engine.mesh(), ValidateLevel::kGeometry);
      for (unsigned i = 0; i < 4; ++i) {
        const Stroke stroke = random_stroke(random, rest_bounds(engine.mesh()));
        SCOPED_TRACE(testing::Message() << "snap " << snap << ", run " << run << ", stroke " << i << ", "
                                        << stroke.name);
        ASSERT_TRUE(engine.cut(stroke).ok());
        const ValidityReport after = validate(engine.mesh(), ValidateLevel::kGeometry);
        EXPECT_TRUE(compare_with_input(before, after).ok) << describe(after);
        EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.volume);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace incise::test::fuzz_test
