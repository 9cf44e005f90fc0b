// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/mesh/transaction.h"

namespace incise::inline v0 {

/// Why a verb cannot be carried out. A refusal is normal flow: nothing has changed.
enum class Refusal : std::uint8_t {
  kNone,
  kDead,          ///< a named element does not live
  kNotAnEdge,     ///< the two vertices share no tet
  kOutOfRange,    ///< a parameter is outside its range
  kWouldInvert,   ///< a tet would lose its positive volume
  kStarIsWhole,   ///< nothing separates the star
};

/// One tet that a split replaces, with its two halves.
struct SplitHalves {
  TetId tet, keeps_a, keeps_b;
};

/// The plan of splitting the edge (a, b) at (1-t)·a + t·b.
struct SplitEdgePlan {
  Refusal refusal = Refusal::kNone;
  VertexId a, b;
  double t = 0.5;
  std::vector<TetId> ring;  ///< the tets around the edge

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Plans the split of an edge. `seed` is any tet that contains it; t in (0, 1), measured from a.
/// Only the face-connected ring of `seed` is split: where the input's tets touch along the edge without sharing a face,
/// the other fan keeps the whole edge and must be split likewise. Cost: O(ring).
SplitEdgePlan plan_split_edge(const TetMesh& mesh, VertexId a, VertexId b, TetId seed, double t);

struct SplitEdgeResult {
  VertexId vertex;
  std::vector<SplitHalves> halves;  ///< in the order of the plan's ring; corner numbers are those of the split tet
};

/// Carries a plan out; cannot fail. The vertex inherits kSkin and kWall where the edge lies on such a surface.
SplitEdgeResult apply(Transaction& transaction, const SplitEdgePlan& plan);

/// The plan of giving a group of tets around a vertex a copy of its own.
struct DuplicateVertexPlan {
  Refusal refusal = Refusal::kNone;
  VertexId vertex;
  std::vector<TetId> group;  ///< the tets that get the copy

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Plans a duplication. Every tet of `group` must contain `vertex`; some tet of the star must stay outside. Cost: O(star).
DuplicateVertexPlan plan_duplicate_vertex(const TetMesh& mesh, VertexId vertex, std::vector<TetId> group);

/// Carries the plan out: the group gets a twin of the vertex, and the faces between group and rest become boundary with
/// `tag`. Returns the twin. Paper §2.3 (subdivision of a vertex). Cost: O(star).
VertexId apply(Transaction& transaction, const DuplicateVertexPlan& plan, std::uint32_t tag);

}  // namespace incise::inline v0
