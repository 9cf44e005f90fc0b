// SPDX-License-Identifier: Apache-2.0
// A split point stays as long as its edge is split: with its slot, and where the body has it. So does a front point
// while the border passes through its face; at rest it is moved there, in a body that moves it is another vertex once
// its rest place has changed. New ones start where the old children had their place.
#include "cut/master_vertices.h"

namespace incise {
inline namespace v0 {

void MasterVertices::make() {
  ClosedComplex& complex = state_.complex;
  for (const std::uint32_t index : state_.dirty) {
    Master& master = complex[index];
    for (unsigned e = 0; e < 6; ++e) update_split_point(index, e);
    for (const std::uint32_t point : master.points) {
      if (point != Master::kNone) update_front_point(complex.point(point));
    }
    if (divider_.has_middle(master)) {
      update_middle(index);
    } else if (master.middle.is_valid()) {
      complex.retire(master.middle);
      master.middle = {};
    }
  }
}

void MasterVertices::update_split_point(std::uint32_t index, unsigned e) {
  ClosedComplex& complex = state_.complex;
  ClosedEdge& edge = complex.edges()[complex[index].edges[e]];
  if (!needs_split(complex[index], e)) {
    if (edge.split.is_valid()) {
      complex.retire(edge.split);
      edge.split = {};
      edge.halves = {};
    }
    return;
  }
  if (edge.split.is_valid()) return;
  const bool is_whole = !complex.has_copies(edge.a) && !complex.has_copies(edge.b);
  edge.split = is_whole ? state_.transaction.add_vertex_on_edge(edge.a, edge.b, edge.t)
                        : add_vertex_at(state_.transaction, edge.position, place_of(edge.position, {index, index}));
  const unsigned at_front = state_.mesh.shape_of(edge.a) & state_.mesh.shape_of(edge.b) & shape::kFront;
  if (at_front != 0) state_.transaction.set_shape(edge.split, shape::kFront);
}

void MasterVertices::update_front_point(FrontPoint& point) {
  point.vertex = taken_to(point.position, point.vertex, point.masters);
}

void MasterVertices::update_middle(std::uint32_t index) {
  Master& master = state_.complex[index];
  master.middle = taken_to(divider_.middle_of(master), master.middle, {index, index});
}

/// A front point of `masters` at a place: `vertex`, moved there, or a new one. At rest a point goes along with the
/// border of the sheet while that passes through the same faces, and so the tets around it stay: only their shapes
/// change. In a body that moves it is another vertex, since it has another place there as well.
VertexId MasterVertices::taken_to(const Vec3& place, VertexId vertex, const std::array<std::uint32_t, 2>& masters) {
  if (vertex.is_valid() && state_.mesh.rest(vertex) == place) return vertex;
  if (vertex.is_valid() && !state_.settings.keeps_pieces && !state_.complex.has_copies(vertex)) {
    const std::uint32_t holder = holder_of(place, masters);
    if (holder != kInvalidIndex) {
      // Others may have moved before: where its tet stands now is what a follower knows.
      const MaterialPlace now = place_in(state_.mesh, material_.children().id(holder), place);
      if (now.inside > -1.0) {
        state_.transaction.move(vertex, place, now.basis, now.weights);
        return vertex;
      }
    }
  }
  if (vertex.is_valid()) state_.complex.retire(vertex);
  return add_vertex_at(state_.transaction, place, place_of(place, masters));
}

/// The old child of a master that holds a rest point.
std::uint32_t MasterVertices::holder_of(const Vec3& rest, const std::array<std::uint32_t, 2>& masters) const {
  for (const std::uint32_t index : masters) {
    if (index == Master::kNone || !state_.complex[index].is_dirty) continue;
    const OldMaterial::Range& range = material_.range(state_.complex[index]);
    return material_.children().holding(rest, range.first, range.last);
  }
  return kInvalidIndex;
}

/// Where a rest point stood in the old children of one or the other master.
MaterialPlace MasterVertices::place_of(const Vec3& rest, const std::array<std::uint32_t, 2>& masters) const {
  const OldChildren& old = material_.children();
  MaterialPlace best;
  for (const std::uint32_t index : masters) {
    if (index == Master::kNone || !state_.complex[index].is_dirty) continue;
    const OldMaterial::Range& range = material_.range(state_.complex[index]);
    const MaterialPlace place = old.place_in(old.holding(rest, range.first, range.last), rest);
    if (place.inside > best.inside) best = place;
  }
  return best;
}

void MasterVertices::bury_retired() {
  ClosedComplex& complex = state_.complex;
  for (const VertexId vertex : complex.retired()) {
    if (complex.has_copies(vertex)) {
      for (const VertexId copy : complex.copies_of(vertex)) state_.transaction.remove_vertex(copy);
      complex.drop_copies(vertex);
    }
    state_.transaction.remove_vertex(vertex);
  }
  complex.retired().clear();
}

}  // namespace v0
}  // namespace incise
