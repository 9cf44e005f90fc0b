// SPDX-License-Identifier: Apache-2.0
// Passivity observer and controller in the time domain: B. Hannaford, J.-H. Ryu, "Time-domain passivity control of
// haptic interfaces", IEEE Trans. Robotics and Automation 18(1), 2002.
#include "incise/sim/passivity.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {

namespace {

/// Of the sampled energy, the share that one tick may spend: a force that runs out of energy fades and does not drop.
constexpr double kSpent = 0.2;
/// Of the saved energy, the share that one tick may risk. From the rest a drained store grows again, tick by tick.
constexpr double kRisked = 0.9;

}  // namespace

void PassivityObserver::add(const Vec3& force, const Vec3& displacement) {
  energy_ = after(force, displacement);
  minimum_ = std::min(minimum_, energy_);
}

Status check(const PassivityOptions& options) {
  const auto is_amount = [](double number) { return number >= 0 && std::isfinite(number); };
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  if (!is_amount(options.initial_energy)) return bad("the initial energy must be at least 0 J");
  if (!is_amount(options.max_acceleration)) return bad("the largest acceleration must be at least 0 m/s²");
  if (!is_amount(options.position_quantum)) return bad("the position's quantum must be at least 0 m");
  if (!is_amount(options.max_saved_energy)) return bad("the largest saved energy must be at least 0 J");
  if (!is_amount(options.recovery_time)) return bad("the recovery time must be at least 0 s");
  return {};
}

PassivityController::PassivityController(const PassivityOptions& options)
    : options_(options),
      held_(options.initial_energy),
      saved_(std::min(options.initial_energy, options.max_saved_energy)) {}

double PassivityController::reach(double dt) const {
  return options_.max_acceleration * dt * dt + 2 * options_.position_quantum;
}

void PassivityController::observe_held(double dt, const Vec3& displacement) {
  // A part in 10⁶: displacements are differences of rounded positions.
  if ((displacement - last_displacement_).norm() > reach(dt) * (1 + 1e-6) + 1e-12) ++counts_.surprises;
  held_.add(held_force_, displacement);
  saved_ = std::min(saved_ - held_force_.dot(displacement), options_.max_saved_energy);
  // Only a surprise leads here. Its debt is forgiven: it is in the report, and a tool gone numb would help nobody.
  if (saved_ < 0) saved_ = std::min(options_.initial_energy, options_.max_saved_energy);
  last_displacement_ = displacement;
}

Vec3 PassivityController::damp(const Vec3& step, const Vec3& wanted) {
  const double missing = wanted.dot(step) - kSpent * sampled_.energy();
  if (missing <= 0) return wanted;
  ++counts_.damped_ticks;
  counts_.removed_energy += missing;
  const Vec3 damped = wanted - (missing / step.squaredNorm()) * step;
  // Rounding, or a step too short to divide by: no force spends nothing.
  return damped.allFinite() && sampled_.after(damped, step) >= 0 ? damped : Vec3::Zero();
}

Vec3 PassivityController::scale(double dt, const Vec3& displacement, const Vec3& wanted) {
  const double worst = wanted.dot(displacement) + wanted.norm() * reach(dt);
  const double budget = kRisked * saved_;
  if (worst <= budget) return wanted;
  ++counts_.scaled_ticks;
  return (budget / worst) * wanted;
}

Vec3 PassivityController::control(double dt, const Vec3& displacement, const Vec3& step, const Vec3& wanted) {
  // A force that was cut comes back slowly: else it would chatter where the hand hardly moves and its direction flips.
  if (gain_ < 1) gain_ = options_.recovery_time > 0 ? std::min(1.0, gain_ + dt / options_.recovery_time) : 1.0;
  const Vec3 eased = gain_ * wanted;
  Vec3 force = scale(dt, displacement, damp(step, eased));
  if (sampled_.after(force, step) < 0) force.setZero();
  if (force != eased) gain_ *= force.norm() / eased.norm();
  return force;
}

Vec3 PassivityController::limit(double dt, const Vec3& displacement, const Vec3& velocity, const Vec3& wanted) {
  observe_held(dt, displacement);
  const Vec3 step = velocity * dt;
  const Vec3 force = options_.is_controlled ? control(dt, displacement, step, wanted) : wanted;
  sampled_.add(force, step);
  held_force_ = force;
  return force;
}

PassivityReport PassivityController::report() const {
  PassivityReport report = counts_;
  report.sampled_energy = sampled_.energy();
  report.sampled_minimum = sampled_.minimum();
  report.held_energy = held_.energy();
  report.held_minimum = held_.minimum();
  return report;
}

}  // namespace v0
}  // namespace incise
