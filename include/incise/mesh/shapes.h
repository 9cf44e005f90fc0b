// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_soup.h"

namespace incise {
inline namespace v0 {

/// Makes a box of `cells[0] × cells[1] × cells[2]` cells, six positive tets each, that share the cell's diagonal
/// (Kuhn's, also called Freudenthal's, triangulation: faces of neighbouring cells match).
///
/// Vertex (i, j, k) lies at low + (high - low)·(i, j, k) / cells and has number i + (nx+1)·(j + (ny+1)·k).
/// @param low, high  opposite corners, low < high on every axis, finite; in length units.
/// @param cells      at least 1 on each axis; all in all at most 2^28 / 6.
/// @return (nx+1)(ny+1)(nz+1) points and 6·nx·ny·nz tets without regions; empty for arguments out of range.
/// Cost: O(tets). **Source:** Paper §4, CUBE (n = 5).
TetSoup kuhn_box(const Vec3& low, const Vec3& high, const std::array<std::uint32_t, 3>& cells);

/// The unit cube as a Kuhn box of n³ cells: 6·n³ tets; n = 5 is the paper's CUBE of 750 tets.
TetSoup kuhn_cube(std::uint32_t n);

/// Moves the points of a box-shaped soup by a repeatable pseudo-random amount.
///
/// Points on the soup's bounding box stay in its faces, edges and corners.
/// @param fraction  of the shortest edge at each point, the most that it moves along one axis; up to about 0.15 no
///                  tet of a Kuhn box turns over.
/// @param seed      equal seeds give equal results on every compiler.
/// Cost: O(tets). Regions and tets stay as they are.
void jitter(TetSoup& soup, double fraction, std::uint64_t seed);

}  // namespace v0
}  // namespace incise
