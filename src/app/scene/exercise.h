// SPDX-License-Identifier: Apache-2.0
// Training in surgical cutting (paper, section 4.4): what a trainee shall cut, and how it is done ideally.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
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

/// Regions of the model that an exercise speaks of.
struct ExerciseRegions {
  std::vector<std::int32_t> stop_at;    ///< their numbers
  std::vector<std::string> stop_names;  ///< more of them, until `take_model` knows their numbers
  std::string name;                     ///< for people: "the fat"; empty until `take_model`: those of the model
};

/// Tissue that must stay whole.
struct ExerciseSpare : ExerciseRegions {
  double depth = 0;  ///< into it, from its nearest face, that a wall of a cut may reach; length units, at least 0
};

/// Tissue that must come off in one piece: a spot with a margin around it, the core of a lump.
struct ExerciseRemove : ExerciseRegions {
  double share = 1;                             ///< of its volume that the piece must hold, in (0, 1]
  std::optional<std::array<double, 2>> margin;  ///< least and greatest way from it to the piece's walls, length units
  std::optional<std::array<double, 2>> volume;  ///< least and greatest of the piece, cubed length units
};

/// What a trainee shall cut. Lengths in the model's unit, positions in the rest shape.
struct Exercise {
  std::string name;
  std::string instructions;  ///< for the trainee, a sentence or two
  std::vector<Vec3>
      target;        ///< polyline on the surface, at least two points, longer than 0; closed: the last is the first
  double depth = 0;  ///< below the surface, above 0
  double angle = 0;  ///< of the edge against the surface's normal, degrees, in [0, 89]
  ExerciseTolerances tolerances;
  double max_force = 0;                   ///< of the tissue on the edge, N, above 0; 0: not judged
  std::uint32_t strokes = 1;              ///< allowed, at least 1
  std::optional<ExerciseRegions> divide;  ///< layers under the line that must be cut through all along it
  std::vector<ExerciseSpare> spare;
  std::optional<ExerciseRemove> remove;
  double pass = 70;                ///< points from which an attempt has passed, in [0, 100]
  std::vector<SceneStroke> ideal;  ///< how the blade moves ideally, in order of time; empty: nobody knows
};

/// Whether the target comes back to where it begins.
[[nodiscard]] bool is_closed(const Exercise& exercise);

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
