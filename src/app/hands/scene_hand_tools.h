// SPDX-License-Identifier: Apache-2.0
// What a person has in hand when a scene is opened.
#pragma once

#include <optional>

#include "app/hands/tools.h"
#include "app/scene/scene.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The settings to begin with: those for the body; in an exercise with the depth and the angle that it asks for; and
/// whatever the scene's `hand` says before all.
///
/// @param body  around the body, in the scene's length unit. A pure function. Cost: O(regions).
[[nodiscard]] ToolSettings settings_for(const Scene& scene, const Box& body);

/// The tool to begin with: that of the scene's `hand`, in an exercise without one the scalpel. Nothing: the tool that
/// is in hand stays there.
[[nodiscard]] std::optional<ToolKind> tool_for(const Scene& scene);

}  // namespace app
}  // namespace v0
}  // namespace incise
