// SPDX-License-Identifier: Apache-2.0
// What the engine promises its callers: undo and redo bit for bit, all or nothing, tags, errors.
#include "incise/engine/engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test::engine_test {
namespace {

TEST(Engine, undo_and_redo_restore_every_state_bit_for_bit) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    Engine engine = make_engine(jittered_cube(5, 1), 0.2, profile);
    std::vector<std::uint64_t> hashes = {engine.mesh().hash()};
    Random random(2);
    for (unsigned i = 0; i < 8; ++i) {
      cut(engine, random_stroke(random, rest_bounds(engine.mesh())));
      hashes.push_back(engine.mesh().hash());
    }
    const double volume = volume_of(engine.mesh());
    for (std::size_t i = hashes.size() - 1; i > 0; --i) {
      ASSERT_TRUE(engine.undo());
      EXPECT_EQ(engine.mesh().hash(), hashes[i - 1]);
      EXPECT_EQ(engine.stroke_count(), i - 1);
    }
    EXPECT_FALSE(engine.undo());
    expect_valid(engine.mesh(), volume);
    for (std::size_t i = 1; i < hashes.size(); ++i) {
      ASSERT_TRUE(engine.redo());
      EXPECT_EQ(engine.mesh().hash(), hashes[i]);
      expect_valid(engine.mesh(), volume);
    }
    EXPECT_FALSE(engine.redo());
  }
}

TEST(Engine, fifty_cuts_undone_in_turn_return_every_hash) {
  Engine engine = make_engine(kuhn_cube(3));
  const double volume = volume_of(engine.mesh());
  std::vector<std::uint64_t> hashes = {engine.mesh().hash()};
  Random random(3);
  for (unsigned i = 0; i < 50; ++i) {
    const Vec3 normal = random_direction(random);
    ASSERT_TRUE(engine.cut(plane(engine, normal, normal.dot(random.point(0.1, 0.9)))).ok());
    hashes.push_back(engine.mesh().hash());
  }
  expect_valid(engine.mesh(), volume);
  for (std::size_t i = 50; i > 0; --i) {
    ASSERT_TRUE(engine.undo());
    ASSERT_EQ(engine.mesh().hash(), hashes[i - 1]) << "after taking cut " << i << " back";
  }
  expect_valid(engine.mesh(), volume);
  for (std::size_t i = 1; i <= 50; ++i) {
    ASSERT_TRUE(engine.redo());
    ASSERT_EQ(engine.mesh().hash(), hashes[i]) << "after cut " << i << " again";
  }
  expect_valid(engine.mesh(), volume);
}

TEST(Engine, cutting_after_an_undo_gives_the_same_bits_as_without_it) {
  const auto first = [](const Engine& e) { return plane(e, Vec3(1, 0.2, 0.1), 0.6); };
  const auto second = [](const Engine& e) { return plane(e, Vec3(0.1, 1, -0.3), 0.4); };
  Engine straight = make_engine(kuhn_cube(4));
  cut(straight, second(straight));
  Engine detour = make_engine(kuhn_cube(4));
  cut(detour, first(detour));
  ASSERT_TRUE(detour.undo());
  cut(detour, second(detour));
  EXPECT_EQ(detour.mesh().hash(), straight.mesh().hash());
  EXPECT_FALSE(detour.redo());
}

TEST(Engine, a_cut_that_changes_nothing_can_be_undone_like_any_other) {
  Engine engine = make_engine(kuhn_cube(3));
  cut(engine, plane(engine, Vec3(1, 0, 0), 0.5));
  const std::uint64_t hash = engine.mesh().hash();
  cut(engine, plane(engine, Vec3(1, 0, 0), 7.0));
  EXPECT_EQ(engine.stroke_count(), 2U);
  EXPECT_TRUE(engine.undo());
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_TRUE(engine.undo());
  EXPECT_EQ(engine.mesh().tet_count(), 162U);
  EXPECT_TRUE(engine.redo());
  EXPECT_EQ(engine.mesh().hash(), hash);
  expect_valid(engine.mesh(), 1.0);
}

TEST(Engine, walls_carry_the_number_of_their_stroke) {
  Engine engine = make_engine(kuhn_cube(5));
  cut(engine, plane(engine, Vec3(1, 0, 0), 0.47));
  cut(engine, plane(engine, Vec3(0, 1, 0), 0.53));
  EXPECT_NEAR(wall_area(engine.mesh(), 1), 1.0, 1e-12);
  EXPECT_NEAR(wall_area(engine.mesh(), 2), 1.0, 1e-12);
  EXPECT_EQ(wall_area(engine.mesh(), 3), 0.0);
}

TEST(Engine, regions_are_inherited_and_keep_their_volumes) {
  TetSoup soup = kuhn_cube(4);
  for (std::size_t t = 0; t < soup.tets.size(); ++t) {
    const Vec3 centre = (soup.points[soup.tets[t][0]] + soup.points[soup.tets[t][3]]) / 2;
    soup.regions.push_back(centre.z() < 0.5 ? 7 : -3);
  }
  for (const double snap : {0.0, 0.2}) {
    Engine engine = make_engine(soup, snap);
    cut(engine, plane(engine, Vec3(1, 0.4, 0), 0.63));
    double low = 0, high = 0;
    engine.mesh().for_each_tet(
        [&](TetId tet) { (engine.mesh().region(tet) == 7 ? low : high) += engine.mesh().rest_volume(tet); });
    EXPECT_NEAR(low + high, 1.0, 1e-12);
    if (snap == 0) {
      EXPECT_NEAR(low, 0.5, 1e-12);
    }
  }
}

TEST(Engine, reports_counts_that_the_mesh_confirms) {
  Engine engine = make_engine(jittered_cube(4, 6));
  const std::size_t tets = engine.mesh().tet_count(), vertices = engine.mesh().vertex_count();
  const Result<StrokeReport> report = engine.cut(plane(engine, Vec3(0.3, 0.5, 0.9), 0.8));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(engine.mesh().tet_count(), tets + static_cast<std::size_t>(report->cut.created_tets));
  EXPECT_EQ(engine.mesh().vertex_count(), vertices + static_cast<std::size_t>(report->cut.new_vertices));
  EXPECT_EQ(report->cut.steps, 1U);
  EXPECT_EQ(report->stroke, 1U);
  EXPECT_GT(report->cut.snapped_vertices, 0U);
  expect_valid(engine.mesh(), 1.0);
}

// --- maintenance
// -------------------------------------------------------------------------------------------------------------

/// Cuts that leave slivers, on an engine that maintains.
Engine make_maintaining_engine(std::uint64_t work_units, Profile profile = Profile::kIncise) {
  EngineOptions options;
  options.cut = {profile, 0.0};
  options.maintain.work_units = work_units;
  return Engine::create(build(jittered_cube(5, 9)), options).value();
}

/// The volume as maintenance keeps it.
double tolerance_of(Profile profile) {
  return profile == Profile::kPaper ? 1e-2 : 1e-9;
}

TEST(EngineMaintenance, is_taken_back_with_its_stroke_and_applied_again) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    Engine engine = make_maintaining_engine(kUnlimitedWork, profile);
    std::vector<std::uint64_t> hashes = {engine.mesh().hash()};
    for (const Vec3& normal : {Vec3(1, 0.1, 0.2), Vec3(0.2, 1, -0.1), Vec3(-0.1, 0.2, 1)}) {
      ASSERT_TRUE(engine.cut(plane(engine, normal, 0.57)).ok());
      expect_valid(engine.mesh(), 1.0, tolerance_of(profile));
      hashes.push_back(engine.mesh().hash());
    }
    for (std::size_t i = 3; i > 0; --i) {
      ASSERT_TRUE(engine.undo());
      EXPECT_EQ(engine.mesh().hash(), hashes[i - 1]);
    }
    for (std::size_t i = 1; i <= 3; ++i) {
      ASSERT_TRUE(engine.redo());
      EXPECT_EQ(engine.mesh().hash(), hashes[i]);
    }
    expect_valid(engine.mesh(), 1.0, tolerance_of(profile));
  }
}

TEST(EngineMaintenance, in_portions_belongs_to_the_last_stroke) {
  Engine engine = make_maintaining_engine(0);
  const std::uint64_t before = engine.mesh().hash();
  const Result<StrokeReport> report = engine.cut(plane(engine, Vec3(1, 0.1, 0.2), 0.57));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->maintain.work_units, 0U);
  MaintainStatistics sum;
  while (engine.has_maintenance()) {
    const MaintainReport portion = *engine.maintain(100);
    ASSERT_GT(portion.maintain.work_units, 0U) << "what waits must be worked on";
    sum += portion.maintain;
  }
  EXPECT_EQ(sum.waiting_tets, 0U);
  EXPECT_EQ(engine.stroke_count(), 1U);
  expect_valid(engine.mesh(), 1.0, 1e-9);
  const std::uint64_t after = engine.mesh().hash();
  ASSERT_TRUE(engine.undo());
  EXPECT_EQ(engine.mesh().hash(), before);
  ASSERT_TRUE(engine.redo());
  EXPECT_EQ(engine.mesh().hash(), after);
  EXPECT_FALSE(engine.redo());
}

TEST(EngineMaintenance, that_waits_is_dropped_by_an_undo) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    Engine engine = make_maintaining_engine(0, profile);
    const std::uint64_t before = engine.mesh().hash();
    ASSERT_TRUE(engine.cut(plane(engine, Vec3(1, 0.1, 0.2), 0.57)).ok());
    ASSERT_TRUE(engine.undo());
    EXPECT_FALSE(engine.has_maintenance());
    EXPECT_EQ(engine.maintain()->maintain.work_units, 0U);
    EXPECT_EQ(engine.mesh().hash(), before);
    expect_valid(engine.mesh(), 1.0);
  }
}

TEST(EngineMaintenance, switched_off_does_nothing_when_asked) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    Engine engine = make_engine(jittered_cube(4, 9), 0.0, profile);
    cut(engine, plane(engine, Vec3(1, 0.1, 0.2), 0.57));
    const std::uint64_t hash = engine.mesh().hash();
    EXPECT_TRUE(engine.maintain().ok());
    EXPECT_EQ(engine.mesh().hash(), hash);
    EXPECT_TRUE(engine.improve().ok());
    EXPECT_EQ(engine.mesh().hash(), hash);
  }
}

TEST(EngineMaintenance, of_the_whole_mesh_is_an_operation_but_no_stroke) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    Engine engine = make_maintaining_engine(kUnlimitedWork, profile);
    const std::uint64_t before = engine.mesh().hash();
    EXPECT_TRUE(engine.improve().ok());
    const std::uint64_t after = engine.mesh().hash();
    expect_valid(engine.mesh(), 1.0, tolerance_of(profile));
    EXPECT_EQ(engine.stroke_count(), 0U);
    ASSERT_TRUE(engine.undo());
    EXPECT_EQ(engine.mesh().hash(), before);
    ASSERT_TRUE(engine.redo());
    EXPECT_EQ(engine.mesh().hash(), after);
  }
}

TEST(EngineMaintenance, accounts_for_the_tets_that_it_takes_away) {
  Engine engine = make_maintaining_engine(kUnlimitedWork);
  const auto tets = [&] { return static_cast<std::int64_t>(engine.mesh().tet_count()); };
  const std::int64_t before = tets();
  const Result<StrokeReport> report = engine.cut(plane(engine, Vec3(1, 0.1, 0.2), 0.57));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(tets(), before + report->cut.created_tets + report->maintain.created_tets);
}

// --- refusals
// ----------------------------------------------------------------------------------------------------------------

void expect_refused(const Stroke& stroke) {
  Engine engine = make_engine(kuhn_cube(2));
  const std::uint64_t hash = engine.mesh().hash();
  const Result<StrokeReport> report = engine.cut(stroke);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::kBadArgument);
  EXPECT_NE(report.error().message.find(stroke.name), std::string::npos) << report.error().message;
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_EQ(engine.stroke_count(), 0U);
  expect_valid(engine.mesh(), 1.0);
}

TEST(Engine, refuses_malformed_strokes_and_names_them) {
  const Stroke good = quad_stroke(Vec3(0.4, -1, -1), Vec3(0.4, 2, -1), Vec3(0.4, -1, 2), Vec3(0.4, 2, 2), 3);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Stroke bad = good;
  bad.times[2] = bad.times[1];
  expect_refused(bad);
  bad = good;
  bad.times[3] = nan;
  expect_refused(bad);
  bad = good;
  bad.times.pop_back();
  expect_refused(bad);
  bad = good;
  bad.edges[1].pop_back();
  expect_refused(bad);
  bad = good;
  bad.edges[2][1].y() = inf;
  expect_refused(bad);
  bad = good;
  for (auto& edge : bad.edges) edge.resize(1);
  expect_refused(bad);
  bad = good;
  bad.times.resize(1);
  bad.edges.resize(1);
  expect_refused(bad);
  bad.times.clear();
  bad.edges.clear();
  expect_refused(bad);
}

void expect_bad_pose(const Status& status, const std::string& message) {
  ASSERT_FALSE(status.ok()) << message;
  EXPECT_EQ(status.error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(status.error().message, message);
}

Status status_of(const Result<StepReport>& report) {
  return report.ok() ? Status() : Status(report.error());
}

TEST(Engine, says_which_pose_is_malformed_and_how) {
  Engine engine = make_engine(kuhn_cube(2));
  cut(engine, plane(engine, Vec3(1, 0, 0), 0.3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const BladePose good{{Vec3(0.6, -0.1, 1.1), Vec3(0.6, 1.1, 1.1)}};
  expect_bad_pose(engine.check_pose({}), "pose 0 of stroke 2: its edge has 0 points; it needs at least 2");
  ASSERT_TRUE(engine.begin_stroke(good).ok());
  ASSERT_TRUE(engine.step({{Vec3(0.6, -0.1, 0.8), Vec3(0.6, 1.1, 0.8)}}).ok());
  const std::uint64_t hash = engine.mesh().hash();
  BladePose bad = good;
  bad.edge.pop_back();
  expect_bad_pose(status_of(engine.step(bad)), "pose 2 of stroke 2: its edge has 1 point; it needs at least 2");
  bad.edge.assign(3, Vec3(0.6, 0.5, 0.5));
  expect_bad_pose(status_of(engine.step(bad)),
                  "pose 2 of stroke 2: its edge has 3 points; all poses of a stroke have as many as its first, 2");
  bad = good;
  bad.edge[1].z() = nan;
  expect_bad_pose(status_of(engine.step(bad)), "pose 2 of stroke 2: point 1 of its edge is not finite");
  bad = good;
  bad.direction.x() = nan;
  expect_bad_pose(status_of(engine.step(bad)), "pose 2 of stroke 2: its direction is not finite");
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_TRUE(engine.is_in_stroke());
  expect_valid(engine.mesh(), 1.0);
}

TEST(Engine, refuses_maintenance_while_a_stroke_is_under_way) {
  Engine engine = make_engine(kuhn_cube(2));
  ASSERT_TRUE(engine.begin_stroke({{Vec3(0.6, -0.1, 1.1), Vec3(0.6, 1.1, 1.1)}}).ok());
  for (const Result<MaintainReport>& report : {engine.maintain(), engine.improve()}) {
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, ErrorCode::kBadArgument);
    EXPECT_NE(report.error().message.find("end it first"), std::string::npos) << report.error().message;
  }
  EXPECT_TRUE(engine.is_in_stroke());
  ASSERT_TRUE(engine.end_stroke().ok());
  EXPECT_TRUE(engine.maintain().ok());
  EXPECT_TRUE(engine.improve().ok());
}

TEST(Engine, lifts_a_blade_where_it_was_put_down) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    Engine engine = make_engine(kuhn_cube(2), 0.2, profile);
    const std::uint64_t hash = engine.mesh().hash();
    ASSERT_TRUE(engine.begin_stroke({{Vec3(0.6, -0.1, 0.5), Vec3(0.6, 1.1, 0.5)}}).ok());
    ASSERT_TRUE(engine.end_stroke().ok());
    EXPECT_EQ(engine.mesh().hash(), hash);
    EXPECT_EQ(engine.stroke_count(), 1U);
    EXPECT_TRUE(engine.undo());
  }
}

TEST(Engine, gives_the_same_mesh_on_any_number_of_threads) {
  TetSoup soup = kuhn_cube(24);  // several blocks of tets, vertices and edges
  jitter(soup, 0.2, 5);
  Stroke stroke;
  stroke.name = "wave";
  for (int i = 0; i <= 12; ++i) {
    const double y = -0.1 + 0.1 * i, x = 0.5 + 0.02 * ((i % 4) - 1.5);
    stroke.times.push_back(i);
    stroke.edges.push_back({Vec3(x, y, -0.1), Vec3(x + 0.1, y, 1.1)});
  }
  std::vector<std::uint64_t> hashes;
  for (const unsigned threads : {1U, 2U, 5U}) {
    EngineOptions options;
    options.threads = threads;
    Engine engine = Engine::create(TetMesh::build(soup).value(), options).value();
    ASSERT_TRUE(engine.cut(stroke).ok());
    hashes.push_back(engine.mesh().hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(Engine, refuses_options_out_of_range) {
  for (const double snap : {-0.1, 0.41, std::numeric_limits<double>::quiet_NaN()}) {
    EngineOptions options;
    options.cut.snap = snap;
    EXPECT_FALSE(Engine::create(build(kuhn_cube(1)), options).ok());
  }
  for (const unsigned threads : {0U, 257U}) {
    EngineOptions options;
    options.threads = threads;
    EXPECT_FALSE(Engine::create(build(kuhn_cube(1)), options).ok());
  }
}

TEST(Engine, of_an_empty_mesh_cuts_nothing) {
  Engine engine = make_engine(TetSoup{});
  const Result<StrokeReport> report =
      engine.cut(quad_stroke(Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->cut.created_tets, 0);
}

TEST(Engine, of_a_body_whose_points_all_coincide_cuts_nothing) {
  TetSoup soup = kuhn_cube(3);
  for (Vec3& point : soup.points) point = Vec3(0.3, -2, 7);
  auto built = TetMesh::build(std::move(soup));
  ASSERT_TRUE(built.ok()) << built.error().message;
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    EngineOptions options;
    options.cut.profile = profile;
    auto engine = Engine::create(*built, options);
    ASSERT_TRUE(engine.ok()) << engine.error().message;
    const std::uint64_t before = engine->mesh().hash();
    Stroke stroke;
    stroke.times = {0, 1};
    stroke.edges = {{{0.3, -3, 6}, {0.3, -3, 8}}, {{0.3, -1, 6}, {0.3, -1, 8}}};
    const auto report = engine->cut(stroke);
    EXPECT_TRUE(!report.ok() || report->cut.cut_tets == 0);
    EXPECT_EQ(engine->mesh().hash(), before);
  }
}

TEST(PlaneStroke, refuses_planes_without_a_direction) {
  const Box box{Vec3(0, 0, 0), Vec3(1, 1, 1)};
  EXPECT_FALSE(plane_stroke(box, Vec3(0, 0, 0), 1).ok());
  EXPECT_FALSE(plane_stroke(box, Vec3(std::numeric_limits<double>::infinity(), 0, 0), 1).ok());
  EXPECT_FALSE(plane_stroke(box, Vec3(1, 0, 0), std::numeric_limits<double>::quiet_NaN()).ok());
}

/// A straight blade along y through a cube, `reach` beyond it on either side, that moves down.
Stroke long_stroke(double reach, unsigned steps) {
  return quad_stroke(Vec3(0.51, -reach, 1.3), Vec3(0.53, reach, 1.3), Vec3(0.46, -reach, -0.3), Vec3(0.48, reach, -0.3),
                     steps);
}

StrokeReport cut_by_steps(Engine& engine, const Stroke& stroke) {
  EXPECT_TRUE(engine.begin_stroke({stroke.edges.front()}).ok());
  for (std::size_t i = 1; i < stroke.edges.size(); ++i) EXPECT_TRUE(engine.step({stroke.edges[i]}).ok());
  Result<StrokeReport> report = engine.end_stroke();
  EXPECT_TRUE(report.ok());
  return *report;
}

TEST(EngineFarBlades, cut_as_near_ones_do) {
  for (const double reach : {1e1, 1e4, 0.99e6}) {
    SCOPED_TRACE(reach);
    for (const unsigned steps : {0U, 1U, 20U}) {
      Engine engine = make_engine(jittered_cube(6, 4), 0.2);
      const Stroke stroke = long_stroke(reach, std::max(steps, 1U));
      steps == 0 ? static_cast<void>(cut(engine, stroke)) : static_cast<void>(cut_by_steps(engine, stroke));
      EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
      expect_valid(engine.mesh(), 1.0);
    }
  }
}

/// Whether a body that stands moved comes apart under a blade.
std::size_t pieces_where_moved(const Stroke& stroke) {
  Engine engine = make_engine(jittered_cube(6, 4), 0.2);
  std::vector<Vec3> positions(engine.mesh().vertex_slots());
  engine.mesh().for_each_vertex([&](VertexId v) {
    const Vec3& p = engine.mesh().rest(v);
    positions[v.value] = p + Vec3(0.02 * p.z(), 0.03 * p.x(), 0.01);
  });
  EXPECT_TRUE(engine.set_positions(positions).ok());
  cut_by_steps(engine, stroke);
  expect_valid(engine.mesh(), 1.0);
  return find_components(engine.mesh()).count();
}

TEST(EngineFarBlades, cut_a_body_that_has_moved) {
  for (const double reach : {1.5, 1e4, 0.99e6}) {
    SCOPED_TRACE(reach);
    EXPECT_EQ(pieces_where_moved(long_stroke(reach, 20)), 2U);
  }
}

TEST(EngineFarBlades, may_come_to_a_body_that_has_moved_from_far_away) {
  for (const double height : {2.0, 1e4, 0.99e6}) {
    SCOPED_TRACE(height);
    EXPECT_EQ(pieces_where_moved(quad_stroke(Vec3(0.51, -0.4, height), Vec3(0.53, 1.4, height),
                                             Vec3(0.46, -0.4, -height), Vec3(0.48, 1.4, -height))),
              2U);
  }
}

/// Two tets on one side of the face between them, neither of which is inverted.
TEST(EngineFolds, are_told_with_what_helps_and_are_cut_but_not_maintained) {
  const TetSoup soup{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.4, 0.2, 0.6}}, {{0, 1, 2, 3}, {0, 1, 2, 4}}, {}};
  std::string told;
  EngineOptions options;
  options.log = [&](LogLevel, std::string_view text) { told += text; };
  Result<Engine> engine = Engine::create(build(soup), options);
  ASSERT_TRUE(engine.ok());
  EXPECT_NE(told.find("two neighbours lie on one side of the face between them"), std::string::npos) << told;
  EXPECT_NE(told.find("mesh it again"), std::string::npos) << told;
  const Result<StrokeReport> report = engine->cut(plane(*engine, Vec3(1, 0, 0), 0.3));
  ASSERT_TRUE(report.ok());
  EXPECT_GT(report->cut.cut_tets, 0U);
  EXPECT_EQ(report->maintain.work_units, 0U);
}

TEST(EngineEmpty, has_nothing_that_a_plane_could_cut) {
  const Result<Stroke> plane = plane_stroke(rest_bounds(TetMesh::build({}).value()), Vec3::UnitX(), 0);
  ASSERT_FALSE(plane.ok());
  EXPECT_NE(plane.error().message.find("no vertices"), std::string::npos) << plane.error().message;
}

TEST(EngineFarBlades, beyond_a_million_bodies_are_refused_and_change_nothing) {
  Engine engine = make_engine(jittered_cube(3, 4), 0.2);
  const std::uint64_t hash = engine.mesh().hash();
  for (const double reach : {1.1e6, 1e12, 1e150, 1e308}) {
    SCOPED_TRACE(reach);
    Stroke stroke = long_stroke(1.5, 2);
    stroke.name = "slip";
    stroke.edges[2][1].y() = reach;
    const Result<StrokeReport> whole = engine.cut(stroke);
    ASSERT_FALSE(whole.ok());
    EXPECT_EQ(whole.error().code, ErrorCode::kBadArgument);
    EXPECT_NE(whole.error().message.find("stroke \"slip\": point 1 at time 2 lies"), std::string::npos)
        << whole.error().message;
    ASSERT_TRUE(engine.begin_stroke({stroke.edges[0]}).ok());
    ASSERT_TRUE(engine.step({stroke.edges[1]}).ok());
    const Result<StepReport> step = engine.step({stroke.edges[2]});
    ASSERT_FALSE(step.ok());
    EXPECT_NE(step.error().message.find("pose 2 of stroke 1: point 1 lies"), std::string::npos) << step.error().message;
    EXPECT_TRUE(engine.is_in_stroke());
    EXPECT_TRUE(engine.undo());
    EXPECT_FALSE(engine.begin_stroke({stroke.edges[2]}).ok());
  }
  EXPECT_EQ(engine.mesh().hash(), hash);
}

TEST(EngineSizes, of_bodies_from_least_to_greatest_are_cut_and_maintained_alike) {
  const auto cut_scaled = [](double by) {
    TetSoup soup = ball(6);
    Stroke stroke = *plane_stroke(rest_bounds(build(soup)), Vec3(0.3, 0.5, 0.9), 0.1);
    for (Vec3& p : soup.points) p *= by;
    for (auto& edge : stroke.edges) {
      for (Vec3& p : edge) p *= by;
    }
    Engine engine = Engine::create(build(std::move(soup))).value();
    EXPECT_TRUE(engine.cut(stroke).ok());
    EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
    return std::pair(engine.mesh().tet_count(), find_components(engine.mesh()).count());
  };
  const auto usual = cut_scaled(1.0);
  EXPECT_EQ(usual.second, 2U);
  // Powers of two change no digit of what is computed.
  EXPECT_EQ(cut_scaled(0x1p98), usual);
  EXPECT_EQ(cut_scaled(0x1p-1), usual);
  EXPECT_EQ(cut_scaled(0x1p-98), usual);
}

}  // namespace
}  // namespace incise::test::engine_test
