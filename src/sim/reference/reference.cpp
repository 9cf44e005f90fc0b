// SPDX-License-Identifier: Apache-2.0
// Newton with exact second derivatives while they are positive definite, projected ones where not, and steps halved
// until the energy falls; near the end forces decide instead of energies (docs/internals.md, 4).
#include "incise/sim/reference.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sim/reference/block_matrix.h"
#include "sim/reference/constants.h"
#include "sim/reference/elastic_body.h"

namespace incise {
inline namespace v0 {

struct ReferenceSolver::Model {
  ElasticBody body;
  std::vector<Vec3> rest;   // m
  std::vector<Vec3> loads;  // N, weight included
  std::vector<VertexId> held;
  double length_unit = 1;
  bool uses_cholesky = true;

  [[nodiscard]] std::vector<Vec3> to_displacements(const std::vector<Vec3>& positions) const;
  void to_positions(const std::vector<Vec3>& displacements, std::vector<Vec3>& positions) const;
};

namespace {

Error bad(std::string message, std::vector<std::uint64_t> ids = {}) {
  return {ErrorCode::kBadArgument, std::move(message), std::move(ids)};
}

/// Slots that no element uses may hold anything.
Status check_vectors(const ElasticBody& body, const std::vector<Vec3>& vectors, const std::string& what) {
  if (vectors.size() != body.slot_count()) return bad(what + ": one is needed for each vertex slot");
  for (std::uint32_t slot = 0; slot < body.slot_count(); ++slot) {
    if (body.mass(slot) > 0 && !vectors[slot].allFinite()) {
      return bad(what + ": that of vertex " + std::to_string(slot) + " is not finite", {slot});
    }
  }
  return {};
}

Status check(const ReferenceLimits& limits) {
  if (!(limits.tolerance > 0)) return bad("the tolerance must be above 0 N");
  return {};
}

Status check(const ReferenceProblem& problem) {
  if (problem.mesh == nullptr) return bad("a mesh is needed");
  if (Status status = check(problem.materials); !status) return status;
  if (!(problem.length_unit > 0 && std::isfinite(problem.length_unit))) return bad("the length unit must be above 0 m");
  if (!problem.gravity.allFinite()) return bad("gravity must be finite");
  if (!(problem.thinnest >= 0 && problem.thinnest < 1)) return bad("thinnest must lie in [0, 1)");
  for (const VertexId vertex : problem.held) {
    if (!problem.mesh->is_live(vertex)) return bad("a held vertex is not in the mesh", {vertex.value});
  }
  return {};
}

/// What Newton's method makes least: elastic energy, less the work of loads, and with a time step the inertia
/// m/(2 dt²) |u - inertial|².
class Objective {
 public:
  Objective(const ElasticBody& body, const std::vector<Vec3>& loads) : body_(body), loads_(loads) {}
  /// With inertia about the places that free flight would lead to, m.
  Objective(const ElasticBody& body, const std::vector<Vec3>& loads, std::vector<Vec3> inertial, double dt)
      : body_(body), loads_(loads), inertial_(std::move(inertial)), per_dt2_(1 / (dt * dt)) {}

  struct Value {
    double sum = 0;
    double scale = 0;  // of its terms
  };

  [[nodiscard]] const ElasticBody& body() const { return body_; }

  [[nodiscard]] Value value(const std::vector<Vec3>& u) const {
    const double elastic = body_.energy(u);
    Value result{elastic, std::abs(elastic)};
    for_each_free([&](std::uint32_t slot, Eigen::Index) {
      add(result, -loads_[slot].dot(u[slot]));
      if (is_dynamic()) add(result, 0.5 * inertia(slot) * (u[slot] - inertial_[slot]).squaredNorm());
    });
    return result;
  }

  [[nodiscard]] VecX gradient(const std::vector<Vec3>& u) const {
    const std::vector<Vec3> elastic = body_.gradient(u);
    VecX result(3 * static_cast<Eigen::Index>(body_.unknown_count()));
    for_each_free([&](std::uint32_t slot, Eigen::Index row) {
      Vec3 sum = elastic[slot] - loads_[slot];
      if (is_dynamic()) sum += inertia(slot) * (u[slot] - inertial_[slot]);
      result.segment<3>(row) = sum;
    });
    return result;
  }

  [[nodiscard]] BlockMatrix hessian(const std::vector<Vec3>& u, bool is_projected) const {
    BlockMatrix result = body_.hessian(u, is_projected);
    if (!is_dynamic()) return result;
    for_each_free([&](std::uint32_t slot, Eigen::Index) {
      result.at(body_.unknown(slot), body_.unknown(slot)) += inertia(slot) * Mat3::Identity();
    });
    return result;
  }

  /// u + step·direction.
  [[nodiscard]] std::vector<Vec3> moved(std::vector<Vec3> u, const VecX& direction, double step) const {
    for_each_free([&](std::uint32_t slot, Eigen::Index row) { u[slot] += step * direction.segment<3>(row); });
    return u;
  }

 private:
  [[nodiscard]] bool is_dynamic() const { return per_dt2_ > 0; }
  [[nodiscard]] double inertia(std::uint32_t slot) const { return body_.mass(slot) * per_dt2_; }
  static void add(Value& value, double term) {
    value.sum += term;
    value.scale += std::abs(term);
  }
  template <class Visit>
  void for_each_free(Visit&& visit) const {
    for (std::uint32_t slot = 0; slot < body_.slot_count(); ++slot) {
      const std::uint32_t unknown = body_.unknown(slot);
      if (unknown != kInvalidIndex) visit(slot, 3 * static_cast<Eigen::Index>(unknown));
    }
  }

  const ElasticBody& body_;
  const std::vector<Vec3>& loads_;
  std::vector<Vec3> inertial_;
  double per_dt2_ = 0;
};

double greatest_force(const VecX& gradient) {
  double greatest2 = 0;
  for (Eigen::Index row = 0; row < gradient.size(); row += 3) {
    greatest2 = std::max(greatest2, gradient.segment<3>(row).squaredNorm());
  }
  return std::sqrt(greatest2);
}

/// Newton's method with backtracking. Exact second derivatives as long as they are positive definite and full steps
/// succeed, else projected ones.
class Newton {
 public:
  Newton(const Objective& objective, const ReferenceLimits& limits, bool uses_cholesky)
      : objective_(objective), limits_(limits), uses_cholesky_(uses_cholesky) {}

  ReferenceReport run(std::vector<Vec3>& u) {
    VecX gradient = objective_.gradient(u);
    report_.residual = greatest_force(gradient);
    while (!(report_.residual <= limits_.tolerance) && report_.iterations < limits_.max_iterations) {
      if (!advance(u, gradient)) break;
      ++report_.iterations;
      gradient = objective_.gradient(u);
      report_.residual = greatest_force(gradient);
    }
    report_.converged = report_.residual <= limits_.tolerance;
    report_.linear_iterations = iterative_.iterations;
    return report_;
  }

 private:
  /// False where no step makes the energy less: rounding errors rule.
  bool advance(std::vector<Vec3>& u, const VecX& gradient) {
    const std::optional<VecX> direction = find_direction(u, gradient);
    if (!direction) return false;
    const double step = search(u, gradient, *direction);
    if (step == 0) return false;
    u = objective_.moved(std::move(u), *direction, step);
    may_be_exact_ = step == 1;
    return true;
  }

  std::optional<VecX> find_direction(const std::vector<Vec3>& u, const VecX& gradient) {
    if (may_be_exact_) {
      std::optional<VecX> exact = solve(objective_.hessian(u, false), -gradient);
      if (exact && exact->dot(gradient) < 0) return exact;
    }
    const BlockMatrix projected = objective_.hessian(u, true);
    return solve_shifted(projected, gradient);
  }

  /// A projected Hessian may still be singular: a little of the identity then helps.
  std::optional<VecX> solve_shifted(BlockMatrix hessian, const VecX& gradient) {
    double shift = 0;
    for (std::uint32_t row = 0; row < hessian.rows(); ++row) shift = std::max(shift, hessian.at(row, row).norm());
    shift *= 1e-12;
    for (std::size_t attempt = 0; attempt < detail::kMostSingular; ++attempt) {
      std::optional<VecX> direction = solve(hessian, -gradient);
      if (direction && direction->dot(gradient) < 0) return direction;
      for (std::uint32_t row = 0; row < hessian.rows(); ++row) hessian.at(row, row) += shift * Mat3::Identity();
      shift *= 1e4;
    }
    return std::nullopt;
  }

  std::optional<VecX> solve(const BlockMatrix& hessian, const VecX& b) {
    return uses_cholesky_ ? direct_.solve(hessian, b) : iterative_.solve(hessian, b);
  }

  /// The length of the step, at most 1; 0 where none helps.
  [[nodiscard]] double search(const std::vector<Vec3>& u, const VecX& gradient, const VecX& direction) const {
    const Objective::Value start = objective_.value(u);
    const double slope = gradient.dot(direction);
    double step = 1;
    for (int halving = 0; halving < detail::kMostStepHalvings; ++halving, step /= 2) {
      const Objective::Value end = objective_.value(objective_.moved(u, direction, step));
      const double noise = detail::kReferenceNoise * (start.scale + end.scale);
      if (end.sum <= start.sum + detail::kSufficient * step * slope) return step;
      // What is left to win is lost in rounding errors: forces tell more than energies.
      if (end.sum <= start.sum + noise && -step * slope <= noise) return lessens_forces(u, gradient, direction, step);
    }
    return 0;
  }

  [[nodiscard]] double lessens_forces(const std::vector<Vec3>& u, const VecX& gradient, const VecX& direction,
                                      double step) const {
    const VecX end = objective_.gradient(objective_.moved(u, direction, step));
    return greatest_force(end) < greatest_force(gradient) ? step : 0;
  }

  const Objective& objective_;
  ReferenceLimits limits_;
  bool uses_cholesky_;
  bool may_be_exact_ = true;
  CholeskySolver direct_;
  ConjugateGradients iterative_;
  ReferenceReport report_;
};

}  // namespace

std::vector<Vec3> ReferenceSolver::Model::to_displacements(const std::vector<Vec3>& positions) const {
  std::vector<Vec3> result(positions.size());
  for (std::size_t slot = 0; slot < result.size(); ++slot) {
    result[slot] = body.mass(static_cast<std::uint32_t>(slot)) > 0 ? Vec3((positions[slot] - rest[slot]) * length_unit)
                                                                   : Vec3(Vec3::Zero());
  }
  return result;
}

void ReferenceSolver::Model::to_positions(const std::vector<Vec3>& displacements, std::vector<Vec3>& positions) const {
  for (std::size_t slot = 0; slot < positions.size(); ++slot) {
    const bool is_free = body.unknown(static_cast<std::uint32_t>(slot)) != kInvalidIndex;
    if (is_free) positions[slot] = rest[slot] + displacements[slot] / length_unit;
  }
}

Result<ReferenceSolver> ReferenceSolver::create(const ReferenceProblem& problem) {
  if (Status status = check(problem); !status) return status.error();
  const TetMesh& mesh = *problem.mesh;
  auto model = std::make_shared<Model>();
  model->body = ElasticBody(problem);
  if (!problem.loads.empty()) {
    if (Status status = check_vectors(model->body, problem.loads, "loads"); !status) return status.error();
  }
  model->held = problem.held;
  std::sort(model->held.begin(), model->held.end());
  model->held.erase(std::unique(model->held.begin(), model->held.end()), model->held.end());
  model->length_unit = problem.length_unit;
  model->uses_cholesky = problem.linear == LinearSolver::kAutomatic ? mesh.tet_count() <= kMostTetsForCholesky
                                                                    : problem.linear == LinearSolver::kCholesky;
  for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) {
    model->rest.push_back(mesh.rest(VertexId(slot)));
    const Vec3 load = problem.loads.empty() ? Vec3(Vec3::Zero()) : problem.loads[slot];
    model->loads.emplace_back(model->body.mass(slot) * problem.gravity + load);
  }
  return ReferenceSolver(std::move(model));
}

Result<ReferenceReport> ReferenceSolver::solve_statics(std::vector<Vec3>& positions,
                                                       const ReferenceLimits& limits) const {
  if (Status status = check(limits); !status) return status.error();
  if (Status status = check_vectors(model_->body, positions, "positions"); !status) return status.error();
  if (const std::uint32_t loose = model_->body.find_loose(model_->held); loose != kInvalidIndex) {
    return bad("the part of vertex " + std::to_string(loose) + " needs three held vertices to have an equilibrium",
               {loose});
  }
  std::vector<Vec3> u = model_->to_displacements(positions);
  const Objective objective(model_->body, model_->loads);
  const ReferenceReport report = Newton(objective, limits, model_->uses_cholesky).run(u);
  model_->to_positions(u, positions);
  return report;
}

Result<ReferenceReport> ReferenceSolver::step(std::vector<Vec3>& positions, std::vector<Vec3>& velocities, double dt,
                                              const ReferenceLimits& limits) const {
  if (!(dt > 0 && std::isfinite(dt))) return bad("the time step must be above 0 s");
  if (Status status = check(limits); !status) return status.error();
  if (Status status = check_vectors(model_->body, positions, "positions"); !status) return status.error();
  if (Status status = check_vectors(model_->body, velocities, "velocities"); !status) return status.error();
  const std::vector<Vec3> start = model_->to_displacements(positions);
  std::vector<Vec3> inertial = start;
  for (std::size_t slot = 0; slot < start.size(); ++slot) inertial[slot] += dt * velocities[slot];
  std::vector<Vec3> u = start;
  const Objective objective(model_->body, model_->loads, std::move(inertial), dt);
  const ReferenceReport report = Newton(objective, limits, model_->uses_cholesky).run(u);
  model_->to_positions(u, positions);
  for (std::size_t slot = 0; slot < start.size(); ++slot) {
    if (model_->body.mass(static_cast<std::uint32_t>(slot)) > 0) velocities[slot] = (u[slot] - start[slot]) / dt;
  }
  return report;
}

double ReferenceSolver::elastic_energy(const std::vector<Vec3>& positions) const {
  return model_->body.energy(model_->to_displacements(positions));
}

std::vector<Vec3> ReferenceSolver::elastic_forces(const std::vector<Vec3>& positions) const {
  std::vector<Vec3> result = model_->body.gradient(model_->to_displacements(positions));
  for (Vec3& force : result) force = -force;
  return result;
}

std::vector<double> ReferenceSolver::masses() const {
  std::vector<double> result(model_->rest.size());
  for (std::size_t slot = 0; slot < result.size(); ++slot) {
    result[slot] = model_->body.mass(static_cast<std::uint32_t>(slot));
  }
  return result;
}

}  // namespace v0
}  // namespace incise
