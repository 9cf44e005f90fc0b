// SPDX-License-Identifier: Apache-2.0
// The punch as a stroke of three rings of the same number of corners: above the skin, at most of the depth, and one
// point at its end.
#include "app/hands/punch.h"

#include <cmath>
#include <numbers>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr int kCorners = 16;                 // of the ring
constexpr double kStraightDepth = 0.8;       // of the depth: below, the ring draws together
constexpr double kRingLift = 0.5;            // above the surface at first, in radii: skin bulges into a ring
constexpr double kDriven = 0.5, kEnd = 0.8;  // s

/// A closed polyline around an axis.
std::vector<Vec3> ring(const Vec3& centre, const Vec3& axis, double radius) {
  const Vec3 x = axis.unitOrthogonal(), y = axis.cross(x);
  std::vector<Vec3> points;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    points.emplace_back(centre + radius * (std::cos(angle) * x + std::sin(angle) * y));
  }
  points.push_back(points.front());
  return points;
}

void draw_ring(const std::vector<Vec3>& points, bool is_dashed, Marks& marks) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    marks.lines.push_back({points[i - 1].cast<float>(), points[i].cast<float>(), Ink::kPreview, 2, true, is_dashed});
  }
}

}  // namespace

Stroke punch_stroke(const Vec3& point, const Vec3& normal, const ToolSettings& settings) {
  const double radius = settings.punch_radius;
  Stroke stroke;
  stroke.name = "punch";
  stroke.times = {0, kDriven, kEnd};
  stroke.edges = {ring(point + kRingLift * radius * normal, normal, radius),
                  ring(point - kStraightDepth * settings.depth * normal, normal, radius),
                  ring(point - settings.depth * normal, normal, 0)};
  return stroke;
}

void draw_punch(const Vec3& point, const Vec3& normal, const ToolSettings& settings, Marks& marks) {
  draw_ring(ring(point, normal, settings.punch_radius), false, marks);
  draw_ring(ring(point - settings.depth * normal, normal, settings.punch_radius), true, marks);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
