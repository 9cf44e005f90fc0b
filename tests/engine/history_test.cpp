// SPDX-License-Identifier: Apache-2.0
// What the engine keeps of its operations, and how it takes back what went wrong.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/journal_cursor.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/mirror_checks.h"
#include "support/random_strokes.h"

namespace incise::test::history_test {
namespace {

Engine new_engine(EngineOptions options = {}) {
  return Engine::create(build(jittered_cube(4, 3)), std::move(options)).value();
}

std::vector<Stroke> six_strokes(const Engine& engine) {
  std::vector<Stroke> strokes;
  Random random(8);
  for (unsigned i = 0; i < 6; ++i) {
    const Vec3 normal = random_direction(random);
    strokes.push_back(plane(engine, normal, normal.dot(random.point(0.2, 0.8))));
  }
  return strokes;
}

TEST(EngineHistory, keeps_as_many_operations_as_asked_and_frees_the_rest) {
  Engine all = new_engine(), few = new_engine();
  JournalCursor follower(few.journal()), sleeper(few.journal());
  ASSERT_TRUE(few.keep_undo(2).ok());
  std::vector<std::uint64_t> hashes = {all.mesh().hash()};
  for (const Stroke& stroke : six_strokes(all)) {
    ASSERT_TRUE(all.cut(stroke).ok());
    ASSERT_TRUE(few.cut(stroke).ok());
    EXPECT_EQ(few.mesh().hash(), all.mesh().hash());
    hashes.push_back(all.mesh().hash());
    EXPECT_EQ(follower.way_to(few.journal()), JournalCursor::Way::kForward) << "who follows each call loses nothing";
    follower.move_to(few.journal());
  }
  EXPECT_EQ(few.journal().position(), all.journal().position());
  EXPECT_LT(few.journal().memory_bytes(), all.journal().memory_bytes() / 2);
  EXPECT_EQ(sleeper.way_to(few.journal()), JournalCursor::Way::kElsewhere);
  for (const std::size_t i : {5U, 4U}) {
    ASSERT_TRUE(few.undo());
    EXPECT_EQ(few.mesh().hash(), hashes[i]);
  }
  EXPECT_FALSE(few.undo());
  EXPECT_EQ(few.stroke_count(), 4U);
  ASSERT_TRUE(few.redo());
  ASSERT_TRUE(few.redo());
  EXPECT_EQ(few.mesh().hash(), hashes[6]);
  expect_valid(few.mesh(), 1.0, 1e-9);
}

TEST(EngineHistory, is_trimmed_at_once_and_never_to_nothing) {
  Engine engine = new_engine();
  for (const Stroke& stroke : six_strokes(engine)) ASSERT_TRUE(engine.cut(stroke).ok());
  const std::size_t before = engine.journal().memory_bytes();
  EXPECT_EQ(engine.keep_undo(0).error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(engine.journal().memory_bytes(), before);
  ASSERT_TRUE(engine.keep_undo(1).ok());
  EXPECT_LT(engine.journal().memory_bytes(), before / 3);
  EXPECT_TRUE(engine.undo());
  EXPECT_FALSE(engine.undo());
  expect_valid(engine.mesh(), 1.0, 1e-9);
}

TEST(EngineHistory, keeps_what_maintenance_has_yet_to_see) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    EngineOptions options;
    options.cut.profile = profile;
    options.maintain.work_units = 0;
    Engine all = new_engine(options), few = new_engine(options);
    ASSERT_TRUE(few.keep_undo(1).ok());
    for (const Stroke& stroke : six_strokes(all)) {
      ASSERT_TRUE(all.cut(stroke).ok());
      ASSERT_TRUE(few.cut(stroke).ok());
    }
    ASSERT_TRUE(all.maintain().ok());
    ASSERT_TRUE(few.maintain().ok());
    EXPECT_EQ(few.mesh().hash(), all.mesh().hash());
    EXPECT_TRUE(few.undo());
    EXPECT_FALSE(few.undo()) << "only what maintenance waited for was kept longer";
  }
}

TEST(EngineHistory, is_followed_by_the_mirror_of_the_examples_as_far_as_it_is_kept) {
  Engine engine = new_engine();
  const std::vector<Stroke> strokes = six_strokes(engine);
  ASSERT_TRUE(engine.cut(strokes[0]).ok());
  JournalMirror mirror(engine.mesh(), engine.journal()), late = mirror;
  ASSERT_TRUE(engine.keep_undo(1).ok());
  for (const std::size_t i : {1U, 2U, 3U}) {
    ASSERT_TRUE(engine.cut(strokes[i]).ok());
    expect_follows(mirror, engine.journal(), engine.mesh());
  }
  ASSERT_TRUE(engine.undo());
  expect_follows(mirror, engine.journal(), engine.mesh());
  ASSERT_TRUE(engine.redo());
  expect_follows(mirror, engine.journal(), engine.mesh());
  EXPECT_EQ(mirror.fault(), "");
  late.follow(engine.journal());
  EXPECT_NE(late.fault().find("trimmed"), std::string::npos) << late.fault();
}

TEST(EngineHistory, behind_which_a_mirror_began_is_noticed_even_when_it_has_grown_again) {
  Engine engine = new_engine();
  const std::vector<Stroke> strokes = six_strokes(engine);
  ASSERT_TRUE(engine.cut(strokes[0]).ok());
  JournalMirror mirror(engine.mesh(), engine.journal());
  ASSERT_TRUE(engine.undo());
  for (const std::size_t i : {1U, 2U}) ASSERT_TRUE(engine.cut(strokes[i]).ok());
  ASSERT_GE(engine.journal().position(), mirror.position());
  mirror.follow(engine.journal());
  EXPECT_NE(mirror.fault().find("behind the place"), std::string::npos) << mirror.fault();
}

/// Puts one vertex that a step has touched nowhere, as whoever writes into the mesh behind the engine's back might.
void spoil(const TetMesh& mesh, const Step& step) {
  std::vector<Vec3> places(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { places[v.value] = mesh.current(v); });
  VertexId victim;
  for (const VertexImage& old : step.before.vertices) victim = mesh.is_live(old.id) ? old.id : victim;
  for (const VertexId v : step.new_vertices) victim = mesh.is_live(v) ? v : victim;
  places[victim.value].x() = std::numeric_limits<double>::quiet_NaN();
  const_cast<TetMesh&>(mesh).set_current(places);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

/// Checks each call, and spoils what the call of that number committed.
EngineOptions spoiled_at(unsigned call) {
  EngineOptions options;
  options.check_step = [call, calls = 0U, check = TouchedCheck()](const TetMesh& mesh, const Journal& journal,
                                                                  std::size_t first) mutable {
    if (++calls == call) spoil(mesh, journal.step(first));
    return check(mesh, journal, first);
  };
  return options;
}

template <class Report>
void expect_internal(const Result<Report>& report) {
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::kInternal);
  EXPECT_NE(report.error().message.find("not_finite"), std::string::npos) << report.error().message;
}

TEST(EngineRollback, takes_a_broken_cut_back) {
  for (const unsigned call : {1U, 2U}) {  // the cut itself; its maintenance
    Engine engine = new_engine(spoiled_at(call)), twin = new_engine();
    const std::uint64_t hash = engine.mesh().hash();
    const std::vector<Stroke> strokes = six_strokes(engine);
    expect_internal(engine.cut(strokes[0]));
    EXPECT_EQ(engine.mesh().hash(), hash);
    EXPECT_EQ(engine.journal().position(), 0U);
    EXPECT_EQ(engine.stroke_count(), 0U);
    EXPECT_FALSE(engine.undo());
    EXPECT_FALSE(engine.redo());
    expect_valid(engine.mesh(), 1.0);
    ASSERT_TRUE(engine.cut(strokes[1]).ok());
    ASSERT_TRUE(twin.cut(strokes[1]).ok());
    EXPECT_EQ(engine.mesh().hash(), twin.mesh().hash()) << "nothing of the broken cut is left";
  }
}

TEST(EngineRollback, ends_a_stroke_before_its_broken_step) {
  Engine engine = new_engine(spoiled_at(5));
  const auto pose = [](unsigned i) {
    const double z = 1.1 - 0.1 * i;
    return BladePose{{Vec3(0.52, -0.1, z), Vec3(0.48, 1.1, z)}, Vec3(0, 0, -1)};
  };
  ASSERT_TRUE(engine.begin_stroke(pose(0)).ok());
  std::uint64_t hash = 0;
  std::size_t position = 0;
  Result<StepReport> report = StepReport();
  for (unsigned i = 1; i <= 12 && report.ok(); ++i) {
    hash = engine.mesh().hash();
    position = engine.journal().position();
    report = engine.step(pose(i));
  }
  expect_internal(report);
  EXPECT_GT(position, 0U);
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_EQ(engine.journal().position(), position);
  EXPECT_FALSE(engine.is_in_stroke());
  EXPECT_EQ(engine.stroke_count(), 1U) << "what was cut before stays";
  expect_valid(engine.mesh(), 1.0, 1e-9);
  ASSERT_TRUE(engine.cut(six_strokes(engine)[0]).ok());
  expect_valid(engine.mesh(), 1.0, 1e-9);
  EXPECT_TRUE(engine.undo());
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_TRUE(engine.undo());
}

TEST(EngineRollback, takes_broken_maintenance_back) {
  Engine engine = new_engine(spoiled_at(1));
  const std::uint64_t hash = engine.mesh().hash();
  expect_internal(engine.improve());
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_FALSE(engine.undo()) << "it is no operation";
  expect_valid(engine.mesh(), 1.0);
  ASSERT_TRUE(engine.improve().ok());
  expect_valid(engine.mesh(), 1.0, 1e-9);
}

TEST(EngineRollback, forgets_a_redo_that_the_broken_call_has_taken_the_place_of) {
  Engine engine = new_engine(spoiled_at(3));
  const std::vector<Stroke> strokes = six_strokes(engine);
  ASSERT_TRUE(engine.cut(strokes[0]).ok());  // two checks: of the cut, and of its maintenance
  ASSERT_TRUE(engine.undo());
  const std::uint64_t hash = engine.mesh().hash();
  expect_internal(engine.cut(strokes[1]));
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_FALSE(engine.redo());
  EXPECT_EQ(engine.mesh().hash(), hash);
}

}  // namespace
}  // namespace incise::test::history_test
