// SPDX-License-Identifier: Apache-2.0
#include "cut/spacing.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

double typical_spacing(const TetMesh& mesh) {
  double sum = 0;
  std::size_t count = 0;
  const std::uint32_t stride = std::max(1U, mesh.tet_slots() / 64U);
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); slot += stride) {
    if (!mesh.is_live(TetId(slot))) continue;
    const TetVertices& v = mesh.vertices(TetId(slot));
    for (const auto& [a, b] : kEdgeCorners) {
      sum += (mesh.rest(v[a]) - mesh.rest(v[b])).norm();
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace v0
}  // namespace incise
