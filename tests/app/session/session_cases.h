// SPDX-License-Identifier: Apache-2.0
// What tests of sessions and of the window share: small scenes, blades, and a file of each kind.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "app/recording/recorded_engine.h"
#include "app/session/session.h"
#include "incise/io/mesh_loader.h"
#include "support/folder.h"
#include "support/scene_cases.h"

namespace incise_test {

/// A cube held at its bottom that a stroke of the scene cuts from 0.1 s to 0.3 s, at frames of 0.02 s.
inline Json cut_scene() {
  Json scene = least_scene();
  scene["name"] = "a cut cube";
  scene["model"] = {{"box", {{"cells", {3, 3, 3}}}}};
  scene["attachments"] = {{{"below", {0, 0, 1, 0.01}}}};
  scene["frame_seconds"] = 0.02;
  scene["frames"] = 40;
  scene["settle"] = {{"frames", 5}};
  scene["strokes"] = {{{"blade", {blade_stroke(0, 0.2)}}, {"start", 0.1}}};
  scene["maintain"] = {{"work_units", 20000}};
  return scene;
}

/// The same left alone.
inline Json still_scene() {
  Json scene = cut_scene();
  scene.erase("strokes");
  return scene;
}

inline incise::app::Scene parsed(const Json& json) {
  incise::Result<incise::app::Scene> scene = incise::app::parse_scene(json.dump(), "scene.json");
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
  return scene.ok() ? std::move(scene).value() : incise::app::Scene();
}

inline incise::app::Session opened(const Json& json, const incise::app::SessionOptions& options = {}) {
  return incise::app::Session::open(parsed(json), options).value();
}

/// A blade across the cube along y at some x, `depth` below its top.
inline incise::app::HandState hand_at(double x, double depth) {
  incise::app::HandState hands;
  hands.blade.emplace();
  hands.blade->edge = {{x, -0.2, 1 - depth}, {x, 0.5, 1 - depth}, {x, 1.2, 1 - depth}};
  return hands;
}

/// Moves a hand's blade into the cube at x within `frames` frames, and takes it off.
inline void cut_by_hand(incise::app::Session& session, double x = 0.52, int frames = 6) {
  for (int i = 0; i <= frames; ++i) EXPECT_TRUE(session.frame(hand_at(x, -0.1 + 0.6 * i / frames)).ok());
  EXPECT_TRUE(session.frame().ok());
}

/// A stroke through the cube along y at some x, from its top to its bottom.
inline incise::Stroke stroke_at(double x, double seconds = 0.1) {
  return {"through", {0, seconds}, {{{x, -0.2, 1.1}, {x, 1.2, 1.1}}, {{x, -0.2, -0.1}, {x, 1.2, -0.1}}}};
}

inline void play(incise::app::Session& session, int frames) {
  for (int i = 0; i < frames; ++i) ASSERT_TRUE(session.frame().ok());
}

/// Writes a recording of `cut_scene`: five frames before, a hand's stroke, undo, redo, five frames after.
inline std::string write_simulation_recording(const Folder& folder, const std::string& name = "log.jsonl") {
  incise::app::SessionOptions options;
  options.record = folder / name;
  incise::app::Session session = opened(still_scene(), options);
  play(session, 5);
  cut_by_hand(session);
  EXPECT_TRUE(session.undo().value());
  EXPECT_TRUE(session.redo().value());
  play(session, 5);
  return folder / name;
}

/// Writes a mesh and a recording of an engine on it: two strokes and an undo.
inline std::string write_engine_recording(const Folder& folder, const std::string& name = "engine.jsonl") {
  const std::string mesh = folder.write("cube.mesh", cube_mesh(3));
  incise::io::LoadedMesh loaded = incise::io::load_mesh(mesh).value();
  incise::app::RecordedEngine engine =
      incise::app::RecordedEngine::create(std::move(loaded.mesh), {}, {folder / name, mesh, 0}).value();
  EXPECT_TRUE(engine.cut(stroke_at(0.52)).ok());
  EXPECT_TRUE(engine.cut(stroke_at(0.27)).ok());
  EXPECT_TRUE(engine.undo().value());
  return folder / name;
}

/// Waits until something holds, up to half a minute; returns whether it came to that.
template <class Condition>
bool wait_for(const Condition& holds) {
  constexpr int kTries = 30000;
  for (int i = 0; i < kTries; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace incise_test
