// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/strip.h"

namespace incise::inline v0 {

/// How a strip crosses an edge of the closed complex.
struct StripCrossing {
  std::uint32_t edge;
  std::uint32_t master;          ///< one that has the edge
  std::uint32_t count = 0;       ///< how often
  double t = 0.5, t_last = 0.5;  ///< of the first and of the last crossing, from a to b, in [0, 1]
  std::uint32_t triangle = 0, triangle_last = 0;
};

/// Counts how often a strip crosses the edges of some masters, at rest. Keeps its memory between steps.
///
/// A crossing is decided by exact signs under Simulation of Simplicity, so that no test is degenerate: every vertex is
/// on one side of every triangle, and neighbours agree. The flags of a face, summed over all strips, are odd where the
/// border of their union pierces it. Paper §2.2 (collision points). Differs: the paper tests with a tolerance.
class StripCrossings {
 public:
  /// The edges that are crossed, in the order of the masters. Cost: O(masters); the sign of a vertex and a triangle is
  /// computed once. Valid until the next call.
  const std::vector<StripCrossing>& find(const TetMesh& mesh, const Strip& strip,
                                         std::span<const std::uint32_t> masters, ClosedComplex& complex,
                                         std::uint32_t step);

 private:
  void count(const TetMesh& mesh, const Sheet& sheet, const ClosedEdge& edge, StripCrossing& crossing);
  int side(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, std::uint32_t triangle);

  std::vector<StripCrossing> crossed_;
  ZeroedArray<std::uint32_t> index_;  // by vertex slot: 1 + row of `signs_`
  std::vector<VertexId> known_;
  std::vector<std::int8_t> signs_;
};

/// A place between two crossings of one edge: the strip passes through it twice.
struct BetweenCrossings {
  std::uint32_t edge, master;
  double t;  ///< halfway, from a to b
};

/// The edges that two parts of a strip pass through more than `gap` of the edge apart. They must be bisected in
/// between, or one crossing would hide the other. An end that coincides with the strip counts as crossed there. A
/// single smooth part that an edge leaves and enters again (a graze: the edge is nearly a chord) is left alone; the cut
/// then follows the chord. Cost: O(crossings), with a search of the strip for their ends.
std::vector<BetweenCrossings> find_doubly_crossed(const TetMesh& mesh, const Strip& strip,
                                                  std::span<const StripCrossing> crossings,
                                                  const ClosedComplex& complex, double gap);

}  // namespace incise::inline v0
