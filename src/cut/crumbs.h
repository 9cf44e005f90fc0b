// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "cut/constants.h"
#include "cut/incision_face.h"
#include "incise/core/grow_array.h"

namespace incise {
inline namespace v0 {

/// The volume below which a piece around a tet is a crumb; 0 far from the blade.
using CrumbLimit = std::function<double(TetId)>;
/// What counts as a crumb.
struct CrumbRules {
  CrumbLimit limit;  ///< the volume below which a piece is one
  /// A piece between two walls is one where it is thinner than this on the average, and one between a wall and skin
  /// where it is thinner than half of it: where a blade comes back beside its cut, or grazes skin, shavings would fall.
  /// In length units; 0: none is.
  double thin = 0.0;
  /// Whether a crumb hangs on its largest face alone: what is beside it may be two pieces before the stroke is through.
  bool hangs_on_one_face = false;
  /// Where set: whether a face was open before. A crumb does not hang on such a one.
  std::function<bool(const IncisionFace&)> stands_open = {};
  /// Where set: whether a tet of a crumb and one behind its face are of two pieces. A crumb hangs on its own one only.
  std::function<bool(TetId, TetId)> are_apart = {};
};

/// Memory that the search for crumbs keeps; all zero between calls.
struct CrumbScratch {
  ZeroedArray<std::uint8_t> blocked, state;  ///< by tet slot
};

/// Takes the incision faces of crumbs out of `incision` and adds them to `dropped`, so that a crumb stays attached to
/// the piece that it shares its faces with. Where it touches two pieces it stays with one, and they come apart. A piece
/// that is all crumbs stays whole. Returns how many crumbs. Cost: O(incision faces) plus a search of a few tets around
/// each small tet beside one.
std::uint64_t keep_crumbs(const TetMesh& mesh, const CrumbRules& rules, std::vector<IncisionFace>& incision,
                          std::vector<IncisionFace>& dropped, CrumbScratch& scratch);

}  // namespace v0
}  // namespace incise
