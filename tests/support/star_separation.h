// SPDX-License-Identifier: Apache-2.0
// An oracle: what comes apart along given faces, told without a closed complex.
#pragma once

#include "paper/dividable.h"

namespace incise::test {

/// Separates the material along the incision faces, in one pass: every vertex of an incision face gets one copy per
/// face-connected part of its star after the incision faces are taken away.
///
/// This is the terminal state of the paper's Algorithms 1 and 2 iterated to the end, whatever their order; it also
/// separates where their literal form stalls (closed interior sheets, several sectors at a vertex). An edge both of
/// whose ends stay whole although two of its fans are apart (a neck one edge wide) is bisected first, so that its
/// midpoint comes apart. Every boundary edge that results has exactly two boundary faces.
/// Source: paper §2.3, §2.4; proof of equivalence in docs/paper_map.md. Cost: O(tet slots · rounds of bisection).
Separation separate_stars(TetMesh& mesh, std::vector<IncisionFace> incision, std::uint32_t tag = 1);

}  // namespace incise::test
