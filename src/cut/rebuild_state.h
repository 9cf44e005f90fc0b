// SPDX-License-Identifier: Apache-2.0
// What the stages of a rebuild have in common: what it is asked to do, on what, and the counts of what it did. All that
// is passed on from one stage to another besides stands in `OldMaterial` and `IncisionFaces`.
#pragma once

#include <cstdint>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/crumbs.h"
#include "cut/stroke_tags.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// How masters are rebuilt.
struct RebuildSettings {
  StrokeTags tags = {};              ///< of the incision
  double crumb_share = kCrumbShare;  ///< of the cubed edge length: smaller pieces are crumbs; 0: none is
  double spacing = 0.0;              ///< the length of a typical edge: crumbs are judged by half of it at least
  double thin = 0.0;                 ///< pieces between walls that are thinner than this are crumbs
  bool keeps_pieces = false;         ///< joins no two pieces again, whatever the flags say: for bodies that move
  bool closes_pinched = true;        ///< leaves faces joined where two fans of tets would touch along an edge
};

/// What a rebuild did.
struct RebuildStatistics {
  std::uint64_t own_sides_before = 0, own_sides_after = 0;  ///< of the incision's walls, on what was rebuilt
  std::uint64_t copied_vertices = 0;
  std::uint64_t crumbs_kept = 0;
  std::uint64_t latent_faces = 0;
  std::uint64_t left_pinched = 0;  ///< incision faces beside edges along which two fans touch, left open since two
                                   ///< pieces meet there: the sheet must be finished, which parts these edges
};

/// One rebuild, as all of its stages see it. Lives as long as the rebuild runs.
struct RebuildState {
  RebuildState(Transaction& edits, ClosedComplex& closed, const RebuildSettings& asked)
      : transaction(edits), mesh(edits.mesh()), complex(closed), dirty(closed.dirty()), settings(asked) {}

  /// The sides of the incision's walls on the children of a master. Cost: O(its children).
  [[nodiscard]] std::uint64_t own_sides(const Master& master) const {
    std::uint64_t sides = 0;
    for (const TetId child : complex.children(master)) {
      for (const Link link : mesh.links(child)) sides += settings.tags.own(link) ? 1U : 0U;
    }
    return sides;
  }

  Transaction& transaction;  ///< every change of the mesh goes through it
  const TetMesh& mesh;       ///< as it stands after the changes so far
  ClosedComplex& complex;
  std::vector<std::uint32_t>& dirty;  ///< the masters to be rebuilt; a master's `entry` is its place in here
  const RebuildSettings& settings;
  RebuildStatistics done = {};
};

}  // namespace v0
}  // namespace incise
