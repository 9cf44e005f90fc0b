// SPDX-License-Identifier: Apache-2.0
// A pointer has two coordinates: a hook gets its third from the plane across the view through what it grasped, or from
// the plane along the surface there.
#include "app/hands/grip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kPushPerNotch = 0.5;                      // of the hook's radius
constexpr double kNearestShare = 0.2, kFarthestShare = 5;  // of the depth of what was grasped
constexpr double kLeastSteep = 0.3;                        // cosine of a ray to a surface that a hook is led along
constexpr double kFarthestAlong = 2;                       // of the depth of what was grasped, on that way
constexpr double kJaw = 0.5;                               // of the hook's radius, as drawn
// Aside by up, of what pulls: a hook's shaft lies low and hides no wound; a retractor's handle is bent already.
constexpr double kHookLean = 2, kRetractorLean = 0.7;
constexpr double kLeastCosine = 1e-3;  // of a ray to the middle of the view: none are in a picture

double depth_of(const Camera& camera, const Vec3& point) {
  return (camera.eye() - point).dot(camera.backward());
}

}  // namespace

Grasp::Grasp(const Hook& hook, const Camera& camera)
    : hook_(hook), grasped_(hook.position), depth_(depth_of(camera, grasped_)), first_depth_(depth_) {}

void Grasp::take(const Camera& camera) {
  depth_ = first_depth_ = depth_of(camera, hook_.position);
}

Grasp::Grasp(const Hook& hook, const Camera& camera, const Vec3& normal) : Grasp(hook, camera) {
  normal_ = normal;
}

/// Where a ray meets the plane along the surface through the hook, if it meets it steeply, and not far beyond what was
/// grasped.
std::optional<Vec3> Grasp::along_surface(const Ray& ray) const {
  const double cosine = -ray.direction.dot(normal_);
  if (cosine < kLeastSteep) return std::nullopt;
  const double way = (ray.origin - hook_.position).dot(normal_) / cosine;
  if (!(way > kNearestShare * first_depth_ && way < kFarthestAlong * first_depth_)) return std::nullopt;
  return Vec3(ray.origin + way * ray.direction);
}

void Grasp::move(const Ray& ray, const Camera& camera) {
  if (const std::optional<Vec3> place = along_surface(ray)) {
    hook_.position = *place;
    depth_ = depth_of(camera, *place);
    return;
  }
  const double cosine = -ray.direction.dot(camera.backward());
  if (cosine > kLeastCosine) hook_.position = ray.origin + depth_ / cosine * ray.direction;
}

void Grasp::push(double notches, const Camera& camera) {
  const double wanted = depth_ + kPushPerNotch * hook_.radius * notches;
  const double depth = std::clamp(wanted, kNearestShare * first_depth_, kFarthestShare * first_depth_);
  hook_.position = camera.eye() + depth / depth_ * (hook_.position - camera.eye());
  depth_ = depth;
}

void Grasp::draw(Marks& marks) const {
  const Eigen::Vector3f to = hook_.position.cast<float>();
  marks.lines.push_back({grasped_.cast<float>(), to, Ink::kHook, 2, true, false});
  marks.balls.push_back({to, Ink::kHook, 6, true});
}

Instrument instrument_at(const Hook& hook, const Vec3& grasped, const HeldBy& by, const Camera& camera) {
  Instrument made;
  made.kind = by.kind;
  made.tip = hook.position;
  made.millimetre = by.millimetre;
  if (by.kind == InstrumentKind::kForceps) {
    made.up = (camera.backward() + 0.6 * camera.right()).normalized();
    made.ahead = camera.upward();
    made.opening = 2 * kJaw * (1 - hook.closed) * hook.radius;
    return made;
  }
  const Vec3 pull = hook.position - grasped;
  const Vec3 flat = pull - pull.dot(by.normal) * by.normal;
  made.ahead = flat;
  const double most = by.kind == InstrumentKind::kHook ? kHookLean : kRetractorLean;
  const double lean = hook.radius > 0 ? std::min(1.0, flat.norm() / hook.radius) : 0;
  made.up = (by.normal + most * lean * flat.stableNormalized()).normalized();
  return made;
}

void draw_circle(const Vec3& centre, const Vec3& normal, double radius, Marks& marks) {
  constexpr int kCorners = 16;
  const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
  Vec3 last = centre + radius * x;
  for (int i = 1; i <= kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const Vec3 next = centre + radius * (std::cos(angle) * x + std::sin(angle) * y);
    marks.lines.push_back({last.cast<float>(), next.cast<float>(), Ink::kPreview, 1.5F, true, false});
    last = next;
  }
}

std::optional<std::size_t> find_pin(const std::vector<Hook>& pins, const Camera& camera, const Viewport& viewport,
                                    const Vec2& pixel, double reach) {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const std::optional<Vec2> at = to_pixel(camera, viewport, pins[i].position);
    if (!at || (*at - pixel).norm() > reach) continue;
    reach = (*at - pixel).norm();
    nearest = i;
  }
  return nearest;
}

void draw_pins(const std::vector<Hook>& pins, Marks& marks) {
  for (const Hook& pin : pins) marks.balls.push_back({pin.position.cast<float>(), Ink::kPin, 6, true});
}

}  // namespace app
}  // namespace v0
}  // namespace incise
