// SPDX-License-Identifier: Apache-2.0
// A box for each piece, from one pass over the tets; pieces whose middle is far from the largest one's are not shown.
#include "app/view/piece_bounds.h"

#include <algorithm>
#include <vector>

namespace incise {
inline namespace v0 {
namespace app {

Box bounds_of_main_pieces(const TetMesh& mesh, const Components& pieces) {
  std::vector<Box> boxes(pieces.count());
  mesh.for_each_tet([&](TetId tet) {
    Box& box = boxes[pieces.label[tet.value]];
    for (const VertexId vertex : mesh.vertices(tet)) box.extend(mesh.current(vertex));
  });
  if (boxes.empty()) return {};
  const auto largest = std::max_element(pieces.volume.begin(), pieces.volume.end()) - pieces.volume.begin();
  const Box main = boxes[static_cast<std::size_t>(largest)];
  const Vec3 middle = 0.5 * (main.lo + main.hi);
  const double size = (main.hi - main.lo).norm();
  Box all = main;
  for (const Box& box : boxes) {
    if (box.is_empty() || (0.5 * (box.lo + box.hi) - middle).norm() > size) continue;
    all.extend(box.lo);
    all.extend(box.hi);
  }
  return all;
}

Box main_part(const Box& drawn, const TetMesh& mesh, const Components& pieces) {
  const Box main = bounds_of_main_pieces(mesh, pieces);
  const Box both{drawn.lo.cwiseMax(main.lo), drawn.hi.cwiseMin(main.hi)};
  return both.is_empty() ? drawn : both;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
