// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cut/piece_finder.h"
#include "cut/strip.h"
#include "cut/surface_index.h"
#include "paper/incision_front.h"

namespace incise {
inline namespace v0 {

/// What an incision at rest has swept since it began: where its blade comes back there a ring is full.
class Ring {
 public:
  /// None: it is not known where the incision began.
  Ring() = default;
  /// Of a blade that stands, with its edge along a row, where it begins.
  explicit Ring(std::vector<Vec3> row) : row_(std::move(row)) {}

  /// Takes in what the blade swept last, up to where it is: along `row`. Nothing counts after the ring is full. Cost:
  /// O(points of both rows).
  void note(const std::shared_ptr<const Strip>& strip, std::span<const Vec3> row, double spacing);
  /// Whether the blade has been elsewhere, at least `kRingTravel` spacings of travel, and has come back, all along its
  /// edge, to within `kClosesWithin` of where it began.
  [[nodiscard]] bool is_full() const { return is_full_; }
  /// Whether both ends of the edge, where it began, lie outside of the body: the ring takes something out. Cost: two
  /// searches of the surface index.
  [[nodiscard]] bool passes_through(const TetMesh& mesh, const SurfaceIndex& surface) const;
  /// All that it has swept, as one sheet. Cost: O(its triangles).
  [[nodiscard]] Strip sheet() const;

 private:
  [[nodiscard]] bool is_near_beginning(const Vec3& point, double distance) const;

  std::vector<Vec3> row_;
  std::vector<std::shared_ptr<const Strip>> strips_;
  double travel_ = 0;
  bool is_full_ = false;
};

/// Whether tissue goes round the walls of the incision under way along a sheet: some piece of the body is on both sides
/// of them. Cost: the tets near the sheet, and as `PieceFinder::find` for those with walls.
[[nodiscard]] bool is_joined_around(const TetMesh& mesh, const Sheet& sheet, const IncisionFront& front,
                                    PieceFinder& finder);

}  // namespace v0
}  // namespace incise
