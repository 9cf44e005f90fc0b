// SPDX-License-Identifier: Apache-2.0
// Measures of the shape of a tet a, b, c, d with positive orientation (b−a)×(c−a)·(d−a) > 0. All but those that say
// "for reports" use + − × ÷ √ alone, and give the same bits on every target. Edges within 1e±50 of the unit.
#pragma once

#include <algorithm>
#include <cmath>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// Six times the signed volume, in cubed length units; rounded (its sign is not exact, see `orient3d`).
inline double signed_volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// The signed volume, in cubed length units: negative where the tet is inverted.
inline double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return signed_volume6(a, b, c, d) / 6.0;
}

/// Longest edge over the radius of the inscribed sphere, L/r. **Lower is better**: 2√6 = 4.899 for the regular tet.
///
/// @return at least 4.899, dimensionless; +infinity where the volume is zero or negative.
/// Cost: about 15 ns. **Source:** Paper §3.1 (quality of a tetrahedron). Differs: inverted tets have no finite value.
double longest_edge_over_inradius(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Cosines of the least and the greatest dihedral angle: `of_least` >= `of_greatest`.
struct DihedralCosines {
  double of_least;     ///< near 1 where an angle is near 0
  double of_greatest;  ///< near -1 where an angle is near 180°
};

/// Finds the extreme dihedral angles without libm; compare cosines instead of angles.
///
/// @return cosines in [−1, 1]; {1, −1} where a face has no area.
/// Cost: about 30 ns. **Source:** Paper §3.1 (for reports and comparison with other measures).
DihedralCosines dihedral_cosines(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Least and greatest dihedral angle in degrees; for reports.
struct DihedralExtremes {
  double least;     ///< degree
  double greatest;  ///< degree
};

/// Finds the extreme dihedral angles in degrees: 70.529 both for the regular tet. For reports: uses acos.
DihedralExtremes dihedral_extremes_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The cube of `mean_ratio`: compares as it does, without a cube root.
///
/// @return in [−1, 1]; 1 for the regular tet, 0 for a flat one, negative for an inverted one. **Higher is better.**
double mean_ratio_cubed(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Mean ratio 12 (3V)^(2/3) / Σ l², signed like the volume V; l runs over the six edges. **Higher is better.**
/// For reports: uses a cube root. **Source:** A. Liu, B. Joe, "Relationship between tetrahedron shape measures", 1994.
double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// A tet counts as flat where |V| <= this times the cube of its longest edge.
///
/// Unit 1. Larger values call needles flat; smaller ones let rounding noise (about 1e-16) pass as volume.
inline constexpr double kFlatTetRatio = 1e-12;

/// Whether the tet (a, b, c, d) is inverted or has no volume to speak of: V ≤ `kFlatTetRatio`·L³, L its longest edge.
/// The same measure names the defect "zero volume" at load. Cost: about 10 ns.
inline bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double longest2 = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (d - a).squaredNorm(),
                                    (c - b).squaredNorm(), (d - b).squaredNorm(), (d - c).squaredNorm()});
  return !(signed_volume6(a, b, c, d) > 6.0 * kFlatTetRatio * longest2 * std::sqrt(longest2));
}

}  // namespace v0
}  // namespace incise
