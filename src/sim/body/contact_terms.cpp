// SPDX-License-Identifier: Apache-2.0
// A spring along the normal while the gap is below zero, and one to the anchor across it that gives way at its limit:
// slopes and bounds of curvature, added to a visit's quadratic (docs/internals.md, 4).
#include "sim/body/contact_terms.h"

#include <algorithm>
#include <cmath>

#include "sim/body/star_kernel.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// Pressing: k/2 gap² below 0. Friction: a spring to the anchor that gives way at its limit, as Huber's function has
/// it, whose slope is continuous: the secant stiffness is its curvature's bound.
static inline ContactState state_of(const ContactTerm& term, const float* places, const std::uint32_t* rows) {
  const float* x = places + std::size_t{4} * rows[term.vertices[0]];
  const float* a = places + std::size_t{4} * rows[term.vertices[1]];
  const float* b = places + std::size_t{4} * rows[term.vertices[2]];
  const float* c = places + std::size_t{4} * rows[term.vertices[3]];
  std::array<float, 3> off;
  for (unsigned i = 0; i < 3; ++i) {
    off[i] = x[i] - (term.share[0] * a[i] + term.share[1] * b[i] + term.share[2] * c[i]) - term.reference[i];
  }
  ContactState state;
  const auto& n = term.normal;
  state.gap = n[0] * off[0] + n[1] * off[1] + n[2] * off[2];
  if (state.gap < 0) state.press = term.stiffness * state.gap;
  if (!(term.limit > 0)) return state;
  for (unsigned i = 0; i < 3; ++i) state.slip[i] = off[i] - state.gap * n[i];
  const float slip2 = state.slip[0] * state.slip[0] + state.slip[1] * state.slip[1] + state.slip[2] * state.slip[2];
  const float force2 = term.stiffness * term.stiffness * slip2;
  state.drag = force2 <= term.limit * term.limit ? term.stiffness : term.limit / std::sqrt(slip2);
  return state;
}

ContactState contact_state(const ContactTerm& term, const float* places, const std::uint32_t* rows) {
  return state_of(term, places, rows);
}

double contact_energy(const ContactTerm& term, const float* places, const std::uint32_t* rows) {
  const ContactState state = state_of(term, places, rows);
  const auto wide = [](float value) { return static_cast<double>(value); };
  double energy = 0.5 * wide(state.press) * wide(std::min(state.gap, 0.0F));
  if (!(state.drag > 0)) return energy;
  const double x = wide(state.slip[0]), y = wide(state.slip[1]), z = wide(state.slip[2]);
  const double length = std::sqrt(x * x + y * y + z * z), stiffness = wide(term.stiffness), limit = wide(term.limit);
  const bool sticks = state.drag == term.stiffness;
  return energy + (sticks ? 0.5 * stiffness * length * length : limit * (length - 0.5 * limit / stiffness));
}

void add_contacts(const Descent& descent, const Motion& motion, Quadratic& q) {
  for (std::uint32_t i = 0; i < motion.contacts; ++i) {
    const ContactUse use = descent.contact_uses[motion.first_contact + i];
    const ContactTerm& term = descent.contact_terms[use / 4];
    const ContactState state = state_of(term, descent.places, descent.rows);
    if (!(state.gap < 0) && !(state.drag > 0)) continue;
    const float weight = term.weight(use % 4);
    const auto& n = term.normal;
    for (unsigned k = 0; k < 3; ++k) {
      q.slope[k] += static_cast<double>(weight * (state.press * n[k] + state.drag * state.slip[k]));
    }
    // along n: the spring's, across it: friction's
    const float across = weight * weight * state.drag;
    const float along = (state.gap < 0 ? weight * weight * term.stiffness : 0.0F) - across;
    const std::array<float, 6> nn = {n[0] * n[0], n[0] * n[1], n[0] * n[2], n[1] * n[1], n[1] * n[2], n[2] * n[2]};
    for (unsigned k = 0; k < 6; ++k) q.curvature[k] += static_cast<double>(along * nn[k]);
    for (const unsigned k : {0U, 3U, 5U}) q.curvature[k] += static_cast<double>(across);
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
