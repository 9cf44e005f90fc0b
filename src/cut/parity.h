// SPDX-License-Identifier: Apache-2.0
// The parity law: a border of the sheet pierces the faces with an odd number of crossed edges (docs/internals.md, 3).
#pragma once

#include <cstdint>

#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {

/// The colour of corner c of a complete tet, relative to corner 0: which side of the sheet it lies on (bit 0 or 1).
constexpr unsigned colour_of(std::uint8_t flagged, unsigned corner) {
  return corner == 0 ? 0U : (unsigned{flagged} >> kEdgeOfCorners[0][corner]) & 1U;
}

/// Whether some face has an odd number of flagged edges: the border of the sheet pierces it (algorithm: parity law).
constexpr bool has_odd_face(std::uint8_t flagged) {
  const unsigned bits = flagged;
  bool is_odd = false;
  for (const auto& edges : kSideEdges) {
    is_odd |= (((bits >> edges[0]) ^ (bits >> edges[1]) ^ (bits >> edges[2])) & 1U) != 0;
  }
  return is_odd;
}

}  // namespace v0
}  // namespace incise
