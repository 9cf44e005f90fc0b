// SPDX-License-Identifier: Apache-2.0
// A tree over the triangles with a dipole for each node; solid angles by an arc tangent of four operations, so that
// bits agree everywhere.
#include "image/winding_number.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint32_t kLeaf = 8;
/// Distance in radii from which on triangles count as one dipole.
constexpr double kFarRadii = 2.5;

/// Of t in [0, 1]: t = tan(2a) is brought down twice to tan(a / 2) < 0.2, where the series ends soon.
double arc_tangent(double t) {
  t = t / (1 + std::sqrt(1 + t * t));
  t = t / (1 + std::sqrt(1 + t * t));
  const double t2 = t * t;
  double sum = 0;
  for (int n = 13; n >= 1; n -= 2) sum = 1.0 / n - t2 * sum;
  return 4 * t * sum;
}

/// Half the solid angle of a triangle seen from the origin; positive where it turns counter-clockwise seen from behind.
double half_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double volume = a.dot(b.cross(c));
  const double scale = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return volume == 0 && scale == 0 ? 0 : angle_of(volume, scale);
}

}  // namespace

double angle_of(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? arc_tangent(ay / ax) : kPi / 2 - arc_tangent(ax / ay);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

WindingNumber::WindingNumber(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  corners_.reserve(triangles.size());
  for (const Triangle& t : triangles) corners_.push_back({points[t[0]], points[t[1]], points[t[2]]});
  if (!corners_.empty()) build(0, static_cast<std::uint32_t>(corners_.size()));
}

void WindingNumber::build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t n = nodes_.size();
  nodes_.emplace_back();
  Node node;
  node.begin = begin;
  node.end = end;
  Box middles;
  double sum = 0;
  const auto middle_of = [](const std::array<Vec3, 3>& c) { return Vec3((c[0] + c[1] + c[2]) / 3); };
  for (std::uint32_t t = begin; t < end; ++t) {
    const auto& c = corners_[t];
    const Vec3 area = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
    const double size = area.norm();
    node.area += area;
    node.middle += size * middle_of(c);
    sum += size;
    middles.extend(middle_of(c));
  }
  node.middle = sum > 0 ? Vec3(node.middle / sum) : middle_of(corners_[begin]);
  for (std::uint32_t t = begin; t < end; ++t) {
    for (const Vec3& p : corners_[t]) node.radius2 = std::max(node.radius2, (p - node.middle).squaredNorm());
  }
  if (end - begin > kLeaf) {
    Eigen::Index axis = 0;
    (void)(middles.hi - middles.lo).maxCoeff(&axis);
    std::stable_sort(corners_.data() + begin, corners_.data() + end,
                     [&](const auto& a, const auto& b) { return middle_of(a)[axis] < middle_of(b)[axis]; });
    build(begin, begin + (end - begin) / 2);
    node.second = static_cast<std::uint32_t>(nodes_.size());
    build(begin + (end - begin) / 2, end);
  }
  nodes_[n] = node;
}

double WindingNumber::operator()(const Vec3& p) const {
  std::array<std::uint32_t, 64> stack{};
  std::size_t depth = 0;
  double angle = 0;  // half the solid angle
  if (!nodes_.empty()) stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t n = stack[--depth];
    const Node& node = nodes_[n];
    const Vec3 away = node.middle - p;
    const double distance2 = away.squaredNorm();
    if (distance2 > kFarRadii * kFarRadii * node.radius2) {
      if (distance2 > 0) angle += 0.5 * node.area.dot(away) / (distance2 * std::sqrt(distance2));
    } else if (node.second != 0) {
      stack[depth++] = node.second;
      stack[depth++] = n + 1;
    } else {
      for (std::uint32_t t = node.begin; t < node.end; ++t) {
        angle += half_solid_angle(corners_[t][0] - p, corners_[t][1] - p, corners_[t][2] - p);
      }
    }
  }
  return angle / (2 * kPi);
}

}  // namespace image
}  // namespace v0
}  // namespace incise
