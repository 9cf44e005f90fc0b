// SPDX-License-Identifier: Apache-2.0
// What is painted on the body after an attempt at an exercise, and what a trainee must see before it.
#pragma once

#include "app/scene/exercise_score.h"
#include "app/view/picture.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// How far off a place of an attempt is.
enum class ExerciseOff : std::uint8_t {
  kWithin,  ///< one tolerance of line and depth
  kNear,    ///< up to where a fault costs all its points
  kFar,     ///< beyond that
  kMissed,  ///< nothing was cut there
};

/// Where a place stands, by the worse of line and depth. A pure function.
[[nodiscard]] ExerciseOff off_of(const Exercise& exercise, const ExercisePlace& place);

/// Adds a ribbon beside the ideal line of an exercise that was scored: from the line to the cut's contour on the skin,
/// and a quarter of a tolerance beyond both, in the ink of how far off the cut is; nothing where it was missed. It lies
/// on the uncut skin. Cost: O(places).
void mark_deviation(const Exercise& exercise, const ExerciseScore& score, Marks& marks);

/// Turns a camera so that it looks straight down on the line of an exercise that was scored, all of it in the picture.
/// A score without a profile leaves it as it is. Cost: O(places).
void look_at_line(const ExerciseScore& score, const Viewport& viewport, Camera& camera);

/// Adds the outer faces of the tissue that an exercise wants whole or off, as it stands now, so that it is seen where
/// its colour does not tell it: a lesion of the skin as a patch, a lump inside by its edges.
/// Cost: O(tets) where the exercise has `remove`, else nothing.
void mark_removal(const Exercise& exercise, const TetMesh& mesh, Marks& marks);

}  // namespace app
}  // namespace v0
}  // namespace incise
