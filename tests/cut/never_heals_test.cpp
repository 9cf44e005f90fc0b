// SPDX-License-Identifier: Apache-2.0
// What has come apart stays apart, whatever the blade does.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "cut/flagged_body.h"
#include "cut/piece_finder.h"
#include "incise/mesh/components.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::never_heals_test {
namespace {

/// Tets and vertices that live on, from two pieces, are not in one now: no vertex goes over by its name either.
void expect_no_join(const TetMesh& before, const TetMesh& after, const Step& step) {
  const Components was = find_components(before), is = find_components(after);
  std::map<std::uint32_t, std::uint32_t> came_from;
  const auto expect_same = [&](TetId now, TetId then, const std::string& what) {
    const auto [known, is_first] = came_from.try_emplace(is.label[now.value], was.label[then.value]);
    EXPECT_EQ(known->second, was.label[then.value]) << what;
  };
  after.for_each_tet([&](TetId tet) {
    if (before.is_live(tet) && before.generation(tet) == after.generation(tet))
      expect_same(tet, tet, "tet " + std::to_string(tet.value));
  });
  after.for_each_vertex([&](VertexId v) {
    const bool is_new = std::count(step.new_vertices.begin(), step.new_vertices.end(), v) > 0;  // its slot was free
    if (before.is_live(v) && !is_new)
      expect_same(after.tet_of(v), before.tet_of(v), "vertex " + std::to_string(v.value));
  });
}

void change_round_after_round(Random& random, std::uint64_t seed, double flag_share, double on_share) {
  SCOPED_TRACE(testing::Message() << seed << " " << flag_share << " " << on_share);
  FlaggedBody body(jittered_cube(3, seed));
  Rebuild::Settings settings;
  settings.keeps_pieces = true;
  for (unsigned round = 0; round < 4 && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    body.toggle_some(random, round == 0 ? flag_share : 0.3 * flag_share);
    body.put_some_on(random, round % 2 == 0 ? on_share : 0.0);
    body.place_points(random, 0.3);
    body.stand(random, 0.05);
    const TetMesh before = body.mesh();
    const RebuildStatistics done = body.rebuild(settings);
    expect_no_join(before, body.mesh(), body.last_step());
    ValidityReport report = validate(body.mesh(), ValidateLevel::kGeometry);
    if (done.left_pinched > 0) continue;  // the sheet is to be finished here, which parts such edges
    EXPECT_TRUE(report.ok) << describe(report);
  }
}

TEST(NeverHeals, whatever_edges_are_crossed_again) {
  Random random(8);
  for (const double flag_share : {0.05, 0.2, 0.5, 0.8, 1.0}) {
    for (std::uint64_t seed = 40; seed < 60; ++seed) change_round_after_round(random, seed, flag_share, 0.0);
  }
}

TEST(NeverHeals, beside_vertices_that_take_part_in_the_cut) {
  Random random(9);
  for (const double flag_share : {0.05, 0.2, 0.5, 0.8, 1.0}) {
    for (std::uint64_t seed = 40; seed < 60; ++seed) change_round_after_round(random, seed, flag_share, 0.2);
  }
}

/// The edges at a vertex are crossed near it, and once more: what had come off around it is in no child of the masters
/// made anew. It ends there, and its vertex with it: that is no vertex of the piece around.
TEST(NeverHeals, a_vertex_ends_with_its_crumb) {
  Random random(11);
  for (std::uint64_t seed = 80; seed < 85; ++seed) {
    FlaggedBody body(jittered_cube(2, seed));
    const VertexId middle(13);  // of 27
    const auto cross_around = [&] {
      for (std::uint32_t edge = 0; edge < body.complex().edges().size(); ++edge) {
        const ClosedEdge& at = body.complex().edges()[edge];
        if (at.a == middle || at.b == middle) body.toggle(edge, at.a == middle ? 0.2 : 0.8);
      }
      body.stand(random, 0.05);
    };
    const Rebuild::Settings settings{.crumb_share = 0, .keeps_pieces = true};
    cross_around();
    body.rebuild(settings);
    ASSERT_EQ(find_components(body.mesh()).count(), 2U);
    cross_around();
    const TetMesh before = body.mesh();
    body.rebuild(settings);
    EXPECT_FALSE(body.mesh().is_live(middle));
    expect_no_join(before, body.mesh(), body.last_step());
    const ValidityReport report = validate(body.mesh(), ValidateLevel::kGeometry);
    EXPECT_TRUE(report.ok) << describe(report);
  }
}

TEST(PieceFinder, agrees_with_the_components_of_the_whole) {
  Random random(10);
  for (std::uint64_t seed = 70; seed < 80; ++seed) {
    FlaggedBody body(jittered_cube(4, seed));
    body.toggle_some(random, 0.5);
    body.rebuild();
    const Components pieces = find_components(body.mesh());
    std::vector<TetId> seeds;
    body.mesh().for_each_tet([&](TetId tet) {
      if (random.real(0, 1) < 0.1) seeds.push_back(tet);
    });
    PieceFinder finder;
    for (unsigned round = 0; round < 2; ++round) {  // it keeps nothing
      std::map<std::uint32_t, std::uint32_t> label_of;
      const std::uint32_t count = finder.find(body.mesh(), seeds);
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        const auto [known, is_first] = label_of.try_emplace(finder.piece_of(i), pieces.label[seeds[i].value]);
        EXPECT_EQ(known->second, pieces.label[seeds[i].value]);
      }
      EXPECT_EQ(label_of.size(), count);
    }
  }
}

TEST(PieceFinder, finds_no_piece_of_nothing) {
  PieceFinder finder;
  EXPECT_EQ(finder.find(build(kuhn_cube(1)), {}), 0U);
}

}  // namespace
}  // namespace incise::test::never_heals_test
