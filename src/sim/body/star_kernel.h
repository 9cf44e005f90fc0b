// SPDX-License-Identifier: Apache-2.0
// The inner loop of the descent: one visit of a vertex moves it to the least energy that its neighbours leave it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "incise/geom/vec.h"
#include "sim/body/contact_terms.h"
#include "sim/body/nodal_volumes.h"
#include "sim/body/packed_stars.h"
#include "sim/body/stars.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// A vertex in motion: what pulls it besides its tets. Places are single precision, against the body's middle.
struct Motion {
  std::array<float, 3> start{};             ///< before the substep
  std::array<float, 3> aim{};               ///< where inertia and gravity take it, from `start`
  double weight = 0;                        ///< mass by the substep squared: what it costs to be elsewhere
  double diagonal = 0;                      ///< of the star's Laplacian
  float reach = 0;                          ///< the most that one visit may move it
  std::uint32_t first_pull = 0, pulls = 0;  ///< its part of the list of pull uses
  std::uint32_t first_contact = 0;          ///< likewise of contact uses
  std::uint16_t contacts = 0;
  bool leaps = false;     ///< its velocity takes it far enough to do harm
  bool is_rigid = false;  ///< it moves with its bone: visits leave it where it is
};

// Visits read `start`, and then `aim`, in four numbers at once.
static_assert(offsetof(Motion, start) == 0 && offsetof(Motion, aim) == sizeof Motion::start);

/// A pull or a tie as the descent sees it; places against the body's middle. Of a tie the point is b − a.
struct PullTerm {
  std::array<std::uint32_t, 8> vertices{};  ///< of a tie: those of a, then those of b
  std::array<double, 8> weights{};          ///< 0 where there is no vertex; of a tie below 0 for a
  std::uint32_t corners = 4;                ///< of these there may be: 8 of a tie
  Vec3 target = Vec3::Zero();
  Vec3 axis = Vec3::Zero();
  double stiffness = 0;
  double limit = std::numeric_limits<double>::infinity();  ///< of the force, along the axis where there is one
  double drag = 0;                                         ///< the same across it: 0: none
  Vec3 anchor = Vec3::Zero();  ///< with drag: where the point is held across the axis, against the target
  bool has_axis = false, pushes_only = false;
  double rest_length = 0;   ///< of a tie
  bool pulls_only = false;  ///< likewise

  [[nodiscard]] bool is_tie() const { return corners == 8; }
};

/// One vertex' part in a pull.
struct PullUse {
  std::uint32_t term = 0;
  double weight = 0;
};

/// What visits read and write. Vertices that are visited are given by their rows; all else goes by vertex slot where it
/// does not say otherwise.
struct Descent {
  float* places = nullptr;  ///< 4 per row, the fourth its pressure for `find_slopes`
  const StarBlock* blocks = nullptr;
  const Star* stars = nullptr;
  const Motion* motions = nullptr;  ///< by row
  const PullTerm* terms = nullptr;
  const PullUse* uses = nullptr;
  const ContactTerm* contact_terms = nullptr;
  const ContactUse* contact_uses = nullptr;
  // of `KernelRows`: by vertex slot, and by row
  const std::uint32_t* rows = nullptr;
  const std::uint32_t* slots = nullptr;
  // of `PackedStars`, by row
  const PackedStar* packed = nullptr;
  const PackedStar* parts = nullptr;
  const NearLanes* near = nullptr;
  const TetLanes* tets = nullptr;
  // of `NodalVolumes`, by row; null where no volume is averaged
  const NodeTerm* nodes = nullptr;
  // of tissue that stiffens; null where none does
  const StiffeningBlock* stiffening = nullptr;
  // of tissue with fibres; null where there are none
  const FibreBlock* fibres = nullptr;
};

/// The energy of one vertex as a quadratic: value 0 at its place, slope, and symmetric curvature (xx xy xz yy yz zz).
struct Quadratic {
  std::array<double, 3> slope{};
  std::array<double, 6> curvature{};
};

/// What a pull does at its point as it stands: the slope of its energy, and how stiff it is there: 0 where it does not
/// push, or has reached its limit.
struct PullState {
  Vec3 slope = Vec3::Zero();
  double stiffness = 0;
  double across = 0;  ///< how stiff it is across the axis
  double energy = 0;  ///< k/2 x², and linear beyond the limits

  /// All of its stiffness.
  [[nodiscard]] Mat3 curvature(const PullTerm& term) const;
};
/// `off`: from the target to the point.
[[nodiscard]] PullState pull_state(const PullTerm& term, const Vec3& off);

/// From a pull's target to its point as it stands; `places` lie by row, `rows` by vertex slot.
[[nodiscard]] Vec3 off_target(const PullTerm& term, const float* places, const std::uint32_t* rows);

/// Adds what pulls a vertex to its quadratic.
void add_pulls(const Descent& descent, const Motion& motion, Quadratic& q);

/// Writes the pressures of vertices as places are now. Whatever moves vertices but for the two below leaves them stale.
/// `find_slopes` reads them from the places: a visit that wrote them there would make the next one wait.
void find_pressures(const Descent& descent, std::span<const std::uint32_t> vertices);
/// Visits vertices in order, or backwards. Vertices of one call are visited one after the other.
void sweep(const Descent& descent, std::span<const std::uint32_t> order, bool is_backward);
/// Puts vertices back to their start where they cost less there: light slivers would fly off where their velocity
/// takes them.
void pick_starts(const Descent& descent, std::span<const std::uint32_t> order);
/// Writes the slopes of the energies of vertices, 4 numbers per vertex slot; moves nothing.
void find_slopes(const Descent& descent, std::span<const std::uint32_t> order, float* slopes);
/// The share of vertices in the elastic energy of their tets, not counted from rest; without that of pressures. Adds
/// to `turned` those of the vertices that have a tet which is inside out, as far as single precision tells.
[[nodiscard]] double energy_share(const Descent& descent, std::span<const std::uint32_t> order,
                                  std::vector<std::uint32_t>& turned);
/// The quadratic of one vertex, its inertia and pulls included.
[[nodiscard]] Quadratic quadratic_of(const Descent& descent, std::uint32_t vertex);

}  // namespace detail
}  // namespace v0
}  // namespace incise
