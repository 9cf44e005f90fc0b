// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/mesh/star.h"
#include "incise/mesh/verbs.h"

namespace incise {
inline namespace v0 {

/// The plan of merging a vertex into a neighbour: the edge between them and the tets around it vanish.
struct CollapsePlan {
  Refusal refusal = Refusal::kNone;  ///< why not; kNone: it may be applied
  VertexId from, into;               ///< the vertex that vanishes, and the one that it merges into
  std::vector<TetId> ring;           ///< the tets around the edge: they vanish
  std::vector<TetId> fan;            ///< the other tets of `from`: they get `into` in its place
  std::vector<TetId> around;         ///< the star of `into`, the ring included

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// Decides whether edges may vanish without a change of topology. Keeps scratch memory between calls.
class CollapsePlanner {
 public:
  /// Plans the collapse of the edge between two neighbours, by topology alone: whether tets stay positive, and the
  /// surface in place, is up to the caller (`stays_positive`).
  ///
  /// Refuses where the link condition fails (kLinkCondition): Lk(a) ∩ Lk(b) = Lk(ab) in the complex that a vertex at
  /// infinity closes along the boundary; and where no tet of `from` would remain. An accepted collapse keeps the
  /// pieces, their Euler characteristics and the manifold boundary. Refuses borders between regions (kOnSurface),
  /// pinched vertices (kNoStar) and edges that do not exist (kNotAnEdge). The plan's vectors are reused. Cost: O(both
  /// stars), about 1 µs.
  /// **Source:** T. Dey, H. Edelsbrunner, S. Guha, D. Nekhayev, "Topology preserving edge contraction", 1999; the
  /// conditions of Paper §2.5 are necessary for it, but not sufficient.
  void plan(const TetMesh& mesh, VertexId from, VertexId into, CollapsePlan& plan);

 private:
  template <class Vertices>
  void mark(const Vertices& vertices, std::uint8_t bit) {
    for (const VertexId v : vertices) {
      marks_[v.value] = static_cast<std::uint8_t>(marks_[v.value] | bit);
    }
  }
  [[nodiscard]] bool keeps_topology(const TetMesh& mesh, const CollapsePlan& plan) const;
  [[nodiscard]] bool touches_rim(const TetMesh& mesh, const CollapsePlan& plan, TetId tet) const;
  void mark_link(const TetMesh& mesh, const CollapsePlan& plan);
  void clear_marks(const TetMesh& mesh, const CollapsePlan& plan);
  [[nodiscard]] bool ring_has(const TetMesh& mesh, const CollapsePlan& plan, VertexId x, VertexId y) const;
  [[nodiscard]] bool shares_only_ring(const TetMesh& mesh, const CollapsePlan& plan, TetId tet) const;

  StarWalker walker_;
  ZeroedArray<std::uint8_t> marks_;  // per vertex; zero between calls
};

/// Whether the fan's tets are positive, by exact sign, once the vertices are one at `place`; with `place` away from
/// `into` also those around it. Cost: O(both stars).
bool stays_positive(const TetMesh& mesh, const CollapsePlan& plan, const Vec3& place);

/// Carries a plan out; cannot fail. `into` stays where it is (move it first, if it shall move) and takes over the shape
/// bits of `from`. Cost: O(star).
void apply(Transaction& transaction, const CollapsePlan& plan);

}  // namespace v0
}  // namespace incise
