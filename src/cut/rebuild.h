// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/crumb_keeper.h"
#include "cut/face_opening.h"
#include "cut/incision_faces.h"
#include "cut/incision_table.h"
#include "cut/master_children.h"
#include "cut/old_material.h"
#include "cut/pinched_faces.h"
#include "cut/rebuild_state.h"
#include "cut/strip.h"
#include "cut/vertex_separation.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// Makes the children of masters anew and separates them along the cut.
///
/// The wound may stand open: vertices that stay keep their slots and positions; new ones start where the old children
/// had their place, each on its own side of the cut. Everything else stays as it is: only the masters given change, and
/// the corners of tets around them whose vertex came apart.
/// Paper §2.2 to §2.4. Source of the cone for masters that the blade is still in: docs/internals.md (exact front).
class Rebuild {
 public:
  using Settings = RebuildSettings;
  /// A corner that goes by another name now.
  using Renamed = VertexSeparation::Renamed;

  explicit Rebuild(SplitTemplates& templates) : templates_(templates) {}

  /// Rebuilds the dirty masters. Cost: O(dirty masters).
  RebuildStatistics run(Transaction& transaction, ClosedComplex& complex, const OwnSheet& sheet,
                        const Settings& settings);

  /// The incision faces that the last run opened.
  [[nodiscard]] const std::vector<IncisionFace>& opened() const { return memory_.faces.faces; }
  /// Boundary sides beside edges along which two fans of tets touch since the last run, which it could not close: the
  /// fans may be of tets that it left as they are.
  [[nodiscard]] const std::vector<Side>& left_pinched() const { return memory_.pinched.sides; }
  /// The corners that go by another name since the last run, in the order of time.
  [[nodiscard]] const std::vector<Renamed>& renamed() const { return memory_.stars.renamed; }

 private:
  class Run;

  /// What the stages keep from run to run.
  struct Memory {
    OldMaterial::Memory material;
    IncisionFaces::Memory faces;
    IncisionTable table;
    MasterChildren::Memory children;
    CrumbKeeper::Memory crumbs;
    VertexSeparation::Memory stars;
    PinchedFaces::Memory pinched;
    FaceOpening::Memory opening;
  };

  SplitTemplates& templates_;
  Memory memory_;
};

}  // namespace v0
}  // namespace incise
