// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cut/edge_table.h"
#include "cut/sheet_crossing.h"

namespace incise {
inline namespace v0 {

/// A mesh edge near the blade, with what the blade did to it. `a` has the lower slot.
struct CutEdge {
  VertexId a, b;
  SheetCrossings crossings;      ///< by the sheet
  double t = 0.5;                ///< where it is split, from a to b
  VertexId split;                ///< the vertex that splits it, once made
  Vec3 position = Vec3::Zero();  ///< of that vertex at rest
  bool is_planned = false;       ///< to be split
  bool is_blocked = false;       ///< splitting it would make a tet that is not sound

  [[nodiscard]] bool is_flagged() const { return crossings.is_odd(); }
};

using EdgeTable = BasicEdgeTable<CutEdge>;

}  // namespace v0
}  // namespace incise
