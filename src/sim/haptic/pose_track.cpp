// SPDX-License-Identifier: Apache-2.0
// Polynomials between poses and normalised sums of quaternions: no libm but the square root, so that tracks are the
// same on every machine.
#include "incise/sim/pose_track.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {

namespace {

/// The short way from a to b, `s` in [0, 1]; no libm but sqrt, unlike slerp.
Eigen::Quaterniond between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double s) {
  const double sign = a.dot(b) < 0 ? -1 : 1;
  const Eigen::Quaterniond sum((1 - s) * a.coeffs() + (sign * s) * b.coeffs());
  // Half-way between opposite turns there is no short way.
  return sum.norm() > 1e-9 ? sum.normalized() : a;
}

bool is_sound(const TimedPose& pose) {
  return std::isfinite(pose.time) && pose.position.allFinite() && std::abs(pose.orientation.squaredNorm() - 1) <= 2e-6;
}

DeviceState resting(const TimedPose& pose) {
  return {pose.position, Vec3::Zero(), pose.orientation, pose.buttons};
}

}  // namespace

Result<PoseTrack> PoseTrack::create(std::vector<TimedPose> poses) {
  const auto bad = [](const char* what, std::size_t i) {
    return Error{ErrorCode::kBadArgument, "pose " + std::to_string(i) + " of a track: " + what, {i}};
  };
  if (poses.empty()) return Error{ErrorCode::kBadArgument, "a track needs at least one pose", {}};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!is_sound(poses[i])) return bad("it must be finite and its orientation of length 1", i);
    if (i > 0 && !(poses[i].time > poses[i - 1].time)) return bad("its time must be above the last one's", i);
  }
  return PoseTrack(std::move(poses));
}

Vec3 PoseTrack::slope(std::size_t pose) const {
  if (pose == 0 || pose + 1 == poses_.size()) return Vec3::Zero();  // it rests before and after
  const TimedPose& before = poses_[pose - 1];
  const TimedPose& after = poses_[pose + 1];
  return (after.position - before.position) / (after.time - before.time);
}

DeviceState PoseTrack::at(double time) const {
  const auto later =
      std::upper_bound(poses_.begin(), poses_.end(), time, [](double t, const TimedPose& p) { return t < p.time; });
  if (later == poses_.begin()) return resting(poses_.front());
  if (later == poses_.end()) return resting(poses_.back());
  const auto next = static_cast<std::size_t>(later - poses_.begin());
  const TimedPose& a = poses_[next - 1];
  const TimedPose& b = poses_[next];
  const double span = b.time - a.time;
  const double s = (time - a.time) / span;
  const Vec3 from = span * slope(next - 1), to = span * slope(next), way = b.position - a.position;
  // p(s) = a + s·from + s²(3·way - 2·from - to) + s³(from + to - 2·way)
  const Vec3 square = 3 * way - 2 * from - to, cube = from + to - 2 * way;
  DeviceState state;
  state.position = a.position + s * (from + s * (square + s * cube));
  state.velocity = (from + s * (2 * square + 3 * s * cube)) / span;
  state.orientation = between(a.orientation, b.orientation, s);
  state.buttons = a.buttons;
  return state;
}

}  // namespace v0
}  // namespace incise
