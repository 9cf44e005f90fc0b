// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "cut/sweep.h"

namespace incise {
inline namespace v0 {

/// What the borders of a sheet find around them in the rest shape.
struct Surroundings {
  bool has_older_cuts = false;  ///< else no function is asked
  /// How far a border at a place is to reach on into an older cut, in length units: along `outwards`, a unit vector
  /// that leads out of a sheet with this normal (of any length); 0 where there is none.
  std::function<double(const Vec3& place, const Vec3& outwards, const Vec3& normal)> reach;
  /// How far a blade at a place is to draw back, against `outwards`: to just before an older wall that it comes to, or
  /// passes by so little that a notch in the other lip would be all that comes of it; 0 where it need not. Walls are
  /// asked for within the last `length` of its way.
  std::function<double(const Vec3& place, const Vec3& outwards, double length)> retreat;
  std::function<bool(const Vec3& place)> is_outside;  ///< of the body
};

/// A place on the border of a sheet, and the unit vector that leads out of the sheet there.
struct BorderPlace {
  SosPoint at;
  Vec3 outwards;
};

/// Makes the pieces of surface by which the border of a sheet reaches on into older cuts.
///
/// The union of all sheets has one border, and only that is a front: where a sheet begins or ends at the rim of an
/// older cut, or at its wall, no tissue may stay between the two. Fronts lie off their blades by a fraction of an
/// element, so the sheet goes on a little, into what is open already. Source: docs/decisions/0022 (older cuts are air).
class BorderReach {
 public:
  /// `spacing`: a typical edge. New points get keys from `next_key` on.
  BorderReach(const Surroundings& around, double spacing, std::uint64_t& next_key)
      : around_(around), spacing_(spacing), next_key_(next_key) {}

  /// From a straight border between two places, as far as it lies at an older cut; up to the skin beside it. Triangles
  /// without area close the seam to the border as one segment. Pieces of consecutive segments share their edge. Empty
  /// where no place lies at an older cut. Cost: O(places asked for): one on each fifth of an edge.
  [[nodiscard]] SweptSurface from_row(const BorderPlace& from, const BorderPlace& to, std::uint32_t column);

 private:
  /// Where a piece ended at a point of the row: the next one goes on from there, so that no border stays between them.
  struct RowEnd {
    std::uint64_t row_key = 0;  ///< of that point; 0: none
    SosPoint beyond{Vec3::Zero(), 0};
  };
  [[nodiscard]] std::vector<double> find_reach(const BorderPlace& from, const BorderPlace& to, std::size_t parts) const;

  const Surroundings& around_;
  double spacing_;
  std::uint64_t& next_key_;
  RowEnd last_;
};

/// Adds a triangle that joins a border to an older cut; none where two of its points are one.
void add_reaching_triangle(SweptSurface& surface, const SosPoint& a, const SosPoint& b, const SosPoint& c,
                           std::uint32_t column);

}  // namespace v0
}  // namespace incise
