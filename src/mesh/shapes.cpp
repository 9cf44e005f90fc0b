// SPDX-License-Identifier: Apache-2.0
// Each of a cell's six tets is a path along three edges from its lowest corner to its highest; noise is a hash of
// seed, point and axis.
#include "incise/mesh/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {
namespace {

using Cell = std::array<std::uint32_t, 3>;

constexpr std::uint64_t kMaxCells = (std::uint64_t{1} << 28U) / 6;

struct Path {
  std::array<std::uint8_t, 3> axes;  // the order in which a tet walks from the cell's low corner to its high one
  bool is_even;
};

constexpr std::array<Path, 6> kPaths = {{{{0, 1, 2}, true},
                                         {{0, 2, 1}, false},
                                         {{1, 0, 2}, false},
                                         {{1, 2, 0}, true},
                                         {{2, 0, 1}, true},
                                         {{2, 1, 0}, false}}};

bool is_in_range(const Vec3& low, const Vec3& high, const Cell& cells) {
  std::uint64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t n = cells[static_cast<std::size_t>(axis)];
    if (n == 0 || n > kMaxCells || !std::isfinite(high[axis] - low[axis]) || !(low[axis] < high[axis])) return false;
    count *= n;
    if (count > kMaxCells) return false;
  }
  return true;
}

std::uint32_t number_of(const Cell& at, const Cell& cells) {
  return at[0] + (cells[0] + 1) * (at[1] + (cells[1] + 1) * at[2]);
}

// Calls visit(cell) for all cells of a grid, x fastest.
template <class Visit>
void for_each_cell(const Cell& counts, Visit&& visit) {
  Cell at{};
  for (at[2] = 0; at[2] < counts[2]; ++at[2]) {
    for (at[1] = 0; at[1] < counts[1]; ++at[1]) {
      for (at[0] = 0; at[0] < counts[0]; ++at[0]) visit(at);
    }
  }
}

std::array<std::uint32_t, 4> tet_along(const Path& path, Cell at, const Cell& cells) {
  std::array<std::uint32_t, 4> tet{};
  tet[0] = number_of(at, cells);
  for (std::size_t i = 0; i < 3; ++i) {
    ++at[path.axes[i]];
    tet[i + 1] = number_of(at, cells);
  }
  if (!path.is_even) std::swap(tet[1], tet[2]);
  return tet;
}

std::uint64_t mix(std::uint64_t x) {  // splitmix64's finaliser
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

// In [-1, 1).
double noise(std::uint64_t seed, std::size_t point, std::size_t axis) {
  const std::uint64_t bits = mix(mix(seed) ^ (std::uint64_t{point} * 3 + axis));
  return static_cast<double>(bits >> 11U) * 0x1p-52 - 1;
}

std::vector<double> shortest_edges(const TetSoup& soup) {
  std::vector<double> shortest(soup.points.size(), std::numeric_limits<double>::infinity());
  for (const auto& tet : soup.tets) {
    for (const auto& [i, j] : kEdgeCorners) {
      const double length = (soup.points[tet[i]] - soup.points[tet[j]]).norm();
      shortest[tet[i]] = std::min(shortest[tet[i]], length);
      shortest[tet[j]] = std::min(shortest[tet[j]], length);
    }
  }
  return shortest;
}

}  // namespace

TetSoup kuhn_box(const Vec3& low, const Vec3& high, const std::array<std::uint32_t, 3>& cells) {
  TetSoup soup;
  if (!is_in_range(low, high, cells)) return soup;
  for_each_cell({cells[0] + 1, cells[1] + 1, cells[2] + 1}, [&](const Cell& at) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      point[axis] = low[axis] + (high[axis] - low[axis]) * at[a] / cells[a];
    }
    soup.points.push_back(point);
  });
  for_each_cell(cells, [&](const Cell& at) {
    for (const Path& path : kPaths) soup.tets.push_back(tet_along(path, at, cells));
  });
  return soup;
}

TetSoup kuhn_cube(std::uint32_t n) {
  return kuhn_box(Vec3(0, 0, 0), Vec3(1, 1, 1), {n, n, n});
}

void jitter(TetSoup& soup, double fraction, std::uint64_t seed) {
  if (soup.points.empty()) return;
  Vec3 low = soup.points[0];
  Vec3 high = low;
  for (const Vec3& point : soup.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const std::vector<double> shortest = shortest_edges(soup);
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    if (!std::isfinite(shortest[i])) continue;
    for (int axis = 0; axis < 3; ++axis) {
      double& x = soup.points[i][axis];
      if (x > low[axis] && x < high[axis]) x += fraction * shortest[i] * noise(seed, i, static_cast<std::size_t>(axis));
    }
  }
}

}  // namespace v0
}  // namespace incise
