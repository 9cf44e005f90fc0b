// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cut/closed_complex.h"
#include "cut/constants.h"
#include "cut/surface_index.h"

namespace incise {
inline namespace v0 {

/// Whether a wall stands within a master, or between two: the sheet of `complex` makes it anew while the blade is
/// there.
[[nodiscard]] bool is_inside_master(const ClosedComplex& complex, Side wall);

/// The walls that a stroke finds in the rest shape when it comes: what an older cut has opened is air.
///
/// A sheet that runs along such a wall needs no border of its own there, and what it would cut beside it is open
/// already. Source: docs/decisions/0022 (older cuts are air); ANSYS' XFEM has such a tolerance from crack tip to crack
/// face (SNAPTOLER).
class OlderWalls {
 public:
  /// `complex`: of the sheet that asks; walls inside its masters are its own, all others are older, those of sheets of
  /// the same stroke that are finished included. `surface` must be up to date. All must outlive the object.
  OlderWalls(const TetMesh& mesh, const SurfaceIndex& surface, const ClosedComplex& complex)
      : mesh_(mesh), surface_(surface), complex_(complex) {}

  /// Whether there is any wall to ask about. Cost: O(1).
  [[nodiscard]] bool exist() const;
  /// Whether a wall along the sheet (normals within 60 degrees) passes by a rest place: at most `beside` across the
  /// wall, and at most `beyond` past its rim, in length units. `normal`: of the sheet there, any length above 0.
  /// Cost: the cells of the surface index within the greater of both.
  [[nodiscard]] bool pass(const Vec3& place, const Vec3& normal, double beside, double beyond) const;
  /// Whether a segment at rest meets a wall, at 6 degrees or more. Cost: the cells of the surface index around it.
  [[nodiscard]] bool meet(const Vec3& from, const Vec3& to) const { return first_met(from, to) <= 1.0; }
  /// Where it meets the first one, at an angle of `least_sine` or more: the share of the way; above 1 where it meets
  /// none. Cost: the same.
  [[nodiscard]] double first_met(const Vec3& from, const Vec3& to, double least_sine = kAcrossWallSine) const;

 private:
  const TetMesh& mesh_;
  const SurfaceIndex& surface_;
  const ClosedComplex& complex_;
};

}  // namespace v0
}  // namespace incise
