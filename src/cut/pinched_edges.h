// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/incision_face.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// A repair that the paper lacks: where two fans of tets touch along a whole edge of opened faces, each fan gets a
/// midpoint of its own. Takes a transaction of its own, since its new vertices lie between copies. Returns how many
/// edges were parted. Cost: O(opened faces).
std::uint64_t part_pinched_edges(Transaction& transaction, const std::vector<IncisionFace>& incision,
                                 StarWalker& walker);

}  // namespace v0
}  // namespace incise
