// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "incise/core/profile.h"
#include "incise/improve/options.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

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

/// Maintains a mesh stroke by stroke. The paper maintains "after a complete incision": tets around the front of one
/// that may go on are left for later, and what was divided there waits with them. Merging comes before smoothing: what
/// it has been asked of once, it is not asked of again, or it would take what smoothing beside a front has made thin.
class PaperMaintainer {
 public:
  /// The steps of the journal from `first_step` on wait to be maintained.
  void take_up(std::size_t first_step);
  /// Whether steps wait.
  [[nodiscard]] bool has_work() const { return first_step_ != kNothing; }
  /// Whether vertices wait that an incision's front has held.
  [[nodiscard]] bool has_held() const { return !waiting_.empty(); }
  /// The first step that waits; the greatest number where none does: the journal must keep it.
  [[nodiscard]] std::size_t first_step() const { return first_step_; }
  /// As `maintain_as_paper`, for the steps that wait and for what fronts held earlier; `front`: vertices where an
  /// incision may go on, ascending: tets that have one stay as they are.
  MaintainStatistics run(TetMesh& mesh, Journal& journal, const std::vector<VertexId>& front,
                         const MaintainOptions& options, StageTimes& times);
  /// Nothing waits any more.
  void forget();

 private:
  static constexpr std::size_t kNothing = static_cast<std::size_t>(-1);
  std::size_t first_step_ = kNothing;
  std::vector<std::pair<VertexId, std::uint32_t>> waiting_;   // with their generations
  std::vector<std::pair<VertexId, std::uint32_t>> unmerged_;  // of them those whose tets merging has not been asked of
};

}  // namespace v0
}  // namespace incise
