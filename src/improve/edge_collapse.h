// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "improve/care.h"
#include "incise/mesh/collapse.h"

namespace incise {
inline namespace v0 {

/// Merges a vertex into a neighbour where that makes the worst tet around better. Keeps scratch memory.
class EdgeCollapser {
 public:
  /// Tries the shortest edges of a tet, in both directions. Where one was accepted `care.changed` holds the fan of the
  /// vertex that is gone.
  ///
  /// A vertex merges only into one that is part of all its surfaces, along an edge that lies on them: a corner never
  /// does. Accepted where the link condition holds, the worst L/r of the vertex's star falls, no new edge is much
  /// longer than the star's, the surfaces stay in place, and they and every region enclose the same volume (where they
  /// are curved `into` moves by the little that this takes), and no tet is inverted, at rest or now. Cost: about 2 µs.
  /// **Source:** Paper §2.5. Differs: the full link condition, and quality decides, not two thresholds.
  bool improve(Care& care, TetId tet);

  /// Tries to merge a vertex that a cut made into one of its neighbours, nearest first, under the same rules, but where
  /// the worst tet is merely no worse, or no worse than `enough` (in (0, 1], of a regular tet): fewer tets of the same
  /// quality. Cost: about 5 µs.
  bool thin_out(Care& care, VertexId vertex, double enough = 1.0);

 private:
  /// One surface of `from`: what changes on it.
  struct Patch {
    Piece before, after;
    Reach reach;       ///< of `before`
    double lost6 = 0;  ///< six times the volume that its faces lose where `into` stays in place
  };

  void begin(Care& care, VertexId from);
  bool try_collapse(Care& care, VertexId from, VertexId into);
  [[nodiscard]] bool may_merge(const Care& care) const;
  void collect_before(const Care& care);
  void collect_after(const Care& care);
  bool keep_volume(const Care& care);
  [[nodiscard]] bool find_volume_step(const TetMesh& mesh, const VertexSurfaces& merged,
                                      const std::array<double, 2>& lost6, Vec3& step) const;
  [[nodiscard]] bool is_short_enough(const Care& care) const;
  [[nodiscard]] bool is_curved() const { return surfaces_.count > 0 && !surfaces_.is_flat(); }
  [[nodiscard]] bool improves(Care& care) const;
  [[nodiscard]] bool keeps_surfaces(const Care& care);
  [[nodiscard]] bool keeps_skin_beside(const Care& care);
  [[nodiscard]] bool keeps_borders_beside(const Care& care);
  void collect_beside(const Care& care, std::uint32_t tag, Piece& before, Piece& after) const;
  [[nodiscard]] bool keeps_current(const Care& care) const;
  [[nodiscard]] bool moves(const Care& care) const { return place_ != care.mesh.rest(plan_.into); }
  bool carry_out(Care& care);

  CollapsePlanner planner_;
  CollapsePlan plan_;
  // Of the vertex that was tried last, as long as nothing has changed:
  VertexId begun_;
  std::vector<TetId> star_;
  VertexSurfaces surfaces_;
  double worst_ = 0;         // ratio in its star
  double longest_ = 0;       // edge of its
  bool is_held_ = false;     // a tet around the vertex begun is locked
  bool has_before_ = false;  // the patches' pieces before, and their limits, are known

  std::vector<TetId> around_;  // the star of `into`
  std::array<Patch, 2> patches_;
  Vec3 place_ = Vec3::Zero();  // of the merged vertex
  double enough_ = 1.0;        ///< what thinning out leaves may be worse than before, but not than this
  double least_gain_ = kLeastGain;
  std::vector<VertexId> neighbours_;
};

}  // namespace v0
}  // namespace incise
