// SPDX-License-Identifier: Apache-2.0
// The sizes of elements as they were before any cut: means over cubes of a few elements in width, so that a graded mesh
// has its own size everywhere.
#include "improve/original_sizes.h"

#include <algorithm>
#include <cmath>

#include "improve/constants.h"
#include "incise/mesh/edge_length.h"

namespace incise {
inline namespace v0 {

namespace {

/// The level whose cells are wider than an extent, by at most a factor of 2.
int level_of(double extent) {
  int exponent = 0;
  std::frexp(extent, &exponent);
  return exponent;
}

}  // namespace

std::size_t OriginalSizes::CellHash::operator()(const Cell& cell) const {
  std::uint64_t hash = static_cast<std::uint64_t>(cell.level) * 0x9E3779B97F4A7C15U;
  for (const std::int64_t at : cell.at) {
    hash = (hash ^ static_cast<std::uint64_t>(at)) * 0xD6E8FEB86659FD93U;
    hash ^= hash >> 32U;
  }
  return static_cast<std::size_t>(hash);
}

OriginalSizes::Cell OriginalSizes::cell_of(const Vec3& place, int level) {
  const auto at = [&](double coordinate) {
    return static_cast<std::int64_t>(std::floor(std::ldexp(coordinate, -level)));
  };
  return {level, {at(place.x()), at(place.y()), at(place.z())}};
}

void OriginalSizes::measure(const TetMesh& mesh) {
  means_.clear();
  levels_.clear();
  mesh.for_each_vertex([&](VertexId v) {
    const TetId tet = mesh.tet_of(v);
    if (!tet.is_valid()) return;
    const double edge = mean_edge_length_by_tets(mesh, v, {&tet, 1});
    const int finest = std::max(level_of(kSizeCell * edge), level_of(mesh.rest(v).cwiseAbs().maxCoeff()) - kMostBits);
    for (int level = finest; level < finest + kSizeLevels; ++level) {
      Mean& mean = means_[cell_of(mesh.rest(v), level)];
      mean.sum += edge;
      mean.count += 1;
      if (std::find(levels_.begin(), levels_.end(), level) == levels_.end()) levels_.push_back(level);
    }
  });
  std::sort(levels_.begin(), levels_.end());
}

double OriginalSizes::at(const Vec3& place) const {
  for (const int level : levels_) {
    const auto mean = means_.find(cell_of(place, level));
    if (mean != means_.end()) return mean->second.sum / mean->second.count;
  }
  return levels_.empty() ? 0.0 : beside(cell_of(place, levels_.back()));
}

/// Of the cells beside one: rounding takes vertices of the skin across the faces of cells.
double OriginalSizes::beside(const Cell& cell) const {
  Mean sum;
  for (std::int64_t x = -1; x <= 1; ++x) {
    for (std::int64_t y = -1; y <= 1; ++y) {
      for (std::int64_t z = -1; z <= 1; ++z) {
        const auto mean = means_.find({cell.level, {cell.at[0] + x, cell.at[1] + y, cell.at[2] + z}});
        if (mean == means_.end()) continue;
        sum.sum += mean->second.sum;
        sum.count += mean->second.count;
      }
    }
  }
  return sum.count > 0 ? sum.sum / sum.count : 0.0;
}

}  // namespace v0
}  // namespace incise
