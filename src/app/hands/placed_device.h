// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>

#include "incise/core/result.h"
#include "incise/core/triple_buffer.h"
#include "incise/sim/haptic_device.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Where a device's room lies in the world.
struct DevicePlacement {
  Vec3 start = Vec3::Zero();                           ///< m: where in the world the device is when it is first live
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< device to world: a rotation
  double scale = 1;                                    ///< m of the world per m of the device, above 0
};

/// The rotation that brings the device's z axis to `up`, unit, and turns as little as it can otherwise.
[[nodiscard]] Eigen::Matrix3d axes_for(const Vec3& up);
/// Reads "x,y,z" and its like: which axis of the device, with its sign, is the world's x, y and z: "x,-z,y". Errors:
/// kBadArgument where an axis is missing, or it is no rotation.
[[nodiscard]] Result<Eigen::Matrix3d> parse_axes(const std::string& text);

/// A device in the world's axes and metres, and lifted like a mouse: while a button is down the device moves without
/// what it holds, feels nothing, and goes on from the same place afterwards.
///
/// Forces are turned, and not scaled: work in the world is `scale` times what the hand does, so what is passive there
/// is passive at the hand. Threads as of `HapticDevice`, and `place` from one other.
class PlacedDevice final : public HapticDevice {
 public:
  static constexpr std::uint32_t kLift = 1;  ///< the button, as a bit

  PlacedDevice(std::unique_ptr<HapticDevice> device, const DevicePlacement& placement);

  /// The world is another one: begins anew, at `placement.start`, when the device is next live. Wait-free.
  void place(const DevicePlacement& placement) { placements_.publish(placement); }

  DeviceState read(double time) override;
  void command(const Vec3& force) override;

 private:
  [[nodiscard]] Vec3 turned(const Vec3& vector) const { return placement_.scale * (placement_.axes * vector); }

  std::unique_ptr<HapticDevice> device_;
  TripleBuffer<DevicePlacement> placements_;
  DevicePlacement placement_;
  Vec3 offset_ = Vec3::Zero();  // of the device's origin in the world, m
  Vec3 held_ = Vec3::Zero();    // where it is in the world
  bool is_placed_ = false, is_lifted_ = false;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
