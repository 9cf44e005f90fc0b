// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/geom/box.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// A blade's motion through the rest shape: its cutting edge as a polyline at increasing times.
///
/// Between two times the blade sweeps the strip of quads between the two polylines, each split along the diagonal from
/// the earlier first point to the later second. Each pair of times is one step. Where the first and last point of
/// every polyline are bitwise equal the edge is closed (coring). A single time sweeps nothing.
struct Stroke {
  std::string name;                      ///< for messages; may be empty
  std::vector<double> times;             ///< s, strictly increasing, `n_times`
  std::vector<std::vector<Vec3>> edges;  ///< `n_times × n_points`, n_points ≥ 2 and the same at all times
};

/// Whether a stroke keeps the promises above, has at least two times and is finite; the error names the time and point.
Status check(const Stroke& stroke);

/// The greatest distance of a blade from the body's box, in units of the longest side of that box. Rounding of a point
/// that is further away could move the cut by a noticeable share of an element.
inline constexpr double kGreatestReach = 1e6;

/// Whether a stroke keeps within `kGreatestReach` of a body; the error names stroke, time and point. True where the
/// body is empty or a point. Cost: O(points).
Status check_reach(const Stroke& stroke, const Box& body);
/// The same for the blade's edge at one moment, which the error calls `name`.
Status check_reach(std::span<const Vec3> edge, const Box& body, const std::string& name);

/// The triangles that a stroke sweeps, without empty ones.
struct SweptTriangles {
  std::vector<Vec3> points;                             ///< in the rest shape, length unit
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `points`
};

/// The sweep of a sound stroke (see `check`). Cost: O(points).
SweptTriangles swept_triangles(const Stroke& stroke);

/// A stroke that cuts through everything in `bounds` along the plane n·x = d, in one step.
///
/// `normal` of any non-zero finite length. The sweep is exactly planar: one triangle (the second of its quad is empty).
/// Errors: kBadArgument for a zero or non-finite plane, and where `bounds` hold nothing.
Result<Stroke> plane_stroke(const Box& bounds, const Vec3& normal, double offset);

}  // namespace v0
}  // namespace incise
