// SPDX-License-Identifier: Apache-2.0
// What a step of the journal puts in place may store energy that was not there, as where it joins lips that stood
// apart: it goes towards its balance, with as much of what stands around as that takes. Hands and tools go on pressing.
#include <algorithm>
#include <array>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// The tets whose energy a step changes: those that it touched, and those around all that goes towards its balance.
class Balance {
 public:
  explicit Balance(DeformableBody::State& state) : s_(state), most_((1 + detail::kBalanceGain) * state.touched.energy) {
    for (const std::uint32_t t : s_.touched.tets) {
      if (!s_.tets[TetId(t)][0].is_valid()) continue;
      list(TetId(t));
      most_ += least_energy(TetId(t));
    }
  }
  Balance(const Balance&) = delete;
  Balance& operator=(const Balance&) = delete;
  ~Balance() {
    for (const std::uint32_t t : tets_) s_.is_touched_tet[t] = 0;
    for (const Taken& taken : taken_) s_.has_changed_star[taken.vertex] = 0;
  }

  /// Whether the tets have more energy than `times` what they had.
  [[nodiscard]] bool has_gained(double times = 1) const {
    double sum = 0;
    for (std::size_t i = 0; i < tets_.size(); ++i) sum += energy(i);
    return sum > times * most_;
  }
  /// Takes in the vertices that the step touched, or one more ring of neighbours, and the tets around them with what
  /// energy they have. Returns whether there were any, and not too many already.
  bool grow() {
    const std::size_t last = taken_.size();
    if (last > detail::kMostByTouched * s_.touched.tets.size() + detail::kMostBesides && !has_gained(detail::kFarMore))
      return false;
    for (std::size_t i = 0; last == 0 && i < tets_.size(); ++i) {
      for (const VertexId v : s_.tets[TetId(tets_[i])]) take(v);
    }
    for (std::size_t i = 0; i < last; ++i) {
      detail::SweepOrder::for_each_neighbour(s_.stars, VertexId(vertices_[i]), [&](VertexId n) { take(n); });
    }
    for (std::size_t i = last; i < taken_.size(); ++i) {
      s_.stars.for_each_tet(VertexId(vertices_[i]), [&](TetId t) {
        if (s_.is_touched_tet[t.value] == 0) most_ += energy(list(t));
      });
    }
    return last < taken_.size();
  }
  /// Sweeps over the vertices that were taken in. Returns whether the energy is down to what it was.
  bool relax() {
    return std::any_of(detail::kBalanceSweeps.begin(), detail::kBalanceSweeps.end(), [&](unsigned sweeps) {
      s_.relax(vertices_, sweeps, true);
      return !has_gained();
    });
  }
  void relax_more() { s_.relax(vertices_, detail::kMoreSweeps, true); }
  /// Wakes what has moved. Returns how many vertices that are, but for those that the step put in place.
  std::size_t wake() {
    double furthest2 = 0;
    std::size_t moved = 0;
    for (const Taken& taken : taken_) {
      s_.order.wake(VertexId(taken.vertex));
      furthest2 = std::max(furthest2, (s_.places[taken.vertex] - taken.place).squaredNorm());
      ++moved;
    }
    for (const std::uint32_t v : s_.touched.fresh) moved -= s_.has_changed_star[v];
    if (s_.options.self.on) s_.contact.note_jump(std::sqrt(furthest2));
    return moved;
  }

 private:
  struct Taken {
    std::uint32_t vertex;
    Vec3 place;  ///< before it moved
  };

  /// Of a tet that is strained so little that it counts for nothing.
  [[nodiscard]] double least_energy(TetId t) const {
    const double volume = detail::six_volumes(s_.corners_at_rest(t)) / 6;
    return 0.5 * detail::kNoStrain * detail::kNoStrain * s_.materials.of(s_.regions[t]).young * s_.unit() * volume;
  }
  [[nodiscard]] double energy(std::size_t i) const {
    return detail::energy_of(elements_[i], s_.corners(TetId(tets_[i])));
  }
  std::size_t list(TetId t) {
    s_.is_touched_tet[t.value] = 1;
    tets_.push_back(t.value);
    elements_.push_back(s_.element(t));
    return tets_.size() - 1;
  }
  /// Bones and crumbs stay where they are.
  void take(VertexId v) {
    const bool stays = !s_.order.moves(v) || s_.motions[v].is_rigid || s_.in_crumb[v] != 0;
    if (stays || s_.has_changed_star[v.value] != 0) return;
    s_.has_changed_star[v.value] = 1;
    taken_.push_back({v.value, s_.places[v.value]});
    vertices_.push_back(v.value);
  }

  DeformableBody::State& s_;
  double most_;
  std::vector<std::uint32_t> tets_;
  std::vector<detail::Element> elements_;  // of the tets
  std::vector<Taken> taken_;
  std::vector<std::uint32_t> vertices_;  // that were taken in
};

}  // namespace

/// Of the tets that are about to be replaced: of tissue that relaxes, as it has by now.
void DeformableBody::State::note_energy() {
  touched.energy = 0;
  for (const std::uint32_t t : touched.tets) {
    const TetId tet(t);
    if (t < tets.size() && tets[tet][0].is_valid()) touched.energy += detail::energy_of(element(tet), corners(tet));
  }
}

std::size_t DeformableBody::State::balance() {
  Balance balance(*this);
  if (!balance.has_gained()) return 0;
  prepare_pulls();
  if (options.self.on) contact.list_terms(*this);
  bool is_balanced = false;
  while (!is_balanced && balance.grow()) is_balanced = balance.relax();
  if (!is_balanced) balance.relax_more();
  return balance.wake();
}

}  // namespace v0
}  // namespace incise
