// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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
  std::vector<TetId> flaps;          ///< those of them that stand out alone: see `Flaps`
  std::vector<TetId> fan;            ///< the other tets of `from`: they get `into` in its place
  std::vector<TetId> around;         ///< the star of `into`, the ring included

  explicit operator bool() const { return refusal == Refusal::kNone; }
};

/// A flap is a tet around the edge whose two faces opposite the edge's ends are both boundary: nothing lies on either
/// side. With the edge it becomes a face with nothing behind it, and must vanish altogether.
enum class Flaps : std::uint8_t {
  kRefused,    ///< no edge vanishes that has one
  kTakenAway,  ///< they vanish, with the vertices that they alone have
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
  /// conditions of Paper §2.5 are necessary for it, but not sufficient. Flaps are ears of the stars of all their
  /// corners, so that to take them away first changes no topology: the condition is asked of what remains, which must
  /// be one fan of tets at the edge.
  void plan(const TetMesh& mesh, VertexId from, VertexId into, CollapsePlan& plan, Flaps flaps = Flaps::kRefused);

 private:
  template <class Vertices>
  void mark(const Vertices& vertices, std::uint8_t bit) {
    for (const VertexId v : vertices) {
      marks_[v.value] = static_cast<std::uint8_t>(marks_[v.value] | bit);
    }
  }
  [[nodiscard]] bool may_take_flaps(const TetMesh& mesh, const CollapsePlan& plan) const;
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
/// bits of `from`; behind flaps the boundary bits of `into` and of their other corners are those of their faces.
/// Cost: O(star).
void apply(Transaction& transaction, const CollapsePlan& plan);

}  // namespace v0
}  // namespace incise
