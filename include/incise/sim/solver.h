// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "incise/core/result.h"
#include "incise/geom/vec.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/tissue_point.h"

namespace incise {
inline namespace v0 {

/// Something that pulls at a point of the tissue: k/2 |a − target|², or k/2 (axis · (a − target))² along an axis.
///
/// The point is a = Σ weights · vertices; in the mesh's length unit, as the body stands.
struct Pull {
  std::array<VertexId, 4> vertices{};         ///< of one tet; those without weight may be invalid
  std::array<double, 4> weights{1, 0, 0, 0};  ///< barycentric, sum 1
  Vec3 target = Vec3::Zero();                 ///< where the point is pulled to
  Vec3 axis = Vec3::Zero();                   ///< a unit vector, or zero: in all directions
  double stiffness = 0;                       ///< N/m, at least 0
  bool pushes_only = false;                   ///< with an axis: acts only where axis · (a − target) < 0
  /// N, at least 0; where the spring would pull harder it gives way, and pulls with this.
  double limit = std::numeric_limits<double>::infinity();
  /// With an axis: the spring holds the point across the axis to `anchor` as well, with this force at most, N:
  /// friction.
  double drag = 0;
  Vec3 anchor = Vec3::Zero();  ///< where it holds it, length unit; without `drag` it means nothing

  /// Whether both are the same in all numbers.
  friend bool operator==(const Pull&, const Pull&) = default;
};

/// A spring between two points of the tissue: k/2 (|b − a| − L)². It pulls at both ends alike, so that it changes
/// neither the momentum of the body nor its angular momentum.
struct Tie {
  std::array<TissuePoint, 2> ends;  ///< a and b, each in a live tet
  double stiffness = 0;             ///< k: N/m, at least 0
  double rest_length = 0;           ///< L: m, at least 0
  bool pushes = true;               ///< below its rest length; a thread, which does not, hangs slack there

  /// Its force on `a` towards `b` where these are `length` metres apart, N: below 0 where it pushes them apart.
  [[nodiscard]] double tension(double length) const {
    return length < rest_length && !pushes ? 0.0 : stiffness * (length - rest_length);
  }
  /// Whether both are the same in all numbers.
  friend bool operator==(const Tie&, const Tie&) = default;
};

/// What following the journal changed.
struct FollowReport {
  std::size_t removed_tets = 0, added_tets = 0;  ///< by the steps that were followed
  std::size_t fresh_vertices = 0;                ///< born, copied or moved, or put elsewhere by the solver
};

/// What one `advance` did.
struct AdvanceReport {
  std::size_t active_vertices = 0;  ///< that were awake
  double fastest = 0;               ///< greatest speed of a vertex, m/s
  std::size_t self_contacts = 0;    ///< vertices that pressed on faces of the same body
  std::size_t torn_holds = 0;       ///< springs that held vertices and tore out
};

/// What relaxes the tissue of a `Simulation`. `DeformableBody` is the solver that Incise has; derive from this one to
/// bring your own.
///
/// A solver takes the mesh where it is made, and follows it through the journal from there on (docs/journal.md;
/// `JournalVisitor` keeps the order of the records). In each frame the simulation calls `set_pulls`, `advance`,
/// `pull_force` for each hook, then cuts and maintains the mesh, then calls `follow`; after `advance`, and after a
/// `follow` that tells of fresh vertices, it hands `positions` to the engine. Nothing is called at the same time.
class Solver {
 public:
  virtual ~Solver() = default;

  /// Catches up with the journal, forwards or backwards (undo): `mesh` as it stands. Returns what is new; where
  /// `fresh_vertices` is 0 the places stay as they were handed over last.
  virtual Result<FollowReport> follow(const Journal& journal, const TetMesh& mesh) = 0;
  /// Moves on by `dt` seconds, in (0, 1].
  virtual Result<AdvanceReport> advance(double dt) = 0;
  /// Replaces all pulls: of hooks, tools, and the blade that presses on tissue. An error names what is malformed.
  virtual Status set_pulls(std::vector<Pull> pulls) = 0;
  /// Replaces all ties: sutures and the like. To be given anew after each `follow`, whose steps may have taken the tets
  /// that they are in. Errors: kBadArgument names the first malformed tie; a solver that has no ties refuses any.
  virtual Status set_ties(std::vector<Tie> ties);
  /// The force of a pull on the tissue as it stands, N. `index` into what `set_pulls` got last.
  [[nodiscard]] virtual Vec3 pull_force(std::size_t index) const = 0;
  /// The place of every vertex slot, in the mesh's length unit, finite. Valid until the next call that changes it.
  [[nodiscard]] virtual std::span<const Vec3> positions() const = 0;
  /// Multiplies all velocities by `factor`, in [0, 1]: for `Simulation::settle`.
  virtual void slow_down(double factor) = 0;
  /// The 3×3 stiffness that a vertex meets while its neighbours stay, N/m, for force feedback.
  [[nodiscard]] virtual Mat3 local_stiffness(VertexId vertex) const = 0;
  /// Of its state, for recordings and tests.
  [[nodiscard]] virtual std::uint64_t hash() const = 0;

 protected:
  Solver() = default;
  Solver(const Solver&) = default;
  Solver& operator=(const Solver&) = default;
};

}  // namespace v0
}  // namespace incise
