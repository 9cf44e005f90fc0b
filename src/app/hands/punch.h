// SPDX-License-Identifier: Apache-2.0
// A biopsy punch: a ring that is driven in and closes below, so that a core comes out.
#pragma once

#include "app/hands/hand_tool.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The way of a punch at a place of the surface, in 0.8 s: a ring of `punch_radius` goes straight in, and draws
/// together on its axis on the last fifth of the depth. What is inside comes off as a piece of its own.
[[nodiscard]] Stroke punch_stroke(const Vec3& point, const Vec3& normal, const ToolSettings& settings);
/// The ring on the surface and at its depth, as a preview.
void draw_punch(const Vec3& point, const Vec3& normal, const ToolSettings& settings, Marks& marks);

}  // namespace app
}  // namespace v0
}  // namespace incise
