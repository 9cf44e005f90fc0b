// SPDX-License-Identifier: Apache-2.0
// What a scene puts into a person's hand.
#pragma once

#include <optional>

#include "app/scene/tool_table.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What a person has in hand when the scene is opened. What is unset goes by the body, and in an exercise by what is
/// asked for. Lengths in the model's unit.
struct HandPreset {
  static constexpr double kMostTilt = 68;  ///< degrees; no tool is tilted further

  std::optional<ToolKind> tool;
  std::optional<double> depth;  ///< of scalpel, scissors and punch below the surface, above 0
  std::optional<double> angle;  ///< of the scalpel to the left of upright, seen along the cut; degrees, ±`kMostTilt`
  std::optional<double> ring;   ///< the punch's radius, above 0
  std::optional<double> grip;   ///< radius of forceps, hooks and retractors, above 0
};

}  // namespace app
}  // namespace v0
}  // namespace incise
