// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// Where a device is. SI units, world axes.
struct DeviceState {
  Vec3 position = Vec3::Zero();                                     ///< m
  Vec3 velocity = Vec3::Zero();                                     ///< m/s
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< device to world, unit
  std::uint32_t buttons = 0;                                        ///< bit i: button i is down
  /// Whether the rest is where the device is now. False: it does not answer, or what it says cannot be; nothing is to
  /// be felt, and nothing is to be done by where it was.
  bool is_live = true;
};

/// A thing to hold that tells where it is and pushes back.
///
/// `read` and `command` are called by one thread, in turns, at 1 kHz or more; they must neither block nor allocate.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  HapticDevice(const HapticDevice&) = delete;
  HapticDevice& operator=(const HapticDevice&) = delete;

  /// The state at `time`, s since the caller's start; times never fall. What was commanded last acts until then.
  virtual DeviceState read(double time) = 0;
  /// The force that the device exerts on the hand from now on, N.
  virtual void command(const Vec3& force) = 0;

 protected:
  HapticDevice() = default;
};

/// A device that rests at the origin and feels nothing: for runs without one.
class NullDevice final : public HapticDevice {
 public:
  DeviceState read(double /*time*/) override { return {}; }
  void command(const Vec3& /*force*/) override {}
};

}  // namespace v0
}  // namespace incise
