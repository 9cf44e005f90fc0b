// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/improve/options.h"
#include "incise/mesh/transaction.h"
#include "paper/held.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// Smart Laplacian Smoothing: moves each vertex to the mean of its neighbours where the average quality of the tets
/// around it gets better by that. The average decides alone, as printed: single tets may get worse.
///
/// Vertices on a boundary or a border between regions stay. One pass, in the order given.
/// Cost: O(their stars). **Source:** Paper §3.2, equation 1 and Algorithm 3.
MaintainStatistics smooth_inside(Transaction& transaction, const std::vector<VertexId>& vertices,
                                 const Held& held = {});

}  // namespace paper
}  // namespace v0
}  // namespace incise
