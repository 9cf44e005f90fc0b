// SPDX-License-Identifier: Apache-2.0
// One mass on a spring and a damper, both taken at the end of a step: no step is too long for it.
#include "incise/sim/simulated_operator.h"

#include <cmath>

#include "incise/sim/time_steps.h"
#include "sim/haptic/amounts.h"

namespace incise {
inline namespace v0 {

Status check(const HandOptions& options) {
  using detail::is_amount;
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  if (!is_amount(options.mass) || options.mass == 0) return bad("the hand's mass must be above 0 kg");
  if (!is_amount(options.stiffness)) return bad("the hand's stiffness must be at least 0 N/m");
  if (!is_amount(options.damping)) return bad("the hand's damping must be at least 0 N·s/m");
  return {};
}

SimulatedOperator::SimulatedOperator(PoseTrack plan, const HandOptions& options)
    : plan_(std::move(plan)), options_(options), state_(plan_.at(0)) {}

void SimulatedOperator::step(double dt, double end) {
  const DeviceState plan = plan_.at(end);
  const double k = options_.stiffness, b = options_.damping;
  const Vec3 push = k * (plan.position - state_.position) + b * plan.velocity + force_;
  state_.velocity = (options_.mass * state_.velocity + dt * push) / (options_.mass + dt * b + dt * dt * k);
  state_.position += dt * state_.velocity;
}

DeviceState SimulatedOperator::read(double time) {
  double end = time_;
  for_time_steps(time_, time, [&](double dt) { step(dt, end += dt); });
  const DeviceState plan = plan_.at(time_);
  state_.orientation = plan.orientation;
  state_.buttons = plan.buttons;
  return state_;
}

}  // namespace v0
}  // namespace incise
