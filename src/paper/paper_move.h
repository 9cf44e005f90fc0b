// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"
#include "paper/constants.h"
#include "paper/paper_quality.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// Moves a vertex to `target`, or as far on the way there as no tet around it turns over, at rest or as the body
/// stands, and the worst of them is not bad-shaped (`kBadShape`) or no worse than the worst before. Returns whether it
/// moved.
///
/// Keeping a boundary vertex on its surface is up to the caller. Cost: O(star), about 1 µs.
/// **Source:** the paper has no such rule in its section 3.4; without it the mesh would not stay valid.
bool move_towards(Transaction& transaction, VertexId vertex, const Vec3& target, QualityMeter& meter,
                  StarWalker& walker);

}  // namespace paper
}  // namespace v0
}  // namespace incise
