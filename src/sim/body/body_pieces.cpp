// SPDX-License-Identifier: Apache-2.0
// Free pieces move as rigid bodies must: what the unfinished descent takes from their momentum is given back.
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {

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

/// The turning ω that a piece needs besides its own, about its centre: what it adds to the angular momentum is linear
/// in it, although it moves the places too.
Vec3 turn_for(const Vec3& missing, const Mat3& by_turn) {
  const Eigen::FullPivLU<Mat3> lu(by_turn);
  return lu.isInvertible() ? Vec3(lu.solve(missing)) : Vec3(Vec3::Zero());
}

}  // namespace

void DeformableBody::State::label_pieces() {
  pieces.clear();
  stale_pieces = 0;
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::fill(piece_of.begin(), piece_of.end(), kNone);
  std::vector<VertexId> stack;
  for (std::uint32_t v = 0; v < piece_of.size(); ++v) {
    if (piece_of[VertexId(v)] != kNone || !is_live(VertexId(v))) continue;
    flood(*this, VertexId(v), static_cast<std::uint32_t>(pieces.size()), stack);
    pieces.emplace_back();
  }
}

/// Flooding costs O(body): a large body waits a few steps before its new pieces are told apart.
void DeformableBody::State::label_stale_pieces() {
  constexpr std::size_t kVerticesPerStep = 20000;
  if (stale_pieces > 0 && stale_pieces++ > places.size() / kVerticesPerStep) label_pieces();
  find_free_pieces();
}

/// What comes off wakes as a whole: it falls at once.
void DeformableBody::State::find_free_pieces() {
  std::vector<bool> was_free;
  for (Piece& piece : pieces) {
    was_free.push_back(piece.is_free);
    piece.is_free = true;
  }
  for (const auto& [v, hold] : holds) pieces[piece_of[VertexId(v)]].is_free = false;
  for (const Pull& pull : pulls) {
    for (unsigned i = 0; i < 4; ++i) {
      if (pull.weights[i] != 0 && pull.stiffness > 0) pieces[piece_of[pull.vertices[i]]].is_free = false;
    }
  }
  has_free_piece = false;
  bool came_off = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    has_free_piece |= pieces[i].is_free;
    came_off |= pieces[i].is_free && !was_free[i];
  }
  if (!came_off) return;
  for (std::uint32_t v = 0; v < places.size(); ++v) {
    if (!is_live(VertexId(v))) continue;
    const std::uint32_t i = piece_of[VertexId(v)];
    if (pieces[i].is_free && !was_free[i]) order.wake(VertexId(v));
  }
}

/// Pieces that have fallen far from what is held sleep where they are: single precision would not tell their cells
/// apart any more. To be called with the middle and extent of what is held.
void DeformableBody::State::leave_lost_pieces() {
  constexpr double kLost = 200;  // extents
  std::vector<double> nearest(pieces.size(), std::numeric_limits<double>::infinity());
  for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
    if (!is_live(VertexId(slot))) continue;
    double& distance = nearest[piece_of[VertexId(slot)]];
    distance = std::min(distance, (places[slot] - middle).norm());
  }
  for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
    const VertexId v(slot);
    const std::uint32_t piece = piece_of[v];
    if (!is_live(v) || !pieces[piece].is_free || !(nearest[piece] > kLost * extent)) continue;
    order.put_to_sleep(v);
    set_momentum(v, Vec3::Zero());
  }
}

/// What each piece's momentum must be after a substep of h, and its angular momentum about its centre.
void DeformableBody::State::expect_motion(double h) {
  if (!has_free_piece) return;
  const double kept = 1 / (1 + options.damping * h);
  const Vec3 fall = h / unit() * options.gravity;
  for (Piece& piece : pieces) piece = {piece.is_free};
  for_each_awake([&](std::uint32_t slot) {
    Piece& piece = pieces[piece_of[VertexId(slot)]];
    const double m = mass_of(VertexId(slot));
    const Vec3 p = momentum_of(VertexId(slot));
    piece.mass += m;
    piece.momentum += p;
    piece.centre += m * places[slot];
    piece.spin += (places[slot] - middle).cross(p);
  });
  for (Piece& piece : pieces) {
    if (piece.mass == 0) continue;
    const Vec3 arm = piece.centre / piece.mass - middle;
    piece.spin = kept * (piece.spin - arm.cross(piece.momentum));
    piece.momentum = kept * piece.momentum + piece.mass * fall;
  }
}

/// Shifts and turns each free piece rigidly so that its momenta are what they must be.
void DeformableBody::State::correct_motion(double h) {
  if (!has_free_piece) return;
  struct Found {
    Vec3 momentum = Vec3::Zero(), centre = Vec3::Zero(), spin = Vec3::Zero(), shift = Vec3::Zero(), turn = Vec3::Zero();
    Mat3 by_turn = Mat3::Zero();  // Σ m (r² − r rᵀ) + h (r pᵀ − r·p): arms r, momenta p
  };
  std::vector<Found> found(pieces.size());
  for_each_awake([&](std::uint32_t slot) {
    const std::uint32_t i = piece_of[VertexId(slot)];
    if (pieces[i].is_free) found[i].centre += mass_of(VertexId(slot)) * (places[slot] - middle);
  });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].mass > 0) found[i].centre /= pieces[i].mass;
  }
  for_each_awake([&](std::uint32_t slot) {
    const std::uint32_t i = piece_of[VertexId(slot)];
    if (!pieces[i].is_free) return;
    const Vec3 arm = places[slot] - middle - found[i].centre, p = momentum_of(VertexId(slot));
    found[i].momentum += p;
    found[i].spin += arm.cross(p);
    const double m = mass_of(VertexId(slot));
    found[i].by_turn += (m * arm.squaredNorm() - h * arm.dot(p)) * Mat3::Identity();
    found[i].by_turn += arm * (h * p - m * arm).transpose();
  });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!pieces[i].is_free || pieces[i].mass == 0) continue;
    found[i].shift = (pieces[i].momentum - found[i].momentum) / pieces[i].mass;
    found[i].turn = turn_for(pieces[i].spin - found[i].spin, found[i].by_turn);
  }
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const std::uint32_t i = piece_of[v];
    if (!pieces[i].is_free) return;
    const Vec3 more = found[i].shift + found[i].turn.cross(places[slot] - middle - found[i].centre);
    places[slot] += h * more;
    set_momentum(v, momentum_of(v) + mass_of(v) * more);
    round_place(v);
  });
}

}  // namespace v0
}  // namespace incise
