// SPDX-License-Identifier: Apache-2.0
// Signs of determinants, exact on doubles, and never zero under a symbolic perturbation. Papers followed:
// J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997;
// H. Edelsbrunner, E. P. Mücke, "Simulation of Simplicity", ACM Transactions on Graphics 9(1), 1990.
//
// Range: exact where every coordinate is finite and the non-zero coordinates of one call lie within a factor 2^640
// (4e192) of one another, whatever their common scale. Outside it products underflow and the sign may be wrong.
// Everything here is pure and safe on every thread.
#pragma once

#include <cmath>
#include <cstdint>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

namespace detail {

/// Half an ulp of 1.
inline constexpr double kRoundOff = 0x1p-53;
/// Relative rounding errors of the determinants below, as computed (Shewchuk 1997, figures 19 and 21: A bounds).
inline constexpr double kOrient2dError = (3.0 + 16.0 * kRoundOff) * kRoundOff;
inline constexpr double kOrient3dError = (7.0 + 56.0 * kRoundOff) * kRoundOff;
/// More than what underflow can add to a determinant within the documented range. Smaller determinants go to the
/// exact path, which rescales.
inline constexpr double kUnderflowGuard = 1e-250;

int orient2d_exact(double ax, double ay, double bx, double by, double cx, double cy);
int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The sign of a value whose absolute error is at most `bound`, or 0 where it is not certain (NaN included).
inline int certain_sign(double value, double bound) {
  return static_cast<int>(value > bound) - static_cast<int>(-value > bound);
}

}  // namespace detail

/// Finds on which side of the directed line a → b the point c lies, exactly.
///
/// @param ax, ay, bx, by, cx, cy  coordinates of a, b and c; any unit; range: see the top of this file.
/// @return 1 where a, b, c turn counter-clockwise, −1 where clockwise, 0 where they are collinear.
/// Cost: about 2 ns; about 30 ns where the points are collinear within rounding.
/// **Source:** Shewchuk 1997, ORIENT2D.
inline int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (bx - ax) * (cy - ay);
  const double right = (by - ay) * (cx - ax);
  const double bound = detail::kOrient2dError * (std::abs(left) + std::abs(right)) + detail::kUnderflowGuard;
  const int sign = detail::certain_sign(left - right, bound);
  return sign != 0 ? sign : detail::orient2d_exact(ax, ay, bx, by, cx, cy);
}

/// Finds the sign of orient3d where rounding cannot change it, and 0 elsewhere: the fast half of `orient3d`.
inline int orient3d_filter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double ux = b.x() - a.x(), uy = b.y() - a.y(), uz = b.z() - a.z();
  const double vx = c.x() - a.x(), vy = c.y() - a.y(), vz = c.z() - a.z();
  const double wx = d.x() - a.x(), wy = d.y() - a.y(), wz = d.z() - a.z();
  const double uyvz = uy * vz, uzvy = uz * vy;
  const double uzvx = uz * vx, uxvz = ux * vz;
  const double uxvy = ux * vy, uyvx = uy * vx;
  const double det = wx * (uyvz - uzvy) + wy * (uzvx - uxvz) + wz * (uxvy - uyvx);
  const double permanent = (std::abs(uyvz) + std::abs(uzvy)) * std::abs(wx) +
                           (std::abs(uzvx) + std::abs(uxvz)) * std::abs(wy) +
                           (std::abs(uxvy) + std::abs(uyvx)) * std::abs(wz);
  return detail::certain_sign(det, detail::kOrient3dError * permanent + detail::kUnderflowGuard);
}

/// Finds the sign of the volume of the tet a, b, c, d, exactly.
///
/// @param a, b, c, d  four points; any unit; range: see the top of this file.
/// @return the sign of (b−a)×(c−a)·(d−a): 1 for a positively oriented tet, −1 for an inverted one, 0 for a flat one.
/// Cost: about 4 ns; 0.1 to 0.4 µs where the points are coplanar within rounding.
/// **Source:** Shewchuk 1997, ORIENT3D; its filter A and an exact determinant, without the stages between.
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int sign = orient3d_filter(a, b, c, d);
  return sign != 0 ? sign : detail::orient3d_exact(a, b, c, d);
}

/// A point with the key that fixes its infinitesimal perturbation.
///
/// Coordinate j (x, y, z = 0, 1, 2) of the point with the r-th smallest key of all is thought to be larger by
/// ε^(2^(3r + j)) with ε → 0+. The perturbations depend on the keys alone, so all signs computed below are the signs
/// of one and the same set of points in general position. Equal keys mean the same point.
struct SosPoint {
  Vec3 position;      ///< in any unit
  std::uint64_t key;  ///< smaller key: larger perturbation; different for different points
};

/// Finds the sign that the perturbation gives to a tet whose `orient3d` is 0.
///
/// @param a, b, c, d  four points of different keys that are exactly coplanar (which is not checked).
/// @return 1 or −1; 0 only where two keys are equal.
/// Cost: sorts four keys, then evaluates at most 17 minors, mostly one or two `orient2d`.
/// **Source:** Edelsbrunner & Mücke 1990, §3. Differs: the order of the minors is generated from the definition of
/// `SosPoint`, whose exponents differ from theirs.
int orient3d_sos_tie(const SosPoint& a, const SosPoint& b, const SosPoint& c, const SosPoint& d);

/// Finds the sign of the volume of the perturbed tet a, b, c, d.
///
/// @param a, b, c, d  four points of different keys; positions may coincide, be collinear or coplanar.
/// @return `orient3d` where that is not 0, else `orient3d_sos_tie`: 1 or −1, odd under exchange of two points.
/// Cost: that of `orient3d`, and about 0.1 µs more for coplanar points.
/// **Source:** Edelsbrunner & Mücke 1990.
inline int orient3d_sos(const SosPoint& a, const SosPoint& b, const SosPoint& c, const SosPoint& d) {
  int sign = orient3d_filter(a.position, b.position, c.position, d.position);
  if (sign == 0) {
    sign = detail::orient3d_exact(a.position, b.position, c.position, d.position);
    if (sign == 0) {
      sign = orient3d_sos_tie(a, b, c, d);
    }
  }
  return sign;
}

/// Finds whether the perturbed segment p q crosses the perturbed triangle a b c.
///
/// No case is degenerate: over a closed surface the number of crossings is even exactly where both ends lie on the
/// same side. Two triangles that share an edge never both count, or both miss, a segment that passes through it.
/// @param p, q, a, b, c  five points of different keys.
/// @param side_of_p      where given, receives `orient3d_sos(a, b, c, p)`: the side of the triangle's plane that p is
///                       on, 1 where the normal (b−a)×(c−a) points. Set whether or not there is a crossing.
/// Cost: two to five times `orient3d_sos`.
/// **Source:** Edelsbrunner & Mücke 1990, §5.
inline bool segment_crosses_triangle(const SosPoint& p, const SosPoint& q, const SosPoint& a, const SosPoint& b,
                                     const SosPoint& c, int* side_of_p = nullptr) {
  const int side = orient3d_sos(a, b, c, p);
  if (side_of_p != nullptr) {
    *side_of_p = side;
  }
  if (side == orient3d_sos(a, b, c, q)) {
    return false;
  }
  const int turn = orient3d_sos(p, q, a, b);
  return turn == orient3d_sos(p, q, b, c) && turn == orient3d_sos(p, q, c, a);
}

}  // namespace v0
}  // namespace incise
