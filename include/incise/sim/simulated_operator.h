// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/sim/pose_track.h"

namespace incise {
inline namespace v0 {

/// A hand and arm at the device, as one mass. Defaults: a light grip, damped to about 0.7 of critical.
struct HandOptions {
  double mass = 0.2;       ///< kg, hand and device; about 0.1 to 0.5, above 0
  double stiffness = 300;  ///< N/m towards the planned place, at least 0
  double damping = 11;     ///< N·s/m towards the planned velocity, at least 0
};

/// Errors: kBadArgument names the first number out of its range.
[[nodiscard]] Status check(const HandOptions& options);

/// A device with a simulated person at it, who follows a planned motion and gives way to the force felt.
///
/// mass · a = stiffness (plan - x) + damping (plan' - v) + force, semi-implicit with spring and damper taken at the
/// end of the step: stable for every dt. Orientation and buttons are the plan's. No allocation; one thread.
class SimulatedOperator final : public HapticDevice {
 public:
  /// Follows `plan`; `options` that `check` accepts.
  explicit SimulatedOperator(PoseTrack plan, const HandOptions& options = {});

  DeviceState read(double time) override;
  void command(const Vec3& force) override { force_ = force; }
  [[nodiscard]] double kinetic_energy() const { return 0.5 * options_.mass * state_.velocity.squaredNorm(); }  ///< J

 private:
  void step(double dt, double end);

  PoseTrack plan_;
  HandOptions options_;
  DeviceState state_;
  Vec3 force_ = Vec3::Zero();
  double time_ = 0;
};

}  // namespace v0
}  // namespace incise
