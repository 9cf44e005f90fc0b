// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/scene/exercise_score.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Where a fault costs all its points, in tolerances; from one tolerance to there they grow evenly.
inline constexpr double kFullFault = 3;

/// Fills in criteria, deductions and points, from the figures that were measured. A pure function.
void grade(const Exercise& exercise, ExerciseScore& score);

}  // namespace app
}  // namespace v0
}  // namespace incise
