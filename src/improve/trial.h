// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "improve/care.h"
#include "improve/close_merge.h"
#include "improve/edge_removal.h"
#include "improve/smooth.h"
#include "incise/mesh/verbs.h"

namespace incise {
inline namespace v0 {

/// Mends bad tets that no single operation makes better: what a first change makes is worse, or takes volume, and the
/// end is better. Where a trial says no **the mesh is left changed, and the caller rolls the transaction back**. Keeps
/// scratch memory.
///
/// **Source:** Klingner & Shewchuk 2007, §3.3 and §4 (insertion, then smoothing and topological passes around it, taken
/// back unless the worst tet is better). Differs: vertices go into edges, so that creases, rims and fronts can be
/// refined without leaving their place; and vertices are merged as well.
class Trial {
 public:
  /// Splits an edge of a bad tet (0 to 5, as in `kEdgeCorners`), lets swaps and smoothing mend what that makes, and
  /// splits the worst of it once more where they end, up to `kSplits` times for tets worse than `kTriedHard`, else
  /// `kFewSplits`. Returns whether all that was touched is better then than the tet was by `kLeastTrialGain`;
  /// `care.changed` holds what was made or reshaped. Cost: about 1 ms, at most 3 ms and one operation.
  bool split(Care& care, TetId tet, unsigned edge);
  /// Merges the first end of an edge into the second one (`is_turned`: the second into the first) where the tet is
  /// worse than `kTriedHard` and `CloseMerger::merge_loosely` lets it, gives the body its volume back by moving
  /// vertices of the surfaces around (`return_volume`), and mends what that makes. Returns, and costs, as `split`.
  bool merge(Care& care, TetId tet, unsigned edge, bool is_turned);

  /// The vertices that the last trial put in.
  [[nodiscard]] const std::vector<VertexId>& born() const { return born_; }

 private:
  struct Waiting {
    double ratio;
    TetId tet;
    bool operator<(const Waiting& o) const { return ratio != o.ratio ? ratio > o.ratio : o.tet.value < tet.value; }
  };

  void begin(const Care& care);
  bool split_edge(Care& care, TetId tet, unsigned edge);
  [[nodiscard]] bool is_at_front(const TetMesh& mesh, const std::array<VertexId, 2>& ends, TetId tet);
  void mend(Care& care);
  bool mend_one(Care& care, TetId tet);
  void take_changed(const Care& care);
  Waiting find_worst(const TetMesh& mesh);

  CloseMerger merger_;
  EdgeRemover remover_;
  FaceRemover face_remover_;
  Smoother smoother_;
  EdgeRing ring_;
  std::vector<Waiting> heap_;
  std::vector<TetId> touched_;
  std::vector<VertexId> born_;
  std::uint64_t last_unit_ = 0;  // of work, in this trial
};

}  // namespace v0
}  // namespace incise
