// SPDX-License-Identifier: Apache-2.0
// Two points and a depth make scissors: the lower blade lies between them under the skin, and the upper one is turned
// about the hinge onto it in straight steps.
#include "app/hands/scissors.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kSeconds = 0.4;
constexpr int kTurnSteps = 8;          // of the turn: between two the edge goes straight
constexpr int kBladeSegments = 4;      // of the edge
constexpr double kHingeLift = 0.3;     // of the hinge above the skin, in depths
constexpr double kOpen = 0.6;          // rise of the upper blade per length, on skin
constexpr double kUpright = 3.5;       // the same from a rim: it has to clear the skin beside the hinge
constexpr double kSameSide = 0.7;      // cosine between the normals of the same skin, at least
constexpr double kShortestBite = 0.2;  // in depths

/// Where the pointer is on the plane through a place of the skin.
std::optional<Vec3> on_plane_of(const SurfaceHit& skin, const Ray& ray) {
  const double sine = -ray.direction.dot(skin.normal);
  if (!(sine > 0.02)) return std::nullopt;
  return Vec3(ray.origin + (ray.origin - skin.point).dot(skin.normal) / sine * ray.direction);
}

bool is_on_skin(const PointerPlace& place) {
  return place.hit && !place.is_wall;
}

}  // namespace

std::optional<ScissorsPlace> place_scissors(const PointerPlace& from, const PointerPlace& to,
                                            const ToolSettings& settings) {
  const bool ends_on_skin = is_on_skin(to);
  // Skin that faces elsewhere is the side of the body: they come over its rim.
  const bool begins_on_skin = is_on_skin(from) && (!ends_on_skin || from.hit->normal.dot(to.hit->normal) > kSameSide);
  if (!begins_on_skin && !ends_on_skin) return std::nullopt;
  const SurfaceHit& skin = ends_on_skin ? *to.hit : *from.hit;
  const std::optional<Vec3> a = begins_on_skin ? from.hit->point : on_plane_of(skin, from.ray);
  const std::optional<Vec3> b = ends_on_skin ? to.hit->point : on_plane_of(skin, to.ray);
  if (!a || !b) return std::nullopt;
  const Vec3 normal =
      begins_on_skin && ends_on_skin ? Vec3((from.hit->normal + to.hit->normal).stableNormalized()) : skin.normal;
  const Vec3 way = *b - *a, flat = way - way.dot(normal) * normal;
  if (!(flat.norm() >= kShortestBite * settings.depth)) return std::nullopt;
  ScissorsPlace place;
  place.hinge = *a + (begins_on_skin ? kHingeLift : -1.0) * settings.depth * normal;
  place.lower_tip = *b - settings.depth * normal;
  const double length = (place.lower_tip - place.hinge).norm();
  const double rise = begins_on_skin ? kOpen : kUpright;
  place.upper_tip = place.hinge + length * (flat.normalized() + rise * normal).normalized();
  return place;
}

Stroke to_stroke(const ScissorsPlace& place) {
  Stroke stroke;
  stroke.name = "scissors";
  const Vec3 open = place.upper_tip - place.hinge, closed = place.lower_tip - place.hinge;
  for (int step = 0; step <= kTurnSteps; ++step) {
    const double share = static_cast<double>(step) / kTurnSteps;
    const Vec3 blade = closed.norm() * ((1 - share) * open + share * closed).normalized();
    stroke.times.push_back(share * kSeconds);
    std::vector<Vec3>& edge = stroke.edges.emplace_back();
    for (int i = 0; i <= kBladeSegments; ++i)
      edge.emplace_back(place.hinge + static_cast<double>(i) / kBladeSegments * blade);
  }
  return stroke;
}

void draw(const ScissorsPlace& place, Marks& marks) {
  const Eigen::Vector3f hinge = place.hinge.cast<float>();
  for (const Vec3& tip : {place.upper_tip, place.lower_tip}) {
    const Vec3 handle = place.hinge - 0.5 * (tip - place.hinge);
    marks.lines.push_back({hinge, tip.cast<float>(), Ink::kBlade, 3, true, false});
    marks.lines.push_back({hinge, handle.cast<float>(), Ink::kBlade, 1.5F, true, false});
  }
  marks.balls.push_back({hinge, Ink::kBlade, 4, true});
}

}  // namespace app
}  // namespace v0
}  // namespace incise
