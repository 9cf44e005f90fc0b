// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/mesh/verbs.h"

namespace incise {
inline namespace v0 {

/// A tet that fills part of a cavity.
struct NewTet {
  TetVertices vertices;      ///< positive in this order
  std::uint32_t parent = 0;  ///< index into the consumed tets: whose material it takes
};

/// The plan of filling the space of a few tets with others on the same vertices.
///
/// Swaps and the removal of edges are such plans. Outer faces stay, except for two boundary faces in one plane that
/// give way to two others there.
struct RemeshPlan {
  Refusal refusal = Refusal::kNone;  ///< why not; kNone: it may be applied
  std::vector<TetId> consumed;       ///< the tets that give way
  std::vector<NewTet> produced;      ///< the tets that take their place
  std::uint32_t tag = 0;             ///< of boundary faces that are new
  VertexId born;                     ///< the vertex that was put in for it in the same transaction, if any

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Plans the 2-3 swap: the two tets at a face give way to three around the line between their apexes.
///
/// Refuses a boundary face or a border between regions (kOnSurface) and where the line misses the face (kWouldInvert,
/// by exact sign). Cost: O(1). **Source:** Paper §3.3, Figure 8.
RemeshPlan plan_swap_23(const TetMesh& mesh, Side face);

/// Plans the 3-2 swap: the three tets around an inner edge give way to two. `seed` is any tet that contains the edge.
///
/// Refuses an edge on a boundary or border (kOnSurface), one with another number of tets (kOutOfRange) and where the
/// two would not be positive (kWouldInvert, by exact sign). Cost: O(1). **Source:** Paper §3.3, Figure 8.
RemeshPlan plan_swap_32(const TetMesh& mesh, VertexId a, VertexId b, TetId seed);

/// The tets around an edge (a, b) in order. Tet i lies between the vertices i and i + 1; all are (a, b, i, i + 1) with
/// positive orientation. Where the edge lies on the boundary the first and last vertex are the ends of the fan.
struct EdgeRing {
  std::vector<TetId> tets;         ///< n of them; n - 1 at the boundary
  std::vector<VertexId> vertices;  ///< n of them
  bool is_closed = false;          ///< no boundary at the edge
};

/// Walks around an edge; `seed` is any tet that contains it. Only the face-connected ring of `seed` is found; it is
/// empty where input that overlaps itself turns back there. Cost: O(ring).
void find_edge_ring(const TetMesh& mesh, VertexId a, VertexId b, TetId seed, EdgeRing& ring);

/// A triangle of the polygon around an edge: indices into `EdgeRing::vertices`, ascending.
using RingTriangle = std::array<std::uint8_t, 3>;

/// Fills `plan` with the removal of an edge: every triangle of a triangulation of its ring makes one tet with either
/// end.
///
/// For an inner edge, or one on the boundary whose two boundary faces lie in one plane and carry one tag. Whether the
/// tets are positive, and the plane, are up to the caller. The 3-2 and 4-4 swaps are the smallest such removals.
/// Cost: O(ring). **Source:** J. Shewchuk, "Two discrete optimization algorithms for the topological improvement of
/// tetrahedral meshes", 2002 (edge removal).
void fill_edge_removal(const TetMesh& mesh, VertexId a, VertexId b, const EdgeRing& ring,
                       const std::vector<RingTriangle>& triangles, RemeshPlan& plan);

/// Carries a plan out; cannot fail. `produced` receives the new tets, in the plan's order. Cost: O(n log n) in its
/// faces.
void apply(Transaction& transaction, const RemeshPlan& plan, std::vector<TetId>& produced);

}  // namespace v0
}  // namespace incise
