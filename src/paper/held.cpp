// SPDX-License-Identifier: Apache-2.0
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

bool Held::holds(const TetMesh& mesh, TetId tet) const {
  const TetVertices& v = mesh.vertices(tet);
  return !front_.empty() && std::any_of(v.begin(), v.end(), [&](VertexId vertex) {
    return std::binary_search(front_.begin(), front_.end(), vertex);
  });
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
