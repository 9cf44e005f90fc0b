// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "improve/care.h"
#include "incise/mesh/collapse.h"

namespace incise {
inline namespace v0 {

/// Merges two vertices that lie so close to each other that what tells them apart does not matter: corners, ends of
/// fronts, a vertex of a crease and one of a cut beside it. Keeps scratch memory.
class CloseMerger {
 public:
  /// Tries to merge the ends of a short edge of a bad tet, whatever surfaces they are part of. Where it was accepted
  /// `care.changed` holds the star of the merged vertex.
  ///
  /// `EdgeCollapser` keeps surfaces apart from each other, and corners in place: two walls that cross at a small angle,
  /// or a wall that passes close to a crease, leave corners beside each other that nothing may merge. Here only the
  /// place of every surface counts: the merged vertex goes to either end, or between, and on from there by what keeps
  /// the volume; each surface around it must lie as near to its reference as the tolerance for bad tets says, and turn
  /// by less than 60 degrees. Flaps at the edge (`Flaps`) vanish with it where it is at most twice as long as each
  /// surface there may leave its place. Vertices of fronts move by `kFrontReach` at most. Accepted where the link
  /// condition holds, the worst L/r of both stars falls, and no tet is inverted, at rest or now. Cost: about 20 µs for
  /// an edge that is short enough. **Source:** as `EdgeCollapser`; geometry decides in place of classes.
  bool improve(Care& care, TetId tet);

  /// Merges a vertex into a neighbour, at the place of either, whatever that does to the shape of tets and to the
  /// volume: a step of a trial (`Trial`). The edge may have any length here, and besides what `improve` allows walls
  /// and fronts may leave their place, and skin its rim at a wall, by `kBentWall` of the edges that the body came with,
  /// as far as snapping bends them. No tet is inverted, at rest or now. Returns six times the volume that the body
  /// lost, none where nothing was done. Cost: as `improve`.
  std::optional<double> merge_loosely(Care& care, VertexId from, VertexId into);

 private:
  /// A boundary facet of either star, the merged vertex first, and the same before.
  struct MovedSide {
    std::uint32_t tag;
    Facet before, after;
    bool stays;  ///< it does not vanish with the edge
  };

  bool try_merge(Care& care, VertexId from, VertexId into);
  [[nodiscard]] bool begin(Care& care);
  void collect_sides(const Care& care);
  bool try_place(Care& care, Vec3 place);
  bool try_loosely(Care& care, const Vec3& place);
  bool may_merge(Care& care, VertexId from, VertexId into);
  double put(const Vec3& place);
  [[nodiscard]] double bend_at(const Care& care, const Vec3& place) const;
  [[nodiscard]] bool are_flaps_thin(const Care& care) const;
  [[nodiscard]] bool keeps_front(const Care& care, const Vec3& place) const;
  bool restore_volume(Vec3& place);
  [[nodiscard]] bool improves(Care& care, const Vec3& place) const;
  [[nodiscard]] bool keeps_surfaces(Care& care, const Vec3& place);
  [[nodiscard]] bool keeps_tag(Care& care, std::uint32_t tag, const Vec3& place);
  [[nodiscard]] bool keeps_current(const Care& care, const Vec3& place) const;
  bool carry_out(Care& care, const Vec3& place);

  CollapsePlanner planner_;
  CollapsePlan plan_;
  std::vector<TetId> star_;  // both stars
  std::vector<MovedSide> sides_;
  std::vector<std::uint32_t> tags_;
  double worst_ = 0, edge_ = 0;  // of the stars: ratio, mean length
  Piece before_, after_;
  double bend_ = 0;   // of the edges that the body came with: how far walls and fronts may leave their place besides
  double lost6_ = 0;  // six times the volume that a merge for trial took
};

}  // namespace v0
}  // namespace incise
