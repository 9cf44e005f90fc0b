// SPDX-License-Identifier: Apache-2.0
#include "app/viewer/viewer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "app/session/session_cases.h"

namespace viewer_test {
namespace {

using namespace incise;
using namespace incise_test;
using app::Action;
using app::PointerEvent;
using app::SessionView;
using app::ToolKind;
using app::Vec2;
using app::Viewer;
using app::ViewerState;
using Kind = PointerEvent::Kind;

/// A viewer of a paused session, with a clock that stands still until it is told to go on.
class ViewerTest : public testing::Test {
 protected:
  void show(app::Session session, const app::ViewerOptions& options = {}) {
    viewer_.reset();
    app::SessionThreadOptions thread;
    thread.speed = 0;
    thread.is_paused = true;
    thread_.emplace(std::move(session), thread);
    app::ViewerOptions chosen = options;
    chosen.folder = folder_ / "";
    viewer_.emplace(*thread_, chosen);
    EXPECT_TRUE(sees([](const SessionView& view) { return view.session == 1; }));
  }
  void SetUp() override { show(opened(still_scene())); }

  template <class Condition>
  bool sees(const Condition& holds) {
    return wait_for([&] {
      viewer_->update(port_, now_);
      return holds(viewer_->view());
    });
  }
  bool sees_notice(const std::string& text) {
    return wait_for([&] {
      viewer_->update(port_, now_);
      return state().notice.find(text) != std::string::npos;
    });
  }
  bool sees_session(std::uint64_t session) {
    return sees([&](const SessionView& view) { return view.session == session && view.busy.empty(); });
  }
  void act(Action action) { viewer_->act(action, port_); }
  [[nodiscard]] const ViewerState& state() const { return std::as_const(*viewer_).state(); }
  [[nodiscard]] const app::Camera& camera() const { return viewer_->picture().camera; }
  [[nodiscard]] const SessionView& view() const { return viewer_->view(); }

  void send(Kind kind, const Vec2& pixel, bool shift = false, bool alt = false) {
    PointerEvent event;
    event.kind = kind;
    event.pixel = pixel;
    event.shift = shift;
    event.alt = alt;
    viewer_->handle(event, port_);
  }
  [[nodiscard]] Vec2 pixel(const Vec3& point) const { return to_pixel(camera(), port_, point).value(); }
  [[nodiscard]] Vec2 top(double x) const { return pixel({x, 0.5, view().body.hi.z()}); }

  Folder folder_;
  app::Viewport port_{800, 600};
  double now_ = 0;
  std::optional<app::SessionThread> thread_;
  std::optional<Viewer> viewer_;
};

// --- the camera

TEST_F(ViewerTest, the_camera_frames_the_body) {
  for (const Vec3& corner : {view().body.lo, view().body.hi}) {
    const Vec2 at = pixel(corner);
    EXPECT_TRUE(at.x() > 0 && at.x() < port_.width && at.y() > 0 && at.y() < port_.height);
  }
}

TEST_F(ViewerTest, the_camera_frames_a_body_whose_scene_has_no_name) {
  Json scene = still_scene();
  scene.erase("name");
  scene["model"]["box"]["size"] = {100, 100, 100};
  show(opened(scene));
  EXPECT_GT(camera().distance, 100);
}

TEST_F(ViewerTest, the_camera_frames_a_new_body_and_keeps_the_view_after_a_reset) {
  act(Action::kZoomIn);
  act(Action::kTurnLeft);
  const Vec3 eye = camera().eye();
  act(Action::kReset);
  ASSERT_TRUE(sees_session(2));
  EXPECT_EQ(camera().eye(), eye);
  Json scene = still_scene();
  scene["name"] = "large";
  scene["model"]["box"]["size"] = {100, 100, 100};
  viewer_->open(folder_.write("large.json", scene.dump()));
  ASSERT_TRUE(sees_session(3));
  EXPECT_GT(camera().distance, 100);
}

TEST_F(ViewerTest, another_body_of_the_same_name_is_framed) {
  Json scene = still_scene();
  scene["model"] = {{"box", {{"cells", {2, 2, 2}}, {"size", {100, 100, 100}}}}};
  viewer_->open(folder_.write("large.json", scene.dump()));
  ASSERT_TRUE(sees_session(2));
  EXPECT_GT(camera().distance, 100);
}

TEST_F(ViewerTest, frame_all_brings_the_body_back) {
  const double distance = camera().distance;
  for (int i = 0; i < 40; ++i) act(Action::kZoomOut);
  EXPECT_GT(camera().distance, 10 * distance);
  act(Action::kFrameAll);
  EXPECT_NEAR(camera().distance, distance, 0.2 * distance);
}

TEST_F(ViewerTest, keys_zoom_and_turn) {
  const app::Camera before = camera();
  act(Action::kZoomIn);
  EXPECT_NEAR(camera().distance, 0.9 * before.distance, 1e-9);
  act(Action::kZoomOut);
  EXPECT_NEAR(camera().distance, before.distance, 1e-9);
  act(Action::kTurnLeft);
  EXPECT_NE(camera().azimuth, before.azimuth);
  act(Action::kTurnRight);
  EXPECT_NEAR(camera().azimuth, before.azimuth, 1e-9);
  act(Action::kTurnUp);
  EXPECT_NE(camera().elevation, before.elevation);
  act(Action::kTurnDown);
  EXPECT_NEAR(camera().elevation, before.elevation, 1e-9);
}

TEST_F(ViewerTest, panels_leave_the_body_a_narrower_part) {
  const double distance = camera().distance;
  viewer_->leave_free(0.45 * port_.width);
  act(Action::kFrameAll);
  EXPECT_GT(camera().distance, 1.2 * distance);
  for (const Vec3& corner : {view().body.lo, view().body.hi}) {
    EXPECT_NEAR(pixel(corner).x(), 0.5 * port_.width, 0.225 * port_.width);
  }
  viewer_->state().panels = app::Panels::kNone;
  act(Action::kFrameAll);
  EXPECT_NEAR(camera().distance, distance, 1e-6 * distance);
}

TEST_F(ViewerTest, a_scene_says_how_it_is_seen_unless_the_view_is_kept) {
  Json scene = still_scene();
  scene["view"] = {
      {"theme", "light"}, {"color", "region"}, {"wireframe", true}, {"clip", {1, 0, 0, 0.25}}, {"look", "vessel"}};
  show(opened(scene));
  EXPECT_EQ(state().options.theme, app::Theme::kLight);
  EXPECT_EQ(state().options.color, app::ColorBy::kRegion);
  EXPECT_TRUE(state().options.shows_wireframe);
  EXPECT_TRUE(state().is_clipped);
  EXPECT_NEAR(state().clip_depth, 0.25, 0.01);
  EXPECT_TRUE(sees([](const SessionView& view) { return bounds_of(view.surface).lo.x() > -0.01; }));
  app::ViewerOptions options;
  options.keeps_view = true;
  options.view.color = app::ColorBy::kStroke;
  options.shades_hollows = false;
  show(opened(scene), options);
  EXPECT_EQ(state().options.theme, app::Theme::kDark);
  EXPECT_EQ(state().options.color, app::ColorBy::kStroke);
  EXPECT_EQ(state().options.look, app::TissueLook::kVessel) << "it is the body's";
  EXPECT_FALSE(state().options.shows_occlusion);
  EXPECT_FALSE(state().is_clipped);
}

TEST_F(ViewerTest, the_theme_that_a_person_chose_stays_whatever_is_opened) {
  act(Action::kTheme);
  ASSERT_EQ(state().options.theme, app::Theme::kLight);
  Json scene = still_scene();
  scene["name"] = "another";
  viewer_->open(folder_.write("another.json", scene.dump()));
  ASSERT_TRUE(sees_session(2));
  EXPECT_EQ(state().options.theme, app::Theme::kLight);
}

// --- what is in hand

TEST_F(ViewerTest, a_scene_puts_a_tool_of_its_settings_into_the_hand) {
  Json scene = still_scene();
  scene["hand"] = {{"tool", "punch"}, {"depth", 0.3}, {"ring", 0.2}};
  act(app::action_of(ToolKind::kGrasp));
  show(opened(scene));
  EXPECT_EQ(viewer_->tools().tool(), ToolKind::kPunch);
  EXPECT_EQ(viewer_->tools().settings().depth, 0.3);
  EXPECT_EQ(viewer_->tools().settings().punch_radius, 0.2);
}

TEST_F(ViewerTest, the_tool_stays_where_a_scene_does_not_name_one) {
  act(app::action_of(ToolKind::kHook));
  Json scene = still_scene();
  scene["name"] = "another";
  viewer_->open(folder_.write("another.json", scene.dump()));
  ASSERT_TRUE(sees_session(2));
  EXPECT_EQ(viewer_->tools().tool(), ToolKind::kHook);
}

TEST_F(ViewerTest, the_same_scene_from_its_start_keeps_tool_and_settings) {
  Json scene = still_scene();
  scene["hand"] = {{"tool", "punch"}, {"depth", 0.3}};
  show(opened(scene));
  act(app::action_of(ToolKind::kScalpel));
  act(Action::kDeeper);
  act(Action::kReset);
  ASSERT_TRUE(sees_session(2));
  EXPECT_EQ(viewer_->tools().tool(), ToolKind::kScalpel);
  EXPECT_NEAR(viewer_->tools().settings().depth, 0.33, 1e-12);
}

TEST_F(ViewerTest, a_demonstration_that_begins_again_has_its_tool_in_hand) {
  Json scene = still_scene();
  scene["view"] = {{"demonstration", true}};
  scene["hand"] = {{"tool", "scalpel"}};
  show(opened(scene));
  act(app::action_of(ToolKind::kHook));
  act(Action::kReset);
  ASSERT_TRUE(sees_session(2));
  EXPECT_EQ(viewer_->tools().tool(), ToolKind::kScalpel);
}

TEST_F(ViewerTest, where_a_device_has_the_blade_the_mouse_keeps_its_tool) {
  Json scene = still_scene();
  scene["hand"] = {{"tool", "punch"}};
  app::ViewerOptions options;
  options.keeps_tool = true;
  show(opened(scene), options);
  EXPECT_EQ(viewer_->tools().tool(), ToolKind::kScalpel);
}

TEST_F(ViewerTest, an_exercise_that_needs_no_file_opens_with_its_tool) {
  viewer_->open(app::StartingExercise::kCore);
  ASSERT_TRUE(sees_session(2));
  ASSERT_TRUE(view().scene->exercise.has_value());
  EXPECT_EQ(view().title, app::kStartingExercises[static_cast<std::size_t>(app::StartingExercise::kCore)].title);
  EXPECT_EQ(viewer_->tools().tool(), ToolKind::kPunch);
}

// --- pictures

TEST_F(ViewerTest, a_picture_is_made_only_where_something_changed) {
  act(Action::kUndo);
  ASSERT_TRUE(sees_notice("Nothing to undo"));  // whatever was asked for before has been done
  ASSERT_TRUE(sees([](const SessionView& view) { return view.validity.state == app::ValidityState::kValid; }));
  viewer_->update(port_, now_);
  EXPECT_FALSE(viewer_->update(port_, now_));
  act(Action::kWireframe);
  EXPECT_TRUE(viewer_->update(port_, now_));
  EXPECT_TRUE(viewer_->picture().options.shows_wireframe);
  EXPECT_FALSE(viewer_->update(port_, now_));
  send(Kind::kMove, {400, 300});
  EXPECT_TRUE(viewer_->update(port_, now_));
}

TEST_F(ViewerTest, the_display_hears_of_pictures) {
  viewer_->drawn(1, 5);
  viewer_->drawn(2, 5);
  EXPECT_NEAR(viewer_->hud().pictures_per_second(), 1, 1e-9);
}

// --- what actions do

TEST_F(ViewerTest, keys_choose_tools) {
  for (int tool = 0; tool < static_cast<int>(ToolKind::kCount); ++tool) {
    act(static_cast<Action>(tool));
    EXPECT_EQ(viewer_->tools().tool(), static_cast<ToolKind>(tool));
  }
}

TEST_F(ViewerTest, keys_set_the_scalpel) {
  const app::ToolSettings before = viewer_->tools().settings();
  act(Action::kDeeper);
  EXPECT_NEAR(viewer_->tools().settings().depth, 1.1 * before.depth, 1e-12);
  act(Action::kShallower);
  EXPECT_NEAR(viewer_->tools().settings().depth, before.depth, 1e-12);
  act(Action::kTiltLeft);
  EXPECT_GT(viewer_->tools().settings().angle, before.angle);
  act(Action::kTiltRight);
  EXPECT_NEAR(viewer_->tools().settings().angle, before.angle, 1e-12);
}

struct Toggle {
  Action action;
  bool (*is_on)(const ViewerState&);
};

TEST_F(ViewerTest, keys_toggle_what_is_shown) {
  const Toggle toggles[] = {
      {Action::kWireframe, [](const ViewerState& s) { return s.options.shows_wireframe; }},
      {Action::kClipPlane, [](const ViewerState& s) { return s.is_clipped; }},
      {Action::kWorstTets, [](const ViewerState& s) { return s.shows_worst; }},
      {Action::kTransparency, [](const ViewerState& s) { return s.options.skin_opacity < 1; }},
      {Action::kOcclusion, [](const ViewerState& s) { return s.options.shows_occlusion; }},
      {Action::kTheme, [](const ViewerState& s) { return s.options.theme == app::Theme::kLight; }},
      {Action::kFullScreen, [](const ViewerState& s) { return s.is_full_screen; }},
      {Action::kHelp, [](const ViewerState& s) { return s.shows_help; }},
      {Action::kImageSequence, [](const ViewerState& s) { return s.saves_sequence; }},
  };
  for (const Toggle& toggle : toggles) {
    const bool before = toggle.is_on(state());
    act(toggle.action);
    EXPECT_NE(toggle.is_on(state()), before) << key_of(toggle.action);
    act(toggle.action);
    EXPECT_EQ(toggle.is_on(state()), before) << key_of(toggle.action);
  }
}

TEST_F(ViewerTest, colours_and_panels_go_round) {
  std::set<app::ColorBy> colors;
  for (int i = 0; i < 5; ++i) {
    colors.insert(state().options.color);
    act(Action::kColor);
  }
  EXPECT_EQ(colors.size(), 5U);
  EXPECT_EQ(state().options.color, app::ColorBy::kTissue);
  for (const app::Panels panels : {app::Panels::kNone, app::Panels::kAll}) {
    act(Action::kPanels);
    EXPECT_EQ(state().panels, panels);
  }
  act(Action::kResearch);
  EXPECT_TRUE(state().is_research);
  for (const app::Panels panels : {app::Panels::kFigures, app::Panels::kNone, app::Panels::kAll}) {
    act(Action::kPanels);
    EXPECT_EQ(state().panels, panels);
  }
  act(Action::kResearch);
  EXPECT_FALSE(state().is_research);
}

// --- a demonstration

class DemonstrationTest : public ViewerTest {
 protected:
  void SetUp() override {
    Json scene = cut_scene();
    scene["view"] = {{"demonstration", true}};
    show(opened(scene));
  }
  /// Makes `frames` frames, and waits for them.
  void run(std::uint64_t frames) {
    const std::uint64_t until = view().figures.frames + frames;
    for (std::uint64_t i = 0; i < frames; ++i) thread_->step();
    EXPECT_TRUE(sees([&](const SessionView& seen) { return seen.figures.frames == until; }));
  }
};

TEST_F(DemonstrationTest, it_cuts_where_nobody_does_anything) {
  EXPECT_TRUE(viewer_->is_demonstrating());
  send(Kind::kMove, top(0.5));
  run(30);
  EXPECT_TRUE(viewer_->is_demonstrating());
  EXPECT_EQ(view().figures.strokes, 1U);
  EXPECT_EQ(viewer_->next_step(), "Press on the skin and drag: you hold the scalpel");
}

TEST_F(DemonstrationTest, the_first_press_ends_it) {
  send(Kind::kPress, {5, 5});
  send(Kind::kRelease, {5, 5});
  EXPECT_FALSE(viewer_->is_demonstrating());
  run(30);
  EXPECT_EQ(view().figures.strokes, 0U);
}

TEST_F(DemonstrationTest, a_key_ends_it_and_a_reset_begins_it_anew) {
  act(Action::kScreenshot);
  EXPECT_FALSE(viewer_->is_demonstrating());
  run(30);
  EXPECT_EQ(view().figures.strokes, 0U);
  act(Action::kReset);
  ASSERT_TRUE(sees_session(2));
  EXPECT_TRUE(viewer_->is_demonstrating());
  run(30);
  EXPECT_EQ(view().figures.strokes, 1U);
}

TEST_F(ViewerTest, scenes_that_are_no_demonstration_go_on_whatever_is_pressed) {
  show(opened(cut_scene()));
  EXPECT_FALSE(viewer_->is_demonstrating());
  EXPECT_EQ(viewer_->next_step(), "");
  act(Action::kTurnLeft);
  for (int i = 0; i < 30; ++i) thread_->step();
  EXPECT_TRUE(sees([](const SessionView& seen) { return seen.figures.strokes == 1; }));
}

TEST_F(ViewerTest, text_stays_readable) {
  for (int i = 0; i < 50; ++i) act(Action::kLarger);
  EXPECT_EQ(state().text_scale, 3);
  for (int i = 0; i < 50; ++i) act(Action::kSmaller);
  EXPECT_EQ(state().text_scale, 0.6);
}

TEST_F(ViewerTest, quit_is_asked_for) {
  EXPECT_FALSE(state().wants_quit);
  act(Action::kQuit);
  EXPECT_TRUE(state().wants_quit);
}

TEST_F(ViewerTest, cancel_ends_what_is_under_way_before_it_closes_the_help) {
  act(Action::kHelp);
  send(Kind::kPress, top(0.5));
  ASSERT_TRUE(viewer_->tools().is_busy());
  act(Action::kCancel);
  EXPECT_FALSE(viewer_->tools().is_busy());
  EXPECT_TRUE(state().shows_help);
  act(Action::kCancel);
  EXPECT_FALSE(state().shows_help);
}

TEST_F(ViewerTest, keys_rule_time) {
  act(Action::kStep);
  EXPECT_TRUE(sees([](const SessionView& view) { return view.figures.frames == 1 && view.is_paused; }));
  act(Action::kPause);
  EXPECT_TRUE(sees([](const SessionView& view) { return view.figures.frames > 3 && !view.is_paused; }));
  act(Action::kPause);
  EXPECT_TRUE(sees([](const SessionView& view) { return view.is_paused; }));
  act(Action::kReset);
  EXPECT_TRUE(sees([](const SessionView& view) { return view.session == 2 && view.figures.frames == 0; }));
  act(Action::kUndo);
  EXPECT_TRUE(sees_notice("Nothing to undo"));
  act(Action::kRedo);
  EXPECT_TRUE(sees_notice("Nothing to redo"));
}

TEST_F(ViewerTest, what_is_pressed_twice_within_a_picture_is_as_it_was) {
  for (int press = 0; press < 2; ++press) act(Action::kPause);
  for (int press = 0; press < 2; ++press) act(Action::kRecord);
  act(Action::kReset);
  ASSERT_TRUE(sees_session(2));
  EXPECT_TRUE(view().is_paused);
  EXPECT_FALSE(view().is_recording);
}

TEST_F(ViewerTest, keys_rule_a_replay) {
  show(app::Session::open(std::filesystem::path(write_simulation_recording(folder_))).value());
  act(Action::kNextStep);
  EXPECT_TRUE(sees([](const SessionView& view) { return view.place.call == 14; }));
  act(Action::kTakeOver);
  EXPECT_TRUE(sees([](const SessionView& view) { return !view.is_replay; }));
}

TEST_F(ViewerTest, keys_write_files_under_free_names) {
  act(Action::kExportMesh);
  ASSERT_TRUE(sees_notice("incise-mesh-0001.vtu"));
  act(Action::kExportMesh);
  ASSERT_TRUE(sees_notice("incise-mesh-0002.vtu"));
  act(Action::kRecord);
  ASSERT_TRUE(sees([](const SessionView& view) { return view.is_recording; }));
  act(Action::kRecord);
  ASSERT_TRUE(sees([](const SessionView& view) { return !view.is_recording; }));
  EXPECT_EQ(folder_.names(),
            (std::vector<std::string>{"incise-mesh-0001.vtu", "incise-mesh-0002.vtu", "incise-recording-0001.jsonl"}));
}

TEST_F(ViewerTest, the_ideal_and_the_score_are_for_exercises) {
  act(Action::kIdeal);
  EXPECT_NE(state().notice.find("no exercise"), std::string::npos);
  EXPECT_FALSE(state().shows_ideal);
  viewer_->notify("");
  act(Action::kScore);
  EXPECT_TRUE(sees_notice("no exercise"));
}

Json exercise() {
  Json scene = still_scene();
  scene["exercise"] = full_scene()["exercise"];
  return scene;
}

TEST_F(ViewerTest, the_ideal_is_shown_and_after_the_score_beside_the_attempt) {
  show(opened(exercise()));
  act(Action::kIdeal);
  EXPECT_TRUE(state().shows_ideal);
  act(Action::kIdeal);
  EXPECT_FALSE(state().shows_ideal);
  for (int i = 0; i < 3; ++i) act(Action::kStep);
  ASSERT_TRUE(sees([](const SessionView& view) { return view.figures.frames == 3; }));
  act(Action::kScore);
  ASSERT_TRUE(sees([](const SessionView& view) { return view.score.has_value(); }));
  ASSERT_TRUE(sees_notice("incise-score-0001.json"));
  const std::optional<std::filesystem::path> page = viewer_->take_page();
  ASSERT_TRUE(page.has_value());
  EXPECT_EQ(page->filename(), "incise-report-0001.html");
  EXPECT_FALSE(viewer_->take_page().has_value()) << "one page for each score";
  ASSERT_TRUE(view().gauges.has_value());
  act(Action::kIdeal);
  EXPECT_TRUE(state().shows_ideal);
  ASSERT_TRUE(sees_session(2));
  EXPECT_TRUE(view().is_replay);
  EXPECT_EQ(view().place.calls, 4U);
}

TEST_F(ViewerTest, the_attempt_is_shown_from_within_a_recording_as_well) {
  show(opened(exercise()));
  act(Action::kRecord);
  act(Action::kStep);
  act(Action::kScore);
  ASSERT_TRUE(sees([](const SessionView& view) { return view.score.has_value() && view.is_recording; }));
  act(Action::kIdeal);
  ASSERT_TRUE(sees_session(2));
  EXPECT_TRUE(view().is_replay);
}

TEST_F(ViewerTest, every_action_may_come_at_any_time) {
  act(Action::kPause);
  for (int round = 0; round < 2; ++round) {
    for (int action = 0; action < static_cast<int>(Action::kCount); ++action) {
      act(static_cast<Action>(action));
      viewer_->update(port_, now_);
    }
  }
}

// --- pointers

TEST_F(ViewerTest, pointer_events_reach_the_tools_and_the_simulation) {
  act(Action::kPause);
  ASSERT_TRUE(sees([](const SessionView& view) { return !view.is_paused; }));
  const Vec2 from = top(0.52), to = from + Vec2(150, 0);
  send(Kind::kPress, from);
  EXPECT_TRUE(viewer_->tools().hands().blade.has_value());
  for (int i = 1; i <= 10; ++i) {
    send(Kind::kMove, from + (to - from) * i / 10);
    const std::uint64_t frames = view().figures.frames;
    ASSERT_TRUE(sees([&](const SessionView& view) { return view.figures.frames > frames; }));
  }
  send(Kind::kRelease, to);
  EXPECT_TRUE(sees([](const SessionView& view) { return view.figures.tets > 162; }));
}

TEST_F(ViewerTest, the_cursor_tells_what_a_press_would_do) {
  act(Action::kPause);
  act(app::action_of(ToolKind::kProbe));
  ASSERT_TRUE(sees([](const SessionView& view) { return !view.is_paused; }));
  send(Kind::kMove, {5, 5});
  EXPECT_EQ(viewer_->cursor(), app::Cursor::kArrow);
  send(Kind::kMove, top(0.52));
  EXPECT_EQ(viewer_->cursor(), app::Cursor::kCross);
  send(Kind::kPress, top(0.52));
  send(Kind::kRelease, top(0.52));
  EXPECT_EQ(viewer_->cursor(), app::Cursor::kCross);
  act(app::action_of(ToolKind::kOrbit));
  send(Kind::kMove, top(0.5));
  EXPECT_EQ(viewer_->cursor(), app::Cursor::kHand);
}

TEST_F(ViewerTest, a_plane_cut_is_made) {
  act(Action::kPause);
  act(app::action_of(ToolKind::kPlaneCut));
  ASSERT_TRUE(sees([](const SessionView& view) { return !view.is_paused; }));
  send(Kind::kPress, {100, 290});
  send(Kind::kMove, {700, 310});
  send(Kind::kRelease, {700, 310});
  EXPECT_TRUE(sees([](const SessionView& view) { return view.figures.strokes == 1; }));
}

TEST_F(ViewerTest, a_click_probes) {
  act(app::action_of(ToolKind::kProbe));
  send(Kind::kPress, top(0.5));
  send(Kind::kRelease, top(0.5));
  EXPECT_TRUE(sees([](const SessionView& view) { return view.probe.has_value(); }));
}

TEST_F(ViewerTest, a_paused_session_says_so_where_a_tool_is_used) {
  send(Kind::kPress, top(0.5));
  EXPECT_NE(state().notice.find("Paused"), std::string::npos);
}

TEST_F(ViewerTest, a_paused_session_says_nothing_where_the_view_is_turned) {
  send(Kind::kPress, top(0.5), false, true);
  EXPECT_EQ(state().notice, "");
  send(Kind::kRelease, top(0.5));
  act(app::action_of(ToolKind::kOrbit));
  send(Kind::kPress, top(0.5));
  EXPECT_EQ(state().notice, "");
}

TEST_F(ViewerTest, a_replay_refuses_the_scalpel_and_turns_the_view_instead) {
  show(app::Session::open(std::filesystem::path(write_simulation_recording(folder_))).value());
  const Vec3 eye = camera().eye();
  send(Kind::kPress, top(0.5));
  EXPECT_NE(state().notice.find(key_of(Action::kTakeOver)), std::string::npos);
  send(Kind::kMove, top(0.5) + Vec2(50, 20));
  EXPECT_FALSE(viewer_->tools().hands().blade.has_value());
  EXPECT_NE(camera().eye(), eye);
}

TEST_F(ViewerTest, a_mouse_that_is_no_hand_turns_the_view_with_either_button) {
  app::ViewerOptions options;
  options.mouse_is_hand = false;
  show(opened(still_scene()), options);
  for (const bool shift : {false, true}) {
    const Vec3 eye = camera().eye();
    send(Kind::kPress, top(0.5), shift);
    send(Kind::kMove, top(0.5) + Vec2(50, 20), shift);
    EXPECT_FALSE(viewer_->tools().hands().blade.has_value());
    EXPECT_TRUE(viewer_->tools().hands().hooks.empty());
    EXPECT_NE(camera().eye(), eye);
    send(Kind::kRelease, top(0.5));
  }
  EXPECT_EQ(state().notice, "");
}

TEST_F(ViewerTest, a_replay_refuses_to_grasp_whatever_the_tool) {
  show(app::Session::open(std::filesystem::path(write_simulation_recording(folder_))).value());
  act(app::action_of(ToolKind::kOrbit));
  send(Kind::kPress, top(0.5), true);
  EXPECT_TRUE(viewer_->tools().hands().hooks.empty());
  EXPECT_NE(state().notice, "");
}

TEST_F(ViewerTest, another_session_takes_the_hands_off) {
  act(app::action_of(ToolKind::kPin));
  send(Kind::kPress, top(0.5));
  send(Kind::kRelease, top(0.5));
  ASSERT_EQ(viewer_->tools().hands().hooks.size(), 1U);
  act(Action::kReset);
  ASSERT_TRUE(sees_session(2));
  EXPECT_TRUE(viewer_->tools().hands().hooks.empty());
}

// --- the clip plane

std::size_t used(const SessionView& view) {
  std::size_t inside = 0;
  for (const app::TriangleLook& look : view.surface.topology->looks) {
    inside += (look.flags & app::TriangleLook::kInside) != 0 ? 1U : 0U;
  }
  return inside;
}

TEST_F(ViewerTest, a_clip_plane_shows_the_inside_and_moves) {
  act(Action::kClipPlane);
  ASSERT_TRUE(sees([](const SessionView& view) { return used(view) > 0; }));
  EXPECT_EQ(state().clip_depth, 0.5);
  act(Action::kClipDeeper);
  EXPECT_NEAR(state().clip_depth, 0.55, 1e-12);
  act(Action::kClipShallower);
  act(Action::kClipShallower);
  EXPECT_NEAR(state().clip_depth, 0.45, 1e-12);
  viewer_->set_clip_depth(7);
  EXPECT_EQ(state().clip_depth, 1);
  ASSERT_TRUE(sees([](const SessionView& view) { return view.surface.topology->used == 0; }));
  viewer_->set_clip_depth(-7);
  EXPECT_EQ(state().clip_depth, 0);
  ASSERT_TRUE(sees([](const SessionView& view) { return view.surface.topology->used == 12 * 9; }));
}

TEST_F(ViewerTest, the_clip_plane_stays_where_it_is_whatever_else_is_shown) {
  act(Action::kClipPlane);
  ASSERT_TRUE(sees([](const SessionView& view) { return used(view) > 0; }));
  const std::size_t triangles = view().surface.topology->used;
  for (int i = 0; i < 3; ++i) {
    act(Action::kWorstTets);
    const bool marks = state().shows_worst;
    ASSERT_TRUE(sees([&](const SessionView& view) { return view.marks.lines.empty() != marks; }));
    EXPECT_EQ(view().surface.topology->used, triangles);
  }
  viewer_->set_clip_depth(1);
  ASSERT_TRUE(sees([](const SessionView& view) { return view.surface.topology->used == 0; }));
  viewer_->set_clip_depth(0.5);
  ASSERT_TRUE(sees([&](const SessionView& view) { return view.surface.topology->used == triangles; }));
}

TEST_F(ViewerTest, another_body_is_whole) {
  act(Action::kClipPlane);
  ASSERT_TRUE(sees([](const SessionView& view) { return used(view) > 0; }));
  viewer_->open(folder_.write("cube.mesh", cube_mesh(2)));
  ASSERT_TRUE(sees_session(2));
  EXPECT_FALSE(state().is_clipped);
  EXPECT_TRUE(sees([](const SessionView& view) { return view.surface.topology->used == 12 * 4; }));
}

TEST_F(ViewerTest, the_clip_plane_stays_after_a_reset) {
  act(Action::kClipPlane);
  ASSERT_TRUE(sees([](const SessionView& view) { return used(view) > 0; }));
  const std::size_t triangles = view().surface.topology->used;
  act(Action::kReset);
  ASSERT_TRUE(sees_session(2));
  EXPECT_TRUE(state().is_clipped);
  EXPECT_TRUE(sees([&](const SessionView& view) { return view.surface.topology->used == triangles; }));
}

// --- notices and pictures that are saved

TEST_F(ViewerTest, notices_vanish_after_a_few_seconds) {
  now_ = 100;
  viewer_->update(port_, now_);
  viewer_->notify("hello");
  EXPECT_EQ(state().notice, "hello");
  viewer_->update(port_, 104.9);
  EXPECT_EQ(state().notice, "hello");
  EXPECT_TRUE(viewer_->update(port_, 105.1));
  EXPECT_EQ(state().notice, "");
}

TEST_F(ViewerTest, a_file_that_cannot_be_opened_is_said) {
  viewer_->open(folder_ / "absent.mesh");
  EXPECT_TRUE(sees_notice("absent.mesh"));
}

TEST_F(ViewerTest, screenshots_get_free_names) {
  EXPECT_FALSE(viewer_->take_screenshot().has_value());
  act(Action::kScreenshot);
  const auto first = viewer_->take_screenshot();
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->filename(), "incise-0001.png");
  EXPECT_EQ(first->parent_path(), std::filesystem::path(folder_ / "").parent_path());
  EXPECT_FALSE(viewer_->take_screenshot().has_value());
  folder_.write("incise-0001.png", "");
  act(Action::kScreenshot);
  EXPECT_EQ(viewer_->take_screenshot()->filename(), "incise-0002.png");
}

TEST_F(ViewerTest, a_sequence_names_one_picture_per_new_frame) {
  act(Action::kImageSequence);
  std::vector<std::string> names;
  for (std::uint64_t frame = 1; frame <= 3; ++frame) {
    if (frame > 1) {
      act(Action::kStep);
      ASSERT_TRUE(sees([&](const SessionView& view) { return view.figures.frames == frame - 1; }));
    }
    const auto name = viewer_->take_screenshot();
    ASSERT_TRUE(name.has_value());
    EXPECT_EQ(name->parent_path().filename(), "incise-pictures-0001");
    names.push_back(name->filename().string());
    act(Action::kWorstTets);  // something happens, but no frame
    const bool marks = state().shows_worst;
    ASSERT_TRUE(sees([&](const SessionView& view) { return view.marks.lines.empty() != marks; }));
    EXPECT_FALSE(viewer_->take_screenshot().has_value());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"000001.png", "000002.png", "000003.png"}));
  act(Action::kImageSequence);
  EXPECT_FALSE(viewer_->take_screenshot().has_value());
}

}  // namespace

}  // namespace viewer_test
