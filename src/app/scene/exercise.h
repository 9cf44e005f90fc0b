// SPDX-License-Identifier: Apache-2.0
// Training in surgical cutting (paper, section 4.4): what a trainee shall cut, and how it is done ideally.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/scene/scene_stroke.h"
#include "incise/engine/engine.h"

namespace incise {
inline namespace v0 {
namespace app {

struct Scene;

/// How far an attempt may be off without losing points.
struct ExerciseTolerances {
  double line = 0;    ///< beside the target line and beyond its ends, length units, above 0
  double depth = 0;   ///< length units, above 0
  double angle = 10;  ///< degrees, above 0 and at most 90
  double force = 0;   ///< above `max_force`, N, at least 0
};

/// What a trainee shall cut. Lengths in the model's unit, positions in the rest shape.
struct Exercise {
  std::string name;
  std::string instructions;  ///< for the trainee, a sentence or two
  std::vector<Vec3> target;  ///< polyline on the surface, at least two points, longer than 0
  double depth = 0;          ///< below the surface, above 0
  double angle = 0;          ///< of the edge against the surface's normal, degrees, in [0, 89]
  ExerciseTolerances tolerances;
  double max_force = 0;            ///< of the tissue on the edge, N, above 0; 0: not judged
  std::uint32_t strokes = 1;       ///< allowed, at least 1
  std::vector<SceneStroke> ideal;  ///< how the blade moves ideally, in order of time; empty: nobody knows
};

/// The ideal blade at a frame of an attempt, to be shown beside it.
///
/// @param frame  counted from 0, the first frame in which the attempt has a blade.
/// @return one pose, or none before the ideal's strokes, between them and after; none without an exercise or an ideal.
/// A pure function. Cost: O(strokes · log times + points).
[[nodiscard]] std::vector<BladePose> ideal_poses(const Scene& scene, std::uint64_t frame);

/// The scene with its exercise's ideal strokes instead of its own, and enough frames that they end half a second
/// before the last; the same scene where there is no ideal. A pure function.
[[nodiscard]] Scene with_ideal(const Scene& scene);

}  // namespace app
}  // namespace v0
}  // namespace incise
