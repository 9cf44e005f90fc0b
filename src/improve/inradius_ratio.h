// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "incise/geom/vec.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// 2√6, the L/r of the regular tet.
inline constexpr double kRegularLr = 4.898979485566356;

/// The measure that maintenance compares: 2√6 / (L/r), in [0, 1]. **Higher is better**; 1 for the regular tet, 0 for
/// one that is flat (by `kFlatTetRatio`: a needle is, long before its ratio vanishes), less for one that is inverted.
/// No libm but the root. Cost: about 12 ns. **Source:** Paper §3.1, inverted.
inline double inradius_ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const Vec3 abc = ab.cross(ac);
  const double volume6 = abc.dot(ad);
  const double area2 = abc.norm() + ab.cross(ad).norm() + ac.cross(ad).norm() + bc.cross(bd).norm();
  const double longest2 = std::max(
      {ab.squaredNorm(), ac.squaredNorm(), ad.squaredNorm(), bc.squaredNorm(), bd.squaredNorm(), cd.squaredNorm()});
  const double longest = std::sqrt(longest2);
  const bool is_flat = !(std::abs(volume6) > 6 * kFlatTetRatio * longest * longest2);
  return is_flat ? 0.0 : kRegularLr * volume6 / (area2 * longest);
}

inline double inradius_ratio(const TetMesh& mesh, const TetVertices& v) {
  return inradius_ratio(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3]));
}

/// With `vertex` of the tet at another place.
inline double inradius_ratio_with(const TetMesh& mesh, TetId tet, VertexId vertex, const Vec3& place) {
  const TetVertices& v = mesh.vertices(tet);
  const auto at = [&](unsigned c) -> const Vec3& { return v[c] == vertex ? place : mesh.rest(v[c]); };
  return inradius_ratio(at(0), at(1), at(2), at(3));
}

}  // namespace v0
}  // namespace incise
