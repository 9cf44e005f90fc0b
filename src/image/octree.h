// SPDX-License-Identifier: Apache-2.0
// An octree whose neighbouring leaves differ by one level at most, and the tets of the graded body-centred cubic
// lattice on it. Source: F. Labelle, J. Shewchuk, "Isosurface stuffing", 2007 (the background grid).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace image {

using Cell = std::array<std::int32_t, 3>;  ///< lowest corner, in edges of the finest leaves that may be

/// Points and tets; all positive.
struct LatticeTets {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 4>> tets;
};

class Octree {
 public:
  /// `roots` cubes of edge `edge` from `low` on; leaves may be halved `depth` times.
  Octree(const Vec3& low, double edge, std::array<std::int32_t, 3> roots, int depth);

  [[nodiscard]] std::size_t nodes() const { return at_.size(); }
  [[nodiscard]] bool is_leaf(std::size_t node) const { return child_[node] == 0; }
  [[nodiscard]] int level(std::size_t node) const { return level_[node]; }
  [[nodiscard]] double edge(std::size_t node) const { return unit_ * static_cast<double>(span(level_[node])); }
  [[nodiscard]] Vec3 low(std::size_t node) const;
  [[nodiscard]] Vec3 middle(std::size_t node) const { return low(node) + Vec3::Constant(0.5 * edge(node)); }

  /// Halves a leaf of less than the full depth: its children are the last eight nodes.
  void split(std::size_t leaf);
  /// Splits leaves until those that share a face, an edge or a corner differ by one level at most.
  void balance();
  /// The tets between leaves; none between two for which `is_void` holds. Nothing lies at the outermost faces.
  [[nodiscard]] LatticeTets fill(const std::function<bool(std::size_t)>& is_void) const;

 private:
  friend class LatticeFiller;
  [[nodiscard]] std::int32_t span(int level) const { return std::int32_t{1} << static_cast<unsigned>(depth_ - level); }
  /// The node around a cell, of at most this level; `nodes()` outside.
  [[nodiscard]] std::size_t find(const Cell& cell, int level) const;

  Vec3 low_;
  double unit_;  // edge of the finest leaves
  std::array<std::int32_t, 3> roots_;
  int depth_;
  std::vector<std::uint32_t> child_;  // the first of eight, 0: leaf
  std::vector<Cell> at_;
  std::vector<std::int8_t> level_;
};

}  // namespace image
}  // namespace v0
}  // namespace incise
