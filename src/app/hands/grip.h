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

/// How a hook follows the pointer. Where the surface is seen at too flat an angle, the hook moves across the view.
enum class GraspWay : std::uint8_t {
  kAcross,        ///< in the plane across the view through what it grasped
  kAlongSurface,  ///< along the surface there: a hand that pulls a lip aside does not pull it into the body
  kLifting,       ///< across the view where that is above the surface, else along it
};

/// A hook in the hand.
class Grasp {
 public:
  /// @param normal  unit, outwards, of the surface that it took hold of; not asked for across the view.
  Grasp(const Hook& hook, const Camera& camera, GraspWay way, const Vec3& normal);

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
  [[nodiscard]] std::optional<Vec3> across_view(const Ray& ray, const Camera& camera) const;

  Hook hook_;
  Vec3 grasped_;        // where it took hold
  double depth_;        // of the plane across the view, before the eye
  double first_depth_;  // of what was grasped
  GraspWay way_;
  Vec3 normal_;
  Vec3 level_;  // a place of the plane along the surface
};

/// What holds tissue where it is.
struct Pin {
  Hook hook;
  Vec3 normal = Vec3::UnitZ();  ///< of the surface that it stands on, outwards
  double millimetre = 0.001;    ///< see `Instrument`
};

/// The nearest of some places to one of the picture, within `reach` pixels: its index.
[[nodiscard]] std::optional<std::size_t> find_place(const std::vector<Vec3>& places, const Camera& camera,
                                                    const Viewport& viewport, const Vec2& pixel, double reach);
/// The pin whose head or whose point is the nearest, likewise.
[[nodiscard]] std::optional<std::size_t> find_pin(const std::vector<Pin>& pins, const Camera& camera,
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
/// Each with its head above the skin, of at least a few pixels.
void draw_pins(const std::vector<Pin>& pins, const Camera& camera, Marks& marks);

}  // namespace app
}  // namespace v0
}  // namespace incise
