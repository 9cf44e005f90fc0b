// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/strip.h"

namespace incise::inline v0 {

/// How front points follow the blade.
struct FrontRules {
  double reach = 0.0;    ///< a point stays where it is while the blade's border pierces its face within this length
  double margin = 0.15;  ///< barycentric share that points keep from every edge of their face: smaller ones make
                         ///< slivers, larger ones move the front off the blade
};

/// Puts a front point into every face where the cut ends: an odd number of its edges are crossed, and one of them is
/// split. Takes away those of faces where it no longer does.
///
/// Notes besides where the strip's border turns inside a master: the front point inside goes there.
/// A point lies where the border of the strip pierces its face, but keeps a share of the face's height from its edges;
/// where this strip's border does not pierce it, an earlier one does, or the point is put at the middle.
/// Marks the masters on both sides of what changed as dirty. **Source:** parity law, docs/internals.md: the crossings
/// of a face's edges and the piercings of its inside by the border sum to an even number. Cost: O(masters · segments).
/// @return faces whose point had to be guessed.
std::uint64_t update_front_points(const TetMesh& mesh, const OwnSheet& sheet, std::span<const std::uint32_t> masters,
                                  const FrontRules& rules, std::uint32_t step, ClosedComplex& complex);

/// Puts all front points where the border pierces their faces, with another margin. Marks what moves as dirty.
void place_front_points(const TetMesh& mesh, double margin, ClosedComplex& complex);

}  // namespace incise::inline v0
