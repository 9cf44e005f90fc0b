// SPDX-License-Identifier: Apache-2.0
// Maintenance after cuts: monotone step by step, whole at any time, the same however it is portioned.
#include "improve/maintainer.h"

#include <filesystem>

#include "improve/maintainer_cases.h"
#include "incise/io/mesh_file.h"

namespace incise::test::maintainer_test {
namespace {

/// Tets and places, to compare a mesh with what it was.
struct Snapshot {
  explicit Snapshot(const TetMesh& mesh) {
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) tets.push_back(mesh.vertices(TetId(i)));
    for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) places.push_back(mesh.rest(VertexId(i)));
  }
  [[nodiscard]] double ratio(const TetVertices& v) const {
    return inradius_ratio(places[v[0].value], places[v[1].value], places[v[2].value], places[v[3].value]);
  }
  [[nodiscard]] bool has(std::size_t slot) const { return slot < tets.size() && tets[slot][0].is_valid(); }

  std::vector<TetVertices> tets;
  std::vector<Vec3> places;
};

bool is_same(const Snapshot& a, const Snapshot& b, std::size_t slot) {
  return a.has(slot) && b.has(slot) && a.tets[slot] == b.tets[slot] &&
         std::all_of(a.tets[slot].begin(), a.tets[slot].end(),
                     [&](VertexId v) { return a.places[v.value] == b.places[v.value]; });
}

/// The worst ratio among the tets of `a` that are not the same in `b`; 1 where all are.
double worst_of_changed(const Snapshot& a, const Snapshot& b) {
  double worst = 1;
  for (std::size_t slot = 0; slot < a.tets.size(); ++slot) {
    if (a.has(slot) && !is_same(a, b, slot)) worst = std::min(worst, a.ratio(a.tets[slot]));
  }
  return worst;
}

std::uint64_t operations(const MaintainStatistics& done) {
  return done.collapsed_edges + done.moved_vertices + done.removed_edges + done.removed_faces + done.inserted_vertices +
         done.peeled_tets;
}

/// Where a cut meets an older one, thinning out may cost shape down to this.
constexpr double kEnoughAtSeams = kRegularLr / 18.0;

/// Every operation of a maintenance, one by one. Returns their number.
unsigned expect_monotone(Engine& engine, bool is_first_stroke) {
  unsigned steps = 0;
  Snapshot before(engine.mesh());
  while (engine.has_maintenance()) {
    const std::size_t position = engine.journal().position();
    const MaintainStatistics done = engine.maintain(1)->maintain;
    if (engine.journal().position() == position) {
      EXPECT_EQ(operations(done), 0U);
      continue;
    }
    const Snapshot after(engine.mesh());
    const double worst_before = worst_of_changed(before, after);
    const bool may_thin = !is_first_stroke && done.collapsed_edges > 0;
    EXPECT_GE(worst_of_changed(after, before), may_thin ? std::min(worst_before, kEnoughAtSeams) : worst_before)
        << "collapses " << done.collapsed_edges << " moves " << done.moved_vertices << " edges " << done.removed_edges
        << " faces " << done.removed_faces << " insertions " << done.inserted_vertices << " peeled "
        << done.peeled_tets;
    before = after;
    ++steps;
  }
  return steps;
}

TEST(Maintenance, never_makes_the_worst_of_what_it_touches_worse) {
  for (const Case& scene : all_kinds_of_cuts()) {
    for (const double snap : {0.0, 0.2}) {
      SCOPED_TRACE(scene.name + (snap == 0 ? " without snapping" : ""));
      Engine engine = maintaining_engine(scene.soup, snap, 0);
      const double volume = volume_of(engine.mesh());
      for (const Stroke& stroke : scene.strokes) {
        cut_and_maintain(engine, stroke);
        const double worst = measure_quality(engine.mesh()).lr_max;
        const unsigned steps = expect_monotone(engine, &stroke == &scene.strokes.front());
        EXPECT_TRUE(snap > 0 || steps > 10U) << steps;
        EXPECT_LE(measure_quality(engine.mesh()).lr_max, std::max(worst, 13.0));
      }
      expect_valid(engine.mesh(), volume, 1e-10);
    }
  }
}

TEST(Maintenance, leaves_a_valid_and_no_worse_mesh_whenever_it_is_stopped) {
  for (const Case& scene : all_kinds_of_cuts()) {
    SCOPED_TRACE(scene.name);
    Engine engine = maintaining_engine(scene.soup, 0.0, 0);
    const double volume = volume_of(engine.mesh());
    for (const Stroke& stroke : scene.strokes) {
      cut_and_maintain(engine, stroke);
      double worst = measure_quality(engine.mesh()).lr_max;
      for (std::uint64_t units = 50; engine.has_maintenance(); units += units / 4) {
        EXPECT_TRUE(engine.maintain(units).ok());
        const double now = measure_quality(engine.mesh()).lr_max;
        EXPECT_LE(now, std::max(worst, kRegularLr / kEnoughAtSeams));
        expect_valid(engine.mesh(), volume, 1e-10);
        worst = now;
      }
    }
  }
}

TEST(Maintenance, keeps_the_volume_of_every_piece) {
  for (const Case& scene : all_kinds_of_cuts()) {
    for (const double snap : {0.0, 0.2}) {
      SCOPED_TRACE(scene.name + (snap == 0 ? " without snapping" : ""));
      Engine engine = maintaining_engine(scene.soup, snap, 0);
      for (const Stroke& stroke : scene.strokes) {
        cut_and_maintain(engine, stroke);
        const std::vector<double> volumes = piece_volumes(engine.mesh());
        EXPECT_TRUE(engine.maintain().ok());
        expect_pieces(engine.mesh(), volumes, 1e-10);
      }
      expect_valid(engine.mesh(), volume_of(engine.mesh()));
    }
  }
}

TEST(Maintenance, spends_its_budget_and_at_most_one_attempt_more) {
  const Case scene = planar_case('A', 4, 1);
  Engine engine = maintaining_engine(scene.soup, 0.0, 500);
  const StrokeReport report = cut_and_maintain(engine, scene.strokes[0]);
  EXPECT_GE(report.maintain.work_units, 500U);
  EXPECT_LT(report.maintain.work_units, 3500U);
  EXPECT_GT(report.maintain.waiting_tets, 0U);
  EXPECT_TRUE(engine.has_maintenance());
  expect_valid(engine.mesh(), 1.0);
}

/// Of the first stroke: to a second one the slots differ, which decide its ties.
TEST(Maintenance, in_portions_does_what_it_does_in_one_go) {
  for (const Case& scene : all_kinds_of_cuts()) {
    for (const std::uint64_t portion : {1U, 777U}) {
      SCOPED_TRACE(scene.name + " in portions of " + std::to_string(portion));
      Engine whole = maintaining_engine(scene.soup, 0.0), portions = maintaining_engine(scene.soup, 0.0, 0);
      const MaintainStatistics once = cut_and_maintain(whole, scene.strokes[0]).maintain;
      MaintainStatistics sum = cut_and_maintain(portions, scene.strokes[0]).maintain;
      while (portions.has_maintenance()) sum += portions.maintain(portion)->maintain;
      EXPECT_EQ(sum.collapsed_edges, once.collapsed_edges);
      EXPECT_EQ(sum.moved_vertices, once.moved_vertices);
      EXPECT_EQ(sum.removed_edges, once.removed_edges);
      EXPECT_EQ(sum.removed_faces, once.removed_faces);
      EXPECT_EQ(sum.inserted_vertices, once.inserted_vertices);
      EXPECT_EQ(sum.peeled_tets, once.peeled_tets);
      EXPECT_EQ(sum.work_units, once.work_units);
      EXPECT_EQ(sum.created_tets, once.created_tets);
      EXPECT_EQ(sum.waiting_tets, 0U);
      EXPECT_TRUE(shape_list(portions.mesh()) == shape_list(whole.mesh()));
      expect_valid(portions.mesh(), volume_of(portions.mesh()));
    }
  }
}

TEST(Maintenance, of_the_same_units_in_other_portions_is_the_same) {
  const Case scene = planar_case('A', 4, 1);
  Engine portions = maintaining_engine(scene.soup, 0.0, 0);
  cut_and_maintain(portions, scene.strokes[0]);
  std::uint64_t spent = 0;
  for (unsigned i = 0; i < 20; ++i) spent += portions.maintain(100)->maintain.work_units;
  Engine once = maintaining_engine(scene.soup, 0.0, spent);
  EXPECT_EQ(cut_and_maintain(once, scene.strokes[0]).maintain.work_units, spent);
  EXPECT_TRUE(shape_list(once.mesh()) == shape_list(portions.mesh()));
  expect_valid(once.mesh(), 1.0);
}

TEST(Maintenance, stops_between_operations_where_it_is_told_to) {
  const Case scene = planar_case('A', 4, 1);
  Engine engine = maintaining_engine(scene.soup, 0.0, 0);
  cut_and_maintain(engine, scene.strokes[0]);
  const std::uint64_t hash = engine.mesh().hash();
  EXPECT_EQ(engine.maintain(kUnlimitedWork, [] { return true; })->maintain.work_units, 0U);
  EXPECT_EQ(engine.mesh().hash(), hash);
  unsigned asked = 0;
  const MaintainStatistics some = engine.maintain(kUnlimitedWork, [&] { return ++asked > 40; })->maintain;
  EXPECT_GT(operations(some), 0U);
  EXPECT_LE(operations(some), 60U);
  EXPECT_TRUE(engine.has_maintenance());
  expect_valid(engine.mesh(), 1.0);
  Engine again = maintaining_engine(scene.soup, 0.0, some.work_units);
  cut_and_maintain(again, scene.strokes[0]);
  EXPECT_EQ(again.mesh().hash(), engine.mesh().hash()) << "units alone must bring a stop by a clock back";
}

TEST(Maintenance, is_taken_back_with_its_cut_bit_for_bit) {
  for (const Case& scene : all_kinds_of_cuts()) {
    SCOPED_TRACE(scene.name);
    Engine engine = maintaining_engine(scene.soup, 0.2, 300);
    std::vector<std::uint64_t> hashes = {engine.mesh().hash()};
    for (const Stroke& stroke : scene.strokes) {
      cut_and_maintain(engine, stroke);
      while (engine.has_maintenance()) EXPECT_TRUE(engine.maintain(1000).ok());
      hashes.push_back(engine.mesh().hash());
    }
    for (std::size_t i = hashes.size() - 1; i > 0; --i) {
      ASSERT_TRUE(engine.undo());
      EXPECT_EQ(engine.mesh().hash(), hashes[i - 1]);
    }
    for (std::size_t i = 1; i < hashes.size(); ++i) {
      ASSERT_TRUE(engine.redo());
      EXPECT_EQ(engine.mesh().hash(), hashes[i]);
    }
    expect_valid(engine.mesh(), volume_of(engine.mesh()));
  }
}

TEST(Maintenance, gives_the_same_mesh_twice_and_on_any_number_of_threads) {
  for (const Case& scene : all_kinds_of_cuts()) {
    SCOPED_TRACE(scene.name);
    const auto run = [&](unsigned threads) {
      Engine engine = maintaining_engine(scene.soup, 0.2, kUnlimitedWork, threads);
      for (const Stroke& stroke : scene.strokes) cut_and_maintain(engine, stroke);
      expect_valid(engine.mesh(), volume_of(engine.mesh()));
      return engine.mesh().hash();
    };
    const std::uint64_t hash = run(1);
    for (const unsigned threads : {1U, 2U, 8U}) EXPECT_EQ(run(threads), hash) << threads << " threads";
  }
}

TEST(Maintenance, merges_alone_and_improves_alone) {
  const Case scene = planar_case('A', 4, 1);
  for (const bool merges : {true, false}) {
    EngineOptions options;
    options.cut.snap = 0;
    options.maintain.merge = merges;
    options.maintain.improve = !merges;
    Result<Engine> engine = Engine::create(build(scene.soup), options);
    ASSERT_TRUE(engine.ok());
    const MaintainStatistics done = cut_and_maintain(*engine, scene.strokes[0]).maintain;
    EXPECT_EQ(done.collapsed_edges > 0, merges);
    EXPECT_EQ(done.removed_edges > 0, !merges);
    EXPECT_EQ(done.removed_faces + done.inserted_vertices + done.peeled_tets > 0, !merges);
    EXPECT_FALSE(engine->has_maintenance());
    expect_valid(engine->mesh(), 1.0, 1e-10);
  }
}

TEST(Maintenance, merges_nothing_for_trial_where_merging_is_off) {
  for (const Case& scene : all_kinds_of_cuts()) {
    SCOPED_TRACE(scene.name);
    EngineOptions options;
    options.maintain.merge = false;
    Result<Engine> engine = Engine::create(build(scene.soup), options);
    ASSERT_TRUE(engine.ok());
    for (const Stroke& stroke : scene.strokes) {
      EXPECT_EQ(cut_and_maintain(*engine, stroke).maintain.collapsed_edges, 0U);
    }
  }
}

TEST(Maintenance, counts_what_it_made) {
  const Case scene = planar_case('A', 4, 1);
  Engine engine = maintaining_engine(scene.soup, 0.0);
  const StrokeReport report = cut_and_maintain(engine, scene.strokes[0]);
  EXPECT_EQ(static_cast<std::int64_t>(engine.mesh().tet_count()),
            static_cast<std::int64_t>(scene.soup.tets.size()) + report.cut.created_tets + report.maintain.created_tets);
  std::size_t moves = 0, born = 0, peeled_or_merged = 0;
  for (std::size_t i = 1; i < engine.journal().size(); ++i) {
    moves += engine.journal().step(i).moved.size();
    born += engine.journal().step(i).born.size();
    peeled_or_merged += engine.journal().step(i).died.size();
  }
  EXPECT_EQ(moves, report.maintain.moved_vertices);
  EXPECT_EQ(born, report.maintain.inserted_vertices);
  EXPECT_GE(peeled_or_merged, report.maintain.collapsed_edges);
  expect_valid(engine.mesh(), 1.0, 1e-10);
}

/// Splits an edge of a vertex in a step of its own.
void split_edge(TetMesh& mesh, Journal& journal, VertexId vertex) {
  Transaction transaction(mesh);
  const TetId tet = mesh.tet_of(vertex);
  const SplitEdgePlan plan =
      plan_split_edge(mesh, vertex, mesh.vertices(tet)[(mesh.corner_of(tet, vertex) + 1) % 4], tet, 0.5);
  ASSERT_TRUE(plan);
  apply(transaction, plan);
  journal.append(transaction.commit());
}

/// Moves a vertex in a step of its own.
void move_to(TetMesh& mesh, Journal& journal, VertexId vertex, const Vec3& place) {
  Transaction transaction(mesh);
  const MoveVertexPlan plan = plan_move_vertex(mesh, vertex, place);
  ASSERT_TRUE(plan);
  apply(transaction, plan);
  journal.append(transaction.commit());
}

/// While something waits for the blade to get on, what was touched stays in care; touched again, it is looked at again.
TEST(Maintenance, looks_again_at_what_is_touched_again) {
  TetMesh mesh = build(kuhn_cube(6));
  Journal journal;
  StageTimes times;
  Maintainer maintainer;
  const VertexId vertex = nearest_vertex(mesh, Vec3(1, 1, 1) / 3.0), waiting = nearest_vertex(mesh, Vec3(1, 1, 1));
  const Vec3 place = mesh.rest(vertex);
  const IsLocked is_locked = [&](TetId tet) { return mesh.corner_of(tet, waiting) < 4; };
  split_edge(mesh, journal, waiting);
  for (const double way : {0.01, 0.95}) {  // of the way into the middle of a side of its star
    const std::size_t first = way < 0.5 ? 0 : journal.position();
    const TetId tet = mesh.tet_of(vertex);
    const auto corners = mesh.vertices(Side(tet, mesh.corner_of(tet, vertex)));
    const Vec3 middle = (mesh.rest(corners[0]) + mesh.rest(corners[1]) + mesh.rest(corners[2])) / 3.0;
    move_to(mesh, journal, vertex, place + way * (middle - place));
    maintainer.take_up(mesh, journal, first, is_locked);
    EXPECT_TRUE(maintainer.has_work()) << "a vertex waits";
    if (way > 0.5) {
      EXPECT_LT(worst_ratio(mesh, tets_of(mesh)), kRegularLr / 60.0);
    }
    maintainer.run(mesh, journal, kUnlimitedWork, times, {}, is_locked);
  }
  EXPECT_GT(worst_ratio(mesh, tets_of(mesh)), kRegularLr / 18.0);
}

/// A vertex beside the cut is merged into one further off: a tet is drawn out that has no corner in care.
TEST(Maintenance, mends_what_it_made_beyond_what_it_took_up) {
  const std::filesystem::path path = std::filesystem::path(INCISE_SOURCE_DIR) / "models/bunny.mesh";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no models/bunny.mesh (script/models makes it)";
  Result<io::MeshFile> file = io::read_mesh(path);
  ASSERT_TRUE(file.ok());
  normalise(file->data.soup);
  Engine engine = maintaining_engine(std::move(file->data.soup), 0.2);
  const double before = measure_quality(engine.mesh()).lr_max;
  const std::vector<Vec3> row = {Vec3(-17.912, -9.426, -1.14), Vec3(4.797, 0.198, -0.092)};
  const Vec3 way(-3.465, 7.529, 5.943);
  ASSERT_TRUE(engine.begin_stroke({row}).ok());
  for (int i = 1; i <= 10; ++i) ASSERT_TRUE(engine.step({{row[0] + 0.1 * i * way, row[1] + 0.1 * i * way}}).ok());
  ASSERT_TRUE(engine.end_stroke().ok());
  EXPECT_LE(measure_quality(engine.mesh()).lr_max, 1.001 * before);
}

TEST(Maintenance, leaves_what_lies_further_from_the_cut_alone) {
  const TetSoup soup = jittered_cube(6, 1);
  Engine engine = maintaining_engine(soup, 0.2);
  cut_and_maintain(engine, plane_of(soup, Vec3(1, 0, 0), 0.25));
  for (std::uint32_t i = 0; i < soup.points.size(); ++i) {
    if (soup.points[i].x() > 0.8) {
      ASSERT_TRUE(engine.mesh().is_live(VertexId(i)));
      EXPECT_EQ(engine.mesh().rest(VertexId(i)), soup.points[i]);
    }
  }
  expect_valid(engine.mesh(), 1.0);
}

}  // namespace
}  // namespace incise::test::maintainer_test
