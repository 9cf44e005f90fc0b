// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/sweep.h"
#include "paper/neighbourhood.h"

namespace incise {
inline namespace v0 {

/// Counts how often the sheet crosses every edge of the near tets, and marks the tets by parity.
///
/// A crossing is decided by exact signs under Simulation of Simplicity, so that no test is degenerate: every edge is
/// on one side or the other, and neighbours agree. Flags of a face sum to the number of times that the sheet's border
/// pierces it, modulo 2. Paper §2.2 (collision points). Differs: the paper tests with a tolerance.
/// Cost: O(near tets); each sign of a vertex and a triangle is computed once where the table of signs is small enough.
void find_crossings(const TetMesh& mesh, const Sheet& sheet, const std::vector<TetId>& near, Neighbourhood& out,
                    unsigned threads = 1);

/// Counts anew how often a sheet crosses the near edges at some vertices (ascending), and marks their tets by parity.
/// Cost: O(near edges · log vertices).
void find_crossings_at(const TetMesh& mesh, const Sheet& sheet, const std::vector<VertexId>& vertices,
                       Neighbourhood& near);

/// An edge that two parts of a sheet pass through, and a point between them.
struct DoublyCrossed {
  std::uint32_t edge;  ///< into `Neighbourhood::edges`
  double t;            ///< halfway between the two crossings, from a to b
};

/// The edges that two parts of the sheet pass through more than `gap` of the edge apart, ascending. They must be
/// bisected in between, or one crossing would hide the other. An end that coincides with the sheet counts as crossed
/// there. That is bisected, too, where one end, not both, is a collision point: beyond a corner of the blade's edge, an
/// edge that starts on one part of the sheet crosses another. A single smooth part that an edge leaves and enters again
/// (a graze: the edge is nearly a chord) is left alone; the cut then follows the chord. Cost: O(edges), with a search
/// of the sheet for ends of crossed edges.
std::vector<DoublyCrossed> find_doubly_crossed(const TetMesh& mesh, const Sheet& sheet,
                                               const Neighbourhood& neighbourhood, double gap);

}  // namespace v0
}  // namespace incise
