// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/incision_face.h"
#include "cut/split_template.h"
#include "incise/mesh/transaction.h"
#include "paper/neighbourhood.h"

namespace incise {
inline namespace v0 {

/// Decides which edges are split, and where: every flagged edge between corners that do not take part in the cut
/// themselves.
///
/// An edge cannot be split where that would make a tet without positive volume from one that has it, or where it
/// belongs to a tet without volume: the cut leaves out the tets around it. Returns the number of edges so blocked.
/// Cost: O(near tets).
std::uint64_t plan_subdivision(const TetMesh& mesh, SplitTemplates& templates, Neighbourhood& neighbourhood);

/// The children of the near tets that were subdivided.
struct Subdivision {
  std::vector<TetId> parents;              ///< subdivided tets, in the order of `Neighbourhood::tets`
  std::vector<std::uint32_t> first_child;  ///< `parents.size() + 1`, into `children`
  std::vector<TetId> children;
  std::vector<IncisionFace> incision;  ///< found afterwards: see `find_paper_incision`
  std::uint64_t new_vertices = 0;
};

/// Carries the plan out: bisects the planned edges in a global order (longest first, then by ends), so that
/// neighbours agree on their common faces, and links the children. Paper §2.2, Figure 2. Cost: O(near tets).
Subdivision subdivide(Transaction& transaction, SplitTemplates& templates, Neighbourhood& neighbourhood);

/// The paper's incision faces: inner faces all of whose vertices are collision points of this incision (§2.2), in the
/// near tets and around `front`, the vertices that frames before have left joined. Cost: O(near tets + stars of front).
std::vector<IncisionFace> find_paper_incision(const TetMesh& mesh, const Neighbourhood& neighbourhood,
                                              const Subdivision& subdivision, std::span<const VertexId> front = {});

}  // namespace v0
}  // namespace incise
