// SPDX-License-Identifier: Apache-2.0
// Tets that undo changes are kept as the body has them; what comes back, or elsewhere at rest, is sampled there,
// through a grid over the rest shape, and momenta are made up for as a whole (docs/internals.md, 4).
#include "sim/body/body_rewind.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {
namespace detail {

// --- the grid

std::array<std::uint32_t, 3> RestGrid::cell_of(const Vec3& point) const {
  std::array<std::uint32_t, 3> cell;
  for (unsigned i = 0; i < 3; ++i) {
    const double width = box_.hi.data()[i] - box_.lo.data()[i];
    const double share = width > 0 ? (point.data()[i] - box_.lo.data()[i]) / width : 0.0;
    cell[i] = static_cast<std::uint32_t>(std::clamp(share * side_, 0.0, side_ - 1.0));
  }
  return cell;
}

template <class Visit>
void RestGrid::for_each_cell(const Corners& tet, const Visit& visit) const {
  Vec3 low = tet[0], high = tet[0];
  for (const Vec3& p : tet) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const auto from = cell_of(low), to = cell_of(high);
  for (std::uint32_t z = from[2]; z <= to[2]; ++z) {
    for (std::uint32_t y = from[1]; y <= to[1]; ++y) {
      for (std::uint32_t x = from[0]; x <= to[0]; ++x) visit(index(x, y, z));
    }
  }
}

void RestGrid::build(std::vector<Corners> tets) {
  tets_ = std::move(tets);
  const double inf = std::numeric_limits<double>::infinity();
  box_ = {Vec3::Constant(inf), Vec3::Constant(-inf)};
  for (const Corners& tet : tets_) {
    for (const Vec3& p : tet) {
      box_.lo = box_.lo.cwiseMin(p);
      box_.hi = box_.hi.cwiseMax(p);
    }
  }
  side_ = 1;
  while (std::size_t{side_} * side_ * side_ < tets_.size() && side_ < 100) ++side_;
  first_.assign(index(0, 0, side_) + 1, 0);
  for (const Corners& tet : tets_) {
    for_each_cell(tet, [&](std::size_t cell) { ++first_[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  members_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < tets_.size(); ++t) {
    for_each_cell(tets_[t], [&](std::size_t cell) { members_[next[cell]++] = t; });
  }
}

std::size_t RestGrid::find(const Vec3& point, Weights& weights) const {
  std::size_t best = 0;
  double best_least = -std::numeric_limits<double>::infinity();
  const auto try_tet = [&](std::uint32_t t) {
    const Corners& p = tets_[t];
    const double volume = six_volumes(p);
    Weights w;
    for (unsigned i = 0; i < 4; ++i) w[i] = volume_slope(p, i).dot(point - p[kSideCorners[i][0]]) / volume;
    const double least = std::min(std::min(w[0], w[1]), std::min(w[2], w[3]));
    if (!(least > best_least)) return;
    best_least = least;
    best = t;
    weights = w;
  };
  const auto cell = cell_of(point);
  const std::size_t at = index(cell[0], cell[1], cell[2]);
  for (std::uint32_t i = first_[at]; i < first_[at + 1]; ++i) try_tet(members_[i]);
  if (best_least < -1e-6) {  // beside all that the cell meets
    for (std::uint32_t t = 0; t < tets_.size(); ++t) try_tet(t);
  }
  return best;
}

// --- undo and redo

void Rewind::begin(const DeformableBody::State& s) {
  const std::size_t slots = s.places.size();
  masses_.assign(s.masses(), s.masses() + slots);
  momenta_.assign(s.momenta(), s.momenta() + 3 * slots);
  was_live_.resize(slots);
  for (std::uint32_t v = 0; v < slots; ++v) was_live_[v] = s.is_live(VertexId(v)) ? 1 : 0;
}

Vec3 Rewind::old_velocity(std::uint32_t v) const {
  const double* p = momenta_.data() + std::size_t{3} * v;
  return Vec3(p[0], p[1], p[2]) / masses_[v];
}

void Rewind::compare(DeformableBody::State& s, const TetMesh& mesh) {
  mesh.for_each_vertex([&](VertexId v) {
    const bool was_live = v.value < was_live_.size() && was_live_[v.value] != 0;
    using Fresh = DeformableBody::State::Fresh;
    if (!was_live || s.rest[v] != mesh.rest(v)) s.note_fresh(v, was_live ? Fresh::kMoved : Fresh::kNew);
  });
  std::vector<RestGrid::Corners> rest;
  for (std::uint32_t slot = 0; slot < s.tets.size(); ++slot) {
    const TetId t(slot);
    if (!s.differs(mesh, t)) continue;
    s.note_tet(t);
    if (!s.tets[t][0].is_valid()) continue;
    OldTet old{s.tets[t], s.corners(t), {}};
    for (unsigned i = 0; i < 4; ++i) old.velocities[i] = old_velocity(old.vertices[i].value);
    old_tets_.push_back(old);
    rest.push_back(s.corners_at_rest(t));
  }
  if (!rest.empty()) grid_.build(std::move(rest));
}

Rewind::Sample Rewind::sample(const Vec3& rest) const {
  Sample sample;
  const std::size_t at = grid_.find(rest, sample.weights);
  sample.tet = &old_tets_[at];
  if (*std::min_element(sample.weights.begin(), sample.weights.end()) < kFarthestWeight) {
    double sum = 0;
    for (double& weight : sample.weights) sum += weight = std::max(weight, 0.0);
    sample.place = rest;
    for (unsigned i = 0; i < 4; ++i) sample.place -= (sample.weights[i] /= sum) * grid_.tet(at)[i];
  }
  for (unsigned i = 0; i < 4; ++i) {
    sample.place += sample.weights[i] * sample.tet->places[i];
    sample.velocity += sample.weights[i] * sample.tet->velocities[i];
  }
  return sample;
}

void Rewind::put_back(DeformableBody::State& s) {
  velocities_.assign(s.touched.fresh.size(), Vec3::Zero());
  for (std::size_t i = 0; !old_tets_.empty() && i < velocities_.size(); ++i) {
    const VertexId v(s.touched.fresh[i]);
    if (!s.is_live(v)) continue;
    const Sample found = sample(s.rest[v]);
    hold_again(s, v, found);
    s.places[v.value] = s.held[v] == Held::kRigidly ? s.holds[v.value].target : found.place;
    s.round_place(v);
    velocities_[i] = found.velocity;
  }
  balance(s);
  s.stale_pieces = std::numeric_limits<unsigned>::max() / 2;  // pieces may have come together: no waiting
}

/// A vertex that was held when it died is held again, where its neighbours still are; one that undo moves stays with
/// what holds it.
void Rewind::hold_again(DeformableBody::State& s, VertexId v, const Sample& found) {
  const auto lost = s.lost_holds.find(v.value);
  if (s.held[v] == Held::kNot) {
    if (lost == s.lost_holds.end() || lost->second.rest != s.rest[v]) return;
    bool has_held_neighbour = false;
    SweepOrder::for_each_neighbour(s.stars, v, [&](VertexId n) { has_held_neighbour |= s.held[n] != Held::kNot; });
    if (!has_held_neighbour) return;
    s.set_hold(v, Hold(lost->second));
    s.lost_holds.erase(lost);
  }
  Hold& hold = s.holds[v.value];
  hold.target = s.held_place(s.rest[v], hold.target - hold.rest, found.tet->vertices, found.weights);
  hold.rest = s.rest[v];
}

/// The mesh's undo brings momenta back as they were when it was cut. Velocities stay, and what their sum then lacks is
/// given to all vertices that have other masses now.
void Rewind::balance(DeformableBody::State& s) {
  Vec3 missing = Vec3::Zero();
  double mass = 0;
  std::vector<std::uint32_t> others;
  const auto slots = static_cast<std::uint32_t>(std::max(was_live_.size(), s.places.size()));
  std::vector<std::uint32_t> fresh_index(slots, 0);
  for (std::uint32_t i = 0; i < s.touched.fresh.size(); ++i) fresh_index[s.touched.fresh[i]] = i + 1;
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    const VertexId v(slot);
    const bool was_live = slot < was_live_.size() && was_live_[slot] != 0, is_live = s.is_live(v);
    const Vec3 before = was_live ? Vec3(masses_[slot] * old_velocity(slot)) : Vec3(Vec3::Zero());
    const bool is_same = was_live && is_live && fresh_index[slot] == 0 && masses_[slot] == s.mass_of(v);
    if (is_same) {
      s.set_momentum(v, Vec3(momenta_[3 * slot], momenta_[3 * slot + 1], momenta_[3 * slot + 2]));
      continue;
    }
    missing += before;
    if (!is_live || s.held[v] == Held::kRigidly) continue;
    const Vec3 velocity = fresh_index[slot] > 0 ? velocities_[fresh_index[slot] - 1] : old_velocity(slot);
    s.set_momentum(v, s.mass_of(v) * velocity);
    missing -= s.momentum_of(v);
    mass += s.mass_of(v);
    others.push_back(slot);
  }
  if (mass <= 0) return;
  for (const std::uint32_t v : others) {
    s.set_momentum(VertexId(v), s.momentum_of(VertexId(v)) + s.mass_of(VertexId(v)) / mass * missing);
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
