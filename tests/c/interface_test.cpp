// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>

#include "handle.h"
#include "support/folder.h"

namespace interface_test {
namespace {

using incise_test::counts;
using incise_test::cube;
using incise_test::cut_plane;
using incise_test::EngineHandle;
using incise_test::Folder;
using incise_test::hash;
using incise_test::rows;
using incise_test::sized;

const double kTwoTetPoints[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};

incise_mesh_arrays two_tets(const std::uint32_t* tets) {
  auto mesh = sized<incise_mesh_arrays>();
  mesh.points = kTwoTetPoints;
  mesh.n_points = 5;
  mesh.tets = tets;
  mesh.n_tets = 2;
  return mesh;
}

TEST(CInterface, tells_its_versions) {
  EXPECT_EQ(incise_abi(), static_cast<std::uint32_t>(INCISE_ABI));
  EXPECT_STREQ(incise_status_name(INCISE_BUSY), "busy");
  EXPECT_STREQ(incise_status_name(-1), "unknown");
  EXPECT_STREQ(incise_status_name(99), "unknown");
}

TEST(CInterface, errors_have_code_message_and_ids) {
  const std::uint32_t tets[] = {0, 1, 2, 3, 1, 3, 2, 4};
  const auto mesh = two_tets(tets);
  incise_engine* engine = nullptr;
  EXPECT_EQ(incise_engine_create(&mesh, nullptr, &engine), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(engine, nullptr);
  EXPECT_EQ(incise_last_error_code(), INCISE_BAD_ARGUMENT);
  EXPECT_NE(std::string(incise_last_error()).find("1"), std::string::npos);
  std::uint64_t ids[4] = {};
  ASSERT_EQ(incise_last_error_ids(ids, 4), 1U);
  EXPECT_EQ(ids[0], 1U);
}

TEST(CInterface, errors_are_short_and_keep_their_remedy) {
  incise_engine* engine = nullptr;
  const std::string path = "/no/" + std::string(200, 'x') + "/" + std::string(3000, 'y') + ".mesh";
  ASSERT_EQ(incise_engine_read(path.c_str(), nullptr, &engine), INCISE_BAD_FILE);
  const std::string message = incise_last_error();
  EXPECT_LE(message.size(), 500U);
  EXPECT_EQ(message.rfind("/no/xxx", 0), 0U) << message;
  EXPECT_NE(message.find(" ... "), std::string::npos) << message;
  EXPECT_NE(message.find("; check the path"), std::string::npos) << message;
}

TEST(CInterface, names_of_files_must_be_names_of_files) {
  incise_engine* read = nullptr;
  ASSERT_EQ(incise_engine_read("", nullptr, &read), INCISE_BAD_FILE);
  EXPECT_STREQ(incise_last_error(), "the name of the file is empty; give one");
  const EngineHandle engine = cube(2);
  const Folder folder;
  const std::string path = std::filesystem::path(folder / "x").parent_path().string();
  const auto ends_with = [](const std::string& part) {
    const std::string message = incise_last_error();
    EXPECT_TRUE(message.size() >= part.size() && message.substr(message.size() - part.size()) == part) << message;
  };
  EXPECT_EQ(incise_engine_write(engine.get(), path.c_str(), INCISE_AT_REST), INCISE_IO);
  ends_with(path + ": is a folder; give the name of a file in it");
  EXPECT_EQ(incise_engine_write_surface(engine.get(), path.c_str()), INCISE_IO);
  ends_with(path + ": is a folder; give the name of a file in it");
  EXPECT_EQ(incise_engine_write(engine.get(), "", INCISE_AT_REST), INCISE_BAD_ARGUMENT);
  ends_with("the name of the file is empty; give one");
  EXPECT_EQ(incise_engine_write(engine.get(), (path + "/mesh").c_str(), INCISE_AT_REST), INCISE_BAD_ARGUMENT);
  EXPECT_NE(std::string(incise_last_error()).find("has no extension"), std::string::npos) << incise_last_error();
}

TEST(CInterface, notes_name_duplicate_tets_that_were_kept) {
  const std::uint32_t tets[] = {0, 1, 2, 3, 1, 0, 3, 2};
  auto mesh = two_tets(tets);
  const auto notes_of = [&mesh] {
    incise_engine* made = nullptr;
    EXPECT_EQ(incise_engine_create(&mesh, nullptr, &made), INCISE_OK) << incise_last_error();
    const EngineHandle engine(made);
    char text[500] = "";
    EXPECT_EQ(incise_engine_notes(made, text, sizeof text, nullptr), INCISE_OK);
    return std::string(text);
  };
  EXPECT_EQ(notes_of(),
            "1 tet has the corners of a tet before (1), and will not be parted by cuts; set mend, which drops it\n");
  mesh.mend = 1;
  EXPECT_EQ(notes_of(), "");
}

TEST(CInterface, errors_are_of_the_thread) {
  EXPECT_EQ(incise_engine_read("/no/such/file.mesh", nullptr, nullptr), INCISE_BAD_ARGUMENT);
  incise_engine* engine = nullptr;
  EXPECT_EQ(incise_engine_read("/no/such/file.mesh", nullptr, &engine), INCISE_BAD_FILE);
  std::thread([] { EXPECT_EQ(incise_last_error_code(), INCISE_OK); }).join();
  EXPECT_EQ(incise_last_error_code(), INCISE_BAD_FILE);
}

TEST(CInterface, mends_arrays_where_asked) {
  const std::uint32_t tets[] = {0, 1, 2, 3, 1, 3, 2, 4};
  auto mesh = two_tets(tets);
  mesh.mend = 1;
  incise_engine* engine = nullptr;
  ASSERT_EQ(incise_engine_create(&mesh, nullptr, &engine), INCISE_OK) << incise_last_error();
  const EngineHandle handle(engine);
  EXPECT_EQ(counts(engine).tets, 2U);
}

TEST(CInterface, mending_refuses_points_that_are_not_there) {
  const std::uint32_t tets[] = {0, 1, 2, 3, 1, 2, 3, 5};
  auto mesh = two_tets(tets);
  mesh.mend = 1;
  incise_engine* engine = nullptr;
  EXPECT_EQ(incise_engine_create(&mesh, nullptr, &engine), INCISE_BAD_ARGUMENT);
  std::uint64_t id = 0;
  ASSERT_EQ(incise_last_error_ids(&id, 1), 1U);
  EXPECT_EQ(id, 1U);
}

TEST(CInterface, serves_programs_that_know_shorter_structs) {
  const EngineHandle engine = cube(2);
  auto full = sized<incise_counts>();
  std::uint32_t shorter[6] = {24, 0, 0, 0, 0, 0};  // size, strokes, vertices, tets
  ASSERT_EQ(incise_engine_counts(engine.get(), &full), INCISE_OK);
  ASSERT_EQ(incise_engine_counts(engine.get(), reinterpret_cast<incise_counts*>(shorter)), INCISE_OK);
  EXPECT_EQ(shorter[0], 24U);
  EXPECT_EQ(shorter[4], full.tets);

  auto options = sized<incise_engine_options>();
  ASSERT_EQ(incise_default_engine_options(&options, sizeof options), INCISE_OK);
  EXPECT_EQ(options.size, sizeof options);
  options.size = 16;  // up to `snap`; what follows is not read
  options.work_units = 3;
  options.threads = 100000;
  EXPECT_NE(cube(2, &options), nullptr);
}

TEST(CInterface, refuses_structs_that_it_does_not_know) {
  const EngineHandle engine = cube(2);
  incise_counts counts{};
  EXPECT_EQ(incise_engine_counts(engine.get(), &counts), INCISE_BAD_ARGUMENT);
  EXPECT_NE(std::string(incise_last_error()).find("sizeof(incise_counts)"), std::string::npos);
  counts.size = sizeof counts + 8;
  EXPECT_EQ(incise_engine_counts(engine.get(), &counts), INCISE_BAD_ARGUMENT);
  EXPECT_NE(std::string(incise_last_error()).find("newer"), std::string::npos);
}

TEST(CInterface, refuses_structs_that_end_within_a_member) {
  const EngineHandle engine = cube(2);
  auto stroke = sized<incise_stroke>();
  for (const std::uint32_t size : {9U, 12U, 23U}) {  // 12: half of the pointer to the times
    stroke.size = size;
    EXPECT_EQ(incise_engine_cut(engine.get(), &stroke, nullptr), INCISE_BAD_ARGUMENT);
    EXPECT_NE(std::string(incise_last_error()).find("sizeof(incise_stroke)"), std::string::npos) << size;
  }
}

TEST(CInterface, handles_are_null_where_nothing_was_made) {
  const EngineHandle engine = cube(2);
  auto* const garbage = reinterpret_cast<void*>(0x10);
  auto* made = static_cast<incise_engine*>(garbage);
  EXPECT_EQ(incise_engine_read(nullptr, nullptr, &made), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(made, nullptr);
  made = static_cast<incise_engine*>(garbage);
  EXPECT_EQ(incise_engine_read_bytes(nullptr, 3, nullptr, nullptr, &made), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(made, nullptr);
  auto* cursor = static_cast<incise_cursor*>(garbage);
  EXPECT_EQ(incise_cursor_create(nullptr, &cursor), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(cursor, nullptr);
  auto* plan = static_cast<incise_plan*>(garbage);
  EXPECT_EQ(incise_plan_read(nullptr, &plan), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(plan, nullptr);
  plan = static_cast<incise_plan*>(garbage);
  EXPECT_EQ(incise_plan_parse(nullptr, nullptr, &plan), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(plan, nullptr);
  auto* simulation = static_cast<incise_simulation*>(garbage);
  for (const auto& call :
       {+[](incise_simulation** out) { return incise_simulation_read(nullptr, nullptr, out); },
        +[](incise_simulation** out) { return incise_simulation_read_scene(nullptr, 1, out); },
        +[](incise_simulation** out) { return incise_simulation_parse_scene(nullptr, nullptr, 1, out); }}) {
    simulation = static_cast<incise_simulation*>(garbage);
    EXPECT_EQ(call(&simulation), INCISE_BAD_ARGUMENT);
    EXPECT_EQ(simulation, nullptr);
  }
}

TEST(CInterface, does_nothing_where_the_report_is_refused) {
  const EngineHandle engine = cube(2);
  const std::uint64_t before = hash(engine.get());
  incise_report report{};
  const double normal[3] = {1, 0, 0};
  EXPECT_EQ(incise_engine_cut_plane(engine.get(), normal, 0.3, &report), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(hash(engine.get()), before);
}

TEST(CInterface, null_handles_are_errors) {
  EXPECT_EQ(incise_engine_hash(nullptr, nullptr), INCISE_BAD_ARGUMENT);
  std::uint64_t hash = 0;
  EXPECT_EQ(incise_engine_hash(nullptr, &hash), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_undo(nullptr, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_simulation_frame(nullptr, nullptr, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_free(nullptr), INCISE_OK);
  EXPECT_EQ(incise_simulation_free(nullptr), INCISE_OK);
  EXPECT_EQ(incise_attributes_free(nullptr), INCISE_OK);
  EXPECT_EQ(incise_cursor_free(nullptr), INCISE_OK);
  EXPECT_EQ(incise_haptic_tool_free(nullptr), INCISE_OK);
  EXPECT_EQ(incise_simulation_engine(nullptr), nullptr);
}

TEST(CInterface, bad_options_are_errors) {
  auto options = sized<incise_engine_options>();
  incise_default_engine_options(&options, sizeof options);
  options.snap = 7;
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  const std::uint32_t cells[3] = {1, 1, 1}, none[3] = {0, 1, 1};
  incise_engine* engine = nullptr;
  EXPECT_EQ(incise_engine_create_box(low, high, cells, &options, &engine), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_create_box(high, low, cells, nullptr, &engine), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_create_box(low, high, none, nullptr, &engine), INCISE_BAD_ARGUMENT);
  options.snap = 0.2;
  options.profile = 9;
  EXPECT_EQ(incise_engine_create_box(low, high, cells, &options, &engine), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(engine, nullptr);
}

TEST(CInterface, views_show_the_engine_itself) {
  const EngineHandle engine = cube(2);
  auto before = sized<incise_view>(), after = sized<incise_view>();
  ASSERT_EQ(incise_engine_view(engine.get(), INCISE_REST, &before), INCISE_OK);
  EXPECT_EQ(before.stride, 24U);
  EXPECT_EQ(before.rows, 27U);
  cut_plane(engine.get(), 1, 0.1, 0, 0.31);
  ASSERT_EQ(incise_engine_view(engine.get(), INCISE_REST, &after), INCISE_OK);
  EXPECT_GT(after.rows, before.rows);
  EXPECT_GT(after.version, before.version);
#if defined(__linux__)
  EXPECT_EQ(after.is_stable, 1);
  EXPECT_EQ(after.data, before.data);
#endif
  EXPECT_EQ(incise_engine_view(engine.get(), 99, &after), INCISE_BAD_ARGUMENT);
}

TEST(CInterface, compact_arrays_are_those_of_the_live_slots) {
  const EngineHandle engine = cube(3);
  cut_plane(engine.get(), 1, 0.2, 0.1, 0.52);
  const incise_counts all = counts(engine.get());
  std::vector<double> points(3 * all.vertices);
  std::vector<std::uint32_t> tets(4 * all.tets), pieces(all.tets), vertex_slots(all.vertices), tet_slots(all.tets);
  auto compact = sized<incise_compact>();
  compact.points = points.data();
  compact.tets = tets.data();
  compact.pieces = pieces.data();
  compact.vertex_slots = vertex_slots.data();
  compact.tet_slots = tet_slots.data();
  ASSERT_EQ(incise_engine_compact(engine.get(), &compact), INCISE_OK);
  EXPECT_EQ(compact.vertices, all.vertices);
  EXPECT_EQ(compact.tet_count, all.tets);
  const auto slots = rows<std::uint32_t>(engine.get(), INCISE_TETS);
  const auto rest = rows<double>(engine.get(), INCISE_REST);
  for (std::size_t t = 0; t < all.tets; ++t) {
    EXPECT_LT(pieces[t], 2U);
    for (unsigned k = 0; k < 4; ++k) {
      const std::uint32_t v = tets[4 * t + k];
      EXPECT_EQ(vertex_slots[v], slots[4 * tet_slots[t] + k]);
      EXPECT_EQ(points[3 * v], rest[3 * vertex_slots[v]]);
    }
  }
}

TEST(CInterface, compact_arrays_that_are_too_small_are_left_alone) {
  const EngineHandle engine = cube(2);
  const incise_counts all = counts(engine.get());
  std::vector<double> points(3 * all.vertices, 7);
  auto compact = sized<incise_compact>();
  compact.points = points.data();
  compact.vertex_room = all.vertices;
  compact.tet_room = all.tets;
  cut_plane(engine.get(), 1, 0.2, 0.1, 0.52);
  EXPECT_EQ(incise_engine_compact(engine.get(), &compact), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(points, std::vector<double>(3 * all.vertices, 7));
  ASSERT_EQ(incise_engine_undo(engine.get(), nullptr), INCISE_OK);
  EXPECT_EQ(incise_engine_compact(engine.get(), &compact), INCISE_OK) << incise_last_error();
  EXPECT_EQ(points[0], 0);
}

TEST(CInterface, surface_is_counted_first_and_then_written) {
  const EngineHandle engine = cube(2);
  std::uint64_t count = 0;
  ASSERT_EQ(incise_engine_surface(engine.get(), nullptr, nullptr, nullptr, 0, &count), INCISE_OK);
  EXPECT_EQ(count, 48U);
  cut_plane(engine.get(), 1, 0, 0, 0.5);
  ASSERT_EQ(incise_engine_surface(engine.get(), nullptr, nullptr, nullptr, 0, &count), INCISE_OK);
  std::vector<std::uint32_t> triangles(3 * count), tags(count), sides(count);
  ASSERT_EQ(incise_engine_surface(engine.get(), triangles.data(), tags.data(), sides.data(), count, &count), INCISE_OK);
  const auto walls = static_cast<std::size_t>(std::count(tags.begin(), tags.end(), 1U));
  EXPECT_GT(walls, 0U);
  EXPECT_EQ(walls + static_cast<std::size_t>(std::count(tags.begin(), tags.end(), 0U)), count);
}

TEST(CInterface, quality_validity_and_pieces) {
  const EngineHandle engine = cube(3);
  cut_plane(engine.get(), 0.1, 1, 0.3, 0.66);
  auto quality = sized<incise_quality>();
  ASSERT_EQ(incise_engine_quality(engine.get(), 0, &quality), INCISE_OK);
  EXPECT_EQ(quality.tets, counts(engine.get()).tets);
  EXPECT_GE(quality.lr_min, 4.89);
  ASSERT_EQ(incise_engine_quality(engine.get(), 1, &quality), INCISE_OK);
  EXPECT_LT(quality.tets, counts(engine.get()).tets);
  auto validity = sized<incise_validity>();
  std::uint64_t violations = 9;
  ASSERT_EQ(incise_engine_validate(engine.get(), INCISE_VALIDATE_GEOMETRY, &validity, nullptr, 0, &violations),
            INCISE_OK);
  EXPECT_EQ(validity.ok, 1);
  EXPECT_NEAR(validity.volume, 1, 1e-12);
  EXPECT_EQ(violations, 0U);
  double volumes[2] = {};
  std::uint64_t pieces = 0;
  ASSERT_EQ(incise_engine_pieces(engine.get(), nullptr, 0, nullptr, volumes, 2, &pieces), INCISE_OK);
  EXPECT_EQ(pieces, 2U);
  EXPECT_NEAR(volumes[0] + volumes[1], 1, 1e-12);
  EXPECT_STREQ(incise_violation_name(0), "count");
  EXPECT_EQ(incise_violation_name(INCISE_VIOLATION_KINDS), nullptr);
}

TEST(CInterface, files_read_back_as_the_same_wound) {
  const Folder folder;
  const EngineHandle engine = cube(3);
  cut_plane(engine.get(), 1, 0.2, 0, 0.5);
  const std::string path = folder / "cut.vtk";
  ASSERT_EQ(incise_engine_write(engine.get(), path.c_str(), INCISE_AT_REST), INCISE_OK) << incise_last_error();
  incise_engine* again = nullptr;
  ASSERT_EQ(incise_engine_read(path.c_str(), nullptr, &again), INCISE_OK) << incise_last_error();
  const EngineHandle handle(again);
  EXPECT_EQ(counts(again).tets, counts(engine.get()).tets);
  EXPECT_EQ(counts(again).next_stroke, 2U);

  std::uint64_t size = 0;
  ASSERT_EQ(incise_engine_write_bytes(engine.get(), ".mesh", INCISE_AT_REST, nullptr, 0, &size), INCISE_OK);
  std::string bytes(size, ' ');
  ASSERT_EQ(incise_engine_write_bytes(engine.get(), ".mesh", INCISE_AT_REST, bytes.data(), size, &size), INCISE_OK);
  incise_engine* from_bytes = nullptr;
  ASSERT_EQ(incise_engine_read_bytes(bytes.data(), size, "memory", nullptr, &from_bytes), INCISE_OK);
  const EngineHandle other(from_bytes);
  EXPECT_EQ(hash(from_bytes), hash(again));
  EXPECT_EQ(incise_engine_write(engine.get(), "/tmp/what.xyz", INCISE_AT_REST), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_write(engine.get(), path.c_str(), 5), INCISE_BAD_ARGUMENT);
}

TEST(CInterface, notes_tell_what_reading_changed) {
  const std::string file =
      "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
      "Tetrahedra 1\n1 3 2 4 0\nEnd\n";
  incise_engine* engine = nullptr;
  ASSERT_EQ(incise_engine_read_bytes(file.data(), file.size(), "turned.mesh", nullptr, &engine), INCISE_OK);
  const EngineHandle handle(engine);
  std::uint64_t size = 0;
  ASSERT_EQ(incise_engine_notes(engine, nullptr, 0, &size), INCISE_OK);
  std::string notes(size, '?');
  ASSERT_EQ(incise_engine_notes(engine, notes.data(), size, &size), INCISE_OK);
  EXPECT_NE(notes.find("turned to positive"), std::string::npos);
  EXPECT_EQ(notes.back(), '\0');
  char few[4] = {'?', '?', '?', '?'};
  ASSERT_EQ(incise_engine_notes(engine, few, 4, &size), INCISE_OK);
  EXPECT_EQ(few[3], '\0');
}

TEST(CInterface, strokes_of_a_blade_file_are_cut_one_after_the_other) {
  const Folder folder;
  const std::string blade = folder.write("blade.json", R"({"format": "incise-blade", "version": 1, "strokes": [
    {"edges": [{"t": 0, "points": [[0.3, -1, -1], [0.3, -1, 2]]}, {"t": 1, "points": [[0.3, 2, -1], [0.3, 2, 2]]}]},
    {"edges": [{"t": 0, "points": [[0.7, -1, -1], [0.7, -1, 2]]}, {"t": 1, "points": [[0.7, 2, -1], [0.7, 2, 2]]}]}]})");
  const EngineHandle engine = cube(3);
  auto report = sized<incise_report>();
  ASSERT_EQ(incise_engine_cut_blade(engine.get(), blade.c_str(), &report), INCISE_OK) << incise_last_error();
  EXPECT_EQ(report.stroke, 2U);
  EXPECT_EQ(report.steps, 2U);
  std::uint64_t pieces = 0;
  ASSERT_EQ(incise_engine_pieces(engine.get(), nullptr, 0, nullptr, nullptr, 0, &pieces), INCISE_OK);
  EXPECT_EQ(pieces, 3U);
}

TEST(CInterface, malformed_strokes_change_nothing) {
  const EngineHandle engine = cube(2);
  const std::uint64_t before = hash(engine.get());
  const double times[] = {0, 0}, edge[] = {0, 0, 0, 1, 1, std::numeric_limits<double>::quiet_NaN()};
  const double points[12] = {};
  auto stroke = sized<incise_stroke>();
  EXPECT_EQ(incise_engine_cut(engine.get(), &stroke, nullptr), INCISE_BAD_ARGUMENT);
  stroke.times = times;
  stroke.n_times = 2;
  stroke.points = points;
  stroke.n_points = 2;
  EXPECT_EQ(incise_engine_cut(engine.get(), &stroke, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_begin_stroke(engine.get(), edge, 2, nullptr, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_begin_stroke(engine.get(), nullptr, 2, nullptr, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_step(engine.get(), points, 2, nullptr, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_set_positions(engine.get(), points, 4), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_keep_undo(engine.get(), 0), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(hash(engine.get()), before);
}

/// A callback that waits until it is let go.
struct Gate {
  std::atomic<bool> is_in{false}, may_go{false};
  int asked = 0;

  static std::int32_t wait(void* user) {
    auto* gate = static_cast<Gate*>(user);
    ++gate->asked;
    gate->is_in = true;
    while (!gate->may_go) std::this_thread::yield();
    return 1;
  }
};

TEST(CInterface, a_second_thread_on_an_engine_gets_an_error) {
  const EngineHandle engine = cube(4);
  Gate gate;
  std::thread worker([&] {
    EXPECT_EQ(incise_engine_improve(engine.get(), Gate::wait, &gate, nullptr), INCISE_OK) << incise_last_error();
  });
  while (!gate.is_in) std::this_thread::yield();
  std::uint64_t hash = 0;
  EXPECT_EQ(incise_engine_hash(engine.get(), &hash), INCISE_BUSY);
  EXPECT_EQ(incise_engine_undo(engine.get(), nullptr), INCISE_BUSY);
  EXPECT_EQ(incise_engine_free(engine.get()), INCISE_BUSY);
  EXPECT_NE(std::string(incise_last_error()).find("one thread"), std::string::npos);
  const EngineHandle other = cube(2);  // another engine has nothing to do with it
  cut_plane(other.get(), 1, 0, 0, 0.4);
  gate.may_go = true;
  worker.join();
  EXPECT_EQ(incise_engine_hash(engine.get(), &hash), INCISE_OK);
  EXPECT_EQ(gate.asked, 1) << "who said stop is not asked again";
}

TEST(CInterface, callbacks_cannot_call_back) {
  const EngineHandle engine = cube(4);
  const auto call_back = [](void* user) -> std::int32_t {
    std::uint64_t hash = 0;
    EXPECT_EQ(incise_engine_hash(static_cast<incise_engine*>(user), &hash), INCISE_BUSY);
    return 1;
  };
  EXPECT_EQ(incise_engine_improve(engine.get(), call_back, engine.get(), nullptr), INCISE_OK);
}

TEST(CInterface, the_log_says_what_could_not_be_done) {
  std::string said;
  auto options = sized<incise_engine_options>();
  incise_default_engine_options(&options, sizeof options);
  options.log = [](void* user, std::int32_t level, const char* message) {
    EXPECT_LE(level, INCISE_LOG_WARNING);
    *static_cast<std::string*>(user) += message;
  };
  options.log_user = &said;
  const EngineHandle engine = cube(3, &options);
  const double times[] = {0, 1};
  const double far[] = {5, 5, 5, 5, 5, 6, 6, 5, 5, 6, 5, 6};
  auto stroke = sized<incise_stroke>();
  stroke.times = times;
  stroke.n_times = 2;
  stroke.points = far;
  stroke.n_points = 2;
  stroke.name = "beside";
  EXPECT_EQ(incise_engine_cut(engine.get(), &stroke, nullptr), INCISE_OK) << incise_last_error();
}

TEST(CInterface, numbers_that_were_negative_are_refused) {
  const EngineHandle engine = cube(2);
  const double edge[6] = {0.5, -1, 2, 0.5, 2, 2}, times[2] = {0, 1};
  EXPECT_EQ(incise_engine_begin_stroke(engine.get(), edge, std::uint64_t(-1), nullptr, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_NE(std::string(incise_last_error()).find("negative"), std::string::npos);
  auto stroke = sized<incise_stroke>();
  stroke.times = times;
  stroke.points = edge;
  stroke.n_times = std::uint64_t(-1);
  stroke.n_points = 1;
  EXPECT_EQ(incise_engine_cut(engine.get(), &stroke, nullptr), INCISE_BAD_ARGUMENT);
  stroke.n_times = 1;
  stroke.n_points = std::uint64_t(-2);
  EXPECT_EQ(incise_engine_cut(engine.get(), &stroke, nullptr), INCISE_BAD_ARGUMENT);
}

TEST(CInterface, followers_of_one_engine_refuse_another) {
  const EngineHandle other = cube(4);
  incise_attributes* attributes = nullptr;
  incise_cursor* cursor = nullptr;
  {
    const EngineHandle engine = cube(2);
    ASSERT_EQ(incise_attributes_create(engine.get(), &attributes), INCISE_OK);
    ASSERT_EQ(incise_cursor_create(engine.get(), &cursor), INCISE_OK);
  }
  const EngineHandle next = cube(2);  // likely where the first one was
  std::int32_t way = 0;
  for (incise_engine* wrong : {other.get(), next.get()}) {
    cut_plane(wrong, 1, 0.1, 0, 0.4);
    EXPECT_EQ(incise_attributes_follow(attributes, wrong), INCISE_BAD_ARGUMENT);
    EXPECT_NE(std::string(incise_last_error()).find("another engine"), std::string::npos);
    EXPECT_EQ(incise_cursor_way(cursor, wrong, &way, nullptr), INCISE_BAD_ARGUMENT);
    EXPECT_EQ(incise_cursor_move(cursor, wrong), INCISE_BAD_ARGUMENT);
  }
  EXPECT_EQ(incise_cursor_free(cursor), INCISE_OK);
  EXPECT_EQ(incise_attributes_free(attributes), INCISE_OK);
}

TEST(CInterface, attributes_follow_their_engine) {
  const EngineHandle engine = cube(3);
  incise_attributes* attributes = nullptr;
  ASSERT_EQ(incise_attributes_create(engine.get(), &attributes), INCISE_OK);
  const double one = 1;
  auto spec = sized<incise_attribute_spec>();
  spec.name = "mass";
  spec.domain = INCISE_AT_TETS;
  spec.width = 1;
  spec.transfer = INCISE_CONSERVE;
  spec.initial = &one;
  std::uint32_t mass = 99, shape = 99, found = 99;
  ASSERT_EQ(incise_attributes_add(attributes, engine.get(), &spec, &mass), INCISE_OK) << incise_last_error();
  spec = sized<incise_attribute_spec>();
  spec.name = "shape";
  spec.domain = INCISE_AT_VERTICES;
  spec.width = 1;
  spec.transfer = INCISE_RECOMPUTE;
  spec.recompute = [](void* user, std::uint32_t slot, double* value, std::uint32_t) {
    *value = rows<std::uint8_t>(static_cast<incise_engine*>(user), INCISE_SHAPES)[slot];
  };
  spec.user = engine.get();
  ASSERT_EQ(incise_attributes_add(attributes, engine.get(), &spec, &shape), INCISE_OK) << incise_last_error();
  EXPECT_EQ(incise_attributes_add(attributes, engine.get(), &spec, &found), INCISE_BAD_ARGUMENT) << "known name";
  ASSERT_EQ(incise_attributes_find(attributes, "mass", &found), INCISE_OK);
  EXPECT_EQ(found, mass);

  cut_plane(engine.get(), 1, 0.2, 0.3, 0.7);
  ASSERT_EQ(incise_attributes_follow(attributes, engine.get()), INCISE_OK) << incise_last_error();
  double* values = nullptr;
  std::uint64_t n = 0;
  ASSERT_EQ(incise_attributes_values(attributes, mass, &values, &n), INCISE_OK);
  double sum = 0;
  for (std::uint64_t i = 0; i < n; ++i) sum += values[i];
  EXPECT_NEAR(sum, 162, 1e-9);
  ASSERT_EQ(incise_attributes_values(attributes, shape, &values, &n), INCISE_OK);
  const auto shapes = rows<std::uint8_t>(engine.get(), INCISE_SHAPES);
  ASSERT_EQ(n, shapes.size());
  for (std::size_t i = 0; i < n; ++i) {
    if ((shapes[i] & INCISE_SHAPE_DEAD) != 0) continue;
    EXPECT_EQ(values[i], shapes[i]) << i;
  }
  EXPECT_EQ(incise_attributes_values(attributes, 7, &values, &n), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_attributes_free(attributes), INCISE_OK);
}

}  // namespace

}  // namespace interface_test
