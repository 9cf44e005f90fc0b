// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/neighbourhood.h"
#include "cut/sweep.h"

namespace incise::inline v0 {

/// Counts how often the sheet crosses every edge of the near tets, and marks the tets by parity.
///
/// A crossing is decided by exact signs under Simulation of Simplicity, so that no test is degenerate: every edge is
/// on one side or the other, and neighbours agree. Flags of a face sum to the number of times that the sheet's border
/// pierces it, modulo 2. Paper §2.2 (collision points). Differs: the paper tests with a tolerance.
/// Cost: O(near tets); each sign of a vertex and a triangle is computed once where the table of signs is small enough.
void find_crossings(const TetMesh& mesh, const Sheet& sheet, const std::vector<TetId>& near, Neighbourhood& out);

/// The edges that the sheet crosses more than once, with the crossings more than `gap` of the edge apart: indices into
/// `edges`, ascending. They must be bisected between the crossings, or one crossing would hide the other.
std::vector<std::uint32_t> find_multiply_crossed(const Neighbourhood& neighbourhood, double gap);

}  // namespace incise::inline v0
