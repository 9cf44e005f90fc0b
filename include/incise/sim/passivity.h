// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "incise/core/result.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// Sums the energy that flows through a port into the virtual world, and keeps its minimum.
///
/// Port convention: `force` acts on the device, `displacement` is the device's, so `-force · displacement` flows from
/// the hand into the virtual world. A world that never gives back more than it got has energy() ≥ 0 at all times.
/// **Source:** Hannaford & Ryu 2002, eq. for the passivity observer: E(n) = E(0) + Σ f·v·dt (there f is the force on
/// the world: the other sign).
class PassivityObserver {
 public:
  /// `initial_energy`: E(0), J.
  explicit PassivityObserver(double initial_energy = 0) : energy_(initial_energy), minimum_(initial_energy) {}

  /// @param force  N on the device.  @param displacement  m, of the device while the force acted.
  void add(const Vec3& force, const Vec3& displacement);

  [[nodiscard]] double energy() const { return energy_; }    ///< J
  [[nodiscard]] double minimum() const { return minimum_; }  ///< J, the smallest energy so far
  /// What the energy would be after a displacement.
  [[nodiscard]] double after(const Vec3& force, const Vec3& displacement) const {
    return energy_ - force.dot(displacement);
  }

 private:
  double energy_, minimum_;
};

/// What the controller may reckon with.
struct PassivityOptions {
  bool is_controlled = true;  ///< false: energies are observed, forces pass unchanged
  /// E(0) of the held port, J, at least 0: about ½ stiffness · surprise², what the first contact from rest needs.
  /// It bounds what the world may ever give beyond what it got; 2e-5 J is a hand of 0.1 kg at 20 mm/s.
  double initial_energy = 2e-5;
  /// The most that one tick's displacement differs from the last by acceleration, m/s²; hands reach some 10 to 30.
  double max_acceleration = 50;
  /// The step of the device's position sensor, m: 0 exact, 1e-5 a fine device, 5.5e-5 a common desktop arm.
  double position_quantum = 1e-5;
  /// Energy that may be saved up for later, J. Work long spent on cutting must not pay for an oscillation now.
  double max_saved_energy = 0.1;
  double recovery_time = 0.05;  ///< s in which a force that was cut to nothing comes back, at least 0
  /// s each way between device and controller, in [0, 0.05]: positions are so old when they come, and forces when they
  /// act. Ticks are to be 1e-4 s or longer then.
  double link_delay = 0;
  static constexpr double kLongestDelay = 0.05;  ///< s; longer ones are refused
};

/// Errors: kBadArgument names the first option out of its range.
[[nodiscard]] Status check(const PassivityOptions& options);

/// What the observers saw and the controller did. Energies in J with the convention of `PassivityObserver`.
struct PassivityReport {
  double sampled_energy = 0;       ///< Σ -f·v·dt with force and velocity of the same tick (Hannaford & Ryu 2002)
  double sampled_minimum = 0;      ///< never below 0 with the controller, whatever the device does
  double held_energy = 0;          ///< initial_energy + what the held force really did while the device moved, at the
                                   ///< device, as far as its positions have come
  double held_minimum = 0;         ///< never below 0 with the controller while surprises == 0
  double removed_energy = 0;       ///< of the sampled port: what the controller kept from being given
  std::uint64_t damped_ticks = 0;  ///< the damper changed the force
  std::uint64_t scaled_ticks = 0;  ///< too little was saved to hold the whole force through the tick
  std::uint64_t surprises = 0;     ///< displacements beyond max_acceleration and position_quantum
};

/// Keeps the energy at the device's port from going below zero by damping, and where that is not enough, by scaling.
///
/// Two ports are kept. *Sampled*, force · velocity of the same tick, is the observer of the paper: the adaptive damper
/// α v lets a tick spend a fifth of it at most, so it is never negative for any input. *Held* is what the motor really
/// does: a force commanded now acts while the device moves to its next place, which nobody knows yet. So the controller
/// asks that the saved energy pay for the worst displacement in reach: the last one ± (max_acceleration · dt² + 2
/// quanta). The force that leaves is never longer than the one that came; after it was cut it comes back slowly.
/// Over a link with a delay a force acts on displacements that come back two delays later. Until then what it may give
/// at worst, within a reach that grows with the time ahead, is set aside and pays for nothing else: so the held port,
/// at the device, keeps its promise for any hand. Where ticks are lost it is not known which force acted on which part
/// of a displacement: it is shared out by time.
/// **Source:** Hannaford & Ryu 2002 (observer, impedance-type controller). *Differs:* the held port and its
/// reach, the fifth, the slow return, the delay.
///
/// One thread, no allocation after it was made, no clock. One call of `limit` per tick. Cost: O(1), and O(forces under
/// way) with a delay.
class PassivityController {
 public:
  /// `options` that `check` accepts.
  explicit PassivityController(const PassivityOptions& options = {});

  /// The force to command, N on the device.
  ///
  /// @param dt  s, above 0.  @param displacement  m, of the device since the last call (while the last force acted);
  /// zero at the first.  @param velocity  m/s, of the device now.  @param wanted  N on the device.
  Vec3 limit(double dt, const Vec3& displacement, const Vec3& velocity, const Vec3& wanted);

  /// What was seen and done so far.
  [[nodiscard]] PassivityReport report() const;
  /// What may be given back now, J: at most the held energy while surprises == 0.
  [[nodiscard]] double saved_energy() const { return saved_; }

 private:
  void observe_held(double dt, const Vec3& displacement);
  [[nodiscard]] Vec3 control(double dt, const Vec3& displacement, const Vec3& step, const Vec3& wanted);
  [[nodiscard]] Vec3 damp(const Vec3& step, const Vec3& wanted);
  [[nodiscard]] Vec3 scale(double dt, const Vec3& displacement, const Vec3& wanted);
  [[nodiscard]] double reach(double dt, double ahead) const;
  [[nodiscard]] double round_trip() const { return 2 * options_.link_delay; }
  [[nodiscard]] Vec3 force_during(double dt);
  [[nodiscard]] double set_aside(double dt, const Vec3& displacement) const;
  void send(const Vec3& force);

  /// A force, and when it was sent.
  struct Sent {
    Vec3 force = Vec3::Zero();
    double time = 0;
  };
  /// The i-th of those whose displacements have not come yet, the oldest first.
  [[nodiscard]] const Sent& under_way(std::size_t i) const { return ring_[(first_ + i) % ring_.size()]; }

  PassivityOptions options_;
  PassivityObserver sampled_, held_;
  PassivityReport counts_;
  double saved_;
  double gain_ = 1;  ///< of the force; below 1 after it was cut
  Vec3 held_force_ = Vec3::Zero();
  Vec3 last_displacement_ = Vec3::Zero();
  double time_ = 0;         // s, sum of all ticks; with a delay alone
  std::vector<Sent> ring_;  // likewise
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace v0
}  // namespace incise
