// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "incise/core/result.h"
#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/material.h"

namespace incise {
inline namespace v0 {

/// How each Newton step is solved.
enum class LinearSolver : std::uint8_t {
  kAutomatic,           ///< Cholesky up to `kMostTetsForCholesky` tets, conjugate gradients above
  kCholesky,            ///< sparse Cholesky: exact, memory and time grow fast with the mesh
  kConjugateGradients,  ///< preconditioned by blocks; slow with thin tets
};

/// The greatest number of tets for which a sparse Cholesky factor is worth its time.
inline constexpr std::size_t kMostTetsForCholesky = 20000;

/// A body, what it is made of, and what acts on it.
struct ReferenceProblem {
  const TetMesh* mesh = nullptr;                   ///< its rest shape; read by `create` alone
  Materials materials;                             ///< by the tets' regions
  double length_unit = 1.0;                        ///< metres per length unit of the mesh, above 0
  Vec3 gravity = Vec3(0, 0, -9.81);                ///< m/s²
  std::vector<VertexId> held;                      ///< stay where they stand when a solve begins
  std::vector<Vec3> loads;                         ///< N, dead loads: one per vertex slot, or none
  double thinnest = 0;                             ///< in [0, 1): see `ReferenceSolver`; 0: off
  LinearSolver linear = LinearSolver::kAutomatic;  ///< how each Newton step is solved
};

/// When a solve ends.
struct ReferenceLimits {
  double tolerance = 1e-9;           ///< N: the greatest force that may be left on a vertex; above 0
  std::size_t max_iterations = 100;  ///< of Newton's method
};

/// What a solve did.
struct ReferenceReport {
  bool converged = false;             ///< `residual` is within the tolerance
  std::size_t iterations = 0;         ///< of Newton's method
  std::size_t linear_iterations = 0;  ///< of conjugate gradients, over all Newton steps; 0 with Cholesky
  double residual = 0;                ///< N: the greatest force left on a vertex that is not held
};

/// Solves for the equilibrium and the motion of an elastic body to many digits, slowly: what real-time solvers are
/// measured against.
///
/// Linear finite elements of stable neo-Hookean tissue, psi = μ/2 (|F|² - 3) + λ'/2 (J - α)², α = 1 + μ/λ', with
/// λ' = λ + μ of Lamé, so that small strains have the material's Young's modulus and Poisson's ratio, from 0 on.
/// A quarter of each tet's mass sits in each of its vertices. Newton's method on the energy, with backtracking; where
/// the second derivatives are not positive definite, those of each element are projected.
/// `thinnest` softens slivers as real-time solvers do: μ and λ' of a tet are multiplied by
/// min(1, least altitude / (thinnest · longest edge)).
/// Flat tets (`is_flat`) have neither mass nor stiffness; vertices with no others never move.
/// Positions: one per vertex slot, in the mesh's unit. All else in SI units. Calls on one solver may run in parallel.
/// **Source:** B. Smith, F. de Goes, T. Kim, "Stable neo-Hookean flesh simulation", 2018. Differs: no logarithm, and
/// eigenvalues by a general solver.
class ReferenceSolver {
 public:
  /// Errors: kBadArgument names what is out of range. Cost: O(tets), and the elimination order.
  static Result<ReferenceSolver> create(const ReferenceProblem& problem);

  /// Finds the equilibrium near where the body stands.
  ///
  /// From rest it is found with slivers of any kind; from a start that scrambles the mesh only while no tet is thinner
  /// than about 1/100 of its edges.
  /// @param positions  in: where to start, finite; out: the best found, converged or not. Slots without tets stay.
  /// Errors: kBadArgument for a wrong count, a position that is not finite, bad limits, or a part of the body that
  /// fewer than three held vertices carry: it has no equilibrium. Cost: per iteration one or two solves.
  Result<ReferenceReport> solve_statics(std::vector<Vec3>& positions, const ReferenceLimits& limits = {}) const;

  /// Moves the body on by one step of implicit Euler: damped, and stable for every step.
  ///
  /// @param positions   as for `solve_statics`; out: after the step.
  /// @param velocities  m/s, one per vertex slot, finite; out: after the step, 0 where held.
  /// @param dt          s, above 0.
  /// Errors: as `solve_statics`, but loose parts may fly.
  Result<ReferenceReport> step(std::vector<Vec3>& positions, std::vector<Vec3>& velocities, double dt,
                               const ReferenceLimits& limits = {}) const;

  /// The elastic energy, J: 0 at rest. One position per vertex slot. Cost: O(tets).
  [[nodiscard]] double elastic_energy(const std::vector<Vec3>& positions) const;
  /// The elastic forces on the vertices, N, held ones too: minus the energy's gradient. Cost: O(tets).
  [[nodiscard]] std::vector<Vec3> elastic_forces(const std::vector<Vec3>& positions) const;
  /// The masses of the vertices, kg; 0 for slots without tets.
  [[nodiscard]] std::vector<double> masses() const;

 private:
  struct Model;
  explicit ReferenceSolver(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

  std::shared_ptr<const Model> model_;  // never changes
};

}  // namespace v0
}  // namespace incise
