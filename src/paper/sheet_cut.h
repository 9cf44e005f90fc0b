// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cut/crumbs.h"
#include "cut/cut_context.h"
#include "cut/split_template.h"
#include "incise/core/result.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"
#include "paper/incision_front.h"
#include "paper/neighbourhood.h"
#include "paper/sheet_so_far.h"
#include "paper/subdivide.h"

namespace incise {
inline namespace v0 {

/// Whether what a cut closes in, and is far smaller than an element, comes off, or stays attached.
enum class Crumbs : std::uint8_t { kComeOff, kStay };

/// Cuts along one sheet, or along what one frame adds to it, as the paper does: sections 2.2 to 2.4. Keeps scratch
/// memory.
class SheetCut {
 public:
  /// `threads` in [1, 256] search the mesh; the result does not depend on it.
  explicit SheetCut(unsigned threads) : threads_(threads) {}

  /// Bisects the edges that the sheet crosses, and runs Algorithms 1 and 2 on the incision faces between the collision
  /// points of this sheet and those of `front`, which is brought up to date. Walls get `tag`. Appends up to two journal
  /// steps: the cut, and the repair of edges that two fans of tets share. Errors: kOutOfMemory where ids would run out;
  /// the mesh is then as before. Cost: one pass over the mesh, then O(cut tets · rounds).
  Status cut(const CutContext& context, const SheetSoFar& sheet, std::uint32_t tag, IncisionFront& front,
             Crumbs crumbs = Crumbs::kComeOff);
  /// The tets that the last cut divided, crossed wholly or in part.
  [[nodiscard]] std::uint64_t divided_tets() const { return divided_tets_; }
  /// The incision faces that the last cut left joined: a later frame may open them.
  [[nodiscard]] std::uint64_t latent_faces() const { return latent_faces_; }

 private:
  std::size_t find_contact(Transaction& transaction, const SheetSoFar& sheet, std::uint32_t tag, IncisionFront& front,
                           StageTimes& times);
  std::vector<TetId> tets_near(const TetMesh& mesh, const Sheet& sheet, const std::vector<VertexId>& vertices);
  void collide(Transaction& transaction, const SheetSoFar& sheet, std::uint32_t tag, IncisionFront& front);
  void bisect(Transaction& transaction, const CutEdge& edge, double t);
  Subdivision divide(Transaction& transaction, const IncisionFront& front, CutStatistics& statistics,
                     StageTimes& times);
  void separate(Transaction& transaction, const Subdivision& subdivision, std::uint32_t tag, CutStatistics& statistics,
                StageTimes& times);
  void part_edges(const CutContext& context, const SheetSoFar& sheet, const Subdivision& subdivision,
                  IncisionFront& front);

  unsigned threads_;
  std::uint64_t latent_faces_ = 0, divided_tets_ = 0;
  Neighbourhood near_;
  SplitTemplates templates_;
  StarWalker walker_;
  CrumbScratch crumbs_;
};

}  // namespace v0
}  // namespace incise
