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
constexpr double kJaw = 0.5, kFold = 0.12;                 // of the hook's radius, as drawn: open, and on what is held
// Aside by up, of what pulls: a hook's shaft lies low and hides no wound; a retractor's handle is bent already.
constexpr double kHookLean = 2, kRetractorLean = 0.7;
constexpr double kPinHead = 1.6, kLeastPinHead = 0.014;  // its radius: mm, and of half a picture's height
constexpr double kPinHeight = 3;                         // of that radius: of the head's middle above the skin
constexpr float kPinNeedle = 2;                          // pixels
constexpr double kLeastCosine = 1e-3;                    // of a ray to the middle of the view: none are in a picture

double depth_of(const Camera& camera, const Vec3& point) {
  return (camera.eye() - point).dot(camera.backward());
}

double head_radius(const Pin& pin, const Camera& camera) {
  const double half_height = depth_of(camera, pin.hook.position) * std::tan(0.5 * camera.field_of_view);
  return std::max(kPinHead * pin.millimetre, kLeastPinHead * half_height);
}

Vec3 head_of(const Pin& pin, const Camera& camera) {
  return pin.hook.position + kPinHeight * head_radius(pin, camera) * pin.normal;
}

}  // namespace

Grasp::Grasp(const Hook& hook, const Camera& camera, GraspWay way, const Vec3& normal)
    : hook_(hook),
      grasped_(hook.position),
      depth_(depth_of(camera, grasped_)),
      first_depth_(depth_),
      way_(way),
      normal_(normal),
      level_(grasped_) {}

void Grasp::take(const Camera& camera) {
  depth_ = first_depth_ = depth_of(camera, hook_.position);
  level_ = hook_.position;
}

/// Where a ray meets the plane along the surface, if it meets it steeply, and not far beyond what was grasped.
std::optional<Vec3> Grasp::along_surface(const Ray& ray) const {
  const double cosine = -ray.direction.dot(normal_);
  if (cosine < kLeastSteep) return std::nullopt;
  const double way = (ray.origin - level_).dot(normal_) / cosine;
  if (!(way > kNearestShare * first_depth_ && way < kFarthestAlong * first_depth_)) return std::nullopt;
  return Vec3(ray.origin + way * ray.direction);
}

std::optional<Vec3> Grasp::across_view(const Ray& ray, const Camera& camera) const {
  const double cosine = -ray.direction.dot(camera.backward());
  if (!(cosine > kLeastCosine)) return std::nullopt;
  return Vec3(ray.origin + depth_ / cosine * ray.direction);
}

void Grasp::move(const Ray& ray, const Camera& camera) {
  std::optional<Vec3> place = across_view(ray, camera);
  const bool is_below = place && (*place - level_).dot(normal_) < 0;
  if (way_ == GraspWay::kAlongSurface || (way_ == GraspWay::kLifting && is_below)) {
    const std::optional<Vec3> along = along_surface(ray);
    if (along && way_ == GraspWay::kAlongSurface) depth_ = depth_of(camera, *along);
    if (along) place = along;
  }
  if (place) hook_.position = *place;
}

void Grasp::push(double notches, const Camera& camera) {
  const double wanted = depth_ + kPushPerNotch * hook_.radius * notches;
  const double depth = std::clamp(wanted, kNearestShare * first_depth_, kFarthestShare * first_depth_);
  const Vec3 old = hook_.position;
  hook_.position = camera.eye() + depth / depth_ * (old - camera.eye());
  level_ += hook_.position - old;
  depth_ = depth;
}

void Grasp::draw(Marks& marks) const {
  marks.balls.push_back({hook_.position.cast<float>(), Ink::kHook, 6, true});
}

Instrument instrument_at(const Hook& hook, const Vec3& grasped, const HeldBy& by, const Camera& camera) {
  Instrument made;
  made.kind = by.kind;
  made.tip = hook.position;
  made.millimetre = by.millimetre;
  if (by.kind == InstrumentKind::kForceps) {
    made.up = (camera.backward() + 0.6 * camera.right()).normalized();
    made.ahead = camera.right();  // both arms are seen, one above the other
    made.opening = 2 * (hook.closed > 0 ? kFold : kJaw) * hook.radius;
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

std::optional<std::size_t> find_place(const std::vector<Vec3>& places, const Camera& camera, const Viewport& viewport,
                                      const Vec2& pixel, double reach) {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::optional<Vec2> at = to_pixel(camera, viewport, places[i]);
    if (!at || (*at - pixel).norm() > reach) continue;
    reach = (*at - pixel).norm();
    nearest = i;
  }
  return nearest;
}

std::optional<std::size_t> find_pin(const std::vector<Pin>& pins, const Camera& camera, const Viewport& viewport,
                                    const Vec2& pixel, double reach) {
  std::vector<Vec3> places;
  for (const Pin& pin : pins) {
    places.push_back(pin.hook.position);
    places.push_back(head_of(pin, camera));
  }
  const std::optional<std::size_t> place = find_place(places, camera, viewport, pixel, reach);
  if (!place) return std::nullopt;
  return *place / 2;
}

void draw_pins(const std::vector<Pin>& pins, const Camera& camera, Marks& marks) {
  for (const Pin& pin : pins) {
    const Eigen::Vector3f point = pin.hook.position.cast<float>(), head = head_of(pin, camera).cast<float>();
    marks.lines.push_back({point, head, Ink::kTool, kPinNeedle, false, false});
    marks.balls.push_back({head, Ink::kPin, static_cast<float>(head_radius(pin, camera)), false});
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
