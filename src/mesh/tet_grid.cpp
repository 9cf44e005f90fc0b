// SPDX-License-Identifier: Apache-2.0
// A grid with the tets of each cell as a list; each tet's box is remembered, so that it is found again when it goes.
#include "mesh/tet_grid.h"

#include <algorithm>
#include <cmath>

#include "incise/mesh/bounds.h"
#include "incise/mesh/edge_length.h"
#include "mesh/constants.h"

namespace incise {
inline namespace v0 {
TetGrid::TetGrid(const TetMesh& mesh) : cell_(mean_edge_length(mesh)) {
  const Box bounds = rest_bounds(mesh);
  low_ = bounds.lo;
  const Vec3 size = bounds.hi - bounds.lo;
  const double most = kMostCellsPerTet * static_cast<double>(mesh.tet_count()) + 1;
  const auto cells = [&] {
    double count = 1;
    for (int k = 0; k < 3; ++k) count *= std::floor(size[k] / cell_) + 1;
    return count;
  };
  while (cells() > most) cell_ *= 2;
  std::size_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    counts_[k] = static_cast<std::int32_t>(size[static_cast<int>(k)] / cell_) + 1;
    count *= static_cast<std::size_t>(counts_[k]);
  }
  cells_.resize(count);
  mesh.for_each_tet([&](TetId tet) { update(mesh, tet); });
}

TetGrid::Cell TetGrid::cell_at(const Vec3& point) const {
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = (point[static_cast<int>(k)] - low_[static_cast<int>(k)]) / cell_;
    cell[k] = at > 0 ? static_cast<std::int32_t>(std::min(at, counts_[k] - 1.0)) : 0;
  }
  return cell;
}

template <class Visit>
void TetGrid::for_each_cell(const Box& box, const Visit& visit) const {
  const Cell lo = cell_at(box.lo), hi = cell_at(box.hi);
  for (std::int32_t z = lo[2]; z <= hi[2]; ++z) {
    for (std::int32_t y = lo[1]; y <= hi[1]; ++y) {
      for (std::int32_t x = lo[0]; x <= hi[0]; ++x) {
        visit(static_cast<std::size_t>(x) +
              static_cast<std::size_t>(counts_[0]) *
                  (static_cast<std::size_t>(y) + static_cast<std::size_t>(counts_[1]) * static_cast<std::size_t>(z)));
      }
    }
  }
}

void TetGrid::update(const TetMesh& mesh, TetId tet) {
  if (tet.value >= boxes_.size()) boxes_.resize(std::size_t{tet.value} + 1);
  Box& box = boxes_[tet.value];
  if (!box.is_empty()) {
    for_each_cell(box, [&](std::size_t cell) {
      auto& list = cells_[cell];
      list.erase(std::find(list.begin(), list.end(), tet.value));
    });
  }
  box = Box();
  if (!mesh.is_live(tet)) return;
  for (const VertexId v : mesh.vertices(tet)) box.extend(mesh.rest(v));
  for_each_cell(box, [&](std::size_t cell) { cells_[cell].push_back(tet.value); });
}

void TetGrid::collect(const Box& box, std::vector<TetId>& tets) const {
  tets.clear();
  marks_.resize(boxes_.size(), 0);
  ++query_;
  for_each_cell(box, [&](std::size_t cell) {
    for (const std::uint32_t tet : cells_[cell]) {
      if (marks_[tet] == query_ || !boxes_[tet].overlaps(box)) continue;
      marks_[tet] = query_;
      tets.emplace_back(tet);
    }
  });
  std::sort(tets.begin(), tets.end());
}

}  // namespace v0
}  // namespace incise
