// SPDX-License-Identifier: Apache-2.0
// Vertices without tets take up no room: they are slots that files left unused.
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {

Box rest_bounds(const TetMesh& mesh) {
  Box box;
  mesh.for_each_vertex([&](VertexId v) {
    if (mesh.tet_of(v).is_valid()) box.extend(mesh.rest(v));
  });
  return box;
}

Box current_bounds(const TetMesh& mesh) {
  Box box;
  mesh.for_each_vertex([&](VertexId v) {
    if (mesh.tet_of(v).is_valid()) box.extend(mesh.current(v));
  });
  return box;
}

}  // namespace v0
}  // namespace incise
