// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/geom/box.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::bench {

/// An axis-aligned tree over all tets of a mesh, as a peer of the walk: what a cutter does that looks its contacts up
/// anew in every step. The tets are sorted along a space-filling curve, eight to a leaf; refitting is one pass over the
/// leaves and one over the inner nodes, both front to back in memory.
class TetBoxTree {
 public:
  explicit TetBoxTree(const TetMesh& mesh);

  /// Makes all boxes those of the tets as they stand now. Cost: O(tets).
  void refit(const TetMesh& mesh);
  /// How many tets meet one of some triangles: their planes, and the prisms above and below them, are tested.
  [[nodiscard]] std::size_t count_hits(const TetMesh& mesh, std::span<const std::array<Vec3, 3>> triangles) const;

 private:
  static constexpr std::size_t kLeafSize = 8;
  [[nodiscard]] std::span<const TetId> leaf(std::size_t index) const;

  std::vector<TetId> tets_;
  std::vector<Box> boxes_;  // a heap: the children of i are 2i + 1 and 2i + 2; leaves come last
  std::size_t first_leaf_ = 0;
};

}  // namespace incise::bench
