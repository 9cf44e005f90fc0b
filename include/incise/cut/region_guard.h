// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "incise/core/result.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Holds a blade's edge outside some regions of a mesh: "to the fat and no further".
///
/// Where the edge would come nearer to a region than 0.4 mean edges of the region's surface it ends, seen from the end
/// that more of it is free from: it is the same sweep without what lies in the regions or behind them. Where no end is
/// free, as when a blade is pressed flat onto a region, it stands still until it can go on. One stroke, one guard.
class RegionGuard {
 public:
  /// Which positions of the mesh count.
  enum class Shape : std::uint8_t { kRest, kCurrent };

  /// @param regions  that the edge must not enter; those that no tet has are no error.
  RegionGuard(std::vector<std::int32_t> regions, Shape shape) : regions_(std::move(regions)), shape_(shape) {}

  /// Puts the blade in place; the edge is divided at half the mean edge of `mesh`.
  /// @return the edge as divided, the same number of points at all times.
  /// Errors: kBadArgument where a point of it lies in the regions, or nearer than that: nothing is held then.
  /// Cost: O(tets).
  Result<std::vector<Vec3>> begin(const TetMesh& mesh, std::span<const Vec3> edge);
  /// Moves the blade on. @param edge  as many points as `begin` had. @return where the divided edge may go.
  /// Cost: O(tets), and some µs per point and eighth of a mean edge.
  std::vector<Vec3> move(const TetMesh& mesh, std::span<const Vec3> edge);

  /// Whether `begin` was called, and held.
  [[nodiscard]] bool is_on() const { return !points_.empty(); }
  /// Whether some point is not where the blade wants it.
  [[nodiscard]] bool holds() const { return points_ != goals_; }

 private:
  struct Place {
    std::uint32_t segment = 0;
    double share = 0;
  };
  enum class End : std::uint8_t { kEither, kFront, kBack };
  class Surface;
  [[nodiscard]] Surface surface_near(const TetMesh& mesh, const std::vector<Vec3>& goals) const;
  [[nodiscard]] bool is_out(const Surface& surface, const Vec3& point) const;
  [[nodiscard]] bool is_clear(const Surface& surface, const Vec3& a, const Vec3& b) const;
  [[nodiscard]] Vec3 reach(const Surface& surface, const Vec3& a, const Vec3& b) const;
  [[nodiscard]] std::vector<Vec3> shortened(const Surface& surface, std::vector<Vec3> edge, bool from_back) const;
  [[nodiscard]] bool is_way_clear(const Surface& surface, const std::vector<Vec3>& next) const;
  static double length(const std::vector<Vec3>& edge);
  void step(const Surface& surface, const std::vector<Vec3>& goals);
  [[nodiscard]] std::vector<Vec3> divided(std::span<const Vec3> edge) const;

  std::vector<std::int32_t> regions_;
  Shape shape_;
  double spacing_ = 0;
  std::vector<Place> places_;  // of the points along the edge
  std::vector<Vec3> goals_;    // where the blade has them
  std::vector<Vec3> points_;   // where they are held
  End end_ = End::kEither;     // from which the edge is seen while it is shortened
  bool stands_ = false;        // no end was free, or the way from where it stands was not
};

/// A stroke through the rest shape, held outside some regions: the same stroke, with more points and times where it
/// is held. Errors: as `check` and `RegionGuard::begin`. Cost: as `RegionGuard::move` per eighth of a mean edge.
[[nodiscard]] Result<Stroke> hold_outside(const TetMesh& mesh, const Stroke& stroke,
                                          const std::vector<std::int32_t>& regions);

}  // namespace v0
}  // namespace incise
