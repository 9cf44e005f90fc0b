// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Tells which tets hang together through faces.
///
/// Nothing is kept between calls: pieces are what the mesh says they are, after any edit, undo and file. So no step of
/// a stroke needs to trust a label to know that it would join what has come apart.
class PieceFinder {
 public:
  /// Numbers the pieces of the mesh that some live tets belong to, in the order in which they come first. `seeds` may
  /// repeat. Returns how many there are; `piece_of` tells of which a seed is. Floods from all seeds at once and stops
  /// when they have met. Cost: where they hang together, the tets nearer to the seeds than their way around the cut;
  /// else up to the size of all these pieces but the largest, times two.
  std::uint32_t find(const TetMesh& mesh, std::span<const TetId> seeds);
  /// The piece of the i-th seed.
  [[nodiscard]] std::uint32_t piece_of(std::size_t i) const { return pieces_[i]; }

 private:
  /// A set of tets that are known to hang together.
  struct Flood {
    std::uint32_t parent;  ///< the flood that it has met, or itself
    std::vector<TetId> queue;
    std::size_t next = 0;  ///< into the queue
  };
  std::uint32_t root(std::uint32_t flood);
  std::uint32_t start(TetId seed);
  void advance(const TetMesh& mesh, std::uint32_t flood);
  void unite(std::uint32_t a, std::uint32_t b);
  void forget();

  std::vector<Flood> floods_;
  std::uint32_t flood_count_ = 0;    // of those in use
  std::vector<std::uint32_t> open_;  // roots that have more to look at
  std::vector<std::uint32_t> pieces_;
  std::vector<std::uint32_t> seen_as_;  // by flood: its piece
  std::vector<TetId> touched_;
  ZeroedArray<std::uint32_t> flood_of_;  // by tet slot: 1 + flood; all zero between calls
};

}  // namespace v0
}  // namespace incise
