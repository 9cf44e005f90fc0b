// SPDX-License-Identifier: Apache-2.0
#include "app/hands/grip.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kPushPerNotch = 0.5;                      // of the hook's radius
constexpr double kNearestShare = 0.2, kFarthestShare = 5;  // of the depth of what was grasped
constexpr double kLeastCosine = 1e-3;                      // of a ray to the middle of the view: none are in a picture

double depth_of(const Camera& camera, const Vec3& point) {
  return (camera.eye() - point).dot(camera.backward());
}

}  // namespace

Grasp::Grasp(const Hook& hook, const Camera& camera)
    : hook_(hook), grasped_(hook.position), depth_(depth_of(camera, grasped_)), first_depth_(depth_) {}

void Grasp::move(const Ray& ray, const Camera& camera) {
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
