// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "app/view/camera.h"
#include "app/view/picture.h"
#include "incise/cut/stroke.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A line across the picture, and the part of the plane through it and the eye that goes through a body.
struct PlaneCut {
  Ray from, to;                ///< through the ends of the line
  std::array<Vec3, 4> corners; /**< nearest to the viewer and furthest, on the side of the line's beginning; then the
                                  same on the side of its end: all outside the body's box */
};

/// The plane through two pixels and the eye, as far as the body's box reaches and a tenth of its extent beyond. Nothing
/// where the pixels are nearer than 8 to each other, or where the box is empty.
[[nodiscard]] std::optional<PlaneCut> plane_cut_between(const Camera& camera, const Viewport& viewport,
                                                        const Vec2& from, const Vec2& to, const Box& body);
/// One second from the beginning of the line to its end.
[[nodiscard]] Stroke to_stroke(const PlaneCut& cut);
/// The line and the plane, as a preview.
void draw(const PlaneCut& cut, const Camera& camera, Marks& marks);

}  // namespace app
}  // namespace v0
}  // namespace incise
