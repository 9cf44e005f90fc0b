// SPDX-License-Identifier: Apache-2.0
// The mirror of the examples keeps up with the mesh through the journal alone, bit for bit, whatever the engine does.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "incise/mesh/bounds.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/mirror_checks.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test::journal_replay_test {
namespace {

void follow(TetSoup soup, double snap, Profile profile, const std::vector<Stroke>& strokes) {
  Engine engine = make_engine(std::move(soup), snap, profile);
  JournalMirror mirror = mirror_of(engine.mesh());
  const double mass = mass_of(mirror);
  const Vec3 momentum = momentum_of(mirror);
  for (const Stroke& stroke : strokes) {
    SCOPED_TRACE(stroke.name);
    cut(engine, stroke);
    expect_follows(mirror, engine.journal(), engine.mesh());
    expect_affine_velocity(mirror, 1e-9);
    EXPECT_NEAR(mass_of(mirror), mass, 1e-12 * mass);
    EXPECT_LT((momentum_of(mirror) - momentum).norm(), 1e-12 * std::max(1.0, momentum.norm()));
    if (testing::Test::HasFailure()) return;
  }
}

/// The same on an engine that maintains. Where walls are bent they may give or take a little volume, the paper's more.
void follow_maintained(TetSoup soup, double snap, Profile profile, const std::vector<Stroke>& strokes) {
  EngineOptions options;
  options.cut = {profile, snap};
  Engine engine = Engine::create(build(std::move(soup)), options).value();
  JournalMirror mirror = mirror_of(engine.mesh());
  const double mass = mass_of(mirror);
  for (const Stroke& stroke : strokes) {
    SCOPED_TRACE(stroke.name);
    ASSERT_TRUE(engine.cut(stroke).ok());
    expect_follows(mirror, engine.journal(), engine.mesh());
    expect_affine_velocity(mirror, 1e-9);
    EXPECT_NEAR(mass_of(mirror), mass, (profile == Profile::kPaper ? 1e-2 : 1e-3) * mass);
    if (testing::Test::HasFailure()) return;
  }
  bool has_edits = false;
  for (std::size_t i = 0; i < engine.journal().size(); ++i) has_edits |= !engine.journal().step(i).edits.empty();
  EXPECT_TRUE(has_edits);
}

std::vector<Stroke> some_strokes(std::uint64_t seed, unsigned count) {
  Random random(seed);
  std::vector<Stroke> strokes;
  for (unsigned i = 0; i < count; ++i) strokes.push_back(random_stroke(random, {Vec3(0, 0, 0), Vec3(1, 1, 1)}));
  return strokes;
}

// T33
TEST(JournalReplay, on_a_mirror_gives_the_mesh_bit_for_bit_with_mass_and_momentum_kept) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    follow(jittered_cube(4, seed), 0.2, Profile::kIncise, some_strokes(seed, 6));
  }
}
TEST(JournalReplay, works_without_snapping) {
  follow(kuhn_cube(4), 0.0, Profile::kIncise, some_strokes(7, 5));
}
TEST(JournalReplay, works_in_the_paper_profile) {
  follow(jittered_cube(4, 8), 0.0, Profile::kPaper, some_strokes(8, 5));
}

TEST(JournalReplay, follows_cuts_that_cross_and_double_passes) {
  const Box box{Vec3(0, 0, 0), Vec3(1, 1, 1)};
  const Stroke down =
      quad_stroke(Vec3(0.47, -0.2, 1.2), Vec3(0.47, 1.2, 1.2), Vec3(0.47, -0.2, -0.2), Vec3(0.47, 1.2, -0.2), 7);
  follow(kuhn_cube(5), 0.2, Profile::kIncise,
         {*plane_stroke(box, Vec3(0, 1, 0), 0.53), followed_by(down, reversed(down)),
          coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 24, -0.2, 1.2), *plane_stroke(box, Vec3(1, 1, 1), 1.5)});
}

TEST(JournalReplay, follows_maintenance_edit_by_edit) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    follow_maintained(jittered_cube(4, seed), 0.2, Profile::kIncise, some_strokes(seed, 4));
  }
}
TEST(JournalReplay, follows_maintenance_of_cuts_without_snapping) {
  follow_maintained(kuhn_cube(4), 0.0, Profile::kIncise, some_strokes(7, 4));
}
TEST(JournalReplay, follows_the_papers_maintenance) {
  follow_maintained(jittered_cube(4, 8), 0.0, Profile::kPaper, some_strokes(8, 4));
}

/// Random calls of an engine whose body moves meanwhile; the mirror is compared after each.
class RandomCalls {
 public:
  RandomCalls(TetSoup soup, const EngineOptions& options, std::uint64_t seed)
      : engine_(Engine::create(build(std::move(soup)), options).value()),
        mirror_(mirror_of(engine_.mesh())),
        box_(rest_bounds(engine_.mesh())),
        random_(seed) {}

  void run(unsigned count) {
    using Call = void (RandomCalls::*)();
    static constexpr std::array<Call, 9> kCalls = {
        &RandomCalls::cut,      &RandomCalls::cut,     &RandomCalls::step_through,
        &RandomCalls::maintain, &RandomCalls::improve, &RandomCalls::undo,
        &RandomCalls::redo,     &RandomCalls::undo,    &RandomCalls::redo};
    for (unsigned i = 0; i < count && !testing::Test::HasFatalFailure(); ++i) {
      (this->*kCalls[static_cast<std::size_t>(random_.integer(0, kCalls.size() - 1))])();
      compare();
      shake();
    }
  }

 private:
  void cut() { ASSERT_TRUE(engine_.cut(random_stroke(random_, box_)).ok()); }
  void step_through() {
    const Stroke stroke = random_stroke(random_, box_);
    ASSERT_TRUE(engine_.begin_stroke({stroke.edges[0]}).ok());
    for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
      ASSERT_TRUE(engine_.step({stroke.edges[i]}).ok());
      compare();
      shake();
    }
    ASSERT_TRUE(engine_.end_stroke().ok());
  }
  void maintain() { EXPECT_TRUE(engine_.maintain(static_cast<std::uint64_t>(random_.integer(0, 200000))).ok()); }
  void improve() { EXPECT_TRUE(engine_.improve().ok()); }
  void undo() { engine_.undo(); }
  void redo() { engine_.redo(); }
  void compare() { expect_follows(mirror_, engine_.journal(), engine_.mesh()); }
  /// What a solver does between two calls.
  void shake() {
    for (std::uint32_t v = 0; v < mirror_.vertices().size(); ++v) {
      if (mirror_.vertices()[v].is_live) mirror_.vertex(VertexId(v)).current += random_.point(-1e-3, 1e-3);
    }
    ASSERT_TRUE(engine_.set_positions(mirror_.positions()).ok());
    ASSERT_EQ(mirror_.difference(engine_.mesh()), "");
  }

  Engine engine_;
  JournalMirror mirror_;
  Box box_;
  Random random_;
};

EngineOptions in_portions(Profile profile) {
  EngineOptions options;
  options.cut.profile = profile;
  options.maintain.work_units = 100000;
  return options;
}

TEST(JournalReplay, keeps_up_with_random_calls_on_a_body_that_moves) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    RandomCalls(jittered_cube(4, seed), in_portions(Profile::kIncise), seed).run(25);
    RandomCalls(ball(6), in_portions(Profile::kIncise), seed + 10).run(15);
    if (testing::Test::HasFailure()) return;
  }
}
TEST(JournalReplay, keeps_up_with_random_calls_in_the_paper_profile) {
  RandomCalls(kuhn_cube(4), in_portions(Profile::kPaper), 5).run(20);
}

TEST(JournalReplay, brings_velocities_back_with_an_undo_and_a_redo) {
  Engine engine = make_engine(jittered_cube(4, 3));
  JournalMirror mirror = mirror_of(engine.mesh());
  cut(engine, plane(engine, Vec3(1, 0.3, 0.1), 0.6));
  expect_follows(mirror, engine.journal(), engine.mesh());
  const VertexId fresh = mirror.fresh().back();
  mirror.vertex(fresh).velocity = Vec3(7, 8, 9);
  ASSERT_TRUE(engine.undo());
  expect_follows(mirror, engine.journal(), engine.mesh());
  expect_affine_velocity(mirror, 1e-12);
  ASSERT_TRUE(engine.redo());
  expect_follows(mirror, engine.journal(), engine.mesh());
  EXPECT_EQ(mirror.vertex(fresh).velocity, Vec3(7, 8, 9));
}

}  // namespace
}  // namespace incise::test::journal_replay_test
