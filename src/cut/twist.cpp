// SPDX-License-Identifier: Apache-2.0
// A segment is divided at the point that it turns about, then into equal parts until the two triangles of each lie
// near the ruled surface (docs/internals.md, 3.1).
#include "cut/twist.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cut/blade_constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// How far the middle of the ruled surface between two segments lies off the diagonal of its two triangles.
double twist_of(const Vec3& a, const Vec3& b, const Vec3& d, const Vec3& e) {
  const Vec3 normal = (e - a).cross(d - b);
  const double length = normal.norm();
  return length > 0 ? 0.25 * std::abs((a + e - b - d).dot(normal)) / length : 0.0;
}

std::vector<double> even_shares(double parts) {
  std::vector<double> shares;
  for (double k = 1; k <= parts; ++k) shares.push_back(k / parts);
  return shares;
}

/// Where a segment turns about a point between its ends, as a share of its length: the point that moves least. Not
/// where that moves about as far as they do, nor where they hardly move.
std::optional<double> pivot_of(const Vec3& a, const Vec3& b, const Vec3& d, const Vec3& e, double tolerance) {
  const Vec3 way_a = d - a, way_b = e - b, change = way_b - way_a;
  const double least = std::min(way_a.norm(), way_b.norm());
  if (!(way_a.dot(way_b) < 0) || !(least > tolerance)) return std::nullopt;
  const double share = -way_a.dot(change) / change.squaredNorm();
  return (way_a + share * change).norm() < kPivotShare * least ? std::optional(share) : std::nullopt;
}

using Shares = std::vector<std::vector<double>>;

/// The shares of segments whose parts are divided in turn, part by part.
Shares divided_further(const Shares& coarse, const Shares& parts) {
  Shares all;
  std::size_t c = 0;
  for (const std::vector<double>& shares : coarse) {
    std::vector<double> finer;
    double start = 0;
    for (const double end : shares) {
      for (const double t : parts[c]) finer.push_back(t == 1.0 ? end : start + t * (end - start));
      start = end;
      ++c;
    }
    all.push_back(std::move(finer));
  }
  return all;
}

bool divides(const Shares& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const auto& shares) { return shares.size() > 1; });
}

Shares at_pivots(std::span<const Vec3> from, std::span<const Vec3> to, double tolerance) {
  Shares parts;
  for (std::size_t c = 0; c + 1 < from.size(); ++c) {
    const auto pivot = pivot_of(from[c], from[c + 1], to[c], to[c + 1], tolerance);
    parts.push_back(pivot ? std::vector<double>{*pivot, 1.0} : std::vector<double>{1.0});
  }
  return parts;
}

Shares where_twisted(std::span<const Vec3> from, std::span<const Vec3> to, double tolerance) {
  Shares parts;
  for (std::size_t c = 0; c + 1 < from.size(); ++c) {
    const double twist = twist_of(from[c], from[c + 1], to[c], to[c + 1]);
    parts.push_back(even_shares(std::clamp(std::ceil(twist / tolerance), 1.0, kMostTwistParts)));
  }
  return parts;
}

}  // namespace

Shares EdgeDivision::divide(std::span<const Vec3> from, std::span<const Vec3> to, double tolerance) {
  Shares parts = at_pivots(from, to, tolerance);
  const std::vector<Vec3> finer_from = incise::divided(from, parts), finer_to = incise::divided(to, parts);
  parts = divided_further(parts, where_twisted(finer_from, finer_to, tolerance));
  if (!divides(parts)) return {};
  shares_ = divided_further(shares_, parts);
  return parts;
}

std::vector<Vec3> divided(std::span<const Vec3> row, const std::vector<std::vector<double>>& shares) {
  std::vector<Vec3> points = {row.front()};
  for (std::size_t c = 0; c < shares.size(); ++c) {
    for (const double t : shares[c]) {
      points.push_back(t == 1.0 ? row[c + 1] : Vec3(row[c] + t * (row[c + 1] - row[c])));
    }
  }
  return points;
}

EdgeDivision division_of(const Stroke& stroke, double tolerance) {
  EdgeDivision division(stroke.edges.front().size());
  for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
    division.divide(division.divided(stroke.edges[i - 1]), division.divided(stroke.edges[i]), tolerance);
  }
  return division;
}

Stroke with_divided_edge(const Stroke& stroke, double tolerance) {
  const EdgeDivision division = division_of(stroke, tolerance);
  Stroke divided = stroke;
  for (std::vector<Vec3>& edge : divided.edges) edge = division.divided(edge);
  for (std::size_t i = 1; i < divided.edges.size(); ++i) {  // what an edge turns about does not move
    for (std::size_t c = 0; c < divided.edges[i].size(); ++c) {
      const Vec3& before = divided.edges[i - 1][c];
      if ((divided.edges[i][c] - before).norm() <= kHolds * tolerance) divided.edges[i][c] = before;
    }
  }
  return divided;
}

}  // namespace v0
}  // namespace incise
