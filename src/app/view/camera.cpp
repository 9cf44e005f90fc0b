// SPDX-License-Identifier: Apache-2.0
// Azimuth and elevation are measured in a ground plane across `up`, so that every `up` behaves alike. Framing looks at
// points one by one: perspective makes near ones larger than any box tells.
#include "app/view/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSteepestView = 0.5 * kPi - 1e-3;  // of `elevation`: straight down has no right and left
constexpr double kPictureMargin = 1.08;             // of pictures around what they show
constexpr double kNearest = 1e-3, kFurthest = 1e3;

/// Two unit vectors across `up`, where azimuth 0 and a quarter turn are.
struct Ground {
  Vec3 ahead, side;
};

Ground ground_of(const Vec3& up) {
  // The axis that comes after the one most like `up`: for z up it is x, and for y up z, as people draw them.
  Vec3::Index steep = 0;
  up.cwiseAbs().maxCoeff(&steep);
  Vec3 ahead = Vec3::Unit((steep + 1) % 3);
  ahead = (ahead - ahead.dot(up) * up).normalized();
  return {ahead, up.cross(ahead)};
}

double size_of(const Box& box) {
  return box.is_empty() ? 1.0 : std::max((box.hi - box.lo).norm(), 1e-300);
}

/// Pixels of the picture's height per unit of the tangent.
double focal_length(const Camera& camera, const Viewport& viewport) {
  return 0.5 * viewport.height / std::tan(0.5 * camera.field_of_view);
}

/// Looks at points from where they all are within the picture, and no further away.
template <class Point>
void frame(Camera& camera, const Viewport& viewport, const Point* points, std::size_t count) {
  const Vec3 right = camera.right(), upward = camera.upward(), backward = camera.backward();
  Box seen;  // in the camera's axes
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = points[i].template cast<double>();
    seen.extend(Vec3(p.dot(right), p.dot(upward), p.dot(backward)));
  }
  const Vec3 middle = 0.5 * (seen.lo + seen.hi);
  camera.target = middle.x() * right + middle.y() * upward + middle.z() * backward;
  const double vertical = std::tan(0.5 * camera.field_of_view);
  double distance = kNearest * size_of(seen);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 to = points[i].template cast<double>() - camera.target;
    const double reach = std::max(std::abs(to.dot(upward)), std::abs(to.dot(right)) / viewport.aspect()) / vertical;
    distance = std::max(distance, kPictureMargin * reach + to.dot(backward));
  }
  camera.distance = distance;
}

}  // namespace

Vec3 Camera::backward() const {
  const auto [ahead, side] = ground_of(up);
  return std::cos(elevation) * (std::cos(azimuth) * ahead + std::sin(azimuth) * side) + std::sin(elevation) * up;
}

Vec3 Camera::right() const {
  const auto [ahead, side] = ground_of(up);
  return std::cos(azimuth) * side - std::sin(azimuth) * ahead;
}

Vec3 Camera::upward() const {
  return backward().cross(right());
}

Mat4 Camera::to_view() const {
  Mat4 view = Mat4::Identity();
  view.block<1, 3>(0, 0) = right().transpose();
  view.block<1, 3>(1, 0) = upward().transpose();
  view.block<1, 3>(2, 0) = backward().transpose();
  view.block<3, 1>(0, 3) = -(view.block<3, 3>(0, 0) * eye());
  return view;
}

double Camera::pixel_size(const Viewport& viewport, const Vec3& at) const {
  const double depth = std::max((eye() - at).dot(backward()), 1e-9 * distance);
  return depth / focal_length(*this, viewport);
}

Mat4 to_clip(const Camera& camera, const Viewport& viewport, const Box& scene) {
  const double radius = 0.5 * size_of(scene);
  const Vec3 centre = scene.is_empty() ? camera.target : Vec3(0.5 * (scene.lo + scene.hi));
  const double middle = (camera.eye() - centre).dot(camera.backward());
  const double far_plane = std::max(middle + 1.2 * radius, 1e-3 * camera.distance);
  const double near_plane = std::max(middle - 1.2 * radius, 1e-3 * far_plane);
  const double scale = 1.0 / std::tan(0.5 * camera.field_of_view);
  Mat4 clip = Mat4::Zero();
  clip(0, 0) = scale / viewport.aspect();
  clip(1, 1) = scale;
  clip(2, 2) = -(far_plane + near_plane) / (far_plane - near_plane);
  clip(2, 3) = -2 * far_plane * near_plane / (far_plane - near_plane);
  clip(3, 2) = -1;
  return clip;
}

Ray ray_through(const Camera& camera, const Viewport& viewport, const Vec2& pixel) {
  const double focal = focal_length(camera, viewport);
  const double x = (pixel.x() + 0.5 - 0.5 * viewport.width) / focal;
  const double y = (0.5 * viewport.height - pixel.y() - 0.5) / focal;
  return {camera.eye(), (x * camera.right() + y * camera.upward() - camera.backward()).normalized()};
}

std::optional<Vec2> to_pixel(const Camera& camera, const Viewport& viewport, const Vec3& point) {
  const Vec3 seen = point - camera.eye();
  const double depth = -seen.dot(camera.backward());
  if (!(depth > 0)) return std::nullopt;
  const double focal = focal_length(camera, viewport);
  return Vec2(0.5 * viewport.width - 0.5 + focal * seen.dot(camera.right()) / depth,
              0.5 * viewport.height - 0.5 - focal * seen.dot(camera.upward()) / depth);
}

void orbit(Camera& camera, const Viewport& viewport, const Vec2& pixels) {
  const double turn = kPi / std::max(viewport.height, 1);
  camera.azimuth = std::remainder(camera.azimuth - turn * pixels.x(), 2 * kPi);
  camera.elevation = std::clamp(camera.elevation + turn * pixels.y(), -kSteepestView, kSteepestView);
}

void pan(Camera& camera, const Viewport& viewport, const Vec2& pixels) {
  const double size = camera.pixel_size(viewport, camera.target);
  camera.target += size * (pixels.y() * camera.upward() - pixels.x() * camera.right());
}

void zoom(Camera& camera, double factor, const Box& scene) {
  const double size = size_of(scene);
  camera.distance = std::clamp(camera.distance * factor, kNearest * size, kFurthest * size);
}

void frame_all(Camera& camera, const Viewport& viewport, const Box& scene) {
  if (scene.is_empty()) return;
  std::array<Vec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    corners[i] = Vec3((i & 1U) != 0 ? scene.hi.x() : scene.lo.x(), (i & 2U) != 0 ? scene.hi.y() : scene.lo.y(),
                      (i & 4U) != 0 ? scene.hi.z() : scene.lo.z());
  }
  frame(camera, viewport, corners.data(), corners.size());
}

void frame_points(Camera& camera, const Viewport& viewport, std::span<const Eigen::Vector3f> points) {
  if (!points.empty()) frame(camera, viewport, points.data(), points.size());
}

void look_along(Camera& camera, const Vec3& direction) {
  const Vec3 back = -direction.normalized();
  const auto [ahead, side] = ground_of(camera.up);
  camera.elevation = std::clamp(std::asin(std::clamp(back.dot(camera.up), -1.0, 1.0)), -kSteepestView, kSteepestView);
  const double x = back.dot(ahead), y = back.dot(side);
  if (std::abs(x) > 1e-9 || std::abs(y) > 1e-9) camera.azimuth = std::atan2(y, x);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
