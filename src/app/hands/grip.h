// SPDX-License-Identifier: Apache-2.0
// What holds tissue: a grasp that follows the pointer, and pins.
#pragma once

#include <optional>
#include <vector>

#include "app/view/camera.h"
#include "app/view/picking.h"
#include "app/view/picture.h"
#include "incise/engine/simulation.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A hook in the hand: it moves in the plane across the view through what it grasped.
class Grasp {
 public:
  Grasp(const Hook& hook, const Camera& camera);

  /// The pointer is elsewhere.
  void move(const Ray& ray, const Camera& camera);
  /// Pushes it away from the viewer, or pulls it nearer, along the way from the eye.
  void push(double notches, const Camera& camera);

  [[nodiscard]] const Hook& hook() const { return hook_; }
  void draw(Marks& marks) const;

 private:
  Hook hook_;
  Vec3 grasped_;        // where it took hold
  double depth_;        // of the hook before the eye
  double first_depth_;  // of what was grasped
};

/// The nearest of some pins to a place of the picture, within `reach` pixels: its index.
[[nodiscard]] std::optional<std::size_t> find_pin(const std::vector<Hook>& pins, const Camera& camera,
                                                  const Viewport& viewport, const Vec2& pixel, double reach);
void draw_pins(const std::vector<Hook>& pins, Marks& marks);

}  // namespace app
}  // namespace v0
}  // namespace incise
