// SPDX-License-Identifier: Apache-2.0
// Everything that has a place takes part, instruments as balls of their greatest length.
#include "render/scene_box.h"

#include <cmath>

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr double kInstrumentLength = 140;  // mm, at most

void extend(Box& box, const Eigen::Vector3f& at, float radius = 0) {
  if (!at.allFinite() || !std::isfinite(radius)) return;
  box.extend(Vec3(at.cast<double>() - Vec3::Constant(radius)));
  box.extend(Vec3(at.cast<double>() + Vec3::Constant(radius)));
}

void extend(Box& box, const app::Marks& marks) {
  for (const auto& line : marks.lines) {
    extend(box, line.from);
    extend(box, line.to);
  }
  for (const auto& ball : marks.balls) extend(box, ball.centre, ball.is_in_pixels ? 0 : ball.radius);
  for (const auto& triangle : marks.triangles) {
    for (const auto& corner : triangle.corners) extend(box, corner);
  }
  // What is nearer than the body must not be cut off.
  for (const auto& one : marks.instruments) {
    extend(box, one.tip.cast<float>(), static_cast<float>(kInstrumentLength * one.millimetre));
  }
}

}  // namespace

Box box_of_all(const app::Picture& picture, const Box& body) {
  Box scene = body;
  extend(scene, picture.marks);
  if (picture.ground) {
    for (const app::SolidCorner& corner : *picture.ground) extend(scene, corner.at);
  }
  return scene;
}

}  // namespace render
}  // namespace v0
}  // namespace incise
