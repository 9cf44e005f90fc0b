// SPDX-License-Identifier: Apache-2.0
// The report of an attempt, for people: one page that needs no other file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/scene/exercise_score.h"
#include "app/scene/scene.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A picture of the body.
struct PagePicture {
  std::string title;  ///< for people
  std::string png;    ///< the file's bytes
};

/// The report as HTML: points and whether the attempt passed, each criterion with what it cost of what it may cost,
/// what became of the tissue, and drawings: the cut beside the line as seen from above, its depth along the line, the
/// force over time. What a scene says is quoted, so that none of it is taken for HTML.
///
/// @param scene     has an exercise.
/// @param score     of that scene.
/// @param pictures  in this order; may be empty.
/// A pure function. Cost: O(size of the pictures), and 100 kB at most beside them.
[[nodiscard]] std::string exercise_page(const Scene& scene, const ExerciseScore& score,
                                        const std::vector<PagePicture>& pictures);

/// Bytes as base 64, with padding.
[[nodiscard]] std::string to_base64(std::string_view bytes);

}  // namespace app
}  // namespace v0
}  // namespace incise
