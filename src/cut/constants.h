// SPDX-License-Identifier: Apache-2.0
// Constants that cuts of both profiles share.
#pragma once

namespace incise {
inline namespace v0 {

/// Vertices closer to the blade than this share of their mean edge coincide with it: geometry given twice, not a
/// choice.
inline constexpr double kCoincident = 1e-6;
/// A blade that lies within this share of the mesh's spacing of what it swept before is in its own slit.
inline constexpr double kOwnSlit = 0.02;
/// What a blade sweeps while it turns is made of triangles that lie within so many spacings of it.
inline constexpr double kTwist = 0.1;
/// A blade turns sharply where the cosine of the angle between two of its moves is below this: by more than 45°.
inline constexpr double kSharpTurn = 0.70710678118654752440;

}  // namespace v0
}  // namespace incise
