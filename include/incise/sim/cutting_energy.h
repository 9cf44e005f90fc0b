// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// How much of the work on a body may be missing before the account says so.
struct EnergyTolerance {
  double relative = 0.1;   ///< of all work put in, 1
  double absolute = 1e-6;  ///< J
};

/// Where the work of a blade went. All in J.
struct EnergyBalance {
  double external = 0;    ///< put in by the tool
  double stored = 0;      ///< elastic + kinetic + potential, less what was there at the start
  double fracture = 0;    ///< toughness · new area
  double friction = 0;    ///< rubbed off at the blade
  double dissipated = 0;  ///< the rest: external - stored - fracture - friction; damping, and the solver's losses
  double tolerance = 0;   ///< by which the rest may be negative
  /// More energy was found than was put in: the forces are too small for the area that was cut.
  [[nodiscard]] bool is_created() const { return dissipated < -tolerance; }
};

/// The energy account of cutting: ∫F·dx = ΔU + J_c·A + friction + what is dissipated.
///
/// Sign: forces are those *on the tool*, as everywhere in force feedback, so moving against them puts work in.
/// Only newly opened area is paid for, one side of the two. **Source:** the energy balance of Mahvash & Hayward 2001.
/// One thread, O(1), no allocation.
class CuttingEnergy {
 public:
  /// @param stored  J in the body before the first motion.
  explicit CuttingEnergy(double stored = 0, const EnergyTolerance& tolerance = {})
      : stored_at_start_(stored), stored_(stored), tolerance_(tolerance) {}

  /// Adds the work of a tool that was moved to `position` (m) and feels `force` (N) there: by the trapezoidal rule
  /// since the last call. The first call of a motion adds nothing.
  void move_tool(const Vec3& force, const Vec3& position);
  /// Says that the next `move_tool` is the first of another motion (the tool was lifted or put elsewhere).
  void lift_tool() { is_moving_ = false; }
  /// Adds work known otherwise, J.
  void add_work(double work) { external_ += work; }
  /// Adds toughness (J/m²) · area (m²) of new cut face.
  void add_cut(double toughness, double area) { fracture_ += toughness * area; }
  /// Adds |force| (N) · distance (m) of rubbing.
  void add_friction(double force, double distance) { friction_ += force * distance; }
  /// What the body holds now, J. `potential`: of gravity and other outside fields.
  void set_stored(double elastic, double kinetic, double potential = 0) { stored_ = elastic + kinetic + potential; }

  /// The account so far.
  [[nodiscard]] EnergyBalance balance() const;

 private:
  double external_ = 0, fracture_ = 0, friction_ = 0;
  double stored_at_start_, stored_;
  EnergyTolerance tolerance_;
  bool is_moving_ = false;
  Vec3 force_ = Vec3::Zero(), position_ = Vec3::Zero();
};

}  // namespace v0
}  // namespace incise
