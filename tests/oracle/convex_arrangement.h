// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incise/geom/vec.h"

namespace incise::oracle {

/// The plane normal · x = offset; the normal may have any length but 0.
struct Plane {
  Vec3 normal;
  double offset;
};

/// Tets that share faces where they share vertices; each of any orientation, none flat, none overlapping.
struct Body {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 4>> tets;
};

/// What counts as nothing.
struct Cutoff {
  /// Points nearer to a plane than this share of the largest coordinate lie on it: what rounding does to the input.
  double on_plane = 4e-15;
  /// Shared areas below this share of the mesh face that they lie in do not join.
  double area = 1e-13;
  /// Pieces below this share of the mean volume of a tet are crumbs.
  double volume = 1e-13;
};

/// The pieces into which planes divide a body.
struct Arrangement {
  std::vector<double> volumes;  ///< of the pieces, ascending
  double total = 0;             ///< of the body
  std::size_t crumbs = 0;       ///< pieces too small to count, not among `volumes`
  double crumb_volume = 0;

  [[nodiscard]] std::size_t piece_count() const { return volumes.size(); }
};

/// Divides a body by whole planes and finds the face-connected pieces.
///
/// Shares no code with the engine. Every tet is divided into its convex cells, one for each combination of sides of
/// the planes; cells of neighbouring tets on the same sides of all planes are one piece where the part of the common
/// face on these sides has an area. So bodies need not be convex, and a plane may separate more than two pieces.
/// Volumes are right to about 1e-14 of the body's: all is computed in long double.
/// Cost: grows with the cells in a tet, up to k³/6 for k planes through it.
Arrangement arrange(const Body& body, const std::vector<Plane>& planes, const Cutoff& cutoff = {});

}  // namespace incise::oracle
