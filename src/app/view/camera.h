// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "incise/geom/box.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace app {

using Vec2 = Eigen::Vector2d;
using Mat4 = Eigen::Matrix4d;

/// The part of a screen that a picture fills, in pixels: (0, 0) is its upper left corner, y grows downwards.
struct Viewport {
  int width = 1280, height = 720;
  [[nodiscard]] double aspect() const { return static_cast<double>(width) / static_cast<double>(height); }
};

/// A half-line.
struct Ray {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();  ///< unit
};

/// A perspective camera that looks at a point and turns around it, `up` staying up. Angles in rad.
struct Camera {
  Vec3 target = Vec3::Zero();
  double distance = 1;         ///< from the eye to the target, length unit, above 0
  double azimuth = -0.7;       ///< around `up`; 0: the eye is on the side of `forward_axis`
  double elevation = 0.35;     ///< of the eye above the plane across `up`, in [-π/2, π/2]
  Vec3 up = Vec3::UnitZ();     ///< unit
  double field_of_view = 0.6;  ///< of the picture's height, in (0, π)

  /// From the target to the eye; unit.
  [[nodiscard]] Vec3 backward() const;
  [[nodiscard]] Vec3 eye() const { return target + distance * backward(); }
  [[nodiscard]] Vec3 right() const;    ///< to the right in the picture; unit
  [[nodiscard]] Vec3 upward() const;   ///< upwards in the picture; unit
  [[nodiscard]] Mat4 to_view() const;  ///< world to eye: x right, y up, looking along −z
  /// Length units per pixel at the depth of a point.
  [[nodiscard]] double pixel_size(const Viewport& viewport, const Vec3& at) const;
};

/// Eye to clip coordinates as OpenGL has them, with the near and far planes around a box.
[[nodiscard]] Mat4 to_clip(const Camera& camera, const Viewport& viewport, const Box& scene);

/// The ray from the eye through the middle of a pixel.
[[nodiscard]] Ray ray_through(const Camera& camera, const Viewport& viewport, const Vec2& pixel);

/// Where a point is in the picture, in pixels; nothing for points behind the eye.
[[nodiscard]] std::optional<Vec2> to_pixel(const Camera& camera, const Viewport& viewport, const Vec3& point);

/// Turns around the target as if the body were dragged by `pixels`: half a turn per picture height.
void orbit(Camera& camera, const Viewport& viewport, const Vec2& pixels);
/// Moves along the picture, so that the target follows the pointer.
void pan(Camera& camera, const Viewport& viewport, const Vec2& pixels);
/// Multiplies the distance by `factor`, above 0; keeps it within 1e-3 and 1e3 of `scene`'s size.
void zoom(Camera& camera, double factor, const Box& scene);
/// Looks at the whole of a box from where it looks now. Keeps the camera where the box is empty.
void frame_all(Camera& camera, const Viewport& viewport, const Box& scene);
/// Looks at all of some points as `frame_all` does, but no further away than these need.
void frame_points(Camera& camera, const Viewport& viewport, std::span<const Eigen::Vector3f> points);
/// Looks along a direction, of any length but zero.
void look_along(Camera& camera, const Vec3& direction);

}  // namespace app
}  // namespace v0
}  // namespace incise
