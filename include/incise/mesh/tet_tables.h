// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

// The numbering of corners, sides and edges of a tet. It lives here alone.
//
//            3            A tet (0,1,2,3) is positive where (1-0)×(2-0)·(3-0) > 0: seen from
//           /|\           corner 3, the corners 0, 1, 2 turn counter-clockwise.
//          / | \          Side s is the face opposite corner s.
//         0--|--2         Edge e joins kEdgeCorners[e]; the edge opposite e is 5 - e.
//          \ | /
//            1
namespace incise {
inline namespace v0 {

/// Corners of side s, turning counter-clockwise seen from outside a positive tet.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kSideCorners = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Corners of edge e, ascending.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdgeCorners = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// The edge that joins two corners; 255 on the diagonal.
inline constexpr std::array<std::array<std::uint8_t, 4>, 4> kEdgeOfCorners = {
    {{255, 0, 1, 2}, {0, 255, 3, 4}, {1, 3, 255, 5}, {2, 4, 5, 255}}};

/// The three edges of side s, ascending.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kSideEdges = {{{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}}};

/// The edge, in [0, 5], that shares no corner with this one.
constexpr unsigned opposite_edge(unsigned edge) {
  return 5 - edge;
}

namespace detail {
constexpr bool tables_agree() {
  for (unsigned e = 0; e < 6; ++e) {
    const auto [a, b] = kEdgeCorners[e];
    if (kEdgeOfCorners[a][b] != e || kEdgeOfCorners[b][a] != e) return false;
    for (const unsigned corner : kEdgeCorners[opposite_edge(e)]) {
      if (corner == a || corner == b) return false;
    }
  }
  for (unsigned s = 0; s < 4; ++s) {
    for (const unsigned e : kSideEdges[s]) {
      if (kEdgeCorners[e][0] == s || kEdgeCorners[e][1] == s) return false;
    }
  }
  return true;
}
static_assert(tables_agree());
}  // namespace detail

}  // namespace v0
}  // namespace incise
