// SPDX-License-Identifier: Apache-2.0
// A critically damped spring draws the device to the pointer, integrated backwards, with bounded acceleration.
#include "app/hands/mouse_device.h"

#include "incise/sim/time_steps.h"

namespace incise {
inline namespace v0 {
namespace app {

MouseDevice::MouseDevice(const MouseOptions& options, const Vec3& start)
    : options_(options), targets_(Target{start, 0}), target_{start, 0} {
  state_.position = start;
}

void MouseDevice::move_to(const Vec3& pointer, std::uint32_t buttons, bool is_clutched) {
  if (has_pointer_ && !is_clutched) target_.position += options_.scale * (pointer - pointer_);
  pointer_ = pointer;
  has_pointer_ = true;
  target_.buttons = buttons;
  targets_.publish(target_);
}

void MouseDevice::follow(double dt) {
  // x'' = ω²(target - x) - 2ω x', backwards. After 5/ω a jump is done to 4 percent.
  const double omega = 5 / options_.settle_time;
  const Vec3 gap = targets_.value().position - state_.position;
  const Vec3 velocity = (state_.velocity + dt * omega * omega * gap) / (1 + 2 * omega * dt + omega * omega * dt * dt);
  Vec3 change = velocity - state_.velocity;
  const double most = options_.max_acceleration * dt;
  if (change.norm() > most) change *= most / change.norm();
  state_.velocity += change;
  state_.position += dt * state_.velocity;
}

DeviceState MouseDevice::read(double time) {
  targets_.take();
  state_.buttons = targets_.value().buttons;
  for_time_steps(time_, time, [this](double dt) { follow(dt); });
  return state_;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
