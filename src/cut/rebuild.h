// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/crumbs.h"
#include "cut/division.h"
#include "cut/material_pieces.h"
#include "cut/old_children.h"
#include "cut/snapping.h"
#include "cut/star_parts.h"
#include "cut/stroke_tags.h"
#include "cut/surface_edges.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// A master falls apart into so many children at most.
inline constexpr std::size_t kMostChildren = 24;

/// What a rebuild did.
struct RebuildStatistics {
  std::uint64_t opened_sides = 0, closed_sides = 0;  ///< of incision faces, made and unmade
  std::uint64_t copied_vertices = 0;
  std::uint64_t crumbs_kept = 0;
  std::uint64_t latent_faces = 0;
  std::uint64_t left_pinched = 0;  ///< incision faces beside edges along which two fans touch, left open since two
                                   ///< pieces meet there: the sheet must be finished, which parts these edges
};

/// Makes the children of masters anew and separates them along the cut.
///
/// The wound may stand open: vertices that stay keep their slots and positions; new ones start where the old children
/// had their place, each on its own side of the cut. Everything else stays as it is: only the masters given change, and
/// the corners of tets around them whose vertex came apart.
/// Paper §2.2 to §2.4. Source of the cone for masters that the blade is still in: docs/internals.md (exact front).
class Rebuild {
 public:
  struct Settings {
    StrokeTags tags = {};  ///< of the incision
    bool keeps_crumbs = true;
    double spacing = 0.0;        ///< the length of a typical edge: crumbs are judged by half of it at least
    double thin = 0.0;           ///< pieces beside an older wall that are thinner than this are crumbs
    bool keeps_pieces = false;   ///< joins no two pieces again, whatever the flags say: for bodies that move
    bool closes_pinched = true;  ///< leaves faces joined where two fans of tets would touch along an edge
  };

  explicit Rebuild(SplitTemplates& templates) : templates_(templates) {}

  /// Rebuilds the dirty masters. Cost: O(dirty masters).
  RebuildStatistics run(Transaction& transaction, ClosedComplex& complex, const OwnSheet& sheet,
                        const Settings& settings);

  /// The incision faces that the last run opened.
  [[nodiscard]] const std::vector<IncisionFace>& opened() const { return incision_; }
  /// The corners that go by another name since the last run, in the order of time.
  struct Renamed {
    VertexId from, to;
  };
  [[nodiscard]] const std::vector<Renamed>& renamed() const { return renamed_; }

 private:
  class Run;

  /// What a master was made of before.
  struct OldRange {
    std::uint32_t first, last;    ///< into `old_`
    std::array<Link, 4> outside;  ///< behind its sides, where there is no master
  };

  SplitTemplates& templates_;
  OldChildren old_;
  StarParts parts_;
  std::vector<IncisionFace> incision_;
  std::vector<IncisionFace> dropped_;  // from here on: memory kept between runs
  std::vector<Renamed> renamed_;
  std::vector<OldRange> ranges_;
  std::vector<TetId> children_;
  std::vector<StarTet> star_;
  std::vector<std::uint32_t> ring_;
  std::vector<Side> surface_, closed_;
  std::vector<std::pair<std::array<VertexId, 3>, Side>> walls_;
  SurfaceEdges edges_;
  CrumbScratch crumbs_;
  MaterialPieces pieces_;
  std::vector<TetId> seeds_;
  Transaction::Sizes sizes_;            // of the last run
  ZeroedArray<std::uint32_t> old_of_;   // by tet slot: the old child that holds the middle of a child
  ZeroedArray<std::uint32_t> visited_;  // by vertex slot: the round that divided its star
  std::uint32_t round_ = 0;
};

}  // namespace v0
}  // namespace incise
