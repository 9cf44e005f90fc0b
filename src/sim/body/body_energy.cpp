// SPDX-License-Identifier: Apache-2.0
// An implicit step only ever takes energy from a body that is left alone. A descent that was not finished may add some,
// and light vertices may carry it on until all flies apart: so what a step has added is taken from the motion.
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"
#include "sim/body/turning.h"

namespace incise {
inline namespace v0 {

/// How each free group moves as a rigid body, which is not to change; nothing for the others.
void DeformableBody::State::find_drifts(std::vector<detail::Drift>& found) const {
  found.assign(groups.size(), {});
  if (!has_free_group) return;
  const auto for_each_free = [&](const auto& visit) {
    for_each_awake([&](std::uint32_t slot) {
      const std::uint32_t group = group_at(VertexId(slot));
      if (groups[group].is_free) visit(found[group], VertexId(slot));
    });
  };
  for_each_free([&](detail::Drift& drift, VertexId v) {
    drift.mass += mass_of(v);
    drift.centre += mass_of(v) * (places[v.value] - middle);
    drift.velocity += momentum_of(v);
  });
  for (detail::Drift& drift : found) {
    if (!(drift.mass > 0)) continue;
    drift.centre /= drift.mass;
    drift.velocity /= drift.mass;
  }
  for_each_free([&](detail::Drift& drift, VertexId v) {
    drift.spin += (places[v.value] - middle - drift.centre).cross(momentum_of(v));
  });
  find_turns(found);
}

/// The rates that go with the spins as the groups stand.
void DeformableBody::State::find_turns(std::vector<detail::Drift>& found) const {
  std::vector<Mat3> inertia(groups.size(), Mat3::Zero());
  for_each_awake([&](std::uint32_t slot) {
    const std::uint32_t group = group_at(VertexId(slot));
    if (!groups[group].is_free) return;
    const Vec3 arm = places[slot] - middle - found[group].centre;
    inertia[group] += mass_of(VertexId(slot)) * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  });
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (found[i].mass > 0) found[i].turn = detail::turn_for(found[i].spin, inertia[i]);
  }
}

/// Gives free groups the rigid motion that has these momenta where they stand, and nothing else.
void DeformableBody::State::move_rigidly(std::vector<detail::Drift> moved) {
  for (detail::Drift& drift : moved) drift.centre.setZero();
  for_each_awake([&](std::uint32_t slot) {
    detail::Drift& drift = moved[group_at(VertexId(slot))];
    if (drift.mass > 0) drift.centre += mass_of(VertexId(slot)) / drift.mass * (places[slot] - middle);
  });
  find_turns(moved);
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const detail::Drift& drift = moved[group_at(v)];
    if (groups[group_at(v)].is_free) set_momentum(v, mass_of(v) * drift.velocity_at(places[slot] - middle));
  });
}

/// What is held or asleep has a share in the energy of tets whose other corners move. Cost: O(awake), or O(body) where
/// most of it is awake: not where most of what may move is, since far more may be held.
void DeformableBody::State::find_resting() {
  resting.clear();
  if (2 * order.awake_count() > places.size()) {
    for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
      const VertexId v(slot);
      if (is_live(v) && in_crumb[v] == 0 && !order.is_awake(v)) resting.push_back(slot);
    }
    return;
  }
  is_resting.resize(places.size(), 0);
  for_each_awake([&](std::uint32_t slot) {
    detail::SweepOrder::for_each_neighbour(stars, VertexId(slot), [&](VertexId n) {
      if (order.is_awake(n) || is_resting[n] != 0) return;
      is_resting[n] = 1;
      resting.push_back(n.value);
    });
  });
  for (const std::uint32_t v : resting) is_resting[VertexId(v)] = 0;
}

/// The energy before an `advance`, and where all stood.
detail::EnergyNow DeformableBody::State::watch_energy() {
  places_before.resize(places.size());
  for_each_awake([&](std::uint32_t v) { places_before[v] = places[v]; });
  return energy_now();
}

/// Of the pressures that an `advance` may change, as they are.
double DeformableBody::State::pressed_energy() const {
  double sum = 0;
  const auto add = [&](std::uint32_t row) {
    const double k = nodal.stiffness(VertexId(rows.slots()[row]));
    const auto pressure = static_cast<double>(floats[std::size_t{4} * row + 3]);
    if (k > 0) sum += 0.5 * pressure * pressure / k;
  };
  for (const auto& part : awake_rows) {
    for (const std::uint32_t row : part) add(row);
  }
  for (const std::uint32_t row : beside_rows) {
    if (!order.is_awake(VertexId(rows.slots()[row]))) add(row);
  }
  return sum;
}

/// Of what an `advance` may change: all but a constant.
detail::EnergyNow DeformableBody::State::energy_now() {
  detail::EnergyNow now;
  find_drifts(drifts);
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const double m = mass_of(v);
    const Vec3 momentum = momentum_of(v);
    const Vec3 relative = momentum - m * drifts[group_at(v)].velocity_at(places[slot] - middle);
    now.total += 0.5 * momentum.squaredNorm() / m;
    now.motion += 0.5 * relative.squaredNorm() / m;
    now.total -= m / unit() * options.gravity.dot(places[slot] - middle);
  });
  const detail::Descent d = descent();
  find_pressures();
  std::vector<std::uint32_t> beside;  // tets that are inside out have a corner that is awake
  double elastic = detail::energy_share(d, rows_of(resting), beside);
  std::array<double, detail::SweepOrder::kParts> of_parts{};
  const auto find = [&](std::size_t part) {
    turned_rows[part].clear();
    of_parts[part] = detail::energy_share(d, awake_rows[part], turned_rows[part]);
  };
  pair.run([&] { find(0); }, [&] { find(1); });
  find(2);
  for (const double part : of_parts) elastic += part;
  if (nodal.is_on) elastic += pressed_energy();
  now.total += elastic;
  now.noise = detail::kEnergyNoise * std::abs(elastic);
  for (const detail::PullTerm& term : terms) {
    if (term.stiffness > 0)
      now.total += detail::pull_state(term, detail::off_target(term, floats.data(), rows.rows())).energy;
  }
  for (const detail::ContactTerm& term : contact.terms()) {
    now.total += detail::contact_energy(term, floats.data(), rows.rows());
  }
  return now;
}

/// Takes from the motion what a step has added to the energy; where that was not all, the step goes less far.
void DeformableBody::State::keep_energy(const detail::EnergyNow& before, double dt) {
  detail::EnergyNow now = energy_now();
  untangle(before, now);
  const double excess = now.excess_over(before);
  if (!(excess > 0)) return;
  const double kept = excess < now.motion ? std::sqrt(1 - excess / now.motion) : 0;
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const Vec3 drift = mass_of(v) * drifts[group_at(v)].velocity_at(places[slot] - middle);
    set_momentum(v, drift + kept * (momentum_of(v) - drift));
  });
  const bool descends = options.relaxation != Relaxation::kPositionBased;  // which knows of no energy
  if (descends && excess > now.motion) step_back(before.total + before.noise, dt);
}

/// Takes awake vertices back towards where they were, but for what free pieces do as rigid bodies, until there is no
/// more energy than that: a descent over tets that are turned inside out may go uphill, on ways that the sweeps do not
/// see.
void DeformableBody::State::step_back(double most, double dt) {
  const std::vector<detail::Drift> moved = drifts;
  std::vector<Mat3> turns(moved.size(), Mat3::Identity());
  std::vector<Vec3> centres(moved.size(), Vec3::Zero());  // before
  for (std::size_t i = 0; i < moved.size(); ++i) turns[i] = detail::turning_by(dt * moved[i].turn);
  for_each_awake([&](std::uint32_t slot) {
    const std::uint32_t group = group_at(VertexId(slot));
    if (groups[group].is_free)
      centres[group] += mass_of(VertexId(slot)) / moved[group].mass * (places_before[slot] - middle);
  });
  for (const double share : {0.5, 0.25, 0.125, 0.0}) {
    for_each_awake([&](std::uint32_t slot) {
      const VertexId v(slot);
      const std::uint32_t group = group_at(v);
      Vec3 back = places_before[slot];
      if (groups[group].is_free) {
        const Vec3 centre = middle + centres[group];
        back = centre + dt * moved[group].velocity + turns[group] * (back - centre);
      }
      const double less = share > 0 ? 0.5 : 0.0;  // of what the last round left
      places[slot] = back + less * (places[slot] - back);
      round_place(v);
    });
    if (has_free_group) move_rigidly(moved);
    const detail::EnergyNow now = energy_now();
    if (!(now.total - now.noise > most)) return;
  }
}

}  // namespace v0
}  // namespace incise
