// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "incise/core/result.h"
#include "incise/geom/vec.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/material.h"
#include "incise/sim/self_contact.h"
#include "incise/sim/solver.h"

namespace incise {
inline namespace v0 {

/// How a body finds its balance.
enum class Relaxation : std::uint8_t {
  kBlockDescent,   ///< vertex block descent: each vertex goes to the least energy that its neighbours leave it
  kPositionBased,  ///< sequential XPBD: bounded on the worst of meshes, but too soft at few iterations
};

/// What a spring that holds a vertex bears.
struct HoldLimit {
  double force = std::numeric_limits<double>::infinity();  ///< N, above 0
  bool tears = false;  ///< beyond it the spring lets go; else the vertex slips, so that it bears just this
};

/// How a body is computed.
struct BodyOptions {
  double length_unit = 1;                             ///< metres per length unit of the mesh, above 0
  Vec3 gravity{0, 0, -9.81};                          ///< m/s²
  double damping = 0;                                 ///< share of the velocity lost per second, 1/s, at least 0
  Relaxation relaxation = Relaxation::kBlockDescent;  ///< by which method
  unsigned substeps = 4;                              ///< per `advance`, in [1, 1000]
  unsigned iterations = 5;                            ///< sweeps over all vertices per substep, in [1, 1000]
  double thinnest = 0.05;     ///< tets thinner than this share of their longest edge are as soft as if they were not
  double sleep_below = 1e-5;  ///< of the local edge length per `advance`: what moves less falls asleep; 0: never
  unsigned threads = 1;       ///< in [1, 256]; two are of use, and the result does not depend on them
  double crumb = 0;           ///< length unit³: smaller tets only resist stretch; 0: 3e-6 of the mean one at load
  SelfContactOptions self;    ///< contact of the body with itself and of its pieces with each other
  /// What resists a change of volume is averaged at the vertices, but for what each tet keeps: Poisson's ratios near
  /// 0.5 do not make the body too stiff. Of block descent alone; a visit takes 1.2 times as long, a
  /// frame 1.3 to 1.4 times (Bonet and Burton 1998; the share that tets keep is Puso and Solberg's, 2006).
  bool average_volumes = false;
  bool coarse = true;  ///< substeps of block descent begin with a step on a coarse lattice through the whole body
};

/// Energies in J.
struct BodyEnergy {
  double elastic = 0;    ///< above that of the rest shape
  double kinetic = 0;    ///< of motion
  double potential = 0;  ///< of gravity, against the origin of coordinates
  double held = 0;       ///< in the springs that hold vertices
  double pulled = 0;     ///< in the pulls, as they stand
  double tied = 0;       ///< in the ties
  [[nodiscard]] double total() const { return elastic + kinetic + potential + held + pulled + tied; }  ///< the sum
};

/// An elastic body that follows a tetrahedral mesh through its journal: the paper's relaxation.
///
/// Stable neo-Hookean tissue, ψ = μ/2 (|F|² − 3) + λ/2 (J − 1)² − μ (J − 1), λ being Lamé's + μ, implicit Euler in
/// time. Seen from one vertex this energy is exactly quadratic, so that a visit is one 3×3 solve (vertex block descent,
/// Chen et al. 2024, in a split form whose stretch part is a constant Laplacian and whose volume part needs no
/// deformation gradient). Mass, momentum and rest volume are kept through every step of the journal. Free pieces fall
/// as they must: what the unfinished descent takes from the momentum of a piece is given back to it rigidly; what has
/// fallen 5 body lengths from what is held sleeps there, and
/// free crumbs below a hundredth of the mean tet move as points and sleep after a second. What a body left alone gains
/// in energy its motion pays for. Positions are in the mesh's length unit, all else in SI units. Not thread-safe. The
/// same calls give the same bits on every compiler and number of threads. *Differs* from the paper, which relaxes a
/// mass-spring mesh.
class DeformableBody final : public Solver {
 public:
  /// Takes the body as it stands, at rest or not, without velocity, and follows its `journal` from here on.
  /// Errors: kBadArgument for options or materials out of range. Cost: O(tets), about 1 µs each.
  static Result<DeformableBody> create(const TetMesh& mesh, const Journal& journal, const Materials& materials,
                                       const BodyOptions& options = {});
  DeformableBody(DeformableBody&&) noexcept;
  DeformableBody& operator=(DeformableBody&&) noexcept;
  ~DeformableBody() override;

  /// As given to `create`.
  [[nodiscard]] const BodyOptions& options() const;
  /// As given to `create`.
  [[nodiscard]] const Materials& materials() const;

  /// Catches up with the journal, forwards or backwards; `mesh` as it stands; after each call of the engine that may
  /// change the mesh. What the steps made or moved wakes, and goes close to its balance, with more of what is around it
  /// where the tets have more elastic energy than before. After an undo or redo, vertices that it leaves where they are
  /// at rest stay where the body has them, and the others go where the body has their material, as fast as that is.
  /// Positions are to be handed on to the mesh. Errors: kBadArgument where the journal stands before `create`. Cost:
  /// O(steps), below 0.5 µs per tet consumed or produced, to 10 µs where energy would be added; O(tets) after an undo.
  Result<FollowReport> follow(const Journal& journal, const TetMesh& mesh) override;

  /// Moves on by `dt` seconds, in (0, 1]. Errors: kBadArgument for another `dt`. Cost: O(awake vertices · substeps ·
  /// iterations), about 10 ns per tet and iteration.
  Result<AdvanceReport> advance(double dt) override;

  // --- what holds it and what pulls it

  /// Holds a vertex where it stands, rigidly (stiffness infinite) or by a spring of `stiffness` N/m; 0 lets it go.
  /// Vertices that cuts put between rigidly held ones are held as well, copies as their sources.
  /// Errors: kBadArgument for a vertex that is not live or a stiffness below 0. Cost: O(1).
  Status hold(VertexId vertex, double stiffness);
  /// The same by a spring that bears no more than `limit`: a pin. `stiffness` is finite here.
  Status hold(VertexId vertex, double stiffness, const HoldLimit& limit);
  /// Sets the place where a held vertex is held. Errors: kBadArgument where it is not held.
  Status move_hold(VertexId vertex, const Vec3& target);
  /// Whether a vertex is held, rigidly or by a spring.
  [[nodiscard]] bool is_held(VertexId vertex) const;
  /// Replaces all pulls. Wakes the vertices of those that come, go or change; what pulls as before lets them sleep.
  /// Errors: kBadArgument names the first malformed pull; then nothing changes. Cost: O(pulls).
  Status set_pulls(std::vector<Pull> pulls) override;
  /// As set last; those whose vertices died pull no more.
  [[nodiscard]] const std::vector<Pull>& pulls() const;
  /// Replaces all ties. Wakes the vertices of those that come, go or change. Errors: kBadArgument names the first
  /// malformed tie; then nothing changes. Cost: O(ties²), a few ns each; O(vertices) where one goes.
  Status set_ties(std::vector<Tie> ties) override;
  /// As set last; those whose tets changed act no more.
  [[nodiscard]] const std::vector<Tie>& ties() const;
  /// The force of a pull on the tissue as it stands, N.
  [[nodiscard]] Vec3 pull_force(std::size_t index) const override;
  /// What the tissue does to its rigid holds, N, at the last substep: elasticity, gravity and inertia. Cost: O(held).
  [[nodiscard]] Vec3 force_on_holds() const;

  // --- what it is like

  /// The places of all vertex slots, for `Engine::set_positions`. Valid until the next call that changes the body.
  [[nodiscard]] std::span<const Vec3> positions() const override;
  /// Puts a vertex at another place, without velocity. Errors: kBadArgument where it is not live, or not finite.
  Status place(VertexId vertex, const Vec3& position);
  [[nodiscard]] Vec3 velocity(VertexId vertex) const;  ///< m/s
  /// Gives a vertex a velocity, m/s, and wakes it; none to one that is held rigidly. Errors: kBadArgument where it is
  /// not live, or not finite.
  Status set_velocity(VertexId vertex, const Vec3& velocity);
  /// Multiplies all velocities by `factor`, in [0, 1], so that the body comes to rest sooner.
  void slow_down(double factor) override;
  [[nodiscard]] double mass(VertexId vertex) const;  ///< kg
  [[nodiscard]] double mass() const;                 ///< kg
  [[nodiscard]] Vec3 momentum() const;               ///< kg m/s
  [[nodiscard]] Vec3 angular_momentum() const;       ///< kg m²/s, about the origin of coordinates
  /// Cost: O(tets).
  [[nodiscard]] BodyEnergy energy() const;
  /// The 3×3 stiffness that a vertex meets while its neighbours stay, N/m: its inverse is the local compliance. Without
  /// inertia. Cost: O(its tets).
  [[nodiscard]] Mat3 local_stiffness(VertexId vertex) const override;
  /// Tets that are turned inside out as the body stands. Cost: O(tets).
  [[nodiscard]] std::size_t count_inverted() const;
  /// Whether all positions and velocities are finite. Cost: O(vertices).
  [[nodiscard]] bool is_finite() const;
  /// Vertices that are awake.
  [[nodiscard]] std::size_t active_vertices() const;
  /// Of positions, momenta and masses. Cost: O(vertices).
  [[nodiscard]] std::uint64_t hash() const override;

  struct State;  ///< how it is done; not for users
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  explicit DeformableBody(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace v0
}  // namespace incise
