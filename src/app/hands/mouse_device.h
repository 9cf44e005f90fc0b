// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "incise/core/triple_buffer.h"
#include "incise/sim/haptic_device.h"

namespace incise {
inline namespace v0 {
namespace app {

struct MouseOptions {
  double scale = 1;              ///< m of the device per unit of the pointer, any sign
  double settle_time = 0.02;     ///< s in which the device comes near a new place; above 0. A pointer jumps at 60 Hz
  double max_acceleration = 40;  ///< m/s², above 0: below what the passivity controller expects of a device
};

/// A pointer as a device: a front end says where it is, the force is only remembered.
///
/// The device follows the pointer like a critically damped mass, so that 1 kHz ticks see a motion and not jumps.
/// While the clutch is held the pointer moves and the device stays, as when a mouse is lifted.
/// Two threads: `move_to`, `take_force` and `last_force` on the front end's, `read` and `command` on the haptic one's.
class MouseDevice final : public HapticDevice {
 public:
  explicit MouseDevice(const MouseOptions& options = {}, const Vec3& start = Vec3::Zero());

  /// Tells where the pointer is, in its own units and the world's axes. Its first place is where the device starts.
  void move_to(const Vec3& pointer, std::uint32_t buttons = 0, bool is_clutched = false);
  /// Takes the newest force, where there is a new one; `last_force` then is that one.
  bool take_force() { return forces_.take(); }
  [[nodiscard]] const Vec3& last_force() const { return forces_.value(); }  ///< N

  DeviceState read(double time) override;
  void command(const Vec3& force) override { forces_.publish(force); }

 private:
  struct Target {
    Vec3 position = Vec3::Zero();
    std::uint32_t buttons = 0;
  };
  void follow(double dt);

  MouseOptions options_;
  TripleBuffer<Target> targets_;
  TripleBuffer<Vec3> forces_{Vec3::Zero()};
  Target target_;                // the front end's
  Vec3 pointer_ = Vec3::Zero();  // the front end's
  bool has_pointer_ = false;     // the front end's
  DeviceState state_;            // the haptic thread's
  double time_ = 0;              // the haptic thread's
};

}  // namespace app
}  // namespace v0
}  // namespace incise
