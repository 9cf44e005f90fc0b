// SPDX-License-Identifier: Apache-2.0
// Exercises that need no file: what the window offers beside its first bodies. All but one are the scenes of the same
// names that come with Incise, compiled in; the vein's body is made on the spot.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "app/scene/scene.h"

namespace incise {
inline namespace v0 {
namespace app {

enum class StartingExercise : std::uint8_t { kSkin, kFat, kVein, kCore, kExcision, kCount };

struct StartingExerciseRow {
  const char* name;   ///< for people, one or two words
  const char* few;    ///< what is to be done, in a few words that fit below the name
  const char* text;   ///< the same as a sentence
  const char* title;  ///< of its scene
};

/// In the order of `StartingExercise`.
inline constexpr std::array<StartingExerciseRow, static_cast<std::size_t>(StartingExercise::kCount)>
    kStartingExercises = {{
        {"Incision", "straight, 30 mm", "Open the skin along a straight line of 30 mm, in one stroke",
         "Training: a straight incision of 30 mm through the skin"},
        {"To the fat", "and no further", "Divide the skin along a curve, and spare the fat below it",
         "Training: a curved incision through the skin to the fat, and no further"},
        {"Venotomy", "the front wall alone", "Open the front wall of a vein, and keep the far wall whole",
         "Training: a vein is opened along its front wall"},
        {"Core biopsy", "half of a lump", "Punch a core out that holds half of a lump below the skin",
         "Training: a core is punched out of a lump below the skin"},
        {"Excision", "a spot, with margin", "Cut a lesion out whole, as an ellipse with a margin",
         "Training: a spot of the skin is excised as an ellipse, with a margin"},
    }};

/// The scene of an exercise. A mesh that it needs goes to `folder`, as that of a starting body. Errors: as `scene_of`
/// of a starting body; kBadArgument for `kCount`. Cost: up to a second.
[[nodiscard]] Result<Scene> scene_of(StartingExercise exercise, const std::filesystem::path& folder = {});

}  // namespace app
}  // namespace v0
}  // namespace incise
