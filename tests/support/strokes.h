// SPDX-License-Identifier: Apache-2.0
// Blades for tests. Curves use + − × ÷ √ alone, so that they have the same bits on every target.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "incise/cut/stroke.h"

namespace incise::test {

/// A point of the unit circle, `turns` times around from (1, 0); not uniform in the angle.
inline std::pair<double, double> on_circle(double turns) {
  const double quarters = 4.0 * (turns - std::floor(turns));
  const double whole = std::floor(quarters);
  const double s = quarters - whole;  // tan of half the angle within the quarter
  const double x = (1.0 - s * s) / (1.0 + s * s), y = 2.0 * s / (1.0 + s * s);
  switch (static_cast<int>(whole)) {
    case 1:
      return {-y, x};
    case 2:
      return {-x, -y};
    case 3:
      return {y, -x};
    default:
      return {x, y};
  }
}

/// A stroke from its polylines, at times 0, 1, 2, …
inline Stroke stroke_of(std::vector<std::vector<Vec3>> edges) {
  Stroke stroke;
  stroke.name = "test";
  for (std::size_t i = 0; i < edges.size(); ++i) stroke.times.push_back(static_cast<double>(i));
  stroke.edges = std::move(edges);
  return stroke;
}

/// A straight blade a b that moves to c d, in `steps` steps.
inline Stroke quad_stroke(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, unsigned steps = 1) {
  std::vector<std::vector<Vec3>> edges;
  for (unsigned i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    edges.push_back({a + t * (c - a), b + t * (d - b)});
  }
  return stroke_of(std::move(edges));
}

/// A blade along z that follows a path in the xy-plane, one step per segment.
inline Stroke path_stroke(const std::vector<Vec3>& path, double z_low, double z_high) {
  std::vector<std::vector<Vec3>> edges;
  for (const Vec3& p : path) edges.push_back({Vec3(p.x(), p.y(), z_low), Vec3(p.x(), p.y(), z_high)});
  return stroke_of(std::move(edges));
}

/// The same surface in one step: the path itself is the blade, and moves along z.
inline Stroke profile_stroke(const std::vector<Vec3>& path, double z_low, double z_high) {
  std::vector<std::vector<Vec3>> edges(2);
  for (const Vec3& p : path) {
    edges[0].emplace_back(p.x(), p.y(), z_low);
    edges[1].emplace_back(p.x(), p.y(), z_high);
  }
  return stroke_of(std::move(edges));
}

/// Points of a circular arc around `centre`, from `from` to `to` turns.
inline std::vector<Vec3> arc_path(const Vec3& centre, double radius, double from, double to, unsigned segments) {
  std::vector<Vec3> path;
  for (unsigned i = 0; i <= segments; ++i) {
    const auto [x, y] = on_circle(from + (to - from) * static_cast<double>(i) / segments);
    path.emplace_back(centre.x() + radius * x, centre.y() + radius * y, 0.0);
  }
  return path;
}

/// A coring cylinder along z: a closed blade that moves from z_low to z_high.
inline Stroke coring_stroke(const Vec3& centre, double radius, unsigned segments, double z_low, double z_high) {
  std::vector<Vec3> path = arc_path(centre, radius, 0.0, 1.0, segments);
  path.back() = path.front();
  return profile_stroke(path, z_low, z_high);
}

/// The area inside a closed path in the xy-plane.
inline double area_inside(const std::vector<Vec3>& path) {
  double twice = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3& p = path[i];
    const Vec3& q = path[(i + 1) % path.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * std::abs(twice);
}

/// The stroke backwards: the same surface, swept from its end.
inline Stroke reversed(Stroke stroke) {
  return stroke_of({stroke.edges.rbegin(), stroke.edges.rend()});
}

/// The stroke followed by another, with equal numbers of points per polyline.
inline Stroke followed_by(Stroke first, const Stroke& second) {
  for (const auto& edge : second.edges) first.edges.push_back(edge);
  return stroke_of(std::move(first.edges));
}

}  // namespace incise::test
