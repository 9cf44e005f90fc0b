// SPDX-License-Identifier: Apache-2.0
// Lips that stood apart and that a step of the journal joins store energy that was not there: their corners go towards
// their balance, with as much of what stands around them as that takes.
#include <algorithm>
#include <array>

#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {

namespace {

/// A tet that is drawn out along an edge by more than this, or pressed to less than that share of its volume, is taken
/// to have lips that stood apart as its corners.
constexpr double kDrawnOut = 1.3, kPressed = 0.6;
/// Sweeps between two looks at the energy: each is over in a moment, and most often one is enough.
constexpr std::array kSweeps = {1U, 1U, 2U, 4U};
/// A step that adds no more than this share of what its tets had adds nothing.
constexpr double kGain = 0.01;
/// Once there are so many vertices by the tets that were touched, and besides, a further ring is taken in only where
/// there is more than so many times the energy still: where lips that stood apart were joined. In the end all are swept
/// so often more.
constexpr std::size_t kMostByTouched = 4, kMostBesides = 400;
constexpr double kFarMore = 1.5;
constexpr unsigned kMoreSweeps = 24;

/// Whether a tet stands as none does that cutting or maintenance puts in place where no lips are joined.
bool is_wide(const std::array<Vec3, 4>& now, const std::array<Vec3, 4>& rest) {
  const auto is_drawn_out = [&](const auto& edge) {
    return (now[edge[0]] - now[edge[1]]).squaredNorm() >
           kDrawnOut * kDrawnOut * (rest[edge[0]] - rest[edge[1]]).squaredNorm();
  };
  return detail::six_volumes(now) < kPressed * detail::six_volumes(rest) ||
         std::any_of(kEdgeCorners.begin(), kEdgeCorners.end(), is_drawn_out);
}

/// The tets whose energy a step changes: those that it touched, and those around all that goes towards its balance.
class Balance {
 public:
  explicit Balance(DeformableBody::State& state) : s_(state), most_((1 + kGain) * state.touched.energy) {
    for (const std::uint32_t t : s_.touched.tets) {
      if (s_.tets[TetId(t)][0].is_valid()) list(TetId(t));
    }
  }
  Balance(const Balance&) = delete;
  Balance& operator=(const Balance&) = delete;
  ~Balance() {
    for (const std::uint32_t t : tets_) s_.is_touched_tet[t] = 0;
    for (const Taken& taken : taken_) s_.has_changed_star[taken.vertex] = 0;
  }

  /// Whether the tets have more energy than they had, so many times.
  [[nodiscard]] bool has_gained(double times = 1) const {
    double sum = 0;
    for (std::size_t i = 0; i < tets_.size(); ++i) sum += energy(i);
    return sum > times * most_;
  }
  /// Takes in the vertices that the step touched, or one more ring of neighbours, and the tets around them with what
  /// energy they have. Returns whether there were any, and not too many already.
  bool grow() {
    const std::size_t last = taken_.size();
    if (last > kMostByTouched * s_.touched.tets.size() + kMostBesides && !has_gained(kFarMore)) return false;
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
    return std::any_of(kSweeps.begin(), kSweeps.end(), [&](unsigned sweeps) {
      s_.relax(vertices_, sweeps, true);
      return !has_gained();
    });
  }
  void relax_more() { s_.relax(vertices_, kMoreSweeps, true); }
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

/// Whether the step has joined lips that stood apart. Else what is more than was there before is what blades and hands
/// press, which sweeps without them would take out.
bool DeformableBody::State::has_joined_lips() const {
  return std::any_of(touched.tets.begin(), touched.tets.end(), [&](std::uint32_t t) {
    const TetId tet(t);
    return tets[tet][0].is_valid() && is_wide(corners(tet), corners_at_rest(tet));
  });
}

std::size_t DeformableBody::State::balance() {
  if (!has_joined_lips()) return 0;
  Balance balance(*this);
  if (!balance.has_gained()) return 0;
  prepare_holds();
  bool is_balanced = false;
  while (!is_balanced && balance.grow()) is_balanced = balance.relax();
  if (!is_balanced) balance.relax_more();
  return balance.wake();
}

}  // namespace v0
}  // namespace incise
