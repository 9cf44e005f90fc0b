// SPDX-License-Identifier: Apache-2.0
// What a plane makes of the unit cube, worked out by hand and not by cutting.
#pragma once

#include <cmath>

#include "incise/geom/vec.h"

namespace incise::test {

/// The part of the unit cube below a plane.
struct Section {
  double volume = 0;
  double area = 0;  ///< of the face that the plane gives it
};

/// The part of the unit cube where normal · x < offset, for a normal of any length without a component near zero.
///
/// Turned so that all components are positive, it is a tet at the corner 0, less those that stick out of the cube, by
/// inclusion and exclusion; the area is the derivative of the volume.
inline Section section_of_unit_cube(const Vec3& normal, double offset) {
  const double length = normal.norm();
  const Vec3 n = normal.cwiseAbs() / length;
  double reach = offset / length;
  for (int axis = 0; axis < 3; ++axis) reach += normal[axis] < 0 ? n[axis] : 0.0;
  Section section;
  for (unsigned corner = 0; corner < 8; ++corner) {
    double left = reach, sign = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (((corner >> static_cast<unsigned>(axis)) & 1U) == 0) continue;
      left -= n[axis];
      sign = -sign;
    }
    if (left <= 0) continue;
    section.volume += sign * left * left * left / (6 * n.x() * n.y() * n.z());
    section.area += sign * left * left / (2 * n.x() * n.y() * n.z());
  }
  return section;
}

}  // namespace incise::test
