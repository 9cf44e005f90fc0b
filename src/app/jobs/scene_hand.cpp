// SPDX-License-Identifier: Apache-2.0
// A plan of the blade's middle is made when the blade is picked up; a frame is then as many ticks of tool and operator
// as it has milliseconds.
#include "app/jobs/scene_hand.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace incise {
inline namespace v0 {
namespace app {

namespace {

constexpr double kTick = 1e-3;  // s

HapticToolOptions options_of(const Scene& scene) {
  HapticToolOptions options;
  options.physics_period = scene.options.frame_seconds;
  return options;
}

/// The point of the tool that moves with the device: the middle of the edge's points, m.
Vec3 middle(const BladePose& pose, double length_unit) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : pose.edge) sum += point;
  return length_unit / static_cast<double>(pose.edge.size()) * sum;
}

}  // namespace

SceneHand::SceneHand(const Scene& scene) : scene_(scene), tool_(options_of(scene)) {}

/// Takes the blade, and plans to go where it will be until it is lifted.
void SceneHand::pick_up(std::uint64_t frame) {
  std::vector<TimedPose> plan;
  for (std::uint64_t i = frame; i < scene_.frames; ++i) {
    const FrameInput input = scene_input(scene_, i);
    if (!input.blade) break;
    TimedPose& pose = plan.emplace_back();
    pose.time = static_cast<double>(i - frame) * scene_.options.frame_seconds;
    pose.position = middle(*input.blade, scene_.options.body.length_unit);
  }
  Result<PoseTrack> track = PoseTrack::create(std::move(plan));
  if (!track.ok()) return;
  hand_.emplace(std::move(track).value());
  picked_up_ = static_cast<double>(frame) * scene_.options.frame_seconds;
}

void SceneHand::feel(std::uint64_t frame, const HapticSnapshot& snapshot) {
  const bool has_blade = scene_input(scene_, frame).blade.has_value();
  if (has_blade && !hand_) pick_up(frame);
  if (!has_blade) hand_.reset();
  tool_.accept(snapshot);
  if (!hand_) return;
  const double begin = static_cast<double>(frame) * scene_.options.frame_seconds - picked_up_;
  const auto ticks = static_cast<unsigned>(std::max(1.0, scene_.options.frame_seconds / kTick));
  for (unsigned i = 1; i <= ticks; ++i) tick(begin + kTick * i);
}

void SceneHand::tick(double time) {
  using Clock = std::chrono::steady_clock;
  const DeviceState device = hand_->read(time);
  const Clock::time_point start = Clock::now();
  const Vec3 force = tool_.tick(kTick, device.position, device.velocity);
  compute_.add(
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count()));
  hand_->command(force);
  peak_force_ = std::max(peak_force_, force.norm());
}

HapticFigures SceneHand::figures() const {
  const PassivityReport passivity = tool_.passivity();
  return {
      tool_.ticks(),          peak_force_, passivity.sampled_minimum, passivity.held_minimum, passivity.removed_energy,
      compute_.microseconds()};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
