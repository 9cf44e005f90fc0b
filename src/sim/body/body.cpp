// SPDX-License-Identifier: Apache-2.0
// The public calls of `DeformableBody`: arguments are checked, what they touch is woken, and energies and forces are
// summed up; steps in time and in the journal are elsewhere (docs/internals.md, 4).
#include "incise/sim/body.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "incise/core/hash.h"
#include "sim/body/body_state.h"
#include "sim/body/bounds.h"

namespace incise {
inline namespace v0 {

namespace {

using detail::is_place;
using detail::is_size;

Error bad(std::string message) {
  return {ErrorCode::kBadArgument, std::move(message), {}};
}

/// "vertex 7 is not live", with the vertex as its id; `before` stands in front.
Error bad_vertex(VertexId vertex, const std::string& what, const std::string& before = {}) {
  return {ErrorCode::kBadArgument, before + "vertex " + std::to_string(vertex.value) + " " + what, {vertex.value}};
}

Status check(const BodyOptions& o) {
  if (!(o.length_unit >= kLeastExtent && o.length_unit <= kGreatestExtent)) {
    return bad("the length unit must be above 0 m, from 1e-30 to 1e+30");
  }
  if (!is_place(o.gravity)) return bad("gravity must be finite, at most 1e+30 m/s²");
  if (!is_size(o.damping)) return bad("the damping must be at least 0 per second, at most 1e+30");
  if (o.substeps < 1 || o.substeps > 1000) return bad("the number of substeps must lie in [1, 1000]");
  if (o.iterations < 1 || o.iterations > 1000) return bad("the number of iterations must lie in [1, 1000]");
  if (!(o.thinnest >= 0 && o.thinnest <= 0.5)) return bad("`thinnest` must lie in [0, 0.5] of the longest edge");
  if (!(o.sleep_below >= 0 && o.sleep_below <= 0.1)) return bad("`sleep_below` must lie in [0, 0.1] of an edge");
  if (!(o.crumb >= 0 && std::isfinite(o.crumb))) return bad("a crumb must be of finite volume, at least 0");
  if (!is_size(o.self.friction)) return bad("the friction of a body on itself must be at least 0, at most 1e+30");
  if (!is_size(o.self.stiffness)) return bad("the stiffness of contact must be at least 0 Pa/m, at most 1e+30");
  if (o.threads < 1 || o.threads > 256) return bad("the number of threads must lie in [1, 256]");
  return {};
}

/// Whether one tet holds all vertices that a pull is at: those of two threads never share one.
bool share_a_tet(const Pull& pull, const DeformableBody::State& state) {
  const auto has_weight = [&](unsigned i) { return pull.weights[i] != 0; };
  unsigned first = 0;
  while (!has_weight(first)) ++first;
  bool is_shared = false;
  state.stars.for_each_tet(pull.vertices[first], [&](TetId t) {
    const TetVertices& corners = state.tets[t];
    bool holds = true;
    for (unsigned i = first + 1; i < 4; ++i) {
      holds = holds && (!has_weight(i) || std::find(corners.begin(), corners.end(), pull.vertices[i]) != corners.end());
    }
    is_shared = is_shared || holds;
  });
  return is_shared;
}

Status check(const Pull& pull, std::size_t index, const DeformableBody::State& state) {
  const auto bad_pull = [&](const char* what) { return bad("pull " + std::to_string(index) + ": " + what); };
  if (!(pull.stiffness >= 0 && std::isfinite(pull.stiffness))) return bad_pull("the stiffness must be at least 0 N/m");
  if (!pull.target.allFinite()) return bad_pull("the target is not finite");
  if (!(pull.limit >= 0)) return bad_pull("the limit must be at least 0 N");
  if (!(pull.drag >= 0) || !pull.anchor.allFinite())
    return bad_pull("the drag must be at least 0 N, its anchor finite");
  const double length2 = pull.axis.squaredNorm();
  if (!(length2 == 0 || std::abs(length2 - 1) < 1e-6)) return bad_pull("the axis must be of length 1, or zero");
  bool has_vertex = false;
  for (unsigned i = 0; i < 4; ++i) {
    if (!std::isfinite(pull.weights[i])) return bad_pull("a weight is not finite");
    if (pull.weights[i] == 0) continue;
    has_vertex = true;
    if (!pull.vertices[i].is_valid() || !state.is_live(pull.vertices[i])) return bad_pull("a vertex is not live");
  }
  if (!has_vertex) return bad_pull("all weights are 0");
  return share_a_tet(pull, state) ? Status{} : Status{bad_pull("its vertices are not of one tet")};
}

}  // namespace

Result<DeformableBody> DeformableBody::create(const TetMesh& mesh, const Journal& journal, const Materials& materials,
                                              const BodyOptions& options) {
  if (Status status = check(materials); !status) return status.error();
  if (Status status = check(options); !status) return status.error();
  auto state = std::make_unique<State>(mesh, journal, materials, options);
  state->build(mesh);
  return DeformableBody(std::move(state));
}

DeformableBody::DeformableBody(std::unique_ptr<State> state) : state_(std::move(state)) {}
DeformableBody::DeformableBody(DeformableBody&&) noexcept = default;
DeformableBody& DeformableBody::operator=(DeformableBody&&) noexcept = default;
DeformableBody::~DeformableBody() = default;

const BodyOptions& DeformableBody::options() const {
  return state_->options;
}
const Materials& DeformableBody::materials() const {
  return state_->materials;
}

// --- what holds it and what pulls it

Status DeformableBody::hold(VertexId vertex, double stiffness) {
  State& s = *state_;
  if (!s.is_live(vertex)) return bad_vertex(vertex, "is not live: it cannot be held");
  if (!(stiffness >= 0)) return bad("the stiffness of a hold must be at least 0 N/m");
  s.dissolve_crumb_at(vertex);
  if (stiffness == 0) {
    s.clear_hold(vertex);
  } else {
    s.set_hold(vertex, {stiffness, s.places[vertex.value], s.rest[vertex]});
  }
  s.bones_changed = s.has_bones;
  s.settle_vertex(vertex);
  s.order.wake_star(vertex, s.stars);
  return {};
}

Status DeformableBody::move_hold(VertexId vertex, const Vec3& target) {
  State& s = *state_;
  const auto hold = s.holds.find(vertex.value);
  if (hold == s.holds.end()) return bad_vertex(vertex, "is not held");
  if (!is_place(target)) return bad_vertex(vertex, "is not finite, or beyond 1e+30", "the target of the hold of ");
  hold->second.target = target;
  if (hold->second.is_rigid()) {
    s.contact.note_jump((target - s.places[vertex.value]).norm());
    s.places[vertex.value] = target;
    s.round_place(vertex);
  }
  s.order.wake_star(vertex, s.stars);
  return {};
}

bool DeformableBody::is_held(VertexId vertex) const {
  return state_->holds.count(vertex.value) > 0;
}

Status DeformableBody::set_pulls(std::vector<Pull> pulls) {
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    if (Status status = check(pulls[i], i, *state_); !status) return status;
  }
  state_->wake_where_pulls_differ(pulls);
  state_->pulls = std::move(pulls);
  return {};
}

const std::vector<Pull>& DeformableBody::pulls() const {
  return state_->pulls;
}

namespace {

/// From a pull's target to its point.
Vec3 off_target(const DeformableBody::State& s, const Pull& pull) {
  Vec3 off = -pull.target;
  for (unsigned i = 0; i < 4; ++i) {
    if (pull.weights[i] != 0 && pull.stiffness > 0) off += pull.weights[i] * s.places[pull.vertices[i].value];
  }
  return off;
}

/// In kg L²/s².
double energy_of(const DeformableBody::State& s, const Pull& pull) {
  if (pull.stiffness <= 0) return 0;
  return detail::pull_state(detail::term_of(pull, Vec3::Zero(), s.unit()), off_target(s, pull)).energy;
}

}  // namespace

Vec3 DeformableBody::pull_force(std::size_t index) const {
  const Pull& pull = state_->pulls[index];
  if (pull.stiffness <= 0) return Vec3::Zero();
  const detail::PullTerm term = detail::term_of(pull, Vec3::Zero(), state_->unit());
  return -state_->unit() * detail::pull_state(term, off_target(*state_, pull)).slope;
}

Vec3 DeformableBody::force_on_holds() const {
  const State& s = *state_;
  Vec3 force = Vec3::Zero();
  for (const auto& [slot, hold] : s.holds) {
    const VertexId v(slot);
    if (!hold.is_rigid()) {
      force -= hold.stiffness * (hold.target - s.places[slot]);
      continue;
    }
    force += s.mass_of(v) / s.unit() * s.options.gravity;
    s.stars.for_each_tet(v, [&](TetId t) {
      unsigned corner = 0;
      while (s.tets[t][corner] != v) ++corner;
      force -= detail::slope_of(s.element(t), s.corners(t), corner);
    });
    if (s.nodal.is_on) force -= s.pressure_slope(v);
  }
  return s.unit() * force;
}

// --- what it is like

std::span<const Vec3> DeformableBody::positions() const {
  return state_->places;
}

Status DeformableBody::place(VertexId vertex, const Vec3& position) {
  State& s = *state_;
  if (!s.is_live(vertex)) return bad_vertex(vertex, "is not live");
  if (!is_place(position)) return bad_vertex(vertex, "is not finite, or beyond 1e+30", "the position of ");
  s.contact.note_jump((position - s.places[vertex.value]).norm());
  s.places[vertex.value] = position;
  s.set_momentum(vertex, Vec3::Zero());
  s.round_place(vertex);
  s.order.wake_star(vertex, s.stars);
  if (const auto hold = s.holds.find(vertex.value); hold != s.holds.end()) hold->second.target = position;
  return {};
}

Vec3 DeformableBody::velocity(VertexId vertex) const {
  return state_->is_live(vertex) ? Vec3(state_->unit() / state_->mass_of(vertex) * state_->momentum_of(vertex))
                                 : Vec3(Vec3::Zero());
}

Status DeformableBody::set_velocity(VertexId vertex, const Vec3& velocity) {
  State& s = *state_;
  if (!s.is_live(vertex)) return bad_vertex(vertex, "is not live");
  if (!is_place(velocity)) return bad_vertex(vertex, "is not finite, or beyond 1e+30 m/s", "the velocity of ");
  if (s.held[vertex] == detail::Held::kRigidly) return {};
  s.dissolve_crumb_at(vertex);
  s.set_momentum(vertex, s.mass_of(vertex) / s.unit() * velocity);
  s.order.wake_star(vertex, s.stars);
  return {};
}

void DeformableBody::slow_down(double factor) {
  for (std::uint32_t v = 0; v < state_->places.size(); ++v) {
    state_->set_momentum(VertexId(v), factor * state_->momentum_of(VertexId(v)));
  }
}

double DeformableBody::mass(VertexId vertex) const {
  return state_->is_live(vertex) ? state_->mass_of(vertex) : 0.0;
}

double DeformableBody::mass() const {
  double sum = 0;
  for (std::uint32_t v = 0; v < state_->places.size(); ++v) sum += mass(VertexId(v));
  return sum;
}

Vec3 DeformableBody::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t v = 0; v < state_->places.size(); ++v) {
    if (state_->is_live(VertexId(v))) sum += state_->momentum_of(VertexId(v));
  }
  return state_->unit() * sum;
}

Vec3 DeformableBody::angular_momentum() const {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t v = 0; v < state_->places.size(); ++v) {
    if (state_->is_live(VertexId(v))) sum += state_->places[v].cross(state_->momentum_of(VertexId(v)));
  }
  return state_->unit() * state_->unit() * sum;
}

BodyEnergy DeformableBody::energy() const {
  const State& s = *state_;
  const double to_joule = s.unit() * s.unit();
  BodyEnergy energy;
  for (std::uint32_t t = 0; t < s.tets.size(); ++t) {
    if (s.tets[TetId(t)][0].is_valid()) {
      energy.elastic += to_joule * detail::energy_of(s.element(TetId(t)), s.corners(TetId(t)));
    }
  }
  if (s.nodal.is_on) energy.elastic += to_joule * s.pressure_energy();
  for (std::uint32_t slot = 0; slot < s.places.size(); ++slot) {
    const VertexId v(slot);
    if (!s.is_live(v)) continue;
    energy.kinetic += 0.5 * to_joule * s.momentum_of(v).squaredNorm() / s.mass_of(v);
    energy.potential -= s.mass_of(v) * s.unit() * s.options.gravity.dot(s.places[slot]);
  }
  for (const auto& [slot, hold] : s.holds) {
    if (!hold.is_rigid()) energy.held += 0.5 * to_joule * hold.stiffness * (s.places[slot] - hold.target).squaredNorm();
  }
  for (const Pull& pull : s.pulls) {
    energy.pulled += to_joule * energy_of(s, pull);
  }
  energy.tied = to_joule * s.tied_energy();
  return energy;
}

Mat3 DeformableBody::local_stiffness(VertexId vertex) const {
  const State& s = *state_;
  Mat3 stiffness = Mat3::Zero();
  if (!s.is_live(vertex)) return stiffness;
  s.stars.for_each_tet(vertex, [&](TetId t) {
    unsigned corner = 0;
    while (s.tets[t][corner] != vertex) ++corner;
    stiffness += detail::stiffness_at(s.soft_element(t, true), s.corners(t), corner);  // of bone by its modulus
  });
  if (s.nodal.is_on) stiffness += s.pressure_stiffness(vertex);
  return stiffness;  // kg/s², whatever the length unit
}

std::size_t DeformableBody::count_inverted() const {
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < state_->tets.size(); ++t) {
    if (state_->tets[TetId(t)][0].is_valid() && !(detail::six_volumes(state_->corners(TetId(t))) > 0)) ++count;
  }
  return count;
}

bool DeformableBody::is_finite() const {
  for (std::uint32_t slot = 0; slot < state_->places.size(); ++slot) {
    const VertexId v(slot);
    if (state_->is_live(v) && !(state_->places[slot].allFinite() && state_->momentum_of(v).allFinite())) return false;
  }
  return true;
}

std::size_t DeformableBody::active_vertices() const {
  return state_->order.count_awake();
}

std::uint64_t DeformableBody::hash() const {
  StateHash hash;
  for (std::uint32_t slot = 0; slot < state_->places.size(); ++slot) {
    const VertexId v(slot);
    if (!state_->is_live(v)) continue;
    hash.add(std::uint64_t{slot});
    hash.add(state_->mass_of(v));
    const Vec3 momentum = state_->momentum_of(v);
    for (unsigned i = 0; i < 3; ++i) {
      hash.add(state_->places[slot].data()[i]);
      hash.add(momentum.data()[i]);
    }
  }
  if (state_->is_viscous) {
    for (std::uint32_t t = 0; t < state_->tets.size(); ++t) {
      if (state_->tets[TetId(t)][0].is_valid()) state_->add_metrics(TetId(t), hash);
    }
  }
  state_->contact.add_to(hash);
  return hash.value();
}

}  // namespace v0
}  // namespace incise
