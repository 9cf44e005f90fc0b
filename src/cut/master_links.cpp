// SPDX-License-Identifier: Apache-2.0
// A face is an incision face if the material on its two sides is on opposite sides of the sheet: inside a complete
// master where the colours of two children differ, inside a cone where a face stands on a line in which the sheet meets
// the master's surface, and between masters where the sheet lies on their common face.
#include "cut/master_links.h"

#include <algorithm>
#include <bit>

#include "cut/division.h"
#include "cut/parity.h"

namespace incise {
inline namespace v0 {

namespace {

/// Whether a segment passes through a sheet an odd number of times. Exact.
bool crosses(const OwnSheet& sheet, const SosPoint& p, const SosPoint& q) {
  const Box box{p.position.cwiseMin(q.position), p.position.cwiseMax(q.position)};
  bool is_odd = false;
  for (const auto& strip : sheet.strips()) {
    const Sheet& part = strip->sheet;
    part.tree().for_each_overlap(box, [&](std::uint32_t t) {
      is_odd ^= segment_crosses_triangle(p, q, part.point(t, 0), part.point(t, 1), part.point(t, 2));
    });
  }
  return is_odd;
}

}  // namespace

void MasterLinks::link() {
  for (const std::uint32_t index : state_.dirty) link(index);
  faces_.sort_standing();
}

void MasterLinks::link_last() {
  keeps_joined_ = true;
  link(state_.dirty.back());
  keeps_joined_ = false;
  faces_.sort_standing();
}

void MasterLinks::link(std::uint32_t index) {
  const ClosedComplex& complex = state_.complex;
  link_inner(complex[index]);
  for (unsigned s = 0; s < 4; ++s) {
    const std::uint32_t behind = complex[index].behind[s];
    if (behind == Master::kNone) {
      link_outside(index, s, material_.range(complex[index]).outside[s]);
    } else if (!complex[behind].is_dirty || complex[index].entry < complex[behind].entry) {
      link_masters(index, s, behind);
    }
  }
}

void MasterLinks::link_inner(const Master& master) {
  const SplitTemplate& split = *master.split;
  if (split.inner.empty()) return;
  std::uint64_t passed = table_.find(master, state_.complex).passed;
  for (const auto& [a, b] : split.inner) {
    meet(state_.complex.facet(master, a), state_.complex.facet(master, b), (passed & 1U) != 0);
    passed >>= 1U;
  }
}

/// Has two sides meet: linked, or apart as a face of the incision.
void MasterLinks::meet(Side a, Side b, bool is_crossed) {
  if (keeps_joined_ && state_.mesh.link(a) == Link(b)) return;
  const StrokeTags& tags = state_.settings.tags;
  const bool is_incision = is_crossed || stand_apart(a, b);
  if (is_incision && !is_crossed) faces_.note_apart(a);
  if (is_incision && tags.own(state_.mesh.link(a)) && tags.own(state_.mesh.link(b))) faces_.note_standing(a);
  set_link(a, is_incision ? tags.wall() : Link(b));
  set_link(b, is_incision ? tags.wall() : Link(a));
  if (is_incision) faces_.all().push_back({a, b});
}

/// Whether two sides are of two pieces: no step joins them. Of masters that are taken in later, where a wall is between
/// them; what this step itself parts counts as apart there.
bool MasterLinks::stand_apart(Side a, Side b) {
  if (!state_.settings.keeps_pieces) return false;
  MaterialPieces& pieces = material_.pieces();
  if (pieces.knows(a.tet()) && pieces.knows(b.tet())) return pieces.are_apart(a.tet(), b.tet());
  const StrokeTags& tags = state_.settings.tags;
  return tags.own(state_.mesh.link(a)) && tags.own(state_.mesh.link(b)) &&
         !pieces.hang_together(state_.mesh, a.tet(), b.tet());
}

void MasterLinks::set_link(Side side, Link link) {
  const Link before = state_.mesh.link(side);
  if (before == link) return;
  state_.transaction.set_link(side, link);
  if (before == Link()) return;  // a new child's: its master is not as before anyway
  const std::uint32_t master = state_.complex.find(side.tet());
  if (master != Master::kNone) faces_.note_relinked(master);
}

void MasterLinks::link_outside(std::uint32_t index, unsigned side, Link outside) {
  ClosedComplex& complex = state_.complex;
  for (const auto child_side : complex[index].split->outer[side]) {
    const Side facet = complex.facet(complex[index], child_side);  // masters may move: others are adopted
    if (outside.is_boundary()) {
      set_link(facet, outside);
      note_surface(facet, outside.tag() == 0 ? shape::kSkin : shape::kWall);
    } else {
      const TetId behind = outside.side().tet();
      if (material_.pieces().are_apart(facet.tet(), behind)) complex.adopt(state_.mesh, behind);
      meet(facet, outside.side(), false);
    }
  }
}

/// The vertices of a boundary side lie on its surface.
void MasterLinks::note_surface(Side side, std::uint8_t bit) {
  for (const VertexId v : state_.mesh.vertices(side)) {
    const std::uint8_t shape = state_.mesh.shape_of(v);
    if ((shape & bit) == 0) state_.transaction.set_shape(v, static_cast<std::uint8_t>(shape | bit));
  }
}

void MasterLinks::link_masters(std::uint32_t index, unsigned side, std::uint32_t behind) {
  const ClosedComplex& complex = state_.complex;
  const Master &master = complex[index], &other = complex[behind];
  const auto& sides = other.behind;
  const auto other_side = static_cast<unsigned>(std::find(sides.begin(), sides.end(), index) - sides.begin());
  const auto &outer = master.split->outer[side], &facing = other.split->outer[other_side];
  if (outer.size() == 1) {
    meet(complex.facet(master, outer[0]), complex.facet(other, facing[0]),
         lies_across(master, side, other, other_side));
    return;
  }
  link_facets(master, side, other, other_side);
}

/// Links the facets of two masters in the side between them, each to that with the same vertices.
void MasterLinks::link_facets(const Master& master, unsigned side, const Master& other, unsigned other_side) {
  const ClosedComplex& complex = state_.complex;
  std::array<std::uint16_t, SplitTemplate::kCodes> there{};  // what a code of `master` is called in `other`
  const auto name = [&](unsigned here, std::size_t code) { there[here] = static_cast<std::uint16_t>(1U << code); };
  const auto place_in = [](const auto& all, auto one) {
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), one) - all.begin());
  };
  for (const unsigned c : kSideCorners[side]) name(c, place_in(other.vertices, master.vertices[c]));
  for (const unsigned e : kSideEdges[side]) {
    name(SplitTemplate::kFirstSplit + e, SplitTemplate::kFirstSplit + place_in(other.edges, master.edges[e]));
  }
  name(SplitTemplate::kFirstPoint + side, SplitTemplate::kFirstPoint + other_side);
  const auto &outer = master.split->outer[side], &facing = other.split->outer[other_side];
  const auto &codes = master.split->on_side[side], &facing_codes = other.split->on_side[other_side];
  for (std::size_t i = 0; i < outer.size(); ++i) {
    unsigned same = 0;
    for (unsigned rest = codes[i]; rest != 0; rest &= rest - 1)
      same |= there[static_cast<unsigned>(std::countr_zero(rest))];
    for (std::size_t k = 0; k < facing.size(); ++k) {
      if (facing_codes[k] == same) meet(complex.facet(master, outer[i]), complex.facet(other, facing[k]), false);
    }
  }
}

/// Whether an undivided face lies on the sheet: three ON vertices, and the two masters on opposite sides.
bool MasterLinks::lies_across(const Master& master, unsigned side, const Master& other, unsigned other_side) const {
  const unsigned face = 15U & ~(1U << side), other_face = 15U & ~(1U << other_side);
  if ((master.on & face) != face || (other.on & other_face) != other_face || has_odd_face(master.flagged) ||
      has_odd_face(other.flagged)) {
    return false;
  }
  const VertexId common = master.vertices[side == 0 ? 1 : 0];
  return is_beyond(common, master, side) != is_beyond(common, other, other_side);
}

/// Whether the sheet passes between an ON vertex and the inside of a master that has it, seen over one of its sides.
bool MasterLinks::is_beyond(VertexId from, const Master& master, unsigned side) const {
  if (((unsigned{master.on} >> side) & 1U) != 0) {  // all four vertices coincide with the sheet: ask for the middle
    Vec3 middle = Vec3::Zero();
    for (const VertexId v : master.vertices) middle += 0.25 * state_.mesh.rest(v);
    const std::uint64_t key = 2 * kFirstBladeKey + state_.complex.children(master)[0].value;
    return crosses(sheet_, {state_.mesh.rest(from), from.value}, {middle, key});
  }
  const auto corner =
      static_cast<unsigned>(std::find(master.vertices.begin(), master.vertices.end(), from) - master.vertices.begin());
  return ((unsigned{master.flagged} >> kEdgeOfCorners[corner][side]) & 1U) != 0;
}

}  // namespace v0
}  // namespace incise
