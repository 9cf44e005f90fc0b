// SPDX-License-Identifier: Apache-2.0
// All points are turned into the ray's frame once; a triangle is met if the origin lies in it as seen along the ray.
#include "app/view/picking.h"

#include <array>
#include <limits>
#include <vector>

#include "incise/geom/closest.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// A point as the ray sees it: across the ray, and along it.
struct Seen {
  double x, y, along;
};

double area(const Seen& a, const Seen& b) {
  return a.x * b.y - a.y * b.x;
}

/// Once per point, so that triangles cost little. The two axes and the ray are a right-handed frame.
std::vector<Seen> seen_along(const Ray& ray, const std::vector<Eigen::Vector3f>& positions) {
  const Vec3 x = ray.direction.unitOrthogonal(), y = ray.direction.cross(x);
  std::vector<Seen> seen;
  seen.reserve(positions.size());
  for (const Eigen::Vector3f& p : positions) {
    const Vec3 from_origin = p.cast<double>() - ray.origin;
    seen.push_back({from_origin.dot(x), from_origin.dot(y), from_origin.dot(ray.direction)});
  }
  return seen;
}

/// How far along the ray it meets a triangle's front; infinity where it does not. Triangles that share an edge compute
/// the same area of it but for the sign, so that no ray slips through between them.
double met_at(const Seen& a, const Seen& b, const Seen& c) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  // Seen along the ray, what is counter-clockwise from outside runs clockwise.
  const double opposite_a = area(c, b), opposite_b = area(a, c), opposite_c = area(b, a);
  if (opposite_a < 0 || opposite_b < 0 || opposite_c < 0) return kNowhere;
  const double sum = opposite_a + opposite_b + opposite_c;
  if (!(sum > 0)) return kNowhere;
  const double along = (opposite_a * a.along + opposite_b * b.along + opposite_c * c.along) / sum;
  return along >= 0 ? along : kNowhere;
}

Vec3 rest_of(const SurfaceTopology& topology, std::size_t triangle, const std::array<double, 3>& weights) {
  Vec3 place = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    place += weights[i] * topology.rest[topology.triangles[triangle][i]].cast<double>();
  }
  return place;
}

}  // namespace

std::optional<SurfaceHit> pick(const SurfaceFrame& surface, const Ray& ray) {
  if (!surface.topology) return std::nullopt;
  const SurfaceTopology& topology = *surface.topology;
  const std::vector<Seen> seen = seen_along(ray, surface.positions);
  SurfaceHit hit;
  hit.distance = std::numeric_limits<double>::infinity();
  for (std::size_t slot = 0; slot < topology.triangles.size(); ++slot) {
    if ((topology.looks[slot].flags & TriangleLook::kUnused) != 0) continue;
    const auto& [a, b, c] = topology.triangles[slot];
    const double distance = met_at(seen[a], seen[b], seen[c]);
    if (!(distance < hit.distance)) continue;
    hit.distance = distance;
    hit.triangle = slot;
  }
  if (hit.distance == std::numeric_limits<double>::infinity()) return std::nullopt;
  const auto& [a, b, c] = topology.triangles[hit.triangle];
  const Vec3 from = surface.positions[a].cast<double>();
  const Vec3 to_b = surface.positions[b].cast<double>() - from, to_c = surface.positions[c].cast<double>() - from;
  hit.side = topology.sides[hit.triangle];
  hit.point = ray.origin + hit.distance * ray.direction;
  hit.normal = to_b.cross(to_c).stableNormalized();
  if (topology.rest.empty()) {
    hit.rest = hit.point;
    return hit;
  }
  hit.rest = rest_of(topology, hit.triangle, closest_on_triangle(hit.point, from, from + to_b, from + to_c).weights);
  return hit;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
