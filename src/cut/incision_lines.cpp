// SPDX-License-Identifier: Apache-2.0
// Each side adds its lines for itself. A line between two corners that take part in the cut may come from both sides
// that have this edge: then the cut does not turn into the master there, and the two take each other out.
#include "cut/incision_lines.h"

namespace incise {
inline namespace v0 {

IncisionLines::IncisionLines(const Master& master, const ClosedComplex& complex) : master_(master), complex_(complex) {
  for (unsigned s = 0; s < 4; ++s) add_side(s);
}

/// What stands for the crossing of a flagged edge: its split point, or the end that takes part in the cut; of two such
/// ends the one of lower rank, so that all masters of the edge agree.
std::uint8_t IncisionLines::crossing_of(unsigned edge) const {
  const auto [a, b] = kEdgeCorners[edge];
  const bool is_a_on = is_on(a), is_b_on = is_on(b);
  if (is_a_on && is_b_on) return rank(a) < rank(b) ? a : b;
  if (is_a_on || is_b_on) return is_a_on ? a : b;
  return static_cast<std::uint8_t>(SplitTemplate::kFirstSplit + edge);
}

void IncisionLines::add_side(unsigned side) {
  std::array<std::uint8_t, 3> crossings{};
  unsigned count = 0;
  for (const unsigned edge : kSideEdges[side]) {
    if (((unsigned{master_.flagged} >> edge) & 1U) != 0) crossings[count++] = crossing_of(edge);
  }
  if (count == 2) {
    toggle(crossings[0], crossings[1]);
  } else if (master_.points[side] != Master::kNone) {
    const auto point = static_cast<std::uint8_t>(SplitTemplate::kFirstPoint + side);
    for (unsigned k = 0; k < count; ++k) toggle(crossings[k], point);
  }
}

void IncisionLines::toggle(std::uint8_t a, std::uint8_t b) {
  if (a == b) return;
  to_[a] = static_cast<std::uint16_t>(to_[a] ^ (1U << b));
  to_[b] = static_cast<std::uint16_t>(to_[b] ^ (1U << a));
}

}  // namespace v0
}  // namespace incise
