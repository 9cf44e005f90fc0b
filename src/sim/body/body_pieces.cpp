// SPDX-License-Identifier: Apache-2.0
// Free pieces move as rigid bodies must: what the unfinished descent takes from their momentum is given back.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {

using detail::Crumb;
using detail::Group;
using detail::Piece;

namespace {

/// The number of the piece that each vertex is in, by flooding over tets.
std::uint32_t flood(DeformableBody::State& s, VertexId seed, std::uint32_t piece, std::vector<VertexId>& stack) {
  std::uint32_t count = 0;
  stack.assign(1, seed);
  s.piece_of[seed] = piece;
  while (!stack.empty()) {
    const VertexId v = stack.back();
    stack.pop_back();
    ++count;
    detail::SweepOrder::for_each_neighbour(s.stars, v, [&](VertexId n) {
      if (s.piece_of[n] == piece) return;
      s.piece_of[n] = piece;
      stack.push_back(n);
    });
  }
  return count;
}

}  // namespace

/// In `correct_motion`: the turning that a piece needs besides its own, about its centre. What it adds to the angular
/// momentum is linear in it, although it moves the places too.
Vec3 detail::turn_for(const Vec3& missing, const Mat3& by_turn) {
  const Eigen::FullPivLU<Mat3> lu(by_turn);
  return lu.isInvertible() ? Vec3(lu.solve(missing)) : Vec3(Vec3::Zero());
}

void DeformableBody::State::label_pieces() {
  const std::vector<Piece> old_pieces = std::move(pieces);
  const IdArray<VertexId, std::uint32_t> old_piece_of = piece_of;
  const auto was_lost = [&](std::uint32_t v) {
    const std::uint32_t old = old_piece_of[VertexId(v)];
    return old < old_pieces.size() && old_pieces[old].is_lost && !order.is_awake(VertexId(v));
  };
  pieces.clear();
  stale_pieces = 0;
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::fill(piece_of.begin(), piece_of.end(), kNone);
  std::vector<VertexId> stack;
  for (std::uint32_t v = 0; v < piece_of.size(); ++v) {
    if (piece_of[VertexId(v)] != kNone || !is_live(VertexId(v))) continue;
    const std::uint32_t count = flood(*this, VertexId(v), static_cast<std::uint32_t>(pieces.size()), stack);
    pieces.emplace_back();
    pieces.back().vertices = count;
    pieces.back().is_lost = was_lost(v);
  }
  gather_crumbs();
}

// --- crumbs

/// Takes pieces that are too small out of the descent: their vertices move with their mean velocity. Those that were
/// crumbs before go on as they are.
void DeformableBody::State::gather_crumbs() {
  std::vector<double> volume(pieces.size());
  for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
    const VertexId v(slot);
    if (!is_live(v) || !(volume[piece_of[v]] < largest_crumb)) continue;  // what is larger is no crumb
    stars.for_each_tet(v, [&](TetId t) { volume[piece_of[v]] += detail::six_volumes(corners_at_rest(t)) / 24; });
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].is_crumb = volume[i] < largest_crumb;
  for (const auto& [v, hold] : holds) pieces[piece_of[VertexId(v)]].is_crumb = false;
  for (const Tie& tie : ties) {
    for (const TissuePoint& end : tie.ends) {
      if (tie.stiffness > 0) pieces[piece_of[end.vertices[0]]].is_crumb = false;
    }
  }
  for (std::size_t i = crumbs.size(); i-- > 0;) {
    const VertexId v(crumbs[i].vertices.front());
    if (!pieces[piece_of[v]].is_crumb) dissolve_crumb_at(v);
  }
  std::vector<std::uint32_t> crumb_of(pieces.size(), kInvalidIndex);
  for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
    const VertexId v(slot);
    if (!is_live(v) || in_crumb[v] != 0 || !pieces[piece_of[v]].is_crumb) continue;
    std::uint32_t& number = crumb_of[piece_of[v]];
    if (number == kInvalidIndex) {
      number = static_cast<std::uint32_t>(crumbs.size());
      crumbs.emplace_back();
    }
    crumbs[number].vertices.push_back(slot);
  }
  for (const std::uint32_t number : crumb_of) {
    if (number != kInvalidIndex) begin_crumb(crumbs[number]);
  }
}

void DeformableBody::State::begin_crumb(const Crumb& crumb) {
  double mass = 0;
  Vec3 momentum = Vec3::Zero();
  for (const std::uint32_t v : crumb.vertices) {
    mass += mass_of(VertexId(v));
    momentum += momentum_of(VertexId(v));
  }
  for (const std::uint32_t slot : crumb.vertices) {
    const VertexId v(slot);
    set_momentum(v, mass_of(v) / mass * momentum);
    in_crumb[v] = 1;
    order.drop(v);
  }
}

/// What a cut, an undo or a hold has changed is computed again.
void DeformableBody::State::dissolve_crumb_at(VertexId vertex) {
  if (in_crumb[vertex] == 0) return;
  const auto holds_vertex = [&](const Crumb& crumb) {
    return std::find(crumb.vertices.begin(), crumb.vertices.end(), vertex.value) != crumb.vertices.end();
  };
  const auto at = std::find_if(crumbs.begin(), crumbs.end(), holds_vertex);
  if (at == crumbs.end()) return;
  const Crumb crumb = std::move(*at);
  crumbs.erase(at);
  for (const std::uint32_t v : crumb.vertices) in_crumb[VertexId(v)] = 0;
  for (const std::uint32_t v : crumb.vertices) {
    if (v < places.size()) settle_vertex(VertexId(v));
  }
}

void DeformableBody::State::move_crumbs(double dt) {
  const double kept = 1 / (1 + options.damping * dt);
  for (Crumb& crumb : crumbs) {
    if (crumb.age >= detail::kCrumbSeconds) continue;
    crumb.age += dt;
    const bool sleeps = crumb.age >= detail::kCrumbSeconds;
    for (const std::uint32_t slot : crumb.vertices) {
      const VertexId v(slot);
      const Vec3 velocity = kept * momentum_of(v) / mass_of(v) + dt / unit() * options.gravity;
      places[slot] += dt * velocity;
      set_momentum(v, sleeps ? Vec3(Vec3::Zero()) : Vec3(mass_of(v) * velocity));
      round_place(v);
    }
  }
}

/// Flooding costs O(body): a large body waits a few steps before its new pieces are told apart.
void DeformableBody::State::label_stale_pieces() {
  if (stale_pieces > 0 && stale_pieces++ > places.size() / detail::kLabelledPerStep) label_pieces();
  find_free_pieces();
}

/// What comes off wakes as a whole: it falls at once.
void DeformableBody::State::find_free_pieces() {
  std::vector<bool> was_free;
  for (Piece& piece : pieces) {
    was_free.push_back(piece.is_free);
    piece.is_free = true;
    piece.is_held = false;
  }
  for (const auto& [v, hold] : holds) {
    Piece& piece = pieces[piece_of[VertexId(v)]];
    if (std::isinf(hold.limit.force)) piece.is_held = true;
    piece.is_free = false;  // pins that give way carry what they hold
  }
  for (const Pull& pull : pulls) {
    for (unsigned i = 0; i < 4; ++i) {
      if (pull.weights[i] != 0 && pull.stiffness > 0) pieces[piece_of[pull.vertices[i]]].is_free = false;
    }
  }
  for (Piece& piece : pieces) {
    piece.is_carried = !piece.is_free && !piece.is_held && !piece.is_crumb;
    piece.is_free = piece.is_free && !piece.is_held && !piece.is_crumb;
    piece.is_lost = piece.is_lost && piece.is_free;
  }
  std::vector<bool> came_off(pieces.size(), false);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    came_off[i] = pieces[i].is_free && !was_free[i] && !pieces[i].is_lost;
  }
  wake_pieces(came_off);
}

void DeformableBody::State::wake_pieces(const std::vector<bool>& which) {
  if (std::find(which.begin(), which.end(), true) == which.end()) return;
  for (std::uint32_t v = 0; v < places.size(); ++v) {
    if (is_live(VertexId(v)) && which[piece_of[VertexId(v)]]) order.wake(VertexId(v));
  }
}

/// A free group moves as a rigid body must only as a whole: what sleeps in it holds the rest like a wall. Where any of
/// it is on its way, all of it wakes; where it comes to rest it is no longer taken for free.
void DeformableBody::State::wake_free_groups() {
  order.refresh();
  std::vector<std::ptrdiff_t> asleep(pieces.size());  // below 0 where vertices were born since they were counted
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    asleep[group_of[i]] += static_cast<std::ptrdiff_t>(pieces[i].vertices);
  }
  std::vector<bool> moves(pieces.size(), false);
  for_each_awake([&](std::uint32_t slot) {
    const std::uint32_t group = group_at(VertexId(slot));
    --asleep[group];
    if (!moves[group]) moves[group] = has_moved(VertexId(slot));
  });
  std::vector<bool> is_woken(pieces.size(), false);
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const std::uint32_t group = group_of[i];
    if (!groups[group].is_free || asleep[group] <= 0) continue;
    is_woken[i] = moves[group];
    if (moves[group]) pieces[i].is_lost = false;
  }
  wake_pieces(is_woken);
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    if (groups[i].is_free && asleep[i] > 0 && !moves[i]) groups[i].is_free = false;
  }
}

/// Pieces that touch or are tied to each other move as one where nothing holds any of them: they hand momentum on.
void DeformableBody::State::find_groups() {
  group_of.resize(pieces.size());
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    group_of[i] = i;
  }
  const auto root = [&](std::uint32_t piece) {
    while (group_of[piece] != piece) piece = group_of[piece] = group_of[group_of[piece]];
    return piece;
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    if (a != b) pieces[a].is_carried = !pieces[a].is_held, pieces[b].is_carried = !pieces[b].is_held;
    const std::uint32_t p = root(a), q = root(b);
    group_of[std::max(p, q)] = std::min(p, q);
  };
  for (const detail::ContactTerm& term : contact.terms())
    join(piece_of[VertexId(term.vertices[0])], piece_of[VertexId(term.vertices[1])]);
  for (const Tie& tie : ties) {
    if (tie.stiffness > 0) join(piece_of[tie.ends[0].vertices[0]], piece_of[tie.ends[1].vertices[0]]);
  }
  for (std::uint32_t i = 0; i < pieces.size(); ++i) group_of[i] = root(i);
  groups.assign(pieces.size(), {});
  has_free_group = false;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    Group& group = groups[group_of[i]];
    group.is_free = group.is_free && pieces[i].is_free;
    has_free_group |= group.is_free;
  }
  if (has_free_group) wake_free_groups();
  has_free_group = has_carried_piece = false;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    has_free_group |= groups[group_of[i]].is_free;
    has_carried_piece |= pieces[i].is_carried;
  }
}

/// Pieces that have fallen far from what is held sleep where they are: single precision would not tell their cells
/// apart any more. To be called with the middle and extent of what is held.
void DeformableBody::State::leave_lost_pieces() {
  std::vector<double> nearest(pieces.size(), std::numeric_limits<double>::infinity());
  for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
    if (!is_live(VertexId(slot))) continue;
    double& distance = nearest[piece_of[VertexId(slot)]];
    distance = std::min(distance, (places[slot] - middle).norm());
  }
  for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
    const VertexId v(slot);
    const std::uint32_t piece = piece_of[v];
    if (!is_live(v) || !pieces[piece].is_free || !(nearest[piece] > detail::kLost * extent)) continue;
    pieces[piece].is_lost = true;
    order.put_to_sleep(v);
    set_momentum(v, Vec3::Zero());
  }
}

/// What each group's momentum must be after a substep of h, and its angular momentum about its centre.
void DeformableBody::State::expect_motion(double h) {
  if (!has_free_group) return;
  const double kept = 1 / (1 + options.damping * h);
  const Vec3 fall = h / unit() * options.gravity;
  for (Group& group : groups) group = {group.is_free};
  for_each_awake([&](std::uint32_t slot) {
    Group& group = groups[group_at(VertexId(slot))];
    const double m = mass_of(VertexId(slot));
    const Vec3 p = momentum_of(VertexId(slot));
    group.mass += m;
    group.momentum += p;
    group.centre += m * places[slot];
    group.spin += (places[slot] - middle).cross(p);
  });
  for (Group& group : groups) {
    if (group.mass == 0) continue;
    const Vec3 arm = group.centre / group.mass - middle;
    group.spin = kept * (group.spin - arm.cross(group.momentum));
    group.momentum = kept * group.momentum + group.mass * fall;
  }
}

/// Shifts and turns each free group rigidly so that its momenta are what they must be.
void DeformableBody::State::correct_motion(double h) {
  if (!has_free_group) return;
  struct Found {
    Vec3 momentum = Vec3::Zero(), centre = Vec3::Zero(), spin = Vec3::Zero(), shift = Vec3::Zero(), turn = Vec3::Zero();
    Mat3 by_turn = Mat3::Zero();  // Σ m (r² − r rᵀ) + h (r pᵀ − r·p): arms r, momenta p
  };
  std::vector<Found> found(groups.size());
  for_each_awake([&](std::uint32_t slot) {
    const std::uint32_t i = group_at(VertexId(slot));
    if (groups[i].is_free) found[i].centre += mass_of(VertexId(slot)) * (places[slot] - middle);
  });
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].mass > 0) found[i].centre /= groups[i].mass;
  }
  for_each_awake([&](std::uint32_t slot) {
    const std::uint32_t i = group_at(VertexId(slot));
    if (!groups[i].is_free) return;
    const Vec3 arm = places[slot] - middle - found[i].centre, p = momentum_of(VertexId(slot));
    found[i].momentum += p;
    found[i].spin += arm.cross(p);
    const double m = mass_of(VertexId(slot));
    found[i].by_turn += (m * arm.squaredNorm() - h * arm.dot(p)) * Mat3::Identity();
    found[i].by_turn += arm * (h * p - m * arm).transpose();
  });
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (!groups[i].is_free || groups[i].mass == 0) continue;
    found[i].shift = (groups[i].momentum - found[i].momentum) / groups[i].mass;
    found[i].turn = detail::turn_for(groups[i].spin - found[i].spin, found[i].by_turn);
  }
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const std::uint32_t i = group_at(v);
    if (!groups[i].is_free) return;
    const Vec3 more = found[i].shift + found[i].turn.cross(places[slot] - middle - found[i].centre);
    places[slot] += h * more;
    set_momentum(v, momentum_of(v) + mass_of(v) * more);
    round_place(v);
  });
}

}  // namespace v0
}  // namespace incise
