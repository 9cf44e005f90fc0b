// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "improve/constants.h"
#include "improve/inradius_ratio.h"
#include "improve/reference.h"
#include "improve/standing.h"
#include "improve/surfaces.h"
#include "incise/improve/options.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// What the operations of maintenance work with: one mesh under one open transaction.
struct Care {
  Transaction& transaction;
  const TetMesh& mesh;
  References& references;
  StarWalker& walker;
  MaintainStatistics& statistics;
  bool is_bad;                  ///< the tet in hand is bad: surfaces may give way more
  VertexId born;                ///< out: the vertex that the last accepted operation put in
  std::vector<TetId>& changed;  ///< out: the live tets that the last accepted operation made or reshaped
  const IsLocked* is_locked = nullptr;
  bool is_at_seam = false;  ///< what is thinned out lies where a cut goes on from an older one: as for bad tets
  mutable bool has_met_lock = false;  ///< out: whether an operation was refused for a tet that is locked

  /// Whether surfaces may give way more than usual.
  [[nodiscard]] bool gives_way() const { return is_bad || is_at_seam; }
  /// Whether an operation may change all of some tets.
  [[nodiscard]] bool may_change(std::span<const TetId> tets) const {
    const bool may =
        is_locked == nullptr || !*is_locked || std::none_of(tets.begin(), tets.end(), std::cref(*is_locked));
    has_met_lock |= !may;
    return may;
  }

  /// Counts evaluations of tets.
  void spend(std::size_t units) { statistics.work_units += units; }
};

inline double skin_tolerance(const Care& care) {
  return care.gives_way() ? kCoarseTolerance : kFineTolerance;
}

/// How far skin may lie from where it was before all, as a share of the local edge.
inline double skin_share(const Care& care) {
  return care.is_bad ? kBadSkinTolerance : (care.is_at_seam ? kSeamSkinTolerance : kSkinTolerance);
}

/// How far a surface may leave its place, in the mesh's unit, at one of its vertices where edges are so long.
inline double surface_tolerance(const Care& care, std::uint32_t tag, VertexId vertex, double edge) {
  const double share = tag == 0 ? skin_tolerance(care) : care.references.tolerance(tag, care.gives_way());
  const bool is_wide = care.gives_way() && (tag == 0 || care.references.knows(tag));
  return std::max(share * edge,
                  is_wide ? kOriginalTolerance * care.references.sizes().at(care.mesh.rest(vertex)) : 0.0);
}

/// The worst of a set of tets as they stand.
inline double worst_of(Care& care, const std::vector<TetId>& tets) {
  double worst = 2.0;
  for (const TetId tet : tets) {
    worst = std::min(worst, inradius_ratio(care.mesh, care.mesh.vertices(tet)));
  }
  care.spend(tets.size());
  return worst;
}

}  // namespace v0
}  // namespace incise
