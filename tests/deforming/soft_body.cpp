// SPDX-License-Identifier: Apache-2.0
#include "deforming/soft_body.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "incise/mesh/bounds.h"
#include "incise/mesh/tet_tables.h"

namespace incise::test {

namespace {

using Matrix3 = Eigen::Matrix3d;

/// Twice the outward area of the side opposite a corner.
Vec3 side_area2(const std::array<Vec3, 4>& p, unsigned corner) {
  const auto [a, b, c] = kSideCorners[corner];
  return (p[b] - p[a]).cross(p[c] - p[a]);
}

double six_volumes_of(const std::array<Vec3, 4>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
}

}  // namespace

SoftBody::SoftBody(const TetMesh& mesh, const SoftBodyOptions& options)
    : options_(options),
      mirror_(mesh),
      bounds_(rest_bounds(mesh)),
      mu_(options.young / (2 * (1 + options.poisson))),
      lambda_(options.young * options.poisson / ((1 + options.poisson) * (1 - 2 * options.poisson))) {
  for (std::uint32_t v = 0; v < mirror_.vertices().size(); ++v) place(v) = held_place(mirror_.vertices()[v].rest);
  rebuild();
}

bool SoftBody::is_held(const Vec3& rest) const {
  const double reach = (options_.held + 1e-12) * (bounds_.hi.x() - bounds_.lo.x());
  return options_.held >= 0 && (rest.x() <= bounds_.lo.x() + reach || rest.x() >= bounds_.hi.x() - reach);
}

Vec3 SoftBody::held_place(const Vec3& rest) const {
  const double middle = 0.5 * (bounds_.lo.x() + bounds_.hi.x());
  return {middle + (1 + options_.stretch) * (rest.x() - middle), rest.y(), rest.z()};
}

// --- what the journal changes
// -----------------------------------------------------------------------------------------

FollowReport SoftBody::follow(const Journal& journal) {
  FollowReport report;
  if (mirror_.has_caught_up(journal)) return report;
  report.has_changed = true;
  report.energy_before = elastic_energy();
  mirror_.follow(journal);
  rebuild();
  report.energy_after = elastic_energy();
  report.fresh = mirror_.fresh().size();
  for (unsigned i = 0; i < options_.fresh_sweeps; ++i) {
    for (const VertexId v : mirror_.fresh()) {
      if (!is_held(mirror_.vertex(v).rest)) minimise(v.value, {});
    }
  }
  report.energy_relaxed = elastic_energy();
  return report;
}

/// Everything that depends on the rest shape: as long as bodies are small, all anew.
void SoftBody::rebuild() {
  elements_.clear();
  mass_.assign(mirror_.vertices().size(), 0.0);
  for (const auto& tet : mirror_.tets()) {
    if (tet.is_live()) add_element(tet.vertices);
  }
  list_uses();
  hold_ends();
}

void SoftBody::add_element(const TetVertices& vertices) {
  std::array<Vec3, 4> p, slope;
  for (unsigned c = 0; c < 4; ++c) p[c] = mirror_.vertex(vertices[c]).rest;
  const double volume6 = six_volumes_of(p), scale = softening(p, volume6);
  for (unsigned c = 0; c < 4; ++c) slope[c] = -side_area2(p, c) / volume6;
  Element element{};
  for (unsigned i = 0; i < 4; ++i) {
    element.v[i] = vertices[i].value;
    mass_[element.v[i]] += options_.density * volume6 / 24;
    for (unsigned j = 0; j < 4; ++j) element.laplacian[i][j] = scale * mu_ * volume6 / 6 * slope[i].dot(slope[j]);
  }
  element.bulk = scale * lambda_ / (6 * volume6);
  element.target = volume6 * (1 + mu_ / lambda_);
  element.offset = scale * volume6 / 6 * (1.5 * mu_ + 0.5 * mu_ * mu_ / lambda_);
  elements_.push_back(element);
}

/// Slivers are as soft as if they were thicker: one among sound tets would hold the descent up.
double SoftBody::softening(const std::array<Vec3, 4>& p, double volume6) const {
  if (options_.thinnest <= 0) return 1;
  double widest = 0;
  for (unsigned c = 0; c < 4; ++c) widest = std::max(widest, side_area2(p, c).norm());
  return std::min(1.0, volume6 / widest / (options_.thinnest * options_.spacing));
}

void SoftBody::list_uses() {
  first_use_.assign(mirror_.vertices().size() + 1, 0);
  for (const Element& element : elements_) {
    for (const std::uint32_t v : element.v) ++first_use_[v + 1];
  }
  for (std::size_t v = 1; v < first_use_.size(); ++v) first_use_[v] += first_use_[v - 1];
  uses_.resize(elements_.size() * 4);
  std::vector<std::uint32_t> next = first_use_;
  for (std::uint32_t e = 0; e < elements_.size(); ++e) {
    for (std::uint32_t c = 0; c < 4; ++c) uses_[next[elements_[e].v[c]]++] = {e, c};
  }
}

void SoftBody::hold_ends() {
  free_.clear();
  for (std::uint32_t v = 0; v < mirror_.vertices().size(); ++v) {
    Vertex& vertex = mirror_.vertex(VertexId(v));
    if (!vertex.is_live) continue;
    if (!is_held(vertex.rest)) {
      free_.push_back(v);
      continue;
    }
    vertex.current = held_place(vertex.rest);
    vertex.velocity.setZero();
  }
}

// --- energy
// -----------------------------------------------------------------------------------------------------------

double SoftBody::six_volumes(const Element& e) const {
  return six_volumes_of({place(e.v[0]), place(e.v[1]), place(e.v[2]), place(e.v[3])});
}

double SoftBody::energy(const Element& e) const {
  double stretch = 0;  // the rows of the Laplacian add up to zero: differences alone count
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = i + 1; j < 4; ++j) stretch -= e.laplacian[i][j] * (place(e.v[i]) - place(e.v[j])).squaredNorm();
  }
  const double swell = six_volumes(e) - e.target;
  return 0.5 * stretch + 0.5 * e.bulk * swell * swell - e.offset;
}

Vec3 SoftBody::growth(const Element& e, std::uint32_t corner) const {
  const auto [a, b, c] = kSideCorners[corner];
  return -(place(e.v[b]) - place(e.v[a])).cross(place(e.v[c]) - place(e.v[a]));
}

double SoftBody::energy_at(std::uint32_t v, const Vec3& at, const Pull& pull) {
  const Vec3 before = std::exchange(place(v), at);
  double sum = 0.5 * pull.weight * (at - pull.place).squaredNorm() - pull.force.dot(at);
  for (const Use& use : uses_of(v)) sum += energy(elements_[use.element]);
  place(v) = before;
  return sum;
}

/// Puts a vertex where its energy is least while all others stay; at most a quarter of the spacing on.
void SoftBody::minimise(std::uint32_t v, const Pull& pull) {
  const Vec3 x = place(v);
  Vec3 slope = pull.weight * (x - pull.place) - pull.force;
  Matrix3 bend = pull.weight * Matrix3::Identity();
  for (const Use& use : uses_of(v)) {
    const Element& e = elements_[use.element];
    const auto& row = e.laplacian[use.corner];
    const Vec3 normal = growth(e, use.corner);
    const auto [a, b, c] = kSideCorners[use.corner];
    const double swell = normal.dot(x - place(e.v[a])) - e.target;
    slope += row[a] * (place(e.v[a]) - x) + row[b] * (place(e.v[b]) - x) + row[c] * (place(e.v[c]) - x);
    slope += e.bulk * swell * normal;
    bend += e.bulk * normal * normal.transpose();
    bend.diagonal().array() += row[use.corner];
  }
  const Vec3 way = -bend.llt().solve(slope);
  const double length = way.norm(), most = 0.25 * options_.spacing;
  if (std::isfinite(length)) place(v) = x + way * (length > most ? most / length : 1.0);
}

// --- motion
// -----------------------------------------------------------------------------------------------------------

template <class PullOf>
void SoftBody::sweep(unsigned count, const PullOf& pull_of) {
  for (unsigned i = 0; i < count; ++i) {
    if (i % 2 == 0) {
      for (auto v = free_.begin(); v != free_.end(); ++v) minimise(*v, pull_of(*v));
    } else {
      for (auto v = free_.rbegin(); v != free_.rend(); ++v) minimise(*v, pull_of(*v));
    }
  }
}

void SoftBody::settle(unsigned sweeps) {
  sweep(sweeps, [&](std::uint32_t v) { return Pull{0, Vec3::Zero(), mass_[v] * options_.gravity}; });
  for (const std::uint32_t v : free_) mirror_.vertex(VertexId(v)).velocity.setZero();
}

void SoftBody::step(double dt) {
  for (unsigned i = 0; i < options_.substeps; ++i) substep(dt / options_.substeps);
}

/// Starts each vertex where its velocity takes it, or where it was if that costs less: light slivers would fly off.
void SoftBody::substep(double dt) {
  start_ = mirror_.positions();
  const auto pull_of = [&](std::uint32_t v) {
    const Vec3 aim = start_[v] + dt * mirror_.vertices()[v].velocity + dt * dt * options_.gravity;
    return Pull{mass_[v] / (dt * dt), aim, Vec3::Zero()};
  };
  for (const std::uint32_t v : free_) place(v) += dt * mirror_.vertices()[v].velocity;
  for (const std::uint32_t v : free_) {
    if (energy_at(v, start_[v], pull_of(v)) < energy_at(v, place(v), pull_of(v))) place(v) = start_[v];
  }
  sweep(options_.sweeps, pull_of);
  for (const std::uint32_t v : free_) mirror_.vertex(VertexId(v)).velocity = (place(v) - start_[v]) / dt;
}

// --- what tests ask
// ---------------------------------------------------------------------------------------------------

double SoftBody::elastic_energy() const {
  double sum = 0;
  for (const Element& element : elements_) sum += energy(element);
  return sum;
}

double SoftBody::kinetic_energy() const {
  double sum = 0;
  for (std::size_t v = 0; v < mass_.size(); ++v) sum += 0.5 * mass_[v] * mirror_.vertices()[v].velocity.squaredNorm();
  return sum;
}

double SoftBody::mass() const {
  double sum = 0;
  for (const double m : mass_) sum += m;
  return sum;
}

Vec3 SoftBody::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t v = 0; v < mass_.size(); ++v) sum += mass_[v] * mirror_.vertices()[v].velocity;
  return sum;
}

bool SoftBody::is_finite() const {
  return std::all_of(mirror_.vertices().begin(), mirror_.vertices().end(), [](const Vertex& vertex) {
    return !vertex.is_live || (vertex.current.allFinite() && vertex.velocity.allFinite());
  });
}

std::size_t SoftBody::inverted() const {
  return static_cast<std::size_t>(
      std::count_if(elements_.begin(), elements_.end(), [&](const Element& e) { return !(six_volumes(e) > 0); }));
}

}  // namespace incise::test
