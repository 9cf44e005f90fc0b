// SPDX-License-Identifier: Apache-2.0
// Sutures and other tools of the hand in sessions: undo, redo, recording, replay, and their order among strokes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/jobs/replay_job.h"
#include "app/session/session_cases.h"
#include "app/session/session_thread.h"

namespace session_sutures_test {
namespace {

using namespace incise;
using namespace incise_test;
using app::Session;
using app::SessionOptions;

const std::array<Vec3, 2> kAcross = {Vec3(0.45, 0.5, 1), Vec3(0.59, 0.5, 1)};  // of a cut at x = 0.52

std::size_t holding(const Session& session) {
  const std::vector<SutureState> all = session.simulation()->sutures();
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const SutureState& s) { return s.status == SutureStatus::kHolds; }));
}

std::string last_text(const Session& session) {
  return session.log().operations().back().text;
}

TEST(SessionSutures, AreTakenBackInTurnWithStrokes) {
  Session session = opened(still_scene());
  cut_by_hand(session);
  ASSERT_TRUE(session.add_suture(kAcross, {}).ok());
  Suture staple;
  staple.pushes = true;
  play(session, 3);
  ASSERT_TRUE(session.add_suture({Vec3(0.45, 0.2, 1), Vec3(0.59, 0.2, 1)}, staple).ok());
  cut_by_hand(session, 0.27);
  EXPECT_EQ(holding(session), 2U);
  const std::uint64_t strokes = session.figures().strokes;
  EXPECT_TRUE(session.undo().value());  // the second cut
  EXPECT_EQ(session.figures().strokes, strokes - 1);
  EXPECT_EQ(holding(session), 2U);
  EXPECT_TRUE(session.undo().value());
  EXPECT_EQ(last_text(session), "Staple taken out");
  EXPECT_EQ(holding(session), 1U);
  EXPECT_TRUE(session.undo().value());
  EXPECT_EQ(holding(session), 0U);
  EXPECT_TRUE(session.undo().value());  // the first cut
  EXPECT_EQ(session.figures().strokes, strokes - 2);
  EXPECT_FALSE(session.undo().value());
  for (const std::size_t expected : {0U, 1U, 2U, 2U}) {
    EXPECT_TRUE(session.redo().value());
    EXPECT_EQ(holding(session), expected);
    play(session, 1);
  }
  EXPECT_EQ(session.figures().strokes, strokes);
  EXPECT_FALSE(session.redo().value());
}

TEST(SessionSutures, ANewOneForgetsWhatWasTakenBack) {
  Session session = opened(still_scene());
  cut_by_hand(session);
  cut_by_hand(session, 0.27);
  EXPECT_TRUE(session.undo().value());
  ASSERT_TRUE(session.add_suture(kAcross, {}).ok());
  EXPECT_FALSE(session.redo().value());
  EXPECT_TRUE(session.undo().value());
  EXPECT_EQ(last_text(session), "Staple taken out");  // a suture pushes unless told otherwise
  EXPECT_TRUE(session.redo().value());
  EXPECT_EQ(holding(session), 1U);
}

TEST(SessionSutures, ANewStrokeForgetsThoseTakenOut) {
  Session session = opened(still_scene());
  cut_by_hand(session);
  ASSERT_TRUE(session.add_suture(kAcross, {}).ok());
  EXPECT_TRUE(session.undo().value());
  cut_by_hand(session, 0.27);
  EXPECT_FALSE(session.redo().value());
  EXPECT_EQ(holding(session), 0U);
}

TEST(SessionSutures, OnesInTheAirAreRefusedAndNothingChanges) {
  Session session = opened(still_scene());
  cut_by_hand(session);
  EXPECT_FALSE(session.add_suture({Vec3(0.5, 0.5, 9), Vec3(0.6, 0.5, 1)}, {}).ok());
  EXPECT_EQ(holding(session), 0U);
  EXPECT_TRUE(session.undo().value());
  EXPECT_EQ(session.figures().strokes, 0U);
}

TEST(SessionSutures, AreRecordedAndReplayed) {
  Folder folder;
  SessionOptions options;
  options.record = folder / "sewn.jsonl";
  {
    Session session = opened(still_scene(), options);
    cut_by_hand(session);
    Suture thread;
    thread.pushes = false;
    thread.strength = 5;
    ASSERT_TRUE(session.add_suture(kAcross, thread).ok());
    play(session, 3);
    ASSERT_TRUE(session.add_suture({Vec3(0.45, 0.2, 1), Vec3(0.59, 0.2, 1)}, {}).ok());
    play(session, 3);
    EXPECT_TRUE(session.undo().value());
    play(session, 3);
  }
  const Result<app::ReplayResult> result = app::run_replay({folder / "sewn.jsonl", true});
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_FALSE(result->difference.has_value());
  // Played in a session, which goes on by hand and takes them out.
  Session played = Session::open(folder / "sewn.jsonl").value();
  EXPECT_FALSE(played.add_suture(kAcross, {}).ok());
  ASSERT_TRUE(played.seek(played.place().calls).ok());
  EXPECT_EQ(holding(played), 1U);
  EXPECT_NE(last_text(played).find("the same state"), std::string::npos) << last_text(played);
  EXPECT_TRUE(played.take_over());
  EXPECT_TRUE(played.undo().value());
  EXPECT_EQ(holding(played), 0U);
}

TEST(SessionHands, GripsOfASideAreRecordedAndReplayed) {
  Folder folder;
  SessionOptions options;
  options.record = folder / "pulled.jsonl";
  {
    Session session = opened(still_scene(), options);
    cut_by_hand(session);
    app::HandState hands;
    hands.hooks.push_back({3, {0.45, 0.5, 1}, 0.2, 500, HookReach::kSurface, 0.5});
    for (int i = 0; i < 20; ++i) {
      hands.hooks[0].position += Vec3(-0.005, 0, 0.005);
      ASSERT_TRUE(session.frame(hands).ok());
    }
  }
  const Result<app::ReplayResult> result = app::run_replay({folder / "pulled.jsonl", true});
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_FALSE(result->difference.has_value());
}

/// A simulation that lags behind the hand: what is asked for after a stroke comes after that stroke.
TEST(SessionThreadHands, AnUndoAfterAStrokeTakesThatStrokeBack) {
  app::SessionThreadOptions options;
  options.speed = 0.2;  // a frame in a tenth of a second
  app::SessionThread thread(opened(still_scene()), options);
  ASSERT_TRUE(wait_for([&] { return thread.take(); }));
  for (int i = 0; i <= 20; ++i) thread.set_hands(hand_at(0.52, -0.1 + 0.6 * i / 20));
  thread.set_hands({});
  thread.undo();
  thread.set_hands(hand_at(0.27, -0.1));
  thread.set_hands(hand_at(0.27, 0.5));
  thread.set_hands({});
  ASSERT_TRUE(wait_for([&] {
    thread.take();
    const auto& log = *thread.view().log;
    return log.size() >= 3;
  }));
  const auto& log = *thread.view().log;
  EXPECT_EQ(log[0].kind, app::Operation::Kind::kStroke) << log[0].text;
  EXPECT_EQ(log[1].kind, app::Operation::Kind::kUndo) << log[1].text;
  EXPECT_EQ(log[2].kind, app::Operation::Kind::kStroke) << log[2].text;
  EXPECT_EQ(thread.view().figures.strokes, 1U);
}

/// A hand that begins while a plane cut is made waits for it; neither is lost.
TEST(SessionThreadHands, AStrokeDuringAPlaneCutComesAfterIt) {
  app::SessionThread thread(opened(still_scene()));
  ASSERT_TRUE(wait_for([&] { return thread.take(); }));
  thread.follow(stroke_at(0.77, 0.3));
  for (int i = 0; i <= 10; ++i) thread.set_hands(hand_at(0.27, -0.1 + 0.06 * i));
  thread.set_hands({});
  ASSERT_TRUE(wait_for([&] {
    thread.take();
    return thread.view().figures.strokes >= 2;
  }));
  EXPECT_EQ(thread.view().figures.strokes, 2U);
}

}  // namespace

}  // namespace session_sutures_test
