// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "incise/core/result.h"
#include "incise/sim/haptic_device.h"

namespace incise {
inline namespace v0 {

/// A pose at a time.
struct TimedPose {
  double time = 0;                                                  ///< s
  Vec3 position = Vec3::Zero();                                     ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< unit
  std::uint32_t buttons = 0;                                        ///< one bit each
};

/// A motion through time-stamped poses.
///
/// Places are joined by cubic Hermite curves whose tangents are the slopes between the neighbours, so the velocity has
/// no steps; orientations linearly and then normalised, the short way round; buttons keep the value of the last pose.
/// Before the first and after the last pose it rests there.
class PoseTrack {
 public:
  /// At least one pose, times strictly increasing, all finite, orientations of length 1 to 1e-6. Errors: kBadArgument.
  static Result<PoseTrack> create(std::vector<TimedPose> poses);

  /// Cost: O(log poses). Any thread, no allocation.
  [[nodiscard]] DeviceState at(double time) const;
  [[nodiscard]] double end_time() const { return poses_.back().time; }          ///< s, of the last pose
  [[nodiscard]] const std::vector<TimedPose>& poses() const { return poses_; }  ///< as given

 private:
  explicit PoseTrack(std::vector<TimedPose> poses) : poses_(std::move(poses)) {}
  [[nodiscard]] Vec3 slope(std::size_t pose) const;

  std::vector<TimedPose> poses_;
};

/// A device that plays a recorded motion and feels nothing.
class RecordedDevice final : public HapticDevice {
 public:
  /// Plays `track`.
  explicit RecordedDevice(PoseTrack track) : track_(std::move(track)) {}

  DeviceState read(double time) override { return track_.at(time); }
  void command(const Vec3& force) override { last_force_ = force; }
  [[nodiscard]] const Vec3& last_force() const { return last_force_; }  ///< N; same thread as `command`

 private:
  PoseTrack track_;
  Vec3 last_force_ = Vec3::Zero();
};

}  // namespace v0
}  // namespace incise
