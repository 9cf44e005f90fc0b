// SPDX-License-Identifier: Apache-2.0
// What a scene puts into a person's hand.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace app {

/// The names of the tools, as scenes have them: those for people, in small letters, in the order of `ToolKind`.
inline constexpr std::array<std::string_view, 12> kHandTools = {"orbit",    "scalpel", "plane cut", "forceps",
                                                                "pin",      "probe",   "hook",      "retractor",
                                                                "scissors", "punch",   "suture",    "staple"};

/// What a person has in hand when the scene is opened. What is unset goes by the body, and in an exercise by what is
/// asked for. Lengths in the model's unit.
struct HandPreset {
  static constexpr double kMostTilt = 68;  ///< degrees; no tool is tilted further

  std::string tool;             ///< one of `kHandTools`; empty: see above
  std::optional<double> depth;  ///< of scalpel, scissors and punch below the surface, above 0
  std::optional<double> angle;  ///< of the scalpel to the left of upright, seen along the cut; degrees, ±`kMostTilt`
  std::optional<double> ring;   ///< the punch's radius, above 0
  std::optional<double> grip;   ///< radius of forceps, hooks and retractors, above 0
};

}  // namespace app
}  // namespace v0
}  // namespace incise
