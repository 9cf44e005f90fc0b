// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/core/profile.h"
#include "incise/improve/options.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Maintains a mesh as the paper does, to the letter where it is unambiguous: the baseline.
///
/// Edge merging (§2.5, Figure 6), then, after the complete incision, Boundary Laplacian (§3.4, equations 2 to 4 and the
/// least-squares plane), Smart Laplacian (§3.2, Algorithm 3) and Face Swapping (§3.3, 2-3 and 3-2). It works on what
/// the journal's steps from `first_step` on changed ("each divided vertex") and appends steps of its own.
/// `docs/paper_map.md` lists the readings. Cost: O(changed tets), about 1 µs per evaluation of a tet's quality. Cannot
/// fail: what would invert a tet is not done. Bodies that touched themselves at load are left as they are. Along curved
/// surfaces the volume drifts, by 1e-5 to 1e-3 of the body's per stroke on the paper's models.
MaintainStatistics maintain_as_paper(TetMesh& mesh, Journal& journal, std::size_t first_step,
                                     const MaintainOptions& options, StageTimes& times);

/// The same for the whole mesh, as if every vertex had been divided. Cost: O(tets).
MaintainStatistics maintain_all_as_paper(TetMesh& mesh, Journal& journal, const MaintainOptions& options,
                                         StageTimes& times);

}  // namespace v0
}  // namespace incise
