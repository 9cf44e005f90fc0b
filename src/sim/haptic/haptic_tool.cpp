// SPDX-License-Identifier: Apache-2.0
// Virtual coupling: J. E. Colgate, M. C. Stanley, J. M. Brown, "Issues in the haptic display of tool use", IROS 1995.
// The coupling is integrated backwards (implicit), in equilibrium with the tissue.
#include "incise/sim/haptic_tool.h"

#include <algorithm>
#include <cmath>

#include "sim/haptic/amounts.h"
#include "sim/haptic/constants.h"

namespace incise {
inline namespace v0 {

namespace {

using detail::is_amount;
using detail::is_positive;
using detail::is_within_bounds;

Vec3 shortened(const Vec3& v, double longest) {
  const double length = v.norm();
  return length > longest ? Vec3(v * (longest / length)) : v;
}

/// Over a link with a delay the coupling is no stiffer than what light grips bear, and the drag takes what it gives
/// away.
HapticToolOptions suited(HapticToolOptions options) {
  options.passivity.link_delay = std::min(options.passivity.link_delay, PassivityOptions::kLongestDelay);
  const double round_trip = 2 * options.passivity.link_delay;
  if (!(round_trip > 0)) return options;
  const double most = detail::kDelayedStiffness * detail::kLightestGrip / (round_trip * round_trip);
  const double softer = std::min(1.0, most / options.coupling_stiffness);
  options.coupling_stiffness *= softer;
  options.coupling_damping *= softer;
  return options;
}

}  // namespace

Status check(const HapticToolOptions& options) {
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  if (!is_positive(options.coupling_stiffness)) return bad("the coupling's stiffness must be above 0 N/m");
  if (!is_amount(options.coupling_damping)) return bad("the coupling's damping must be at least 0 N·s/m");
  if (!is_amount(options.drag)) return bad("the drag must be at least 0 N·s/m");
  if (!is_positive(options.max_stretch)) return bad("the coupling's largest stretch must be above 0 m");
  if (!is_positive(options.max_force)) return bad("the largest force must be above 0 N");
  if (!is_amount(options.physics_period)) return bad("the physics period must be at least 0 s");
  if (!(options.rupture.onset >= 1 && is_amount(options.rupture.onset))) {
    return bad("rupture must need at least the force of cutting");
  }
  if (!(options.rupture.arrest >= 0 && options.rupture.arrest < 1)) return bad("the arrest must lie in [0, 1)");
  return check(options.passivity);
}

HapticTool::HapticTool(const HapticToolOptions& options)
    : options_(suited(options)), tissue_(options.rupture), controller_(options.passivity) {}

double HapticTool::drag(double dt) const {
  const double round_trip = 2 * options_.passivity.link_delay;
  if (!(round_trip > 0)) return options_.drag;
  return std::max(options_.drag, options_.coupling_stiffness * (0.5 * dt + round_trip));
}

bool HapticTool::accept(const HapticSnapshot& snapshot) {
  const std::uint64_t last = has_pending_ ? pending_.serial : tissue_.snapshot().serial;
  if (snapshot.serial <= last || !is_sound(snapshot)) return false;
  pending_ = snapshot;
  has_pending_ = true;
  return true;
}

HapticTool::Coupling HapticTool::couple(double dt, const Vec3& device_position) const {
  const double damper = options_.coupling_damping / dt;
  Coupling coupling;
  coupling.stiffness = options_.coupling_stiffness + damper;
  coupling.rest = (damper / coupling.stiffness) * stretch_;
  coupling.handle = device_position + coupling.rest;
  return coupling;
}

Vec3 HapticTool::blend(double dt, const Coupling& coupling) {
  const double period = options_.physics_period;
  const auto faded = [&] { return fading_left_ > 0 ? Vec3(fading_ * (fading_left_ / period)) : Vec3(Vec3::Zero()); };
  fading_left_ = std::max(0.0, fading_left_ - dt);
  Vec3 force = tissue_.force(coupling.stiffness, coupling.handle);
  if (has_pending_) {
    const Vec3 before = force + faded();
    tissue_.follow(pending_);
    has_pending_ = false;
    force = tissue_.force(coupling.stiffness, coupling.handle);
    fading_ = before - force;
    fading_left_ = period;
  }
  return force + faded();
}

void HapticTool::place_tool(const Coupling& coupling, const Vec3& device_position) {
  stretch_ = shortened(coupling.rest + tissue_force_ / coupling.stiffness, options_.max_stretch);
  tool_position_ = device_position + stretch_;
}

Status HapticTool::check_tick(double dt, const Vec3& device_position, const Vec3& device_velocity) {
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  if (!(dt >= kShortestTick && dt <= kLongestTick)) return bad("a tick must last from 1e-9 to 1 s");
  if (!is_within_bounds(device_position)) return bad("the device's position must lie within 1e+15 m");
  if (!is_within_bounds(device_velocity)) return bad("the device's velocity must lie within 1e+15 m/s");
  return {};
}

Vec3 HapticTool::stop() {
  has_moved_ = false;
  force_.setZero();
  return force_;
}

Vec3 HapticTool::tick(double dt, const Vec3& device_position, const Vec3& device_velocity) {
  if (!check_tick(dt, device_position, device_velocity)) return stop();
  const Vec3 displacement = has_moved_ ? Vec3(device_position - device_position_) : Vec3(Vec3::Zero());
  const Coupling coupling = couple(dt, device_position);
  tissue_force_ = blend(dt, coupling);
  place_tool(coupling, device_position);
  // The saturated coupling, not the tissue, is what the hand feels.
  const Vec3 pull = coupling.stiffness * (stretch_ - coupling.rest);
  const Vec3 wanted = shortened(pull - drag(dt) * device_velocity, options_.max_force);
  force_ = controller_.limit(dt, displacement, device_velocity, wanted);
  device_position_ = device_position;
  has_moved_ = true;
  ++ticks_;
  return force_;
}

}  // namespace v0
}  // namespace incise
