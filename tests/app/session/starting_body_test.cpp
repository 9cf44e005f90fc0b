// SPDX-License-Identifier: Apache-2.0
#include "app/session/starting_body.h"

#include <gtest/gtest.h>

#include "app/hands/punch.h"
#include "app/jobs/replay_job.h"
#include "app/session/session_cases.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"

namespace starting_body_test {
namespace {

using namespace incise;
using namespace incise_test;
using app::StartingBody;

}  // namespace

TEST(StartingBody, the_patch_is_cut_and_opened_by_its_demonstration) {
  app::Session session = app::Session::open(app::skin_patch()).value();
  const app::Scene& scene = session.scene();
  ASSERT_TRUE(scene.view && scene.view->is_demonstration && scene.view->has_drapes);
  app::Marks before;
  session.draw(before);
  EXPECT_TRUE(before.instruments.empty());
  while (session.figures().seconds < 3.2) ASSERT_TRUE(session.frame().ok());
  app::Marks marks;
  session.draw(marks);
  ASSERT_EQ(marks.instruments.size(), 1U);
  EXPECT_TRUE(marks.instruments[0].is_ghost);
  EXPECT_GT(marks.instruments[0].ahead.x(), 0) << "it is turned into the stroke";
  session.end_script();
  ASSERT_TRUE(session.frame().ok());
  app::Marks after;
  session.draw(after);
  EXPECT_TRUE(after.instruments.empty());
  EXPECT_EQ(session.figures().strokes, 1U);
  EXPECT_TRUE(validate(session.mesh(), ValidateLevel::kGeometry).ok);
}

TEST(StartingBody, two_idle_seconds_pass_before_anything_is_cut) {
  app::Session session = app::Session::open(app::skin_patch()).value();
  while (session.figures().seconds < 1.99) ASSERT_TRUE(session.frame().ok());
  EXPECT_EQ(session.figures().strokes, 0U);
  session.end_script();
  while (session.figures().seconds < 3) ASSERT_TRUE(session.frame().ok());
  EXPECT_EQ(session.figures().strokes, 0U);
}

TEST(StartingBody, a_punch_takes_cores_out_of_the_patch_and_what_is_recorded_replays) {
  const Folder folder;
  app::SessionOptions options;
  options.record = folder / "log.jsonl";
  {
    app::Session session = app::Session::open(app::skin_patch(), options).value();
    session.end_script();
    const app::ToolSettings settings = app::settings_for(rest_bounds(session.mesh()), 12e3, 1e-3);
    std::size_t pieces = 1;
    for (const Vec3& place : {Vec3(42, 30, 24), Vec3(23.4, 18.2, 24), Vec3(61.7, 41.9, 24)}) {
      session.follow(app::punch_stroke(place, Vec3::UnitZ(), settings), app::ToolKind::kPunch);
      while (session.is_following()) ASSERT_TRUE(session.frame().ok());
      EXPECT_EQ(find_components(session.mesh()).count(), ++pieces) << place.transpose();
    }
    EXPECT_TRUE(validate(session.mesh(), ValidateLevel::kGeometry).ok);
    session.stop_recording();
  }
  const Result<app::ReplayResult> result = app::run_replay({folder / "log.jsonl", true});
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_FALSE(result->difference.has_value());
}

TEST(StartingBody, a_scene_says_all_of_it) {
  const app::Scene scene = app::skin_patch();
  const Result<app::Scene> again = app::parse_scene(app::to_json(scene), "scene.json");
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(app::to_json(*again), app::to_json(scene));
  EXPECT_TRUE(again->view->is_demonstration);
  EXPECT_TRUE(again->view->has_drapes);
}

TEST(StartingBody, organs_are_one_sound_piece_of_a_size_that_runs_while_it_is_cut) {
  const Folder folder;
  for (const StartingBody organ : {StartingBody::kLiver, StartingBody::kVein, StartingBody::kVertebra}) {
    const char* name = app::kStartingBodies[static_cast<std::size_t>(organ)].name;
    const Result<app::Scene> scene = app::scene_of(organ, folder / "");
    ASSERT_TRUE(scene.ok()) << name << ": " << scene.error().message;
    Result<app::Session> session = app::Session::open(*scene);
    ASSERT_TRUE(session.ok()) << name << ": " << session.error().message;
    const TetMesh& mesh = session->mesh();
    EXPECT_GT(mesh.tet_count(), 2000U) << name;
    EXPECT_LT(mesh.tet_count(), 25000U) << name;
    EXPECT_EQ(find_components(mesh).count(), 1U) << name;
    EXPECT_TRUE(validate(mesh, ValidateLevel::kGeometry).ok) << name;
    ASSERT_TRUE(session->frame().ok()) << name;
  }
}

}  // namespace starting_body_test
