// SPDX-License-Identifier: Apache-2.0
// Tets that a step left inside out are turned back. A sliver weighs next to nothing in the balance of its corners, so
// that a way of its own thickness turns it over, and it stays so; turning it back takes no more. Each that is inside
// out asks its corners for a share of its volume at rest, on ways that leave centre and spin of all four as they are
// where none is held: the volume constraint of M. Müller, B. Heidelberger, M. Hennix, J. Ratcliff, "Position based
// dynamics", 2007, section 4.4, asked of one side only. Places alone change: what that adds to the energy is taken from
// the motion, like all that a step adds, and where that is not enough they stay inside out: slivers cost next to
// nothing.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {

namespace {

void sort_out(std::vector<TetId>& tets) {
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
}

}  // namespace

/// Whether a way of its own may be given to a vertex.
bool DeformableBody::State::may_turn_back(VertexId v) const {
  return order.moves(v) && order.is_awake(v) && !motions[v].is_rigid && in_crumb[v] == 0;
}

/// Adds the tets around a vertex that are inside out, or without volume: slivers alone, or all.
void DeformableBody::State::add_turned_around(VertexId v, bool slivers, std::vector<TetId>& found) const {
  stars.for_each_tet(v, [&](TetId t) {
    if (detail::six_volumes(corners(t)) > 0) return;
    if (!slivers || detail::is_thinner(corners_at_rest(t), options.thinnest)) found.push_back(t);
  });
}

/// Gives a tet the least volume. Returns the greatest way of its corners, length unit; 0 where none may move.
double DeformableBody::State::turn_back(TetId t) {
  const std::array<Vec3, 4> now = corners(t);
  const double lacks = detail::kLeastVolume * detail::six_volumes(corners_at_rest(t)) - detail::six_volumes(now);
  std::array<Vec3, 4> ways;
  double gain = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const Vec3 slope = detail::volume_slope(now, i);
    ways[i] = may_turn_back(tets[t][i]) ? Vec3(slope / mass_of(tets[t][i])) : Vec3(Vec3::Zero());
    gain += slope.dot(ways[i]);
  }
  if (!(lacks > 0 && gain > 0)) return 0;
  double share = lacks / gain, greatest = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const double most = detail::kTurningReach * static_cast<double>(motions[tets[t][i]].reach), way = ways[i].norm();
    if (share * way > most) share = most / way;
    greatest = std::max(greatest, way);
  }
  for (unsigned i = 0; i < 4; ++i) {
    const VertexId v = tets[t][i];
    turned_from.emplace_back(v, places[v.value]);
    places[v.value] += share * ways[i];
    round_place(v);
  }
  return share * greatest;
}

/// Turns back what `energy_now` found, slivers alone or all. Returns whether anything moved.
bool DeformableBody::State::turn_all_back(bool slivers) {
  turned_from.clear();
  std::vector<TetId> turned, next;
  for (const auto& part : turned_rows) {
    for (const std::uint32_t row : part) add_turned_around(VertexId(rows.slots()[row]), slivers, turned);
  }
  sort_out(turned);
  const std::size_t before = turned.size();
  double way = 0;
  std::size_t turns = 0;
  for (unsigned sweep = 0; sweep < detail::kTurningSweeps && !turned.empty(); ++sweep) {
    sort_out(turned);
    turns += turned.size();
    if (turns > detail::kMostUntangled) break;
    double greatest = 0;
    for (const TetId t : turned) greatest = std::max(greatest, turn_back(t));
    if (!(greatest > 0)) break;
    way += greatest;
    next.clear();
    for (const TetId t : turned) {
      for (const VertexId v : tets[t]) add_turned_around(v, slivers, next);
    }
    turned.swap(next);
  }
  sort_out(turned);
  contact.note_jump(way);
  if (turned.size() < before) return true;
  if (way > 0) turn_all_over();
  return false;
}

/// Takes back what the last `turn_all_back` did.
void DeformableBody::State::turn_all_over() {
  for (std::size_t i = turned_from.size(); i-- > 0;) {
    places[turned_from[i].first.value] = turned_from[i].second;
    round_place(turned_from[i].first);
  }
  find_pressures();
}

/// Slivers first, which cost next to nothing, then what else is inside out: as far as the motion has the energy for it,
/// beside what the step has added already. `now`: how it stands, and then stands.
void DeformableBody::State::untangle(const detail::EnergyNow& before, detail::EnergyNow& now) {
  for (const bool slivers : {true, false}) {
    if (!turn_all_back(slivers)) continue;
    const std::array<std::vector<std::uint32_t>, detail::SweepOrder::kParts> rows_before = turned_rows;
    const detail::EnergyNow then = energy_now();
    if (then.excess_over(before) < std::max(now.excess_over(before), then.motion)) {
      now = then;
    } else {
      turn_all_over();
      turned_rows = rows_before;
    }
  }
}

}  // namespace v0
}  // namespace incise
