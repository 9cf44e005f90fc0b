// SPDX-License-Identifier: Apache-2.0
// No test here is about time: waits are as long as they have to be, up to a bound that is generous.
#include "app/session/session_thread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/jobs/replay_job.h"
#include "app/session/session_cases.h"

namespace session_thread_test {
namespace {

using namespace incise;
using namespace incise_test;
using app::SessionThread;
using app::SessionThreadOptions;
using app::SessionView;

SessionThreadOptions fast() {
  SessionThreadOptions options;
  options.speed = 0;
  return options;
}

SessionThreadOptions paused() {
  SessionThreadOptions options = fast();
  options.is_paused = true;
  return options;
}

/// Takes views until one holds what is asked for.
template <class Condition>
bool sees(SessionThread& thread, const Condition& holds) {
  return wait_for([&] {
    thread.take();
    return holds(thread.view());
  });
}

bool sees_notice(SessionThread& thread, const std::string& text) {
  return sees(thread, [&](const SessionView& view) { return view.notice.find(text) != std::string::npos; });
}

/// Waits until all commands so far have been done.
void sync(SessionThread& thread) {
  const std::uint64_t notices = thread.view().notices;
  thread.export_mesh("/absent/mesh.vtu");
  EXPECT_TRUE(sees(thread, [&](const SessionView& view) { return view.notices > notices && view.busy.empty(); }));
}

bool has_seen_frame(const SessionView& view) {
  return view.figures.frames > 0;
}

class SessionThreadTest : public testing::Test {
 protected:
  Folder folder_;
};

TEST_F(SessionThreadTest, the_view_is_whole_before_the_first_was_taken) {
  SessionThread thread(opened(still_scene()), paused());
  ASSERT_NE(thread.view().log, nullptr);
  EXPECT_TRUE(thread.view().log->empty());
  EXPECT_EQ(thread.view().session, 0U);
}

TEST_F(SessionThreadTest, shows_frames) {
  SessionThread thread(opened(cut_scene()), fast());
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.frames >= 40; }));
  const SessionView& view = thread.view();
  EXPECT_EQ(view.session, 1U);
  EXPECT_EQ(view.title, "a cut cube");
  EXPECT_EQ(view.figures.strokes, 1U);
  EXPECT_EQ(view.quality.tets, view.figures.tets);
  EXPECT_EQ(view.quality_before.tets, 162U);
  EXPECT_GT(view.surface.positions.size(), 0U);
  EXPECT_FALSE(view.log->empty());
  EXPECT_FALSE(view.body.is_empty());
  EXPECT_TRUE(view.busy.empty());
}

TEST_F(SessionThreadTest, serials_grow_and_a_view_is_taken_once) {
  SessionThread thread(opened(still_scene()), fast());
  std::uint64_t serial = 0;
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(wait_for([&] { return thread.take(); }));
    EXPECT_GT(thread.view().serial, serial);
    serial = thread.view().serial;
  }
}

TEST_F(SessionThreadTest, a_paused_session_makes_the_steps_that_are_asked_for) {
  SessionThread thread(opened(still_scene()), paused());
  for (int i = 0; i < 3; ++i) thread.step();
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.frames == 3; }));
  sync(thread);
  EXPECT_EQ(thread.view().figures.frames, 3U);
  EXPECT_TRUE(thread.view().is_paused);
  thread.pause(false);
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.frames > 5 && !view.is_paused; }));
}

TEST_F(SessionThreadTest, a_step_pauses) {
  SessionThread thread(opened(still_scene()), fast());
  thread.step();
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.is_paused; }));
}

TEST_F(SessionThreadTest, a_paused_session_where_nothing_happens_shows_nothing_new) {
  SessionThread thread(opened(still_scene()), paused());
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.validity.state == app::ValidityState::kValid; }));
  sync(thread);
  const std::uint64_t serial = thread.view().serial;
  std::this_thread::sleep_for(std::chrono::milliseconds(350));
  EXPECT_FALSE(thread.take());
  EXPECT_EQ(thread.view().serial, serial);
}

TEST_F(SessionThreadTest, commands_are_done_in_their_order) {
  SessionThread thread(opened(still_scene()), paused());
  thread.start_recording(folder_ / "log.jsonl");
  for (int i = 0; i < 4; ++i) thread.step();
  thread.undo();
  thread.redo();
  thread.export_mesh(folder_ / "out.vtu");
  ASSERT_TRUE(sees_notice(thread, "out.vtu"));
  EXPECT_EQ(thread.view().notices, 4U);
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"log.jsonl", "out.vtu"}));
}

TEST_F(SessionThreadTest, commands_are_done_while_a_slow_session_waits_for_its_frame) {
  SessionThreadOptions options;
  options.speed = 1e-9;
  SessionThread thread(opened(still_scene()), options);
  ASSERT_TRUE(sees(thread, has_seen_frame));
  thread.undo();
  EXPECT_TRUE(sees_notice(thread, "Nothing to undo"));
  thread.set_speed(0);
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.frames > 10; }));
}

TEST_F(SessionThreadTest, keeps_pace_with_the_clock) {
  SessionThread thread(opened(still_scene()));
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.real_time > 0 && view.steps_per_second > 0; }));
}

TEST_F(SessionThreadTest, hands_reach_the_simulation) {
  SessionThread thread(opened(still_scene()), fast());
  for (int i = 0; i <= 6; ++i) thread.set_hands(hand_at(0.52, -0.1 + 0.1 * i));
  thread.set_hands({});
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.strokes == 1; }));
  thread.undo();
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.strokes == 0; }));
  EXPECT_EQ(thread.view().notice, "Stroke taken back");
  EXPECT_EQ(thread.view().quality.tets, 162U);
  thread.redo();
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.strokes == 1; }));
}

TEST_F(SessionThreadTest, strokes_are_followed) {
  SessionThread thread(opened(still_scene()), fast());
  thread.follow(stroke_at(0.27));
  thread.follow(stroke_at(0.77));
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.strokes == 2; }));
}

TEST_F(SessionThreadTest, the_light_follows_a_cut) {
  SessionThread thread(opened(still_scene()), fast());
  thread.follow(stroke_at(0.52));
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.strokes == 1; }));
  thread.pause(true);
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.validity.state == app::ValidityState::kValid; }));
}

TEST_F(SessionThreadTest, a_bad_file_leaves_the_session_and_gives_a_notice) {
  SessionThread thread(opened(still_scene()), fast());
  ASSERT_TRUE(sees(thread, has_seen_frame));
  thread.open(folder_ / "absent.mesh");
  ASSERT_TRUE(sees_notice(thread, "absent.mesh"));
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.busy.empty(); }));
  EXPECT_EQ(thread.view().session, 1U);
  EXPECT_EQ(thread.view().title, "a cut cube");
  const std::uint64_t frames = thread.view().figures.frames;
  EXPECT_TRUE(sees(thread, [&](const SessionView& view) { return view.figures.frames > frames; }));
}

TEST_F(SessionThreadTest, opens_another_file) {
  SessionThread thread(opened(still_scene()), fast());
  app::HandState hands;
  hands.hooks.push_back({0, {0.5, 0.5, 1.2}, 0.4, 1000});
  thread.set_hands(hands);
  thread.open(folder_.write("cube.mesh", cube_mesh(2)));
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.session == 2 && view.busy.empty(); }));
  EXPECT_EQ(thread.view().title, "cube.mesh");
  EXPECT_EQ(thread.view().quality_before.tets, 48U);
  EXPECT_TRUE(sees_notice(thread, "Opened cube.mesh"));
}

TEST_F(SessionThreadTest, reset_begins_anew_with_the_hands_off) {
  SessionThread thread(opened(cut_scene()), paused());
  thread.set_hands(hand_at(0.52, 0.2));
  thread.step();
  thread.reset();
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.session == 2 && view.busy.empty(); }));
  EXPECT_EQ(thread.view().figures.frames, 0U);
  thread.pause(false);
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.strokes == 1; }));  // the script's
}

TEST_F(SessionThreadTest, replays_pause_at_their_end) {
  SessionThread thread(app::Session::open(std::filesystem::path(write_simulation_recording(folder_))).value(), fast());
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.is_paused; }));
  EXPECT_TRUE(thread.view().is_replay);
  EXPECT_EQ(thread.view().place.call, thread.view().place.calls);
  EXPECT_EQ(thread.view().log->back().text, "End: the same state as was recorded");
}

TEST_F(SessionThreadTest, seeks_forward_and_back) {
  SessionThread thread(app::Session::open(std::filesystem::path(write_simulation_recording(folder_))).value(),
                       paused());
  thread.seek(14);
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.place.call == 14; }));
  const std::uint64_t cut = thread.view().quality.tets;
  EXPECT_GT(cut, 162U);
  EXPECT_EQ(thread.view().quality.tets, thread.view().figures.tets);
  thread.seek(3);
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.place.call == 3; }));
  EXPECT_EQ(thread.view().quality.tets, 162U);
  thread.seek_next_step();
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.place.call == 14; }));
  EXPECT_EQ(thread.view().quality.tets, cut);
}

TEST_F(SessionThreadTest, the_next_step_of_a_live_session_does_nothing) {
  SessionThread thread(opened(still_scene()), fast());
  thread.seek_next_step();
  sync(thread);
  EXPECT_FALSE(thread.view().is_paused);
}

TEST_F(SessionThreadTest, taking_over_goes_on_by_hand) {
  SessionThread thread(app::Session::open(std::filesystem::path(write_simulation_recording(folder_))).value(),
                       paused());
  thread.seek(3);
  thread.take_over();
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return !view.is_replay && !view.is_paused; }));
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.figures.frames > 5; }));
}

TEST_F(SessionThreadTest, a_recording_of_an_engine_can_only_be_watched) {
  SessionThread thread(app::Session::open(std::filesystem::path(write_engine_recording(folder_))).value(), paused());
  thread.take_over();
  EXPECT_TRUE(sees_notice(thread, "only be watched"));
  EXPECT_TRUE(thread.view().is_replay);
}

/// A recording of many frames.
std::string long_recording(const Folder& folder) {
  app::SessionOptions options;
  options.record = folder / "long.jsonl";
  app::Session session = opened(still_scene(), options);
  play(session, 2000);
  return options.record.string();
}

TEST_F(SessionThreadTest, a_long_seek_is_broken_off_by_the_next_command_and_by_the_end) {
  app::Session session = app::Session::open(std::filesystem::path(long_recording(folder_))).value();
  SessionThread thread(std::move(session), paused());
  thread.seek(1'000'000);
  thread.seek(1);
  thread.seek(2);
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.place.call == 2; }));
  thread.seek(1'000'000);
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.place.call > 2; }));
}

TEST_F(SessionThreadTest, recordings_begin_and_end) {
  SessionThread thread(opened(still_scene()), fast());
  thread.start_recording(folder_ / "log.jsonl");
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.is_recording; }));
  thread.stop_recording();
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return !view.is_recording; }));
  EXPECT_EQ(thread.view().notice, "Recording ended");
  EXPECT_TRUE(app::run_replay({folder_ / "log.jsonl", true}).ok());
  thread.start_recording(folder_ / "absent/log.jsonl");
  EXPECT_TRUE(sees_notice(thread, "absent/log.jsonl"));
  EXPECT_FALSE(thread.view().is_recording);
}

TEST_F(SessionThreadTest, a_recording_is_whole_when_the_thread_has_ended) {
  {
    SessionThread thread(opened(still_scene()), fast());
    thread.start_recording(folder_ / "log.jsonl");
    ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.is_recording && view.figures.frames > 10; }));
  }
  const Result<app::ReplayResult> result = app::run_replay({folder_ / "log.jsonl", true});
  ASSERT_TRUE(result.ok());
  EXPECT_FALSE(result->difference.has_value());
  EXPECT_FALSE(result->is_cut_off);
}

TEST_F(SessionThreadTest, a_place_is_probed_until_its_tet_is_gone) {
  SessionThread thread(opened(still_scene()), paused());
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.session == 1; }));
  const Side side = thread.view().surface.topology->sides.at(0);
  thread.probe(side);
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.probe.has_value(); }));
  EXPECT_EQ(thread.view().probe->tet, side.tet());
  EXPECT_EQ(thread.view().marks.lines.size(), 6U);
  thread.probe(Side(TetId(100000), 0));
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return !view.probe.has_value(); }));
}

TEST_F(SessionThreadTest, the_worst_tets_are_marked) {
  SessionThread thread(opened(still_scene()), paused());
  thread.show({}, 5);
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.marks.lines.size() == 5 * 6; }));
  thread.show({}, 0);
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return view.marks.lines.empty(); }));
}

TEST_F(SessionThreadTest, a_clip_plane_hides_tets_but_not_how_large_the_body_is) {
  SessionThread thread(opened(still_scene()), paused());
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.session == 1; }));
  const Box whole = thread.view().body;
  thread.show({app::HalfSpace{Vec3::UnitX(), 0.5}}, 0);
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return bounds_of(view.surface).lo.x() > 0.2; }));
  EXPECT_LT((thread.view().body.lo - whole.lo).norm(), 1e-6);
  EXPECT_LT((thread.view().body.hi - whole.hi).norm(), 1e-6);
  thread.show({app::HalfSpace{Vec3::UnitX(), 5}}, 0);
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.surface.topology->used == 0; }));
  EXPECT_FALSE(thread.view().body.is_empty());
}

Json exercise() {
  Json scene = still_scene();
  scene["exercise"] = {
      {"target", {{0.52, 0.1, 1}, {0.52, 0.9, 1}}}, {"depth", 0.5}, {"tolerances", {{"line", 0.15}, {"depth", 0.2}}}};
  return scene;
}

TEST_F(SessionThreadTest, a_score_writes_both_files_and_pauses) {
  SessionThread thread(opened(exercise()), fast());
  ASSERT_TRUE(sees(thread, has_seen_frame));
  thread.score(folder_ / "score.json", folder_ / "attempt.jsonl");
  ASSERT_TRUE(sees(thread, [](const SessionView& view) { return view.score.has_value() && view.is_paused; }));
  EXPECT_TRUE(sees_notice(thread, "score.json"));
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"attempt.jsonl", "score.json"}));
  EXPECT_EQ(Json::parse(read(folder_ / "score.json"))["format"], "incise-exercise-score");
  EXPECT_TRUE(app::run_replay({folder_ / "attempt.jsonl", true}).ok());
  EXPECT_FALSE(thread.view().is_recording);
  thread.reset();
  EXPECT_TRUE(sees(thread, [](const SessionView& view) { return !view.score.has_value(); }));
}

TEST_F(SessionThreadTest, a_score_within_a_recording_writes_the_attempt_and_goes_on_recording) {
  SessionThread thread(opened(exercise()), paused());
  thread.start_recording(folder_ / "log.jsonl");
  thread.step();
  thread.score(folder_ / "score.json", folder_ / "attempt.jsonl");
  ASSERT_TRUE(sees_notice(thread, "score.json"));
  EXPECT_TRUE(thread.view().is_recording);
  EXPECT_TRUE(app::run_replay({folder_ / "attempt.jsonl", true}).ok());
}

TEST_F(SessionThreadTest, a_scene_without_an_exercise_has_no_score) {
  SessionThread thread(opened(still_scene()), fast());
  thread.score(folder_ / "score.json", folder_ / "attempt.jsonl");
  EXPECT_TRUE(sees_notice(thread, "no exercise"));
  EXPECT_FALSE(thread.view().is_paused);
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(SessionThreadTest, ends_at_once_whatever_is_waiting) {
  SessionThread thread(opened(cut_scene()), fast());
  for (int i = 0; i < 20; ++i) {
    thread.step();
    thread.reset();
    thread.set_hands(hand_at(0.1 * i, 0));
  }
}

}  // namespace

}  // namespace session_thread_test
