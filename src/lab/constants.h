// SPDX-License-Identifier: Apache-2.0
// Constants of the cited methods: what their publications leave open.
#pragma once

namespace incise {
inline namespace v0 {
namespace lab {

/// Share of an edge that a point on it keeps from its ends. Smaller: parts of almost no volume where the blade passes
/// a vertex. Larger: walls further beside the blade.
inline constexpr double kNearestToEnd = 0.01;
/// How far the points on crossed sides lie off the sheet in a division into 17, as a share of the way to the edge that
/// is not crossed. 0: the part in the middle of a tet cut in half would have no volume, since the points halfway along
/// the sides of a quadrilateral lie in one plane.
inline constexpr double kOffTheSheet = 0.1;
/// Vertices move onto the blade that cross an edge within this share of it, where the rest is divided. Larger: fewer
/// tets, flatter ones.
inline constexpr double kReachOfMoves = 0.3;

/// Where vertices snap and nothing is divided, all that cross an edge within this share of it move: half of it, so any
/// edge that is crossed has an end that does.
inline constexpr double kReachOfSnapping = 0.5;
/// Consecutive parts of a sweep that meets itself overlap by this many spacings, so that the cut stays whole.
inline constexpr double kPartOverlap = 3.0;

}  // namespace lab
}  // namespace v0
}  // namespace incise
