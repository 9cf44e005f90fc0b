// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "incise/cut/stroke.h"

namespace incise {
inline namespace v0 {

/// A row whose segments are divided at shares of their lengths, the last one of each 1.
[[nodiscard]] std::vector<Vec3> divided(std::span<const Vec3> row, const std::vector<std::vector<double>>& shares);

/// Where the segments of a blade's edge are divided so that what they sweep is smooth.
///
/// A segment that turns while it moves sweeps a ruled surface that is no plane. Two triangles stand for it, and fold
/// along their diagonal by as much as the way of its ends differs, however short the step: the blade seems to cut the
/// same edges twice. Parts of the segment fold less. One that turns about a point between its ends moves one way on one
/// side of that and the other way on the other: its two triangles, between four corners in turn, would cover all that
/// lies between these, most of which it has not come to, and again in each step. So it is divided at that point, which
/// all that it sweeps then shares. Paper §2.2 (sweep face): differs in that its quads are taken as they are.
class EdgeDivision {
 public:
  /// An edge of `points` points, at least 2, undivided.
  explicit EdgeDivision(std::size_t points = 2) : shares_(points - 1, {1.0}) {}

  /// Divides the segments further that turn on the way between two divided rows: where they turn about a point of their
  /// own and both ends move by more than `tolerance` (length units, above 0), and until their triangles lie within it
  /// of the ruled surface; at most `kMostTwistParts` parts at a time of a segment, or of each side of that point.
  /// Returns the shares at which each segment of a divided row is divided now, the last one 1; empty where nothing
  /// changes. Cost: O(points).
  std::vector<std::vector<double>> divide(std::span<const Vec3> from, std::span<const Vec3> to, double tolerance);
  /// How many points the undivided edge has.
  [[nodiscard]] std::size_t points() const { return shares_.size() + 1; }
  /// A row of the edge with the points in between.
  [[nodiscard]] std::vector<Vec3> divided(std::span<const Vec3> row) const { return incise::divided(row, shares_); }

 private:
  std::vector<std::vector<double>> shares_;  // of each segment of the edge, the last one 1
};

/// How the edge of a whole stroke is divided, in the end and so all along. `stroke` must pass `check`.
[[nodiscard]] EdgeDivision division_of(const Stroke& stroke, double tolerance);
/// A stroke with points added to its edge, so that what it sweeps is smooth all along. `stroke` must pass `check`.
[[nodiscard]] Stroke with_divided_edge(const Stroke& stroke, double tolerance);

}  // namespace v0
}  // namespace incise
