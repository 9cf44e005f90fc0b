// SPDX-License-Identifier: Apache-2.0
// The constants of geometry, with what each is measured in and what goes wrong where it is changed, and those that
// modules share which may not include each other. All were chosen by hand, and changing them changes hashes.
#pragma once

#include <cstddef>

namespace incise {
inline namespace v0 {

/// 180/π, for reports.
inline constexpr double kDegreesPerRadian = 57.295779513082320876798154814105;

/// Unit normals whose cross product is this short belong to one plane, and directions of this sine lie in it: rounding.
/// A vertex that slides in a plane changes no volume beyond that.
inline constexpr double kOnePlane = 1e-9;

/// Triangles of a leaf of a tree, at most. A matter of speed.
inline constexpr std::size_t kTreeLeafSize = 4;
/// A box is passed over only where it is further than this share of the distance: distances to boxes and to triangles
/// round differently, and triangles at equal distances must all be seen for the lowest to win.
inline constexpr double kBoxSlack = 1.0 - 1e-12;
/// Squared sine of the angle at a corner below which the normal is too rough to trust the face alone.
inline constexpr double kThinCorner = 1e-12;

}  // namespace v0
}  // namespace incise
