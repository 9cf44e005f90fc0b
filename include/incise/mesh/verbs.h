// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// Why a verb cannot be carried out. A refusal is normal flow: nothing has changed.
enum class Refusal : std::uint8_t {
  kNone,
  kDead,           ///< a named element does not live
  kNotAnEdge,      ///< the two vertices share no tet
  kOutOfRange,     ///< a parameter is outside its range
  kWouldInvert,    ///< a tet would be inverted, or has no volume to divide
  kStarIsWhole,    ///< nothing separates the star
  kNoStar,         ///< the vertex has no tets, or they were not face-connected at load: its star cannot be walked
  kOnSurface,      ///< a boundary or a border between regions would not stay where it is
  kLinkCondition,  ///< the topology would change
};

/// One tet that a split replaces, with its two halves.
struct SplitHalves {
  TetId tet, keeps_a, keeps_b;  ///< the tet before, and the halves with the end a and with the end b
};

/// The plan of splitting the edge (a, b) at (1-t)·a + t·b.
struct SplitEdgePlan {
  Refusal refusal = Refusal::kNone;  ///< why not; kNone: it may be applied
  VertexId a, b;                     ///< the edge's ends
  double t = 0.5;                    ///< from a to b, in (0, 1)
  std::vector<TetId> ring;           ///< the tets around the edge

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Plans the split of an edge. `seed` is any tet that contains it; t in (0, 1), measured from a.
/// Only the face-connected ring of `seed` is split: where the input's tets touch along the edge without sharing a face,
/// the other fan keeps the whole edge and must be split likewise. Cost: O(ring).
SplitEdgePlan plan_split_edge(const TetMesh& mesh, VertexId a, VertexId b, TetId seed, double t);

/// What splitting an edge made.
struct SplitEdgeResult {
  VertexId vertex;                  ///< the new vertex
  std::vector<SplitHalves> halves;  ///< in the order of the plan's ring; corner numbers are those of the split tet
};

/// Carries a plan out; cannot fail. The vertex inherits kSkin and kWall where the edge lies on such a surface.
SplitEdgeResult apply(Transaction& transaction, const SplitEdgePlan& plan);

/// The plan of giving a group of tets around a vertex a copy of its own.
struct DuplicateVertexPlan {
  Refusal refusal = Refusal::kNone;  ///< why not; kNone: it may be applied
  VertexId vertex;                   ///< the vertex to be copied
  std::vector<TetId> group;          ///< the tets that get the copy

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Plans a duplication. Every tet of `group` must contain `vertex`; some tet of the star must stay outside. Cost:
/// O(star).
DuplicateVertexPlan plan_duplicate_vertex(const TetMesh& mesh, VertexId vertex, std::vector<TetId> group);

/// Carries the plan out: the group gets a twin of the vertex, and the faces between group and rest become boundary with
/// `tag`. Returns the twin. Paper §2.3 (subdivision of a vertex). Cost: O(star).
VertexId apply(Transaction& transaction, const DuplicateVertexPlan& plan, std::uint32_t tag);

/// The plan of putting a vertex into a face.
struct SplitFacePlan {
  Refusal refusal = Refusal::kNone;  ///< why not; kNone: it may be applied
  Side face;                         ///< as one of its tets sees it
  std::array<double, 3> weights{};   ///< of the vertices of `face`, in the order of `TetMesh::vertices(Side)`
  Vec3 rest = Vec3::Zero(), current = Vec3::Zero();  ///< of the new vertex, length unit

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Plans the split of a face at Σ weights · vertices: two tets become six, on the boundary one becomes three.
/// `weights` in (0, 1), in the order of `mesh.vertices(face)`; their sum may miss 1 by 1e-12. Cost: O(1).
SplitFacePlan plan_split_face(const TetMesh& mesh, Side face, const std::array<double, 3>& weights);

/// One tet that a split replaces. Child c is the tet with the new vertex in place of its corner c; corner numbers stay.
struct SplitParts {
  TetId tet;                      ///< the tet that was split
  std::array<TetId, 4> children;  ///< by corner; invalid where the split leaves no such part
};

/// What splitting a face made.
struct SplitFaceResult {
  VertexId vertex;                  ///< the new vertex
  std::array<SplitParts, 2> parts;  ///< the plan's tet, then the one behind its face; invalid where there is none
};

/// Carries a plan out; cannot fail. On the boundary the vertex is kSkin or kWall, as the face's tag says.
SplitFaceResult apply(Transaction& transaction, const SplitFacePlan& plan);

/// The plan of putting a vertex into a tet.
struct SplitTetPlan {
  Refusal refusal = Refusal::kNone;                  ///< why not; kNone: it may be applied
  TetId tet;                                         ///< the tet to be split
  std::array<double, 4> weights{};                   ///< of its corners
  Vec3 rest = Vec3::Zero(), current = Vec3::Zero();  ///< of the new vertex, length unit

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Plans the split of a tet into four at Σ weights · corners. `weights` as for `plan_split_face`. Cost: O(1).
SplitTetPlan plan_split_tet(const TetMesh& mesh, TetId tet, const std::array<double, 4>& weights);

/// What splitting a tet made.
struct SplitTetResult {
  VertexId vertex;   ///< the new vertex
  SplitParts parts;  ///< the tet and its four parts
};

/// Carries a plan out; cannot fail. The vertex is interior.
SplitTetResult apply(Transaction& transaction, const SplitTetPlan& plan);

/// The plan of moving a vertex.
struct MoveVertexPlan {
  Refusal refusal = Refusal::kNone;  ///< why not; kNone: it may be applied
  VertexId vertex;                   ///< the vertex to be moved
  Vec3 rest = Vec3::Zero();          ///< where to, in the mesh's length unit
  TetVertices basis;                 ///< the tet of the star that holds the place, or is nearest to holding it
  std::array<double, 4> weights{};   ///< barycentric coordinates of the place in it

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Plans a move in the rest shape. Refuses where a tet of positive volume would lose it, by exact sign, or one
/// that is not flat (`is_flat`) would become so; keeping a boundary vertex on its surface is up to the caller. Refuses
/// pinched vertices (kNoStar). Cost: O(star).
MoveVertexPlan plan_move_vertex(const TetMesh& mesh, VertexId vertex, const Vec3& rest);

/// Carries a plan out; cannot fail. Links, slots and shape bits stay.
void apply(Transaction& transaction, const MoveVertexPlan& plan);

}  // namespace v0
}  // namespace incise
