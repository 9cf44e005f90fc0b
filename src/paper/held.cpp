// SPDX-License-Identifier: Apache-2.0
// The front's vertices and the corners of all tets around them, sorted: asked by halving (docs/internals.md, 3.12).
#include "paper/held.h"

#include <algorithm>
#include <utility>

#include "paper/paper_region.h"

namespace incise {
inline namespace v0 {
namespace paper {

Held::Held(const TetMesh& mesh, std::vector<VertexId> front)
    : front_(std::move(front)), vertices_(find_corners_of(mesh, find_tets_at(mesh, front_))) {}

bool Held::is_front(VertexId vertex) const {
  return std::binary_search(front_.begin(), front_.end(), vertex);
}

bool Held::holds(VertexId vertex) const {
  return std::binary_search(vertices_.begin(), vertices_.end(), vertex);
}

namespace {

/// Whether the input touched itself at a corner: the star there is not whole, and neither the paper's conditions nor
/// the link condition see all of it.
bool touches_itself(const TetMesh& mesh, const TetVertices& v) {
  return mesh.touched_itself_at_load() &&
         std::any_of(v.begin(), v.end(), [&](VertexId u) { return (mesh.shape_of(u) & shape::kPinched) != 0; });
}

}  // namespace

bool Held::holds(const TetMesh& mesh, TetId tet) const {
  const TetVertices& v = mesh.vertices(tet);
  if (touches_itself(mesh, v)) return true;
  return !front_.empty() && std::any_of(v.begin(), v.end(), [&](VertexId vertex) {
    return std::binary_search(front_.begin(), front_.end(), vertex);
  });
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
