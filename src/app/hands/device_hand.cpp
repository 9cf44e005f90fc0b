// SPDX-License-Identifier: Apache-2.0
// A straight edge around the device's place, sized by the body. The pose is handed to the simulation only near the
// body, so that each approach is a stroke.
#include "app/hands/device_hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kLongestEdge = 0.02;  // m: a scalpel's
constexpr double kEdgeShare = 0.35;    // of the body's shortest side
constexpr double kStartAbove = 0.5;    // of the edge, from the top of the body to its tip at the start
constexpr double kNear = 0.25;         // of the edge: from there on it belongs to the simulation
constexpr int kSegments = 4;           // of the edge

/// Against gravity; z where there is none.
Vec3 up_of(const Scene& scene) {
  const Vec3& gravity = scene.options.body.gravity;
  const double size = gravity.norm();
  return size > 0 ? Vec3(-gravity / size) : Vec3(Vec3::UnitZ());
}

/// The middle of a box's face to one side.
Vec3 top_of(const Box& body, const Vec3& up) {
  return 0.5 * (body.lo + body.hi) + 0.5 * (body.hi - body.lo).dot(up.cwiseAbs()) * up;
}

}  // namespace

Status check(const DeviceHandOptions& options) {
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!is_positive(options.scale)) return bad("the scale of a device must be above 0");
  if (options.blade_length && !is_positive(*options.blade_length))
    return bad("the length of an edge must be above 0 m");
  return check(options.loop);
}

Result<std::unique_ptr<DeviceHand>> DeviceHand::create(std::unique_ptr<HapticDevice> device,
                                                       const DeviceHandOptions& options) {
  if (Status status = check(options); !status.ok()) return status.error();
  return std::unique_ptr<DeviceHand>(new DeviceHand(std::move(device), options));
}

DeviceHand::DeviceHand(std::unique_ptr<HapticDevice> device, const DeviceHandOptions& options)
    : options_(options), device_(std::move(device), {}) {}

DeviceHand::~DeviceHand() = default;

void DeviceHand::begin(const Scene& scene, const Box& body) {
  unit_ = scene.options.body.length_unit;
  const Vec3 up = up_of(scene);
  const double shortest = body.is_empty() ? 0 : (body.hi - body.lo).minCoeff();
  length_ = options_.blade_length.value_or(std::min(kLongestEdge, kEdgeShare * shortest * unit_)) / unit_;
  const Vec3 top = body.is_empty() ? Vec3(Vec3::Zero()) : top_of(body, up);
  device_.place(
      {unit_ * (top + (0.5 + kStartAbove) * length_ * up), options_.axes.value_or(axes_for(up)), options_.scale});
  pose_.reset();
  feel({});
  if (loop_) return;
  HapticLoopOptions loop = options_.loop;
  loop.tool.physics_period = scene.options.frame_seconds;
  loop_.emplace(device_, loop);
  // Options are sound, so that only threads can run out; there is no device then, and the simulation goes on.
  if (!loop_->start().ok()) loop_.reset();
}

std::optional<BladePose> DeviceHand::blade(const Box& body) {
  if (!loop_) return std::nullopt;
  loop_->take_tool_state();
  const HapticToolState& state = loop_->tool_state();
  peak_force_ = std::max(peak_force_, state.force.norm());
  passivity_ = state.passivity;
  is_live_ = state.tick > 0 && state.device.is_live;
  pose_.reset();
  if (!is_live_ || !state.tool_position.allFinite()) return std::nullopt;
  const Vec3 middle = state.tool_position / unit_;
  const Vec3 shaft = state.device.orientation * Vec3::UnitZ();
  BladePose& pose = pose_.emplace();
  for (int i = 0; i <= kSegments; ++i) {
    pose.edge.emplace_back(middle + (0.5 - static_cast<double>(i) / kSegments) * length_ * shaft);
  }
  const bool is_lifted = (state.device.buttons & PlacedDevice::kLift) != 0;
  const bool is_near = segment_meets(body, kNear * length_, pose.edge.front(), pose.edge.back());
  if (is_lifted || !is_near) return std::nullopt;
  return pose_;
}

void DeviceHand::feel(const HapticSnapshot& snapshot) {
  if (!loop_) return;
  HapticSnapshot numbered = snapshot;
  numbered.serial = ++serial_;
  loop_->publish(numbered);
}

HapticFigures DeviceHand::figures() const {
  const HapticLoopStatistics loop = statistics();
  return {loop.ticks,  peak_force_, passivity_.sampled_minimum, passivity_.held_minimum, passivity_.removed_energy,
          loop.compute};
}

HapticLoopStatistics DeviceHand::statistics() const {
  return loop_ ? loop_->statistics() : HapticLoopStatistics();
}

void DeviceHand::draw(Marks& marks) const {
  if (!pose_) return;
  for (std::size_t i = 1; i < pose_->edge.size(); ++i) {
    marks.lines.push_back(
        {pose_->edge[i - 1].cast<float>(), pose_->edge[i].cast<float>(), Ink::kBlade, 4, true, false});
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
