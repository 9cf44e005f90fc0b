// SPDX-License-Identifier: Apache-2.0
#include "app/session/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/jobs/replay_job.h"
#include "app/jobs/simulate_job.h"
#include "app/session/session_cases.h"
#include "app/text/text_file.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/bounds.h"

namespace session_test {
namespace {

using namespace incise;
using namespace incise_test;
using app::Operation;
using app::Session;
using app::SessionFigures;
using app::SessionOptions;

std::string error_of(const std::string& path, const SessionOptions& options = {}) {
  const Result<Session> session = Session::open(std::filesystem::path(path), options);
  return session.ok() ? "" : session.error().message;
}

Session open_file(const std::string& path) {
  return Session::open(std::filesystem::path(path)).value();
}

std::vector<std::string> texts(const Session& session, Operation::Kind kind) {
  std::vector<std::string> found;
  for (const Operation& o : session.log().operations()) {
    if (o.kind == kind) found.push_back(o.text);
  }
  return found;
}

app::ReplayResult verified(const std::string& recording) {
  const Result<app::ReplayResult> result = app::run_replay({recording, true});
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  if (!result.ok()) return {};
  EXPECT_FALSE(result->difference.has_value());
  return *result;
}

/// A session whose settling and frames cost little.
class SessionFiles : public testing::Test {
 protected:
  Folder folder_;
};

// --- what is opened

TEST_F(SessionFiles, opens_a_scene) {
  const Session session = open_file(folder_.write("cut.json", cut_scene().dump()));
  EXPECT_EQ(session.title(), "a cut cube");
  EXPECT_EQ(session.mesh().tet_count(), 162U);
  EXPECT_FALSE(session.is_replay());
  ASSERT_NE(session.simulation(), nullptr);
  EXPECT_EQ(session.figures().tets, 162U);
  EXPECT_EQ(session.figures().tets_at_start, 162U);
  EXPECT_EQ(session.figures().frames, 0U);
  EXPECT_FALSE(session.score().has_value());
}

TEST_F(SessionFiles, names_a_scene_without_a_name_by_its_file) {
  Json scene = cut_scene();
  scene.erase("name");
  EXPECT_EQ(open_file(folder_.write("cut.json", scene.dump())).title(), "cut.json");
}

TEST_F(SessionFiles, opens_a_mesh_as_soft_tissue_of_ten_centimetres) {
  const Session session = open_file(folder_.write("cube.mesh", cube_mesh(3)));
  EXPECT_EQ(session.title(), "cube.mesh");
  EXPECT_NEAR(session.scene().options.body.length_unit, 0.1, 1e-12);
  EXPECT_LT(session.scene().options.body.gravity.z(), 0);
  EXPECT_EQ(session.scene().attachments.size(), 1U);
  EXPECT_FALSE(session.is_replay());
}

TEST_F(SessionFiles, a_mesh_stands_on_its_lowest_part_along_any_axis) {
  const Box body{{-1, 2, 3}, {1, 4, 7}};
  for (const Vec3& up : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(-Vec3::UnitZ())}) {
    const app::Scene scene = app::scene_of_mesh("m.mesh", body, up);
    EXPECT_NEAR(scene.options.body.length_unit, 0.025, 1e-12);
    EXPECT_EQ(scene.options.body.gravity, Vec3(-9.81 * up));
    const auto& held = std::get<app::HalfSpace>(scene.attachments.at(0).where);
    const double low = std::min(body.lo.dot(up), body.hi.dot(up)), high = std::max(body.lo.dot(up), body.hi.dot(up));
    EXPECT_NEAR(held.offset, low + 0.1 * (high - low), 1e-12);
  }
}

TEST_F(SessionFiles, opens_a_recording_of_a_simulation) {
  const Session session = open_file(write_simulation_recording(folder_));
  EXPECT_TRUE(session.is_replay());
  EXPECT_EQ(session.title(), "a cut cube");
  EXPECT_EQ(session.place().call, 0U);
  EXPECT_EQ(session.place().calls, 1U + 5 + 7 + 1 + 2 + 5);
}

TEST_F(SessionFiles, opens_what_a_run_of_a_scene_recorded) {
  app::SimulateJob job;
  job.run.record = folder_ / "run.jsonl";
  const Result<app::SimulateResult> run = app::run_simulate(parsed(cut_scene()), job);
  ASSERT_TRUE(run.ok());
  Session session = open_file(folder_ / "run.jsonl");
  ASSERT_TRUE(session.seek(session.place().calls).ok());
  EXPECT_EQ(session.simulation()->hash(), run->report.state_hash);
  EXPECT_EQ(texts(session, Operation::Kind::kReplay), std::vector<std::string>{"End: the same state as was recorded"});
}

TEST_F(SessionFiles, opens_a_recording_of_an_engine) {
  const Session session = open_file(write_engine_recording(folder_));
  EXPECT_TRUE(session.is_replay());
  EXPECT_EQ(session.title(), "engine.jsonl");
  EXPECT_EQ(session.simulation(), nullptr);
  EXPECT_EQ(session.mesh().tet_count(), 162U);
  EXPECT_GE(session.place().calls, 3U);
}

TEST_F(SessionFiles, bad_files_give_errors_that_name_them) {
  std::filesystem::create_directory(folder_ / "folder.mesh");
  const std::string scene = cut_scene().dump();
  for (const std::string& path : {
           folder_ / "absent.json",
           folder_ / "absent.mesh",
           folder_ / "folder.mesh",
           folder_.write("empty.mesh", ""),
           folder_.write("empty.json", ""),
           folder_.write("garbage.mesh", std::string("\x7f\x00\xff garbage", 11)),
           folder_.write("garbage.json", "{ garbage"),
           folder_.write("cut_off.json", scene.substr(0, scene.size() / 2)),
           folder_.write("other.json", R"({"format": "something else"})"),
           folder_.write("empty_recording.jsonl", R"({"format": "incise-simulation"})"),
       }) {
    EXPECT_NE(error_of(path).find(path), std::string::npos) << path << ": " << error_of(path);
  }
}

TEST_F(SessionFiles, recordings_of_a_missing_mesh_give_errors_that_name_it) {
  const std::string engine = write_engine_recording(folder_);
  Json scene = still_scene();
  scene["model"] = {{"file", folder_ / "cube.mesh"}};
  SessionOptions options;
  options.record = folder_ / "log.jsonl";
  ASSERT_TRUE(Session::open(parsed(scene), options).ok());
  std::filesystem::remove(folder_ / "cube.mesh");
  EXPECT_NE(error_of(engine).find("cube.mesh"), std::string::npos) << error_of(engine);
  EXPECT_NE(error_of(folder_ / "log.jsonl").find("cube.mesh"), std::string::npos) << error_of(folder_ / "log.jsonl");
}

TEST_F(SessionFiles, recordings_of_another_mesh_are_refused) {
  const std::string engine = write_engine_recording(folder_);
  folder_.write("cube.mesh", cube_mesh(2));
  EXPECT_NE(error_of(engine), "");
}

TEST_F(SessionFiles, a_recording_with_a_bad_line_is_refused) {
  const std::string log = write_simulation_recording(folder_);
  std::string text = read(log);
  text.insert(text.find('\n', text.find('\n') + 1) + 1, "{\"call\":\"dance\"}\n");
  EXPECT_NE(error_of(folder_.write("log.jsonl", text)).find("log.jsonl:3"), std::string::npos);
}

// --- live

TEST(SessionLive, scripted_strokes_play) {
  Session session = opened(cut_scene());
  play(session, 40);
  EXPECT_EQ(session.figures().strokes, 1U);
  EXPECT_GT(session.figures().tets, 162U);
  const std::vector<std::string> strokes = texts(session, Operation::Kind::kStroke);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes[0].rfind("Stroke 1: ", 0), 0U);
}

TEST(SessionLive, scripted_strokes_do_not_play_where_they_shall_not) {
  SessionOptions options;
  options.plays_script = false;
  Session session = opened(cut_scene(), options);
  play(session, 40);
  EXPECT_EQ(session.figures().strokes, 0U);
}

TEST(SessionLive, does_what_run_simulate_does) {
  const Result<app::SimulateResult> run = app::run_simulate(parsed(cut_scene()), {});
  Session session = opened(cut_scene());
  play(session, 40);
  EXPECT_EQ(session.simulation()->hash(), run->report.state_hash);
}

TEST(SessionLive, figures_add_up) {
  Session session = opened(cut_scene());
  play(session, 40);
  const SessionFigures& f = session.figures();
  EXPECT_EQ(f.frames, 40U);
  EXPECT_DOUBLE_EQ(f.seconds, 0.8);
  EXPECT_EQ(f.tets, session.mesh().tet_count());
  EXPECT_EQ(f.vertices, session.mesh().vertex_count());
  EXPECT_EQ(f.force.size(), 40U);
  EXPECT_GT(f.times.total(), 0);
  EXPECT_GE(f.busy_ms, f.frame_ms);
  EXPECT_GT(f.cut.cut_tets, 0U);
  double peak = 0;
  for (const app::ForceSample& sample : f.force) peak = std::max(peak, static_cast<double>(sample.force));
  EXPECT_NEAR(f.peak_force, peak, 1e-6 * peak);
}

TEST(SessionLive, keeps_the_newest_force_samples) {
  Json scene = still_scene();
  scene["model"] = {{"box", {{"cells", {1, 1, 1}}}}};
  Session session = opened(scene);
  const int frames = static_cast<int>(SessionFigures::kForceSamples) + 10;
  play(session, frames);
  const std::vector<app::ForceSample>& force = session.figures().force;
  ASSERT_EQ(force.size(), SessionFigures::kForceSamples);
  EXPECT_NEAR(force.back().time, 0.02 * frames, 1e-3);
  EXPECT_NEAR(force.front().time, 0.02 * 11, 1e-3);
}

TEST(SessionLive, a_hand_cuts) {
  Session session = opened(still_scene());
  cut_by_hand(session);
  EXPECT_EQ(session.figures().strokes, 1U);
  EXPECT_GT(session.figures().tets, 162U);
}

TEST(SessionLive, a_hand_takes_over_from_the_script) {
  Session session = opened(cut_scene());
  play(session, 2);
  ASSERT_TRUE(session.frame(hand_at(0.7, -0.2)).ok());
  play(session, 37);
  EXPECT_EQ(session.figures().tets, 162U);  // the hand was above the body, and the script ended before its stroke
}

/// The poses of a recording, frame by frame: whether there is a blade, and where its first point is.
std::vector<std::optional<double>> blades_of(const std::string& recording) {
  std::vector<std::optional<double>> blades;
  app::SimulationReader reader = app::SimulationReader::open(std::filesystem::path(recording)).value();
  while (true) {
    const std::optional<app::SimulationCall> call = reader.next().value();
    if (!call) return blades;
    if (call->kind != app::SimulationCallKind::kFrame) continue;
    blades.emplace_back();
    if (call->input.blade) blades.back() = call->input.blade->edge[0].x();
  }
}

TEST_F(SessionFiles, between_the_scripts_blade_and_the_hands_is_a_frame_without) {
  SessionOptions options;
  options.record = folder_ / "log.jsonl";
  Session session = opened(cut_scene(), options);
  play(session, 8);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(session.frame(hand_at(0.7, -0.2)).ok());
  const auto blades = blades_of(folder_ / "log.jsonl");
  ASSERT_EQ(blades.size(), 11U);
  EXPECT_TRUE(blades[7].has_value());
  EXPECT_FALSE(blades[8].has_value());
  EXPECT_EQ(blades[9], 0.7);
  EXPECT_EQ(blades[10], 0.7);
}

TEST_F(SessionFiles, a_stroke_that_is_followed_after_the_scripts_loses_nothing) {
  std::vector<std::ptrdiff_t> frames;
  for (const int before : {2, 8}) {  // the script's blade is not there yet, or is
    SessionOptions options;
    options.record = folder_ / "log.jsonl";
    Session session = opened(cut_scene(), options);
    play(session, before);
    session.follow(stroke_at(0.7));
    play(session, 20);
    const auto blades = blades_of(folder_ / "log.jsonl");
    frames.push_back(std::count(blades.begin(), blades.end(), std::optional<double>(0.7)));
  }
  EXPECT_GT(frames[0], 4);
  EXPECT_EQ(frames[0], frames[1]);
}

TEST_F(SessionFiles, between_a_recordings_blade_and_the_hands_is_a_frame_without) {
  Session session = open_file(write_simulation_recording(folder_));
  ASSERT_TRUE(session.seek(10).ok());  // within the stroke
  ASSERT_TRUE(session.take_over());
  ASSERT_TRUE(session.start_recording(folder_ / "hand.jsonl").ok());
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(session.frame(hand_at(0.7, -0.2)).ok());
  const auto blades = blades_of(folder_ / "hand.jsonl");
  ASSERT_EQ(blades.size(), 11U);
  EXPECT_TRUE(blades[8].has_value());
  EXPECT_FALSE(blades[9].has_value());
  EXPECT_EQ(blades[10], 0.7);
}

TEST(SessionLive, a_hand_that_goes_on_is_one_stroke) {
  Session session = opened(still_scene());
  for (int i = 0; i <= 20; ++i) ASSERT_TRUE(session.frame(hand_at(0.52, -0.1 + 0.02 * i)).ok());
  play(session, 1);
  EXPECT_EQ(session.figures().strokes, 1U);
}

TEST(SessionLive, hands_hold_the_tissue) {
  Session pulled = opened(still_scene()), left = opened(still_scene());
  app::HandState hands;
  hands.hooks.push_back({0, {0.5, 0.5, 1.2}, 0.4, 1000});
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(pulled.frame(hands).ok());
  play(left, 10);
  EXPECT_NE(pulled.simulation()->hash(), left.simulation()->hash());
}

TEST(SessionLive, followed_strokes_queue) {
  Session session = opened(cut_scene());
  session.follow(stroke_at(0.27));
  session.follow(stroke_at(0.77));
  EXPECT_TRUE(session.is_following());
  play(session, 30);
  EXPECT_FALSE(session.is_following());
  EXPECT_EQ(session.figures().strokes, 2U);  // those of the scene no more
}

TEST(SessionLive, a_stroke_that_is_followed_late_follows_all_the_same) {
  Session session = opened(still_scene());
  session.follow(stroke_at(0.27));
  for (int frame = 0; frame < 12 && session.is_following(); ++frame) {
    play(session, 1);
    if (frame == 5) session.follow(stroke_at(0.77));
  }
  play(session, 20);
  EXPECT_EQ(session.figures().strokes, 2U);
}

TEST(SessionLive, a_hand_ends_what_is_followed) {
  Session session = opened(still_scene());
  session.follow(stroke_at(0.27));
  play(session, 1);
  ASSERT_TRUE(session.frame(hand_at(0.7, -0.2)).ok());
  EXPECT_FALSE(session.is_following());
}

TEST(SessionLive, a_bad_stroke_is_not_followed) {
  Session session = opened(still_scene());
  Stroke stroke = stroke_at(0.27);
  stroke.times = {1, 1};
  session.follow(stroke);
  EXPECT_FALSE(session.is_following());
  session.follow(Stroke());
  EXPECT_FALSE(session.is_following());
}

TEST(SessionLive, undo_and_redo_a_stroke) {
  Session session = opened(still_scene());
  EXPECT_FALSE(session.undo().value());
  EXPECT_FALSE(session.redo().value());
  const std::uint64_t before = session.mesh().hash();
  cut_by_hand(session);
  const std::uint64_t after = session.mesh().hash();
  EXPECT_TRUE(session.undo().value());
  EXPECT_EQ(session.mesh().hash(), before);
  EXPECT_EQ(session.figures().tets, 162U);
  EXPECT_EQ(session.figures().strokes, 0U);
  EXPECT_TRUE(session.redo().value());
  EXPECT_EQ(session.mesh().hash(), after);
  EXPECT_EQ(session.figures().strokes, 1U);
  EXPECT_EQ(texts(session, Operation::Kind::kUndo).size(), 1U);
  EXPECT_EQ(texts(session, Operation::Kind::kRedo).size(), 1U);
}

TEST(SessionLive, undo_within_a_stroke_takes_it_back) {
  Session session = opened(still_scene());
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(session.frame(hand_at(0.52, 0.1 * i)).ok());
  EXPECT_TRUE(session.undo().value());
  EXPECT_EQ(session.figures().tets, 162U);
  play(session, 2);
  EXPECT_TRUE(texts(session, Operation::Kind::kStroke).empty());
}

TEST(SessionLive, keeps_as_many_strokes_for_undo_as_it_is_told) {
  SessionOptions options;
  options.keep_undo = 2;
  Session session = opened(still_scene(), options);
  Session all = opened(still_scene());
  for (const double x : {0.3, 0.52, 0.74}) {
    cut_by_hand(session, x);
    cut_by_hand(all, x);
  }
  EXPECT_EQ(session.simulation()->hash(), all.simulation()->hash());
  EXPECT_GT(session.engine().journal().first(), 0U);
  EXPECT_EQ(all.engine().journal().first(), 0U) << "three strokes are fewer than " << incise::app::kKeptStrokes;
  EXPECT_LT(session.engine().journal().memory_bytes(), all.engine().journal().memory_bytes());
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(session.undo().value());
    EXPECT_TRUE(all.undo().value());
    EXPECT_EQ(session.mesh().hash(), all.mesh().hash());
  }
  EXPECT_FALSE(session.undo().value());
  EXPECT_TRUE(all.undo().value());
  EXPECT_TRUE(session.redo().value());
  play(session, 3);
  ASSERT_TRUE(session.reset().ok());
  for (const double x : {0.3, 0.52, 0.74}) cut_by_hand(session, x);
  EXPECT_GT(session.engine().journal().first(), 0U);
}

TEST_F(SessionFiles, keeps_all_strokes_of_a_recording_until_a_hand_takes_over) {
  const std::string recording = write_simulation_recording(folder_);
  SessionOptions options;
  options.keep_undo = 1;
  Session session = Session::open(std::filesystem::path(recording), options).value();
  ASSERT_TRUE(session.seek(session.place().calls).ok());
  EXPECT_EQ(session.engine().journal().first(), 0U);
  ASSERT_TRUE(session.take_over());
  for (const double x : {0.3, 0.74}) cut_by_hand(session, x);
  EXPECT_GT(session.engine().journal().first(), 0U);
  EXPECT_TRUE(session.undo().value());
  EXPECT_FALSE(session.undo().value());
}

TEST(SessionLive, reset_goes_back_to_the_start) {
  Session session = opened(cut_scene());
  const std::uint64_t start = session.simulation()->hash();
  play(session, 40);
  const std::uint64_t end = session.simulation()->hash();
  ASSERT_TRUE(session.reset().ok());
  EXPECT_EQ(session.simulation()->hash(), start);
  EXPECT_EQ(session.figures().frames, 0U);
  EXPECT_EQ(session.figures().tets, 162U);
  EXPECT_TRUE(session.figures().force.empty());
  play(session, 40);
  EXPECT_EQ(session.simulation()->hash(), end);
}

TEST(SessionLive, a_malformed_blade_is_an_error_and_the_session_goes_on) {
  Session session = opened(still_scene());
  app::HandState hands = hand_at(0.5, 0);
  hands.blade->edge[1].x() = std::nan("");
  EXPECT_FALSE(session.frame(hands).ok());
  EXPECT_EQ(texts(session, Operation::Kind::kNotice).size(), 1U);
  play(session, 1);
  cut_by_hand(session);
  EXPECT_EQ(session.figures().strokes, 1U);
}

// --- recordings

TEST_F(SessionFiles, a_recording_from_the_start_replays) {
  SessionOptions options;
  options.record = folder_ / "log.jsonl";
  Session session = opened(cut_scene(), options);
  EXPECT_TRUE(session.is_recording());
  play(session, 20);
  cut_by_hand(session, 0.8);
  session.stop_recording();
  EXPECT_FALSE(session.is_recording());
  const app::ReplayResult result = verified(folder_ / "log.jsonl");
  EXPECT_EQ(result.hash, session.simulation()->hash());
  EXPECT_EQ(result.calls, 1U + 20 + 8);
}

TEST_F(SessionFiles, a_recording_begun_in_the_middle_replays_from_the_start) {
  Session session = opened(cut_scene());
  play(session, 10);
  cut_by_hand(session, 0.8);
  EXPECT_TRUE(session.undo().value());
  ASSERT_TRUE(session.start_recording(folder_ / "log.jsonl").ok());
  play(session, 5);
  cut_by_hand(session, 0.2);
  EXPECT_EQ(verified(folder_ / "log.jsonl").hash, session.simulation()->hash());
}

TEST_F(SessionFiles, calls_before_the_recording_have_no_hash_but_the_last) {
  Session session = opened(still_scene());
  play(session, 3);
  const std::uint64_t hash = session.simulation()->hash();
  ASSERT_TRUE(session.start_recording(folder_ / "log.jsonl").ok());
  play(session, 1);
  app::SimulationReader reader = app::SimulationReader::open(std::filesystem::path(folder_ / "log.jsonl")).value();
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(reader.next().value()->hash.has_value());
  EXPECT_EQ(reader.next().value()->hash, hash);
  EXPECT_EQ(reader.next().value()->hash, session.simulation()->hash());
  EXPECT_FALSE(reader.next().value().has_value());
}

TEST_F(SessionFiles, a_changed_call_without_a_hash_is_found_at_the_next_that_has_one) {
  Session session = opened(still_scene());
  cut_by_hand(session);
  ASSERT_TRUE(session.start_recording(folder_ / "log.jsonl").ok());
  session.stop_recording();
  std::string text = read(folder_ / "log.jsonl");
  const std::size_t at = text.find("0.52", text.find("\"frame\"", text.find('\n')));
  ASSERT_NE(at, std::string::npos);
  for (std::size_t i = at; i != std::string::npos; i = text.find("0.52", i)) text.replace(i, 4, "0.27");
  const Result<app::ReplayResult> result = app::run_replay({folder_.write("log.jsonl", text), true});
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_TRUE(result->difference.has_value());
  Session replay = open_file(folder_ / "log.jsonl");
  ASSERT_TRUE(replay.seek(replay.place().calls).ok());
  EXPECT_EQ(texts(replay, Operation::Kind::kReplay), std::vector<std::string>{"End: NOT the state that was recorded"});
}

TEST_F(SessionFiles, a_recording_begins_again_under_numbers_after_resets) {
  SessionOptions options;
  options.record = folder_ / "log.jsonl";
  Session session = opened(still_scene(), options);
  for (int i = 0; i < 3; ++i) {
    play(session, 1 + i);
    ASSERT_TRUE(session.reset().ok());
    EXPECT_TRUE(session.is_recording());
  }
  session.stop_recording();
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"log-2.jsonl", "log-3.jsonl", "log-4.jsonl", "log.jsonl"}));
  for (const std::string& name : folder_.names()) verified(folder_ / name);
  EXPECT_EQ(verified(folder_ / "log-3.jsonl").calls, 1U + 3);
  ASSERT_TRUE(session.reset().ok());
  EXPECT_FALSE(session.is_recording());
}

TEST_F(SessionFiles, a_recording_after_a_reset_spares_files_that_are_there) {
  folder_.write("log-2.jsonl", "precious");
  SessionOptions options;
  options.record = folder_ / "log.jsonl";
  Session session = opened(still_scene(), options);
  ASSERT_TRUE(session.reset().ok());
  EXPECT_EQ(read(folder_ / "log-2.jsonl"), "precious");
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"log-2.jsonl", "log-3.jsonl", "log.jsonl"}));
}

TEST_F(SessionFiles, a_copy_of_the_recording_may_be_saved_at_any_time) {
  SessionOptions options;
  options.record = folder_ / "log.jsonl";
  Session session = opened(still_scene(), options);
  cut_by_hand(session);
  ASSERT_TRUE(session.save_recording(folder_ / "copy.jsonl").ok());
  EXPECT_TRUE(session.is_recording());
  EXPECT_EQ(verified(folder_ / "copy.jsonl").hash, session.simulation()->hash());
  play(session, 2);
  EXPECT_EQ(verified(folder_ / "log.jsonl").hash, session.simulation()->hash());
  EXPECT_FALSE(session.save_recording(folder_ / "absent/copy.jsonl").ok());
}

TEST_F(SessionFiles, a_copy_saved_before_anything_was_done_is_a_recording_of_nothing) {
  Json scene = still_scene();
  scene.erase("settle");
  const Session session = opened(scene);
  ASSERT_TRUE(session.save_recording(folder_ / "copy.jsonl").ok());
  EXPECT_EQ(verified(folder_ / "copy.jsonl").calls, 0U);
  EXPECT_TRUE(Session::open(folder_ / "copy.jsonl").ok());
}

TEST_F(SessionFiles, a_recording_in_a_folder_that_is_not_there_is_an_error_and_the_session_goes_on) {
  Session session = opened(still_scene());
  play(session, 2);
  const Status status = session.start_recording(folder_ / "absent/log.jsonl");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
  EXPECT_NE(status.error().message.find("absent/log.jsonl"), std::string::npos);
  EXPECT_FALSE(session.is_recording());
  cut_by_hand(session);
  EXPECT_EQ(session.figures().strokes, 1U);
  EXPECT_FALSE(Session::open(parsed(still_scene()), {1, {}, folder_ / "absent/log.jsonl"}).ok());
}

TEST_F(SessionFiles, a_recording_that_fails_at_a_frame_ends_and_the_frame_counts) {
  Json scene = still_scene();
  scene.erase("settle");
  Session session = opened(scene);
  ASSERT_TRUE(session.start_recording(folder_ / "absent/log.jsonl").ok());  // nothing to be written yet
  const Status status = session.frame();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
  EXPECT_FALSE(session.is_recording());
  EXPECT_EQ(session.figures().frames, session.simulation()->frames());
  play(session, 1);
  ASSERT_TRUE(session.start_recording(folder_ / "log.jsonl").ok());
  EXPECT_EQ(verified(folder_ / "log.jsonl").hash, session.simulation()->hash());
}

// --- replay

TEST_F(SessionFiles, plays_a_recording_call_by_call_to_its_end) {
  Session session = open_file(write_simulation_recording(folder_));
  const std::uint64_t calls = session.place().calls;
  for (std::uint64_t call = 0; call < calls; ++call) {
    EXPECT_EQ(session.place().call, call);
    play(session, 1);
  }
  EXPECT_EQ(session.simulation()->hash(), verified(folder_ / "log.jsonl").hash);
  const std::uint64_t count = session.log().count();
  play(session, 3);
  EXPECT_EQ(session.place().call, calls);
  EXPECT_EQ(session.log().count(), count);
  EXPECT_EQ(texts(session, Operation::Kind::kReplay), std::vector<std::string>{"End: the same state as was recorded"});
}

TEST_F(SessionFiles, hands_do_nothing_while_a_recording_plays) {
  Session session = open_file(write_simulation_recording(folder_));
  session.follow(stroke_at(0.27));
  EXPECT_FALSE(session.is_following());
  EXPECT_FALSE(session.undo().value());
  EXPECT_FALSE(session.redo().value());
  const std::uint64_t calls = session.place().calls;
  for (std::uint64_t call = 0; call < calls; ++call) {
    ASSERT_TRUE(session.frame(hand_at(0.8, 0.01 * static_cast<double>(call))).ok());
  }
  EXPECT_EQ(session.simulation()->hash(), verified(folder_ / "log.jsonl").hash);
}

TEST_F(SessionFiles, seeking_gives_the_same_as_playing) {
  for (const std::string& file : {write_simulation_recording(folder_), write_engine_recording(folder_)}) {
    Session played = open_file(file), sought = open_file(file);
    std::vector<std::uint64_t> hashes = {played.mesh().hash()};
    for (std::uint64_t call = 0; call < played.place().calls; ++call) {
      play(played, 1);
      hashes.push_back(played.mesh().hash());
    }
    const std::uint64_t last = hashes.size() - 1;
    for (const std::uint64_t call : {last, last - 1, std::uint64_t{0}, last / 2, last / 2, last / 2 + 1, last}) {
      ASSERT_TRUE(sought.seek(call).ok());
      EXPECT_EQ(sought.place().call, call);
      EXPECT_EQ(sought.mesh().hash(), hashes[call]) << file << " " << call;
      EXPECT_EQ(sought.figures().tets, sought.mesh().tet_count());
    }
    ASSERT_TRUE(sought.seek(1'000'000).ok());
    EXPECT_EQ(sought.place().call, last);
  }
}

TEST_F(SessionFiles, seeking_stops_where_it_is_told_to) {
  Session session = open_file(write_simulation_recording(folder_));
  int asked = 0;
  ASSERT_TRUE(session.seek(15, [&] { return ++asked == 4; }).ok());
  EXPECT_EQ(session.place().call, 4U);
}

TEST_F(SessionFiles, the_next_step_is_the_end_of_a_stroke_an_undo_or_a_redo) {
  Session session = open_file(write_simulation_recording(folder_));
  std::vector<std::uint64_t> places;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(session.seek_next_step().ok());
    places.push_back(session.place().call);
  }
  EXPECT_EQ(places, (std::vector<std::uint64_t>{14, 15, 16, 21, 21}));
}

TEST_F(SessionFiles, the_next_step_of_an_engine_is_a_stroke_or_an_undo) {
  Session session = open_file(write_engine_recording(folder_));
  std::vector<std::uint32_t> strokes;
  while (session.place().call < session.place().calls) {
    ASSERT_TRUE(session.seek_next_step().ok());
    strokes.push_back(session.engine().stroke_count());
  }
  EXPECT_EQ(strokes, (std::vector<std::uint32_t>{1, 2, 1}));
  EXPECT_EQ(texts(session, Operation::Kind::kReplay), std::vector<std::string>{"End: the same mesh as was recorded"});
}

TEST_F(SessionFiles, reset_of_a_replay_begins_it_again) {
  Session session = open_file(write_simulation_recording(folder_));
  const std::uint64_t start = session.mesh().hash();
  ASSERT_TRUE(session.seek(15).ok());
  ASSERT_TRUE(session.reset().ok());
  EXPECT_TRUE(session.is_replay());
  EXPECT_EQ(session.place().call, 0U);
  EXPECT_EQ(session.mesh().hash(), start);
}

TEST_F(SessionFiles, taking_over_makes_it_live_and_recordable) {
  Session session = open_file(write_simulation_recording(folder_));
  ASSERT_TRUE(session.seek(14).ok());
  EXPECT_TRUE(session.take_over());
  EXPECT_FALSE(session.is_replay());
  EXPECT_EQ(session.place().calls, 0U);
  cut_by_hand(session, 0.8);
  EXPECT_EQ(session.figures().strokes, 2U);
  EXPECT_TRUE(session.undo().value());
  ASSERT_TRUE(session.start_recording(folder_ / "on.jsonl").ok());
  play(session, 2);
  EXPECT_EQ(verified(folder_ / "on.jsonl").hash, session.simulation()->hash());
}

TEST_F(SessionFiles, recordings_of_an_engine_can_only_be_watched) {
  Session session = open_file(write_engine_recording(folder_));
  EXPECT_FALSE(session.take_over());
  EXPECT_TRUE(session.is_replay());
  EXPECT_FALSE(session.start_recording(folder_ / "on.jsonl").ok());
  EXPECT_FALSE(session.save_recording(folder_ / "on.jsonl").ok());
  EXPECT_FALSE(session.is_recording());
}

TEST_F(SessionFiles, seeking_back_ends_a_recording_of_the_replay_which_is_whole) {
  Session session = open_file(write_simulation_recording(folder_));
  ASSERT_TRUE(session.seek(10).ok());
  ASSERT_TRUE(session.start_recording(folder_ / "again.jsonl").ok());
  ASSERT_TRUE(session.seek(14).ok());
  const std::uint64_t hash = session.simulation()->hash();
  ASSERT_TRUE(session.seek(3).ok());
  EXPECT_FALSE(session.is_recording());
  EXPECT_EQ(texts(session, Operation::Kind::kRecording).size(), 2U);
  EXPECT_EQ(verified(folder_ / "again.jsonl").hash, hash);
}

// --- what goes out

TEST_F(SessionFiles, an_exported_mesh_reads_back) {
  Session session = opened(still_scene());
  cut_by_hand(session);
  for (const char* name : {"out.vtu", "out.mesh", "out.msh"}) {
    ASSERT_TRUE(session.export_mesh(folder_ / name).ok()) << name;
    const Result<io::LoadedMesh> loaded = io::load_mesh(folder_ / name);
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_EQ(loaded->mesh.tet_count(), session.mesh().tet_count());
    EXPECT_EQ(rest_bounds(loaded->mesh).hi, Vec3(1, 1, 1));
  }
  EXPECT_FALSE(session.export_mesh(folder_ / "absent/out.vtu").ok());
  EXPECT_FALSE(session.export_mesh(folder_ / "out.xyz").ok());
}

TEST(SessionLive, an_exercise_scores) {
  Json scene = still_scene();
  scene["exercise"] = {
      {"target", {{0.52, 0.1, 1}, {0.52, 0.9, 1}}}, {"depth", 0.5}, {"tolerances", {{"line", 0.15}, {"depth", 0.2}}}};
  Session session = opened(scene);
  ASSERT_TRUE(session.score().has_value());
  EXPECT_EQ(session.score()->points, 0);
  cut_by_hand(session);
  EXPECT_GT(session.score()->points, 30);
  EXPECT_EQ(session.score()->strokes, 1U);
  ASSERT_TRUE(session.reset().ok());
  EXPECT_EQ(session.score()->points, 0);
}

std::size_t lines_of(const Session& session, app::Ink ink, bool shows_ideal = false) {
  app::Marks marks;
  session.draw(marks, shows_ideal);
  return static_cast<std::size_t>(std::count_if(marks.lines.begin(), marks.lines.end(),
                                                [&](const app::Marks::Line& line) { return line.ink == ink; }));
}

TEST(SessionLive, draws_what_the_scene_does_but_not_what_the_hand_does) {
  Json scene = cut_scene();
  scene["exercise"] = full_scene()["exercise"];
  Session session = opened(scene);
  EXPECT_EQ(lines_of(session, app::Ink::kTarget), 1U);
  EXPECT_EQ(lines_of(session, app::Ink::kBlade), 0U);
  play(session, 8);
  EXPECT_EQ(lines_of(session, app::Ink::kBlade), 1U);
  EXPECT_EQ(lines_of(session, app::Ink::kIdeal), 0U);
  EXPECT_EQ(lines_of(session, app::Ink::kIdeal, true), 1U);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(session.frame(hand_at(0.7, -0.2)).ok());
  EXPECT_EQ(lines_of(session, app::Ink::kBlade), 0U);
}

TEST(SessionLive, draws_sutures_once_they_hold) {
  Json scene = still_scene();
  scene["sutures"] = {{{"from", {0.4, 0.5, 0.5}}, {"to", {0.6, 0.5, 0.5}}, {"start", 0.05}}};
  Session session = opened(scene);
  EXPECT_EQ(lines_of(session, app::Ink::kPin), 0U);
  play(session, 8);
  EXPECT_EQ(lines_of(session, app::Ink::kPin), 1U);
}

TEST_F(SessionFiles, draws_the_blade_of_a_recording) {
  Session session = open_file(write_simulation_recording(folder_));
  ASSERT_TRUE(session.seek(8).ok());
  EXPECT_EQ(lines_of(session, app::Ink::kBlade), 2U);
  ASSERT_TRUE(session.seek(14).ok());
  EXPECT_EQ(lines_of(session, app::Ink::kBlade), 0U);
}

TEST(OperationLog, keeps_the_newest) {
  app::OperationLog log;
  for (std::size_t i = 0; i < app::OperationLog::kMost + 5; ++i)
    log.add({Operation::Kind::kNotice, 0, std::to_string(i)});
  EXPECT_EQ(log.operations().size(), app::OperationLog::kMost);
  EXPECT_EQ(log.operations().front().text, "5");
  EXPECT_EQ(log.operations().back().text, "1004");
  EXPECT_EQ(log.count(), 1005U);
}

}  // namespace

}  // namespace session_test
