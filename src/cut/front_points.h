// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/constants.h"
#include "cut/older_walls.h"
#include "cut/strip.h"
#include "cut/wake.h"

namespace incise {
inline namespace v0 {

/// How front points follow the blade.
struct FrontRules {
  double reach = 0.0;    ///< a point stays where it is while the blade's border pierces its face within this length
  double margin = 0.15;  ///< barycentric share that points keep from every edge of their face: smaller ones make
                         ///< slivers, larger ones move the front off the blade
  double spacing = 0.0;  ///< the length of a typical edge of the mesh
  double beside =
      kBesideWall;  ///< an older wall passes so far beside a border that lies in it, as a share of the local edge
  const OlderWalls* older = nullptr;  ///< a border that lies in an older cut ends nothing; null: there is none
};

/// Puts a front point into every face where the cut ends: an odd number of its edges are crossed, and the border of the
/// sheet pierces its inside, or one of these edges is split. Takes away those of faces where it no longer does. Where
/// the border lies in an older cut, nothing ends: there is no point.
///
/// Notes besides where the strip's border turns inside a master: the front point inside goes there.
/// A point lies where the border of the strip pierces its face, but keeps a share of the face's height from its edges;
/// where this strip's border does not pierce it, an earlier one does, or the point is put at the middle.
/// Marks the masters on both sides of what changed as dirty. **Source:** parity law, docs/internals.md: the crossings
/// of a face's edges and the piercings of its inside by the border sum to an even number. Cost: O(masters · segments).
/// @return faces whose point had to be guessed.
std::uint64_t update_front_points(const TetMesh& mesh, const OwnSheet& sheet, std::span<const std::uint32_t> masters,
                                  const FrontRules& rules, std::uint32_t step, ClosedComplex& complex);

/// Gives the front points of masters that settle another margin, to which they slide along the line in which the sheet
/// passes through their face, so that they stay on the sheet; and puts them back on it where vertices of the face have
/// moved. From then on they are final. Marks what moves as dirty. Cost: O(settling masters), with a search of the sheet
/// for each point.
void place_front_points(const TetMesh& mesh, const OwnSheet& sheet, const Wake& wake, double margin,
                        ClosedComplex& complex);

}  // namespace v0
}  // namespace incise
