// SPDX-License-Identifier: Apache-2.0
// Which parts a star has, and which copy each part gets, is told by `StarParts`. Here is told which vertices are looked
// at, each once a round, and which copy a part of new tets should have: that on its side of the cut, so that the flaps
// of an open wound do not jump.
#include "cut/vertex_separation.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

namespace {

/// Which end of its edge a part of a split point's star contains: 0 for a, 1 for b, 2 for both or neither.
unsigned half_of(std::span<const StarTet> part) {
  unsigned ends = 0;
  for (const StarTet& tet : part) ends |= tet.ends;
  return ends == 1 || ends == 2 ? ends - 1 : 2;
}

}  // namespace

VertexSeparation::VertexSeparation(RebuildState& state, OldMaterial& material, IncisionFaces& faces,
                                   IncisionTable& table, Memory& memory)
    : state_(state),
      material_(material),
      faces_(faces),
      table_(table),
      memory_(memory),
      star_(state, material, memory.star) {
  memory_.renamed.clear();
  memory_.surface.clear();
}

void VertexSeparation::separate() {
  std::vector<Side>& surface = memory_.surface;
  surface.clear();
  ++memory_.round;
  ++rounds_;
  for (const std::uint32_t index : state_.dirty) divide_around(index);
  divide_apart();
  std::sort(surface.begin(), surface.end());
  surface.erase(std::unique(surface.begin(), surface.end()), surface.end());
}

/// The vertices of the cut in a dirty master.
void VertexSeparation::divide_around(std::uint32_t index) {
  ClosedComplex& complex = state_.complex;
  const bool keeps_pieces = state_.settings.keeps_pieces;
  if (!complex[index].is_divided() && complex[index].on == 0 && !keeps_pieces) return;
  for (unsigned c = 0; c < 4; ++c) {
    const VertexId corner = complex[index].vertices[c];
    if (complex[index].is_kept && complex.is_half_baked(corner)) continue;  // it has the copy that it had
    const bool is_apart = keeps_pieces && (complex.has_copies(corner) || has_gone_over(complex[index], c));
    if (((unsigned{complex[index].on} >> c) & 1U) != 0 || is_apart) divide_corner(index, corner);
  }
  for (unsigned e = 0; e < 6; ++e) {
    const std::uint32_t at = complex[index].edges[e];
    if (complex.edges()[at].split.is_valid()) divide_split_point(at);
  }
  for (const std::uint32_t point : complex[index].points) {
    if (point != Master::kNone) divide_front_point(complex.point(point));
  }
  if (complex[index].middle.is_valid()) divide_middle(index);
}

/// Whether a child has a corner that was of another piece than its material: that piece is in no child any more, and
/// its vertex must not go over by its name alone.
bool VertexSeparation::has_gone_over(const Master& master, unsigned corner) const {
  const MaterialPieces& pieces = material_.pieces();
  if (!pieces.has_several()) return false;
  const auto tets = state_.complex.children(master);
  const auto around = master.split->around(static_cast<std::uint8_t>(corner));
  return std::any_of(around.begin(), around.end(), [&](unsigned at) {
    const TetId tet = tets[at / 4U];
    return pieces.are_apart(tet, state_.mesh.vertices(tet)[at & 3U]);
  });
}

/// The vertices of faces that are left open since two pieces meet there.
void VertexSeparation::divide_apart() {
  for (const auto& [vertex, master] : faces_.apart()) {
    const auto& corners = state_.complex[master].vertices;
    if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) divide_corner(master, vertex);
  }
}

bool VertexSeparation::has_visited(VertexId vertex) const {
  const VertexId closed = state_.complex.closed(vertex);
  return closed.value < memory_.visited.capacity() && memory_.visited[closed.value] == memory_.round;
}

void VertexSeparation::note_visited(VertexId vertex) {
  memory_.visited.ensure(std::size_t{vertex.value} + 1);
  memory_.visited[vertex.value] = memory_.round;
}

/// Whether a closed vertex is looked at for the first time in this round; from now on it is not.
bool VertexSeparation::is_first(VertexId vertex) {
  if (vertex.value < memory_.visited.capacity() && memory_.visited[vertex.value] == memory_.round) return false;
  note_visited(vertex);
  return true;
}

void VertexSeparation::divide_corner(std::uint32_t master, VertexId vertex) {
  if (!is_first(vertex)) return;
  const std::vector<std::uint32_t>& masters = state_.complex.star(state_.mesh, master, vertex);
  star_.gather_corner(masters, vertex);
  find_across(masters, vertex);
  const bool may_be_named = state_.complex.is_known_around(vertex, masters);
  const VertexId named = divide(
      vertex, [&](std::span<const StarTet> part) { return home_of_corner(vertex, part); }, false, may_be_named);
  across_.clear();
  if (named == vertex) return;
  state_.complex.rename(vertex, named, masters);
  for (auto& apart : faces_.apart()) apart.vertex = apart.vertex == vertex ? named : apart.vertex;
  memory_.renamed.push_back({vertex, named});
}

void VertexSeparation::divide_split_point(std::uint32_t at) {
  ClosedComplex& complex = state_.complex;
  const VertexId vertex = complex.edges()[at].split;
  if (!is_first(vertex) || is_as_before(at)) return;
  star_.gather_split_point(at);
  complex.edges()[at].split = divide(
      vertex,
      [&](std::span<const StarTet> part) {
        const unsigned half = half_of(part);
        return half < 2 ? complex.edges()[at].halves[half] : VertexId();
      },
      true, true);
  note_halves(complex.edges()[at]);
}

void VertexSeparation::divide_front_point(FrontPoint& point) {
  if (!is_first(point.vertex) || is_as_before(point)) return;
  star_.gather_front_point(point);
  point.vertex = divide(
      point.vertex, [&](std::span<const StarTet> part) { return home_of_corner(point.vertex, part); }, false, true);
}

void VertexSeparation::divide_middle(std::uint32_t index) {
  const VertexId middle = state_.complex[index].middle;
  if (!is_first(middle) || (may_skip() && faces_.is_as_before(index))) return;
  if (takes_whole_middle(state_.complex[index])) return;
  star_.gather_middle(index);
  state_.complex[index].middle = divide(
      middle, [&](std::span<const StarTet> part) { return home_of_corner(middle, part); }, false, true);
}

/// Whether stars need not be divided that are as they were: their parts have their copies. Not where faces may have
/// been closed since they were found, nor where pieces are told by more than links.
bool VertexSeparation::may_skip() const {
  return rounds_ == 1 && state_.done.crumbs_kept == 0 && !state_.settings.keeps_pieces;
}

/// Whether the star of the point that splits an edge is as it was before this rebuild.
bool VertexSeparation::is_as_before(std::uint32_t edge) const {
  bool is_same = may_skip();
  if (is_same) state_.complex.for_each_around(edge, [&](std::uint32_t m) { is_same &= faces_.is_as_before(m); });
  return is_same;
}

bool VertexSeparation::is_as_before(const FrontPoint& point) const {
  bool is_same = may_skip();
  for (const std::uint32_t m : point.masters) is_same = is_same && (m == Master::kNone || faces_.is_as_before(m));
  return is_same;
}

/// The point inside a cone that was made anew has one part where the table says so, which takes it as it is: there is
/// nothing to divide. Not where faces may have been closed since they were found.
bool VertexSeparation::takes_whole_middle(const Master& master) {
  if (!may_skip() || !master.is_dirty || master.is_kept || ends_without_point(master)) return false;
  const PassedFaces& faces = table_.find(master, state_.complex);
  if (!faces.is_middle_whole) return false;
  ClosedComplex& complex = state_.complex;
  if (complex.has_copies(master.middle)) {
    for (const VertexId copy : complex.copies_of(master.middle)) state_.transaction.remove_vertex(copy);
    complex.drop_copies(master.middle);
  }
  const unsigned before = state_.mesh.shape_of(master.middle);
  const unsigned bits =
      (before & (shape::kPinched | shape::kFront)) | (faces.passed != 0 ? unsigned{shape::kWall} | shape::kFront : 0U);
  if (bits != before) state_.transaction.set_shape(master.middle, static_cast<std::uint8_t>(bits));
  return true;
}

/// Divides the star that was gathered. Returns what the closed vertex is called now.
VertexId VertexSeparation::divide(VertexId vertex, const StarParts::Home& home, bool makes_twins, bool may_be_named) {
  const bool keeps = state_.settings.keeps_pieces;
  const StarParts::Settings settings{state_.settings.tags,  makes_twins,         keeps,
                                     keeps && may_be_named, &material_.pieces(), across_};
  const StarParts::Division division = memory_.parts.divide(state_.transaction, state_.complex, material_.children(),
                                                            vertex, star_.tets(), home, settings);
  state_.done.copied_vertices += division.made;
  if (division.closed != vertex) note_visited(division.closed);
  note_surface_around(division.closed);
  return division.closed;
}

/// The neighbours across the sheet of a vertex that takes part in the cut for the first time, in a body that moves.
void VertexSeparation::find_across(std::span<const std::uint32_t> masters, VertexId vertex) {
  across_.clear();
  if (!state_.settings.keeps_pieces || state_.complex.has_copies(vertex)) return;
  for (const std::uint32_t index : masters) {
    const Master& master = state_.complex[index];
    const unsigned c = corner_of(master, vertex);
    for (unsigned other = 0; other < 4; ++other) {
      const bool is_on = ((unsigned{master.on} >> other) & 1U) != 0;
      if (other == c || is_on || ((unsigned{master.flagged} >> kEdgeOfCorners[c][other]) & 1U) == 0) continue;
      across_.push_back(master.vertices[other]);
    }
  }
}

/// Whether the material of a new tet had the vertex before.
bool VertexSeparation::was_home(const StarTet& tet, VertexId vertex) const {
  if (tet.old == kInvalidIndex) return false;
  const TetVertices& corners = material_.children().vertices(tet.old);
  return std::find(corners.begin(), corners.end(), vertex) != corners.end();
}

/// The part in whose material the vertex stood keeps it: that on its side of the sheet. Until it takes part in the cut
/// it is told from the other one by that; what snapping takes over from one to the other says nothing.
VertexId VertexSeparation::home_of_corner(VertexId vertex, std::span<const StarTet> part) const {
  unsigned sides = 0;
  for (const StarTet& tet : part) sides |= tet.ends;
  if (!across_.empty() && sides != 0) return (sides & 1U) != 0 ? vertex : VertexId();
  const bool is_home = std::any_of(part.begin(), part.end(), [&](const StarTet& t) { return was_home(t, vertex); });
  return is_home ? vertex : VertexId();
}

/// Notes which copies of an edge's split point are towards which of its ends.
void VertexSeparation::note_halves(ClosedEdge& edge) {
  edge.halves = {};
  for (const StarTet& tet : star_.tets()) {
    for (const unsigned half : {0U, 1U}) {
      if (((unsigned{tet.ends} >> half) & 1U) != 0) edge.halves[half] = state_.mesh.vertices(tet.tet)[tet.corner];
    }
  }
}

/// Notes the boundary sides of the star for the stages that follow, see `surface`: at rest, not at points of the cut
/// inside the body.
void VertexSeparation::note_surface_around(VertexId vertex) {
  bool is_plain = !state_.complex.is_on(vertex) && !star_.is_beside_closed() && state_.done.crumbs_kept == 0 &&
                  !state_.settings.keeps_pieces;
  for (const StarTet& tet : star_.tets()) is_plain &= has_plain_sides(tet);
  if (is_plain) return;
  for (const StarTet& tet : star_.tets()) {
    for (unsigned s = 0; s < 4; ++s) {
      if (s != tet.corner && state_.mesh.links(tet.tet)[s].is_boundary()) memory_.surface.emplace_back(tet.tet, s);
    }
  }
}

/// Whether all boundary sides of a tet around the vertex are new faces of the cut.
bool VertexSeparation::has_plain_sides(const StarTet& tet) const {
  bool is_plain = true;
  for (unsigned s = 0; s < 4; ++s) {
    const Link link = state_.mesh.links(tet.tet)[s];
    if (s != tet.corner && link.is_boundary()) is_plain &= state_.settings.tags.own(link) && tet.is_new;
  }
  return is_plain;
}

}  // namespace v0
}  // namespace incise
