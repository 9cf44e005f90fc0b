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

/// A hook in the hand: it moves in the plane across the view through what it grasped, or along the surface there.
class Grasp {
 public:
  Grasp(const Hook& hook, const Camera& camera);
  /// @param normal  unit, of the surface that it moves along: a hand that pulls a lip aside pulls it along the skin,
  /// and
  ///                not into the body. Where the surface is seen too flat for that, it moves across the view.
  Grasp(const Hook& hook, const Camera& camera, const Vec3& normal);

  /// Another hand, or another view, takes it where it is.
  void take(const Camera& camera);
  /// The pointer is elsewhere.
  void move(const Ray& ray, const Camera& camera);
  /// Pushes it away from the viewer, or pulls it nearer, along the way from the eye.
  void push(double notches, const Camera& camera);

  [[nodiscard]] const Hook& hook() const { return hook_; }
  [[nodiscard]] const Vec3& grasped() const { return grasped_; }  ///< where it took hold
  void draw(Marks& marks) const;

 private:
  [[nodiscard]] std::optional<Vec3> along_surface(const Ray& ray) const;

  Hook hook_;
  Vec3 grasped_;                // where it took hold
  double depth_;                // of the hook before the eye
  double first_depth_;          // of what was grasped
  Vec3 normal_ = Vec3::Zero();  // of the surface that it moves along; zero: across the view
};

/// The nearest of some pins to a place of the picture, within `reach` pixels: its index.
[[nodiscard]] std::optional<std::size_t> find_pin(const std::vector<Hook>& pins, const Camera& camera,
                                                  const Viewport& viewport, const Vec2& pixel, double reach);
/// The instrument that a hook in the hand is, and where it was put on.
struct HeldBy {
  InstrumentKind kind = InstrumentKind::kForceps;
  Vec3 normal = Vec3::UnitZ();  ///< of the surface that it took hold of, outwards
  double millimetre = 0.001;    ///< see `Instrument`
};
/// Forceps are held towards the viewer; hooks and retractors stand on the skin and lean to where they pull.
[[nodiscard]] Instrument instrument_at(const Hook& hook, const Vec3& grasped, const HeldBy& by, const Camera& camera);
/// A circle on a surface: what a grip takes hold of, or where the pointer is.
void draw_circle(const Vec3& centre, const Vec3& normal, double radius, Marks& marks);
void draw_pins(const std::vector<Hook>& pins, Marks& marks);

}  // namespace app
}  // namespace v0
}  // namespace incise
