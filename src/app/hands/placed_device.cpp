// SPDX-License-Identifier: Apache-2.0
// World = offset + scale · axes · device. Each lift ends with a new offset, such that what is held stays where it was.
#include "app/hands/placed_device.h"

#include <array>
#include <cmath>
#include <utility>

namespace incise {
inline namespace v0 {
namespace app {

Eigen::Matrix3d axes_for(const Vec3& up) {
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), up).toRotationMatrix();
}

Result<Eigen::Matrix3d> parse_axes(const std::string& text) {
  const Error bad{ErrorCode::kBadArgument,
                  "'" + text +
                      "' are no axes; name the device's axis that is the world's x, y and z each, so that it is "
                      "a rotation: x,y,z or x,-z,y",
                  {}};
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  std::size_t at = 0;
  for (Eigen::Index row = 0; row < 3; ++row) {
    if (row > 0 && (at >= text.size() || text[at++] != ',')) return bad;
    const bool is_negative = at < text.size() && text[at] == '-';
    at += is_negative ? 1 : 0;
    if (at >= text.size() || text[at] < 'x' || text[at] > 'z') return bad;
    axes(row, text[at++] - 'x') = is_negative ? -1 : 1;
  }
  if (at != text.size() || std::abs(axes.determinant() - 1) > 0.5) return bad;
  return axes;
}

PlacedDevice::PlacedDevice(std::unique_ptr<HapticDevice> device, const DevicePlacement& placement)
    : device_(std::move(device)), placement_(placement) {}

DeviceState PlacedDevice::read(double time) {
  DeviceState state = device_->read(time);
  if (placements_.take()) {
    placement_ = placements_.value();
    is_placed_ = false;
  }
  if (!state.is_live) return state;
  const Vec3 place = turned(state.position);
  const bool goes_on = is_placed_ && is_lifted_;
  is_lifted_ = (state.buttons & kLift) != 0;
  if (!std::exchange(is_placed_, true)) offset_ = placement_.start - place;
  if (goes_on) offset_ = held_ - place;
  held_ = offset_ + place;
  state.position = held_;
  state.velocity = is_lifted_ ? Vec3(Vec3::Zero()) : turned(state.velocity);
  state.orientation = Eigen::Quaterniond(placement_.axes) * state.orientation;
  return state;
}

void PlacedDevice::command(const Vec3& force) {
  device_->command(is_lifted_ ? Vec3(Vec3::Zero()) : Vec3(placement_.axes.transpose() * force));
}

}  // namespace app
}  // namespace v0
}  // namespace incise
