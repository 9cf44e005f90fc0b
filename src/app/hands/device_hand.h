// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "app/hands/haptic_loop.h"
#include "app/hands/placed_device.h"
#include "app/jobs/live_hand.h"
#include "app/view/picture.h"

namespace incise {
inline namespace v0 {
namespace app {

struct DeviceHandOptions {
  std::optional<Eigen::Matrix3d> axes;  ///< device to world; unset: z of the device is up in the scene
  double scale = 1;                     ///< m of the world per m of the device, above 0
  std::optional<double> blade_length;   ///< m of edge; unset: as suits the body, at most 2 cm
  HapticLoopOptions loop;               ///< `tool.physics_period` is the scene's
};

/// Errors: kBadArgument names the first option out of its range.
[[nodiscard]] Status check(const DeviceHandOptions& options);

/// A blade in a hand at a haptic device: gives a simulation its blade, and the hand what the tissue does, at 1 kHz.
///
/// The device holds the middle of the edge, which lies along the device's z axis (a grip's shaft). When a body begins,
/// it is above its top. The blade is in a frame while it is near the body: each approach is a stroke of its own. While
/// the device is not live, or button 0 is down (`PlacedDevice`), there is no blade and no force. One thread but for the
/// device's own (`HapticLoop`).
class DeviceHand final : public LiveHand {
 public:
  /// Errors: as `check`. The loop begins with the first body.
  static Result<std::unique_ptr<DeviceHand>> create(std::unique_ptr<HapticDevice> device,
                                                    const DeviceHandOptions& options = {});
  ~DeviceHand() override;  ///< commands no force

  void begin(const Scene& scene, const Box& body) override;
  [[nodiscard]] std::optional<BladePose> blade(const Box& body) override;
  void feel(const HapticSnapshot& snapshot) override;
  [[nodiscard]] HapticFigures figures() const override;

  /// Whether the device was live when `blade` was asked for last.
  [[nodiscard]] bool is_live() const { return is_live_; }
  /// Adds the edge, where there is one.
  void draw(Marks& marks) const;
  [[nodiscard]] HapticLoopStatistics statistics() const;

 private:
  DeviceHand(std::unique_ptr<HapticDevice> device, const DeviceHandOptions& options);

  DeviceHandOptions options_;
  PlacedDevice device_;
  std::optional<HapticLoop> loop_;
  double unit_ = 1;    // m per length unit
  double length_ = 0;  // of the edge, length unit
  std::optional<BladePose> pose_;
  bool is_live_ = false;
  std::uint64_t serial_ = 0;  // of the last snapshot: simulations begin anew, the loop does not
  double peak_force_ = 0;
  PassivityReport passivity_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
