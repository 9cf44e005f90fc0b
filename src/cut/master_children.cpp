// SPDX-License-Identifier: Apache-2.0
// A child is four codes of the template, read as vertices of the master. Its material is that of the old child which
// holds its middle; the mesh's vertices are closed ones here, until `VertexSeparation` writes their copies.
#include "cut/master_children.h"

namespace incise {
inline namespace v0 {

void MasterChildren::make() {
  for (const std::uint32_t index : state_.dirty) make(index);
}

void MasterChildren::make(std::uint32_t index) {
  Master& master = state_.complex[index];
  const SplitTemplate& split = divider_.find(master);
  if (is_divided_so(master, split)) {
    keep(index);
    return;
  }
  master.is_kept = false;
  const OldMaterial::Range& range = material_.range(master);
  memory_.children.clear();
  for (const SplitTemplate::Child& child : split.children) {
    TetVertices v;
    Vec3 middle = Vec3::Zero();
    for (unsigned c = 0; c < 4; ++c) {
      v[c] = vertex_of(master, child[c]);
      middle += 0.25 * state_.mesh.rest(v[c]);
    }
    const std::uint32_t old = material_.children().holding(middle, range.first, range.last);
    const TetId tet = state_.transaction.add_tet(v, material_.children().id(old));
    for (const VertexId vertex : v) state_.transaction.set_tet_of(vertex, tet);
    memory_.children.push_back(tet);
    material_.hand_down(old, tet);
  }
  state_.complex.set_children(index, split, memory_.children);
}

void MasterChildren::keep(std::uint32_t index) {
  Master& master = state_.complex[index];
  master.is_kept = true;
  const OldMaterial::Range& range = material_.range(master);
  for (std::uint32_t old = range.first; old < range.last; ++old) {
    material_.hand_down(old, material_.children().id(old));
  }
}

/// Whether a master's children are those of a template already, down to the vertices.
bool MasterChildren::is_divided_so(const Master& master, const SplitTemplate& split) const {
  if (master.split != &split) return false;
  const ClosedComplex& complex = state_.complex;
  const auto children = complex.children(master);
  for (std::size_t k = 0; k < children.size(); ++k) {
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId vertex = state_.mesh.vertices(children[k])[c];
      if (complex.closed(vertex) != vertex_of(master, split.children[k][c])) return false;
    }
  }
  return true;
}

VertexId MasterChildren::vertex_of(const Master& master, std::uint8_t code) const {
  const ClosedComplex& complex = state_.complex;
  if (code < SplitTemplate::kFirstSplit) return master.vertices[code];
  if (code < SplitTemplate::kFirstPoint) return complex.edges()[master.edges[code - SplitTemplate::kFirstSplit]].split;
  if (code < SplitTemplate::kMiddle) return complex.point(master.points[code - SplitTemplate::kFirstPoint]).vertex;
  return master.middle;
}

void MasterChildren::remove_old() {
  for (const std::uint32_t index : state_.dirty) {
    const Master& master = state_.complex[index];
    if (master.is_kept) continue;
    const OldMaterial::Range& range = material_.range(master);
    for (std::uint32_t k = range.first; k < range.last; ++k) {
      state_.transaction.remove_tet(material_.children().id(k));
    }
  }
}

}  // namespace v0
}  // namespace incise
