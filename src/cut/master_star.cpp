// SPDX-License-Identifier: Apache-2.0
// A closed vertex has a code in each master around it, and the master's template lists the children at each code. What
// a child has besides, towards which end of the edge or on which side of the sheet it is, follows from its codes, too.
#include "cut/master_star.h"

#include "cut/division.h"
#include "cut/parity.h"

namespace incise {
inline namespace v0 {

/// The code of a closed vertex in a master; those of the ends of its edge, where it splits one.
struct MasterStar::Codes {
  std::uint8_t vertex;
  std::uint8_t a = SplitTemplate::kCodes, b = SplitTemplate::kCodes;
};

namespace {

/// Of a child that has a corner of its master, by the codes that it has: bit 0 where another corner is on the same side
/// of the sheet, bit 1 where one is across. Corners that take part in the cut are on neither.
std::uint8_t sides_of(const Master& master, std::uint8_t corner, unsigned has) {
  unsigned sides = 0;
  for (unsigned c = 0; c < 4; ++c) {
    if (c == corner || ((has >> c) & 1U) == 0 || ((unsigned{master.on} >> c) & 1U) != 0) continue;
    sides |= 1U + ((unsigned{master.flagged} >> kEdgeOfCorners[corner][c]) & 1U);
  }
  return static_cast<std::uint8_t>(sides);
}

}  // namespace

bool ends_without_point(const Master& master) {
  if (!has_odd_face(master.flagged)) return false;
  bool does_end = false;
  for (unsigned s = 0; s < 4; ++s) does_end |= master.points[s] == Master::kNone && is_odd_side(master, s);
  return does_end;
}

void MasterStar::gather_corner(std::span<const std::uint32_t> masters, VertexId vertex) {
  gather(masters, [&](const Master& m) { return Codes{static_cast<std::uint8_t>(corner_of(m, vertex))}; });
}

void MasterStar::gather_split_point(std::uint32_t edge) {
  memory_.masters.clear();
  state_.complex.for_each_around(edge, [&](std::uint32_t m) { memory_.masters.push_back(m); });
  const VertexId end = state_.complex.edges()[edge].a;
  gather(memory_.masters, [&](const Master& m) {
    const auto e = static_cast<std::size_t>(std::find(m.edges.begin(), m.edges.end(), edge) - m.edges.begin());
    const auto [first, second] = kEdgeCorners[e];
    const auto code = static_cast<std::uint8_t>(SplitTemplate::kFirstSplit + e);
    return m.vertices[first] == end ? Codes{code, first, second} : Codes{code, second, first};
  });
}

void MasterStar::gather_front_point(const FrontPoint& point) {
  memory_.masters.clear();
  for (const std::uint32_t master : point.masters) {
    if (master != Master::kNone) memory_.masters.push_back(master);
  }
  gather(memory_.masters, [&](const Master& m) {
    std::uint8_t s = 0;
    while (m.points[s] == Master::kNone || state_.complex.point(m.points[s]).vertex != point.vertex) ++s;
    return Codes{static_cast<std::uint8_t>(SplitTemplate::kFirstPoint + s)};
  });
}

void MasterStar::gather_middle(std::uint32_t master) {
  gather({&master, 1}, [](const Master&) { return Codes{SplitTemplate::kMiddle}; });
}

/// `codes_in(master)` tells which of a template's vertices it is.
template <class CodesIn>
void MasterStar::gather(std::span<const std::uint32_t> masters, CodesIn&& codes_in) {
  memory_.tets.clear();
  is_beside_closed_ = false;
  for (const std::uint32_t index : masters) {
    const Master& master = state_.complex[index];
    is_beside_closed_ |= master.is_pinched || master.has_latent_faces || ends_without_point(master);
    add(master, codes_in(master));
  }
}

/// The children of one master around a vertex.
void MasterStar::add(const Master& master, const Codes& codes) {
  const SplitTemplate& split = *master.split;
  const auto tets = state_.complex.children(master);
  const bool is_new = master.is_dirty && !master.is_kept;
  for (const std::uint8_t at : split.around(codes.vertex)) {
    const unsigned k = at / 4U, has = split.codes[k];
    const auto ends = codes.vertex < SplitTemplate::kFirstSplit
                          ? sides_of(master, codes.vertex, has)
                          : static_cast<std::uint8_t>(((has >> codes.a) & 1U) | ((has >> codes.b) & 1U) << 1U);
    const std::uint32_t old = master.is_dirty ? material_.old_of(tets[k]) : kInvalidIndex;
    memory_.tets.push_back({tets[k], at & 3U, is_new, old, 0, ends});
  }
}

}  // namespace v0
}  // namespace incise
