// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/sheet_crossing.h"
#include "cut/strip.h"

namespace incise {
inline namespace v0 {

/// How a strip crosses an edge of the closed complex.
struct StripCrossing : SheetCrossings {
  std::uint32_t edge = 0;
  std::uint32_t master = 0;  ///< one that has the edge
};

/// Counts how often a strip crosses the edges of some masters, at rest. Keeps its memory between steps.
///
/// Exact, see `find_crossings`. The flags of a face, summed over all strips, are odd where the border of their union
/// pierces it.
class StripCrossings {
 public:
  /// The edges that are crossed, in the order of the masters. Cost: O(masters); the sign of a vertex and a triangle is
  /// computed once. Valid until the next call.
  const std::vector<StripCrossing>& find(const TetMesh& mesh, const Strip& strip,
                                         std::span<const std::uint32_t> masters, ClosedComplex& complex,
                                         std::uint32_t step);

 private:
  std::vector<StripCrossing> crossed_;
  SideSigns sides_;
};

/// A place between two crossings of one edge: the strip passes through it twice.
struct BetweenCrossings {
  std::uint32_t edge, master;
  double t;  ///< halfway, from a to b
};

/// The edges that two parts of a strip pass through more than `gap` of the edge apart: see `find_between`.
/// Cost: O(crossings), with a search of the strip for their ends.
std::vector<BetweenCrossings> find_doubly_crossed(const TetMesh& mesh, const Strip& strip,
                                                  std::span<const StripCrossing> crossings,
                                                  const ClosedComplex& complex, double gap);

}  // namespace v0
}  // namespace incise
