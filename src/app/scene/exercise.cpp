// SPDX-License-Identifier: Apache-2.0
// The ideal is a scene's strokes like any other: frames of an attempt are counted from its first blade, those of the
// ideal from the ideal's.
#include "app/scene/exercise.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/scene/scene.h"
#include "app/scene/scene_blade.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kDemonstrationTail = 0.5;  // s, that a demonstration goes on after its last stroke

/// Frames until a time, no more than a scene may have.
std::uint64_t frames_until(double seconds, double frame_seconds) {
  return static_cast<std::uint64_t>(std::min(seconds / frame_seconds, static_cast<double>(kMaxSceneFrames)));
}

/// The first frame that has the blade of the ideal's first stroke.
std::uint64_t first_frame(const Exercise& exercise, double frame_seconds) {
  std::uint64_t frame = frames_until(exercise.ideal.front().stroke.times.front(), frame_seconds);
  frame -= frame > 0 ? 1 : 0;  // the quotient may have been rounded up
  while (!blade_at(exercise.ideal, frame_seconds, frame) && frame <= kMaxSceneFrames) ++frame;
  return frame;
}

}  // namespace

bool is_closed(const Exercise& exercise) {
  return exercise.target.size() > 3 && exercise.target.front() == exercise.target.back();
}

std::vector<BladePose> ideal_poses(const Scene& scene, std::uint64_t frame) {
  if (!scene.exercise || scene.exercise->ideal.empty() || frame > kMaxSceneFrames) return {};
  const double seconds = scene.options.frame_seconds;
  const std::uint64_t first = first_frame(*scene.exercise, seconds);
  std::optional<BladePose> pose = blade_at(scene.exercise->ideal, seconds, first + frame);
  return pose ? std::vector<BladePose>{std::move(*pose)} : std::vector<BladePose>{};
}

Scene with_ideal(const Scene& scene) {
  Scene shown = scene;
  if (!scene.exercise || scene.exercise->ideal.empty()) return shown;
  shown.strokes = scene.exercise->ideal;
  const double end = shown.strokes.back().stroke.times.back() + kDemonstrationTail;
  const std::uint64_t frames = frames_until(end, scene.options.frame_seconds) + 1;
  shown.frames = std::max(shown.frames, std::min(frames, kMaxSceneFrames));
  return shown;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
