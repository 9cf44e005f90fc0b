// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cut/dividable.h"
#include "cut/neighbourhood.h"
#include "cut/subdivide.h"
#include "cut/sweep.h"
#include "incise/core/profile.h"
#include "incise/cut/options.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Cuts along a sheet as the paper does, after the fact: its sections 2.2 to 2.4.
///
/// Every edge that the sheet crosses is bisected, faces of three collision points are opened where Algorithms 1 and 2
/// find their vertices dividable; where the sheet ends inside an element nothing comes apart (§4.5).
class PaperCut {
 public:
  /// `threads` search the mesh; the result does not depend on it.
  explicit PaperCut(unsigned threads) : threads_(threads) {}

  /// Appends up to two journal steps: the cut, and the repair of edges that two fans of tets share. Adds to
  /// `statistics`. Errors: kOutOfMemory where ids would run out. Cost: one pass over the mesh, then O(cut tets ·
  /// rounds).
  Status cut(TetMesh& mesh, Journal& journal, const Sheet& sheet, std::uint32_t tag, CutStatistics& statistics,
             StageTimes& times);

 private:
  void find_contact(Transaction& transaction, const Sheet& sheet, StageTimes& times);
  void collide(Transaction& transaction, const Sheet& sheet);
  void bisect(Transaction& transaction, const CutEdge& edge, double t);
  Subdivision divide(Transaction& transaction, CutStatistics& statistics, StageTimes& times);
  void separate(Transaction& transaction, const Subdivision& subdivision, std::uint32_t tag, CutStatistics& statistics,
                StageTimes& times);
  void part_edges(TetMesh& mesh, Journal& journal, const Subdivision& subdivision, CutStatistics& statistics,
                  StageTimes& times);

  unsigned threads_;
  Neighbourhood near_;
  SplitTemplates templates_;
  StarWalker walker_;
};

}  // namespace v0
}  // namespace incise
