// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "app/session/starting_exercise.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The file of a scene that is compiled in, as it stands in `scenes`; empty for one that is made in code. Its text
/// stays for good.
[[nodiscard]] std::string_view shipped_exercise(StartingExercise exercise);

}  // namespace app
}  // namespace v0
}  // namespace incise
