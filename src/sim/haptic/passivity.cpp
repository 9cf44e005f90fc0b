// SPDX-License-Identifier: Apache-2.0
// Passivity observer and controller in the time domain: B. Hannaford, J.-H. Ryu, "Time-domain passivity control of
// haptic interfaces", IEEE Trans. Robotics and Automation 18(1), 2002.
#include "incise/sim/passivity.h"

#include <algorithm>
#include <cmath>

#include "sim/haptic/amounts.h"
#include "sim/haptic/constants.h"

namespace incise {
inline namespace v0 {

void PassivityObserver::add(const Vec3& force, const Vec3& displacement) {
  energy_ = after(force, displacement);
  minimum_ = std::min(minimum_, energy_);
}

Status check(const PassivityOptions& options) {
  using detail::is_amount;
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  if (!is_amount(options.initial_energy)) return bad("the initial energy must be at least 0 J");
  if (!is_amount(options.max_acceleration)) return bad("the largest acceleration must be at least 0 m/s²");
  if (!is_amount(options.position_quantum)) return bad("the position's quantum must be at least 0 m");
  if (!is_amount(options.max_saved_energy)) return bad("the largest saved energy must be at least 0 J");
  if (!is_amount(options.recovery_time)) return bad("the recovery time must be at least 0 s");
  if (!(options.link_delay >= 0 && options.link_delay <= PassivityOptions::kLongestDelay)) {
    return bad("the link's delay must lie in [0, 0.05] s each way");
  }
  return {};
}

PassivityController::PassivityController(const PassivityOptions& options)
    : options_(options),
      held_(options.initial_energy),
      saved_(std::min(options.initial_energy, options.max_saved_energy)) {
  options_.link_delay = std::min(options.link_delay, PassivityOptions::kLongestDelay);  // options may be refused ones
  if (options_.link_delay > 0) ring_.resize(static_cast<std::size_t>(round_trip() / detail::kShortestDelayedTick) + 4);
}

/// By how much the displacement within a tick that ends so long ahead may differ from the last one.
double PassivityController::reach(double dt, double ahead) const {
  return options_.max_acceleration * dt * ahead + 2 * options_.position_quantum;
}

/// The force that acted, in the mean, during the last tick whose displacement has come; forgets those that act no more.
Vec3 PassivityController::force_during(double dt) {
  if (ring_.empty()) return held_force_;
  const double from = time_ - round_trip(), to = from + dt;
  time_ += dt;
  Vec3 sum = Vec3::Zero();
  while (count_ > 0) {
    const bool is_last = count_ == 1;
    const double end = is_last ? to : std::min(to, under_way(1).time);
    sum += std::max(0.0, end - std::max(from, under_way(0).time)) * under_way(0).force;
    if (is_last || under_way(1).time > to) break;
    first_ = (first_ + 1) % ring_.size();
    --count_;
  }
  return sum / dt;
}

/// What the forces under way may give at worst, if the device goes on from its last displacement.
double PassivityController::set_aside(double dt, const Vec3& displacement) const {
  double sum = 0;
  const double seen = time_ - round_trip();
  for (std::size_t i = 0; i < count_; ++i) {
    const Sent& sent = under_way(i);
    const double end = i + 1 < count_ ? under_way(i + 1).time : time_;
    const double lasts = end - std::max(sent.time, seen);
    if (!(lasts > 0)) continue;
    const double along = sent.force.dot(displacement) * (lasts / dt);
    sum += std::max(0.0, along + sent.force.norm() * reach(lasts, end - seen));
  }
  return sum;
}

void PassivityController::send(const Vec3& force) {
  held_force_ = force;
  if (ring_.empty() || count_ == ring_.size()) return;
  ring_[(first_ + count_++) % ring_.size()] = {force, time_};
}

void PassivityController::observe_held(double dt, const Vec3& displacement) {
  // A part in 10⁶: displacements are differences of rounded positions.
  if ((displacement - last_displacement_).norm() > reach(dt, dt) * (1 + 1e-6) + 1e-12) ++counts_.surprises;
  const Vec3 force = force_during(dt);
  held_.add(force, displacement);
  saved_ = std::min(saved_ - force.dot(displacement), options_.max_saved_energy);
  // Only a surprise leads here. Its debt is forgiven: it is in the report, and a tool gone numb would help nobody.
  if (saved_ < 0) saved_ = std::min(options_.initial_energy, options_.max_saved_energy);
  last_displacement_ = displacement;
}

Vec3 PassivityController::damp(const Vec3& step, const Vec3& wanted) {
  const double missing = wanted.dot(step) - detail::kSpent * sampled_.energy();
  if (missing <= 0) return wanted;
  ++counts_.damped_ticks;
  counts_.removed_energy += missing;
  const Vec3 damped = wanted - (missing / step.squaredNorm()) * step;
  // Rounding, or a step too short to divide by: no force spends nothing.
  return damped.allFinite() && sampled_.after(damped, step) >= 0 ? damped : Vec3::Zero();
}

Vec3 PassivityController::scale(double dt, const Vec3& displacement, const Vec3& wanted) {
  const double worst = wanted.dot(displacement) + wanted.norm() * reach(dt, dt + round_trip());
  const double budget = detail::kRisked * (saved_ - set_aside(dt, displacement));
  if (worst <= std::max(0.0, budget)) return wanted;
  ++counts_.scaled_ticks;
  return (std::max(0.0, budget) / worst) * wanted;
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
  send(force);
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
