// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/neighbourhood.h"
#include "cut/split_template.h"
#include "cut/sweep.h"
#include "incise/cut/options.h"
#include "incise/mesh/transaction.h"

namespace incise::inline v0 {

/// A face along which material will be separated: its two sides.
struct IncisionFace {
  Side a, b;
};

/// How a sheet divides the near tets.
struct SubdivisionRules {
  bool splits_partial_tets = false;  ///< bisect every flagged edge (paper), or only those of tets that are cut through
  double clamp = 0.0;                ///< split points keep this share of their edge on either side
  bool keeps_shape_floor = true;     ///< refuse children flatter than the input's own definition of zero volume
};

/// Decides which edges are split and which tets are cut through, and where the split points lie.
///
/// A tet is cut through where all its faces have an even number of flagged edges and all flagged edges between corners
/// that are not ON can be split. An edge cannot be split where that would make a tet without positive volume from one
/// that has it, or where it belongs to a tet without volume: the cut leaves out the tets around it. Returns the number
/// of edges so blocked. Cost: O(near tets).
std::uint64_t plan_subdivision(const TetMesh& mesh, const SubdivisionRules& rules, SplitTemplates& templates,
                               Neighbourhood& neighbourhood);

/// The children of the near tets that were subdivided.
struct Subdivision {
  std::vector<TetId> parents;              ///< subdivided tets, in the order of `Neighbourhood::tets`
  std::vector<std::uint32_t> first_child;  ///< `parents.size() + 1`, into `children`
  std::vector<TetId> children;
  std::vector<IncisionFace> incision;  ///< faces with material of the sheet's two sides on either side
  std::uint64_t new_vertices = 0;
};

/// Carries the plan out: bisects the planned edges in a global order (longest first, then by ends), so that
/// neighbours agree on their common faces, and links the children. Paper §2.2, Figure 2.
/// Finds the incision faces from the sides of the tets: between children of opposite sides, and original faces with
/// three ON vertices whose two tets lie on opposite sides. Differs from the paper, which takes every face with three
/// collision vertices (see `find_paper_incision`). Cost: O(near tets).
Subdivision subdivide(Transaction& transaction, const Sheet& sheet, SplitTemplates& templates,
                      Neighbourhood& neighbourhood);

/// The paper's incision faces: inner faces all of whose vertices are collision points of this stroke (§2.2).
std::vector<IncisionFace> find_paper_incision(const TetMesh& mesh, const Neighbourhood& neighbourhood,
                                              const Subdivision& subdivision);

}  // namespace incise::inline v0
