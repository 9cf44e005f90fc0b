// SPDX-License-Identifier: Apache-2.0
// What the descent reads of contacts between parts of the body.
#pragma once

#include <array>
#include <cstdint>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace detail {

struct Descent;
struct Motion;
struct Quadratic;

/// A vertex before a face, one cache line. The gap vector is x₀ − Σ share · xᵢ − reference: along the normal it is the
/// gap, across it how far the vertex has slipped from its anchor.
struct ContactTerm {
  std::array<std::uint32_t, 4> vertices{};  ///< the vertex, then the corners of the face
  std::array<float, 3> share{};             ///< of the face's corners, sum 1
  std::array<float, 3> normal{};            ///< unit, out of the face
  std::array<float, 3> reference{};
  float stiffness = 0;  ///< kg/s²
  float limit = 0;      ///< of friction, kg L/s²: its coefficient times the last force
  float unused = 0;

  /// The weight of one of the four vertices in the gap vector.
  [[nodiscard]] float weight(unsigned corner) const { return corner == 0 ? 1.0F : -share[corner - 1]; }
};
static_assert(sizeof(ContactTerm) == 64);

/// One vertex' part in a term: term · 4 + corner.
using ContactUse = std::uint32_t;

/// What a term does at its gap as it stands; `places` lie by row, `rows` by vertex slot.
struct ContactState {
  float gap = 0;                ///< below 0: in force
  float press = 0;              ///< the slope of the energy along the normal, at most 0
  float drag = 0;               ///< the slope of the energy by how far it has slipped
  std::array<float, 3> slip{};  ///< across the normal
};
[[nodiscard]] ContactState contact_state(const ContactTerm& term, const float* places, const std::uint32_t* rows);
/// The energy of a term as it stands, kg L²/s².
[[nodiscard]] double contact_energy(const ContactTerm& term, const float* places, const std::uint32_t* rows);

/// Adds the contacts of a vertex to its quadratic.
void add_contacts(const Descent& descent, const Motion& motion, Quadratic& q);

}  // namespace detail
}  // namespace v0
}  // namespace incise
