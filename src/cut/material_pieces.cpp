// SPDX-License-Identifier: Apache-2.0
// Labels of tets pass to their vertices, and to the tets that take their place; forgetting costs what was labelled.
#include "cut/material_pieces.h"

#include <array>

namespace incise {
inline namespace v0 {

void MaterialPieces::find(const TetMesh& mesh, std::span<const TetId> tets) {
  has_several_ = finder_.find(mesh, tets) > 1;
  has_labels_ = true;
  for (std::size_t i = 0; i < tets.size(); ++i) label(mesh, tets[i], finder_.piece_of(i) + 1);
}

void MaterialPieces::label(const TetMesh& mesh, TetId tet, std::uint32_t piece) {
  of_tet_.set(tet, piece);
  for (const VertexId vertex : mesh.vertices(tet)) of_vertex_.set(vertex, piece);
}

void MaterialPieces::forget() {
  of_tet_.forget();
  of_vertex_.forget();
  has_several_ = has_labels_ = false;
}

void MaterialPieces::follow(TetId tet, TetId other) {
  if (has_labels_) of_tet_.set(tet, of_tet_[other.value]);
}

bool MaterialPieces::hang_together(const TetMesh& mesh, TetId a, TetId b) {
  const std::array<TetId, 2> both = {a, b};
  return finder_.find(mesh, both) == 1;
}

}  // namespace v0
}  // namespace incise
