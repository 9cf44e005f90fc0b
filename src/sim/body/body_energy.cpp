// SPDX-License-Identifier: Apache-2.0
// An implicit step only ever takes energy from a body that is left alone. A descent that was not finished may add some,
// and light vertices may carry it on until all flies apart: so what a step has added is taken from the motion.
#include <algorithm>
#include <cmath>

#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {

namespace {

/// Of the sum of single-precision energies, which do not start at 0: changes below are rounding.
constexpr double kNoise = 2e-7;

/// k/2 x², and linear beyond the limit.
double energy_of(const detail::PullTerm& term, const Vec3& off) {
  const detail::PullState state = detail::pull_state(term, off);
  const double force = state.slope.norm();
  if (force == 0) return 0;
  const double reached = force / term.stiffness;
  const double beyond = term.has_axis ? std::abs(term.axis.dot(off)) - reached : 0;
  return 0.5 * force * reached + force * std::max(beyond, 0.0);
}

}  // namespace

/// The mean velocity of each free piece, which is not to change; zero for the others.
void DeformableBody::State::find_drifts(std::vector<Vec3>& found) const {
  found.assign(pieces.size(), Vec3::Zero());
  if (!has_free_piece) return;
  std::vector<double> mass(pieces.size());
  for_each_awake([&](std::uint32_t slot) {
    const std::uint32_t piece = piece_of[VertexId(slot)];
    if (!pieces[piece].is_free) return;
    found[piece] += momentum_of(VertexId(slot));
    mass[piece] += mass_of(VertexId(slot));
  });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (mass[i] > 0) found[i] /= mass[i];
  }
}

detail::EnergyNow DeformableBody::State::energy_now() {
  detail::EnergyNow now;
  resting.clear();
  for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
    const VertexId v(slot);
    if (!is_live(v)) continue;
    if (!order.is_awake(v)) resting.push_back(slot);
    now.total -= mass_of(v) / unit() * options.gravity.dot(places[slot] - middle);
  }
  find_drifts(drifts);
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const double m = mass_of(v);
    const Vec3 momentum = momentum_of(v), relative = momentum - m * drifts[piece_of[v]];
    now.total += 0.5 * momentum.squaredNorm() / m;
    now.motion += 0.5 * relative.squaredNorm() / m;
  });
  const detail::Descent d = descent();
  double elastic = detail::energy_share(d, resting);
  for (std::size_t part = 0; part < detail::SweepOrder::kParts; ++part) {
    elastic += detail::energy_share(d, order.awake(static_cast<detail::SweepOrder::Part>(part)));
  }
  now.total += elastic;
  now.noise = kNoise * std::abs(elastic);
  for (const detail::PullTerm& term : terms) {
    if (term.stiffness > 0) now.total += energy_of(term, detail::off_target(term, floats.data()));
  }
  return now;
}

/// Takes from the motion what a step has added to the energy; where that was not all, the step goes less far.
void DeformableBody::State::keep_energy(const detail::EnergyNow& before, double dt) {
  const detail::EnergyNow now = energy_now();
  const double excess = now.total - before.total - now.noise - before.noise;
  if (!(excess > 0)) return;
  const double kept = excess < now.motion ? std::sqrt(1 - excess / now.motion) : 0;
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const Vec3 drift = mass_of(v) * drifts[piece_of[v]];
    set_momentum(v, drift + kept * (momentum_of(v) - drift));
  });
  const bool descends = options.relaxation != Relaxation::kPositionBased;  // which knows of no energy
  if (descends && excess > now.motion) step_back(before.total + before.noise, dt);
}

/// Takes awake vertices back towards where they were, but for the drift of free pieces, until there is no more energy
/// than that: a descent over tets that are turned inside out may go uphill, on ways that the sweeps do not see.
void DeformableBody::State::step_back(double most, double dt) {
  for (const double share : {0.5, 0.25, 0.125, 0.0}) {
    for_each_awake([&](std::uint32_t slot) {
      const VertexId v(slot);
      const Vec3 drift = dt * drifts[piece_of[v]];
      const double less = share > 0 ? 0.5 : 0.0;  // of what the last round left
      const Vec3 way = places[slot] - places_before[slot] - drift;
      places[slot] = places_before[slot] + drift + less * way;
      round_place(v);
    });
    const detail::EnergyNow now = energy_now();
    if (!(now.total - now.noise > most)) return;
  }
}

}  // namespace v0
}  // namespace incise
