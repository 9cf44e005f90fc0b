// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// A repair that the paper lacks: where two fans of tets touch along a whole edge of some walls, each fan gets a
/// midpoint of its own. Sides that are gone, or no walls, are passed over. Takes a transaction of its own, since its
/// new vertices lie between copies. Returns how many edges were parted. Cost: O(walls).
std::uint64_t part_pinched_edges(Transaction& transaction, std::span<const Side> walls, StarWalker& walker);

/// Whether there are such edges. Cost: O(walls).
[[nodiscard]] bool has_pinched_edges(const TetMesh& mesh, std::span<const Side> walls, StarWalker& walker);

}  // namespace v0
}  // namespace incise
