// SPDX-License-Identifier: Apache-2.0
// The plane is laid as far as the box of the body reaches, seen from the eye along the two middle directions; the
// stroke is one edge moved from one end to the other.
#include "app/view/plane_cut.h"

#include <algorithm>
#include <limits>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kLeastPixels = 8;
constexpr double kMargin = 0.1;       // of the body's extent
constexpr double kLeastDepth = 0.05;  // of the line that is shown, of the distance to the target

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// What a box covers along a unit direction, from a point, with a margin.
Extent extent_of(const Box& box, const Vec3& from, const Vec3& direction) {
  const Vec3 middle = 0.5 * (box.lo + box.hi), half = 0.5 * (box.hi - box.lo);
  const double centre = (middle - from).dot(direction);
  // Of the diagonal, so that flat boxes keep a distance too.
  const double reach = half.dot(direction.cwiseAbs()) + kMargin * half.norm();
  return {centre - reach, centre + reach};
}

bool is_sound(const Box& box) {
  return !box.is_empty() && box.lo.allFinite() && box.hi.allFinite() && (box.hi - box.lo).norm() > 0;
}

}  // namespace

std::optional<PlaneCut> plane_cut_between(const Camera& camera, const Viewport& viewport, const Vec2& from,
                                          const Vec2& to, const Box& body) {
  if (!((to - from).norm() >= kLeastPixels) || !is_sound(body)) return std::nullopt;
  PlaneCut cut{ray_through(camera, viewport, from), ray_through(camera, viewport, to), {}};
  const Vec3 eye = cut.from.origin, normal = cut.from.direction.cross(cut.to.direction);
  const Vec3 inwards = (cut.from.direction + cut.to.direction).normalized();
  const Vec3 along = normal.cross(inwards).normalized();
  const Extent depth = extent_of(body, eye, inwards), width = extent_of(body, eye, along);
  cut.corners = {eye + depth.low * inwards + width.low * along, eye + depth.high * inwards + width.low * along,
                 eye + depth.low * inwards + width.high * along, eye + depth.high * inwards + width.high * along};
  return cut;
}

Stroke to_stroke(const PlaneCut& cut) {
  const auto& c = cut.corners;
  return {"plane cut", {0, 1}, {{c[0], c[1]}, {c[2], c[3]}}};
}

void draw(const PlaneCut& cut, const Camera& camera, Marks& marks) {
  // Before the body, so that none of it hides the line; not at the eye, where it would be clipped.
  const Vec3 inwards = (cut.from.direction + cut.to.direction).normalized();
  const double depth = std::max((cut.corners[0] - cut.from.origin).dot(inwards), kLeastDepth * camera.distance);
  const Vec3 from = cut.from.origin + depth / cut.from.direction.dot(inwards) * cut.from.direction;
  const Vec3 to = cut.to.origin + depth / cut.to.direction.dot(inwards) * cut.to.direction;
  marks.lines.push_back({from.cast<float>(), to.cast<float>(), Ink::kPreview, 2, true, false});
  std::array<Eigen::Vector3f, 4> c;
  std::transform(cut.corners.begin(), cut.corners.end(), c.begin(), [](const Vec3& p) { return p.cast<float>(); });
  marks.triangles.push_back({{c[0], c[1], c[2]}, Ink::kPreview});
  marks.triangles.push_back({{c[1], c[3], c[2]}, Ink::kPreview});
}

}  // namespace app
}  // namespace v0
}  // namespace incise
