// SPDX-License-Identifier: Apache-2.0
#include "cut/twist.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

std::vector<std::vector<double>> EdgeDivision::divide(std::span<const Vec3> from, std::span<const Vec3> to,
                                                      double tolerance) {
  std::vector<std::vector<double>> parts;
  std::size_t most = 1;
  for (std::size_t c = 0; c + 1 < from.size(); ++c) {
    const double twist = twist_of(from[c], from[c + 1], to[c], to[c + 1]);
    parts.push_back(even_shares(std::clamp(std::ceil(twist / tolerance), 1.0, kMostParts)));
    most = std::max(most, parts.back().size());
  }
  if (most == 1) return {};
  std::size_t c = 0;
  for (std::vector<double>& shares : shares_) {
    std::vector<double> finer;
    double start = 0;
    for (const double end : shares) {
      for (const double t : parts[c]) finer.push_back(t == 1.0 ? end : start + t * (end - start));
      start = end;
      ++c;
    }
    shares = std::move(finer);
  }
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

Stroke with_divided_edge(const Stroke& stroke, double tolerance) {
  EdgeDivision division(stroke.edges.front().size());
  for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
    division.divide(division.divided(stroke.edges[i - 1]), division.divided(stroke.edges[i]), tolerance);
  }
  Stroke divided = stroke;
  for (std::vector<Vec3>& edge : divided.edges) edge = division.divided(edge);
  return divided;
}

}  // namespace v0
}  // namespace incise
