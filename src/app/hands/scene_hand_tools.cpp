// SPDX-License-Identifier: Apache-2.0
// Settings come in three layers, each over the one before: what suits the body, what the exercise asks for, what the
// scene's `hand` says.
#include "app/hands/scene_hand_tools.h"

#include <algorithm>
#include <numbers>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180;

double stiffest_material(const Scene& scene) {
  double young = scene.options.materials.fallback.young;
  for (const Materials::Entry& entry : scene.options.materials.by_region) young = std::max(young, entry.material.young);
  return young;
}

}  // namespace

ToolSettings settings_for(const Scene& scene, const Box& body) {
  ToolSettings settings = settings_for(body, stiffest_material(scene), scene.options.body.length_unit);
  if (scene.exercise) {
    settings.depth = scene.exercise->depth;
    settings.angle = std::min(scene.exercise->angle, HandPreset::kMostTilt) * kRadPerDegree;
  }
  const HandPreset hand = scene.hand.value_or(HandPreset{});
  settings.depth = hand.depth.value_or(settings.depth);
  if (hand.angle) settings.angle = *hand.angle * kRadPerDegree;
  settings.punch_radius = hand.ring.value_or(settings.punch_radius);
  settings.grasp_radius = hand.grip.value_or(settings.grasp_radius);
  return settings;
}

std::optional<ToolKind> tool_for(const Scene& scene) {
  if (scene.hand && scene.hand->tool) return scene.hand->tool;
  return scene.exercise ? std::optional(ToolKind::kScalpel) : std::nullopt;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
