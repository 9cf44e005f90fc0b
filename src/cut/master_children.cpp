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
  find_vertices(master, split);
  if (is_divided_so(master, split)) {
    keep(index);
    return;
  }
  master.is_kept = false;
  const OldMaterial::Range& range = material_.range(master);
  const auto& vertices = memory_.vertices;
  std::array<Vec3, SplitTemplate::kCodes> quarters;
  for (std::uint8_t code = 0; code < SplitTemplate::kCodes; ++code) {
    if (vertices[code].is_valid()) quarters[code] = 0.25 * state_.mesh.rest(vertices[code]);
  }
  memory_.children.clear();
  for (const SplitTemplate::Child& child : split.children) {
    const TetVertices v = {vertices[child[0]], vertices[child[1]], vertices[child[2]], vertices[child[3]]};
    const Vec3 middle = quarters[child[0]] + quarters[child[1]] + quarters[child[2]] + quarters[child[3]];
    const std::uint32_t old = material_.children().holding(middle, range.first, range.last);
    const TetId tet = state_.transaction.add_tet(v, material_.children().id(old));
    memory_.children.push_back(tet);
    material_.hand_down(old, tet);
  }
  for (std::uint8_t code = 0; code < SplitTemplate::kCodes; ++code) {
    const auto around = split.around(code);
    if (!around.empty()) state_.transaction.set_tet_of(vertices[code], memory_.children[around.back() / 4U]);
  }
  state_.complex.set_children(index, split, memory_.children);
}

/// The vertices of the master that its template names.
void MasterChildren::find_vertices(const Master& master, const SplitTemplate& split) {
  for (std::uint8_t code = 0; code < SplitTemplate::kCodes; ++code) {
    memory_.vertices[code] = split.around(code).empty() ? VertexId() : vertex_of(master, code);
  }
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
      if (complex.closed(vertex) != memory_.vertices[split.children[k][c]]) return false;
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
