// SPDX-License-Identifier: Apache-2.0
// The vein's walls become regions by two half-spaces, and its line follows `vein_bend`; the ideal goes down, along the
// line and out again.
#include "app/session/starting_exercise.h"

#include <cmath>
#include <utility>

#include "app/session/shipped_exercises.h"
#include "app/session/starting_body.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::int32_t kFrontWall = 1, kFarWall = 2;
constexpr double kLineHalf = 8;         // mm, of the line along the vein
constexpr double kWallDepth = 3.5;      // mm, see `vein_bend` and the tube's radii in starting_body.cpp
constexpr double kBladeLength = 20;     // mm
constexpr double kIdealDepth = 4.3;     // mm: through the wall where it gives way, too
constexpr double kIn = 0.6, kRate = 5;  // s to go in; mm/s along
constexpr double kSeconds = 20;         // of the scene, where nobody watches
constexpr int kLinePoints = 16;         // steps of the line

/// A point of the vein's uppermost line.
Vec3 on_top(double x) {
  return {x, vein_bend(x), kVeinRadius};
}

void add_edge(double time, double x, double depth, Stroke& stroke) {
  const Vec3 tip = on_top(x) - depth * Vec3::UnitZ();
  stroke.times.push_back(time);
  stroke.edges.push_back({Vec3(tip + kBladeLength * Vec3::UnitZ()), tip});
}

/// Down in front of the line, along it, and out behind it.
SceneStroke ideal_venotomy() {
  SceneStroke made;
  made.stroke.name = "venotomy";
  const double from = -kLineHalf, to = kLineHalf + 0.8;
  add_edge(0.5, from, -1, made.stroke);
  for (int i = 0; i <= kLinePoints; ++i) {
    const double x = from + (to - from) * i / kLinePoints;
    add_edge(0.5 + kIn + (x - from) / kRate, x, kIdealDepth, made.stroke);
  }
  add_edge(made.stroke.times.back() + kIn, to, -1, made.stroke);
  return made;
}

Exercise venotomy() {
  Exercise exercise;
  exercise.name = "Venotomy";
  exercise.instructions =
      "Open the front wall of the vein along the line in one stroke. The wall is 3.5 mm thick: it must be opened into "
      "the lumen all along the line, and the far wall must stay whole. Your scalpel goes 4 mm deep.";
  for (int i = 0; i <= kLinePoints; ++i) {
    exercise.target.push_back(on_top(kLineHalf * (2.0 * i / kLinePoints - 1)));
  }
  exercise.depth = kWallDepth;
  exercise.tolerances.line = 1;
  exercise.tolerances.depth = 0.7;
  exercise.tolerances.angle = 12;
  exercise.tolerances.force = 0.2;
  exercise.max_force = 2;
  exercise.divide.emplace().stop_at = {kFrontWall};
  exercise.divide->name = "the front wall";
  exercise.spare.emplace_back().stop_at = {kFarWall};
  exercise.spare.back().name = "the far wall";
  exercise.ideal = {ideal_venotomy()};
  return exercise;
}

/// The window's vein, told apart into its walls.
Result<Scene> venotomy_scene(const std::filesystem::path& folder) {
  Result<Scene> scene = scene_of(StartingBody::kVein, folder);
  if (!scene.ok()) return scene.error();
  scene->name = kStartingExercises[static_cast<std::size_t>(StartingExercise::kVein)].title;
  scene->model.regions = {{kFrontWall, "front wall", HalfSpace{-Vec3::UnitZ(), 0}},
                          {kFarWall, "far wall", HalfSpace{Vec3::UnitZ(), 0}}};
  scene->frames = static_cast<std::uint64_t>(kSeconds / scene->options.frame_seconds);
  scene->exercise = venotomy();
  scene->hand = HandPreset{ToolKind::kScalpel, 4, {}, {}, {}};
  return scene;
}

}  // namespace

Result<Scene> scene_of(StartingExercise exercise, const std::filesystem::path& folder) {
  if (exercise >= StartingExercise::kCount) return Error{ErrorCode::kBadArgument, "there is no such exercise", {}};
  if (exercise == StartingExercise::kVein) return venotomy_scene(folder);
  return parse_scene(shipped_exercise(exercise), kStartingExercises[static_cast<std::size_t>(exercise)].name);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
