// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/scene/exercise_score.h"
#include "app/text/json_write.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What `to_json` prints.
[[nodiscard]] Json score_tree(const ExerciseScore& score);

}  // namespace app
}  // namespace v0
}  // namespace incise
