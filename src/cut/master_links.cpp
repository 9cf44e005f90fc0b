// SPDX-License-Identifier: Apache-2.0
// A face is an incision face if the material on its two sides is on opposite sides of the sheet: inside a complete
// master where the colours of two children differ, inside a cone where a face stands on a line in which the sheet meets
// the master's surface, and between masters where the sheet lies on their common face.
#include "cut/master_links.h"

#include <algorithm>

#include "cut/division.h"
#include "cut/incision_lines.h"
#include "cut/parity.h"

namespace incise {
inline namespace v0 {

namespace {

/// Which side of the sheet a child of a complete master lies on: the colour of any corner that is not on the sheet.
unsigned colour_of_child(const SplitTemplate::Child& child, const Master& master) {
  for (const std::uint8_t code : child) {
    if (code < SplitTemplate::kFirstSplit && ((unsigned{master.on} >> code) & 1U) == 0) {
      return colour_of(master.flagged, code);
    }
  }
  return colour_of(master.flagged, child[0] < SplitTemplate::kFirstSplit ? child[0] : 0);
}

/// Whether a face of a cone stands on a line of the incision.
bool lies_on_line(const IncisionLines& lines, const SplitTemplate::Child& child, unsigned side) {
  std::array<std::uint8_t, 2> foot{};
  unsigned count = 0;
  for (const unsigned c : kSideCorners[side]) {
    if (child[c] != SplitTemplate::kMiddle) foot[count++] = child[c];
  }
  return lines.contains(foot[0], foot[1]);
}

/// Whether two faces have the same three vertices.
bool are_same(const std::array<VertexId, 3>& u, const std::array<VertexId, 3>& v) {
  return std::all_of(u.begin(), u.end(), [&](VertexId x) { return x == v[0] || x == v[1] || x == v[2]; });
}

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
  link(state_.dirty.back());
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
  const ClosedComplex& complex = state_.complex;
  const SplitTemplate& split = *master.split;
  if (split.inner.empty()) return;
  const bool is_cone = Divider::is_cone(master);
  const IncisionLines lines(master, complex);
  for (const auto& [a, b] : split.inner) {
    const auto &first = split.children[a / 4U], &second = split.children[b / 4U];
    const bool is_incision = is_cone ? lies_on_line(lines, first, a & 3U)
                                     : colour_of_child(first, master) != colour_of_child(second, master);
    meet(complex.facet(master, a), complex.facet(master, b), is_incision);
  }
}

/// Has two sides meet: linked, or apart as a face of the incision.
void MasterLinks::meet(Side a, Side b, bool is_crossed) {
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
  if (state_.mesh.link(side) != link) state_.transaction.set_link(side, link);
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
  constexpr std::size_t kMostFacets = 6;
  std::array<std::array<VertexId, 3>, kMostFacets> there;
  for (std::size_t k = 0; k < facing.size(); ++k) there[k] = closed_facet(other, facing[k]);
  for (const auto a : outer) {
    const std::array<VertexId, 3> here = closed_facet(master, a);
    for (std::size_t k = 0; k < facing.size(); ++k) {
      if (are_same(here, there[k])) meet(complex.facet(master, a), complex.facet(other, facing[k]), false);
    }
  }
}

/// The closed vertices of a facet of a master.
std::array<VertexId, 3> MasterLinks::closed_facet(const Master& master, SplitTemplate::ChildSide side) const {
  const ClosedComplex& complex = state_.complex;
  const auto v = state_.mesh.vertices(complex.facet(master, side));
  return {complex.closed(v[0]), complex.closed(v[1]), complex.closed(v[2])};
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
