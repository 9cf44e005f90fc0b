// SPDX-License-Identifier: Apache-2.0
#include "seams/spring_solver.h"

#include <algorithm>

#include "incise/core/hash.h"
#include "incise/mesh/tet_tables.h"

namespace incise::test {
namespace {

constexpr double kStiffness = 40, kMass = 0.01, kDamping = 3;  // N/m, kg, 1/s
constexpr unsigned kSubsteps = 8;

template <std::size_t N>
Vec3 blend(const std::vector<Vec3>& values, const std::array<VertexId, N>& of, const std::array<double, N>& weights) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < N; ++i) {
    if (of[i].is_valid()) sum += weights[i] * values[of[i].value];
  }
  return sum;
}

}  // namespace

SpringSolver::SpringSolver(const TetMesh& mesh) {
  grow(mesh.vertex_slots(), mesh.tet_slots());
  double highest = -1e300;
  mesh.for_each_vertex([&](VertexId v) {
    rest_[v.value] = place_[v.value] = mesh.rest(v);
    highest = std::max(highest, mesh.rest(v).z());
  });
  mesh.for_each_vertex([&](VertexId v) { is_held_[v.value] = mesh.rest(v).z() == highest; });
  mesh.for_each_tet([&](TetId t) { tets_[t.value] = mesh.vertices(t); });
}

void SpringSolver::grow(std::size_t vertices, std::size_t tets) {
  rest_.resize(std::max(rest_.size(), vertices), Vec3::Zero());
  place_.resize(rest_.size(), Vec3::Zero());
  velocity_.resize(rest_.size(), Vec3::Zero());
  is_held_.resize(rest_.size(), false);
  tets_.resize(std::max(tets_.size(), tets));
}

Result<FollowReport> SpringSolver::follow(const Journal& journal, const TetMesh& mesh) {
  if (journal.position() < position_) return Error{ErrorCode::kUnsupported, "springs know no undo", {}};
  grow(mesh.vertex_slots(), mesh.tet_slots());
  fresh_ = added_ = removed_ = 0;
  for (; position_ < journal.position(); ++position_) visit(journal.step(position_), *this);
  return FollowReport{removed_, added_, fresh_};
}

void SpringSolver::born(const BornVertex& born) {
  rest_[born.id.value] = born.rest;
  place_[born.id.value] = blend(place_, born.parents, born.weights);
  velocity_[born.id.value] = blend(velocity_, born.parents, born.weights);
  is_held_[born.id.value] = false;
  ++fresh_;
}
void SpringSolver::moved(const MovedVertex& moved) {
  const Vec3 place = blend(place_, moved.basis, moved.weights), velocity = blend(velocity_, moved.basis, moved.weights);
  rest_[moved.id.value] = moved.rest;
  place_[moved.id.value] = place;
  velocity_[moved.id.value] = velocity;
  ++fresh_;
}
void SpringSolver::copied(const CopiedVertex& copied) {
  rest_[copied.id.value] = rest_[copied.source.value];
  place_[copied.id.value] = place_[copied.source.value];
  velocity_[copied.id.value] = velocity_[copied.source.value];
  is_held_[copied.id.value] = is_held_[copied.source.value];
  ++fresh_;
}
void SpringSolver::replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) {
  for (const ConsumedTet& tet : consumed) tets_[tet.id.value] = {};
  for (const ProducedTet& tet : produced) tets_[tet.id.value] = tet.vertices;
  removed_ += consumed.size();
  added_ += produced.size();
}
void SpringSolver::rewired(const RewiredTet& tet) {
  tets_[tet.id.value] = tet.vertices;
}

void SpringSolver::fall(double dt) {
  std::vector<Vec3> force(rest_.size(), Vec3(0, 0, -9.81 * kMass));
  for (const TetVertices& tet : tets_) {
    if (!tet[0].is_valid()) continue;
    for (const auto& [i, j] : kEdgeCorners) {
      const std::uint32_t a = tet[i].value, b = tet[j].value;
      const Vec3 along = place_[b] - place_[a];
      const double length = along.norm();
      if (!(length > 0)) continue;
      const Vec3 pull = kStiffness * (1 - (rest_[b] - rest_[a]).norm() / length) * along;
      force[a] += pull;
      force[b] -= pull;
    }
  }
  for (std::size_t i = 0; i < pulls_.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (pulls_[i].vertices[c].is_valid()) force[pulls_[i].vertices[c].value] += pulls_[i].weights[c] * pull_force(i);
    }
  }
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    if (is_held_[v]) continue;
    velocity_[v] = (velocity_[v] + dt / kMass * force[v]) / (1 + dt * kDamping);
    place_[v] += dt * velocity_[v];
  }
}

Result<AdvanceReport> SpringSolver::advance(double dt) {
  for (unsigned i = 0; i < kSubsteps; ++i) fall(dt / kSubsteps);
  AdvanceReport report;
  for (const Vec3& velocity : velocity_) report.fastest = std::max(report.fastest, velocity.norm());
  report.active_vertices = rest_.size();
  return report;
}

Status SpringSolver::set_pulls(std::vector<Pull> pulls) {
  pulls_ = std::move(pulls);
  return {};
}

Vec3 SpringSolver::pull_force(std::size_t index) const {
  const Pull& pull = pulls_[index];
  const Vec3 to = pull.target - blend(place_, pull.vertices, pull.weights);
  if (pull.axis.isZero(0)) return pull.stiffness * to;
  const double along = pull.axis.dot(to);
  return pull.pushes_only && along <= 0 ? Vec3(Vec3::Zero()) : Vec3(pull.stiffness * along * pull.axis);
}

void SpringSolver::slow_down(double factor) {
  for (Vec3& velocity : velocity_) velocity *= factor;
}

Mat3 SpringSolver::local_stiffness(VertexId /*vertex*/) const {
  return kStiffness * Mat3::Identity();
}

std::uint64_t SpringSolver::hash() const {
  StateHash hash;
  for (const Vec3& place : place_) {
    for (int i = 0; i < 3; ++i) hash.add(place[i]);
  }
  return hash.value();
}

bool SpringSolver::fits(const TetMesh& mesh) const {
  bool fits = mesh.vertex_slots() == rest_.size() && mesh.tet_slots() == tets_.size();
  for (std::uint32_t slot = 0; fits && slot < mesh.tet_slots(); ++slot) {
    const bool is_live = mesh.is_live(TetId(slot));
    fits = is_live == tets_[slot][0].is_valid() && (!is_live || tets_[slot] == mesh.vertices(TetId(slot)));
  }
  return fits;
}

}  // namespace incise::test
