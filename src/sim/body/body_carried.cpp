// SPDX-License-Identifier: Apache-2.0
// Pieces that lie on others or on tools, and that nothing holds: sweeps alone bring what presses at their surface too
// slowly through them, so that they would slide and fall as if they were many times as heavy. So each moves rigidly to
// where inertia, weight, contacts and pulls leave it: six unknowns for each, and what joins them piece by piece.
#include <Eigen/Cholesky>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// A rigid motion of a piece within a substep, and what stands against it. Places against the body's middle.
struct Carried {
  double weight = 0;  // mass by the substep squared
  Vec3 centre = Vec3::Zero();
  Vec6 slope = Vec6::Zero();      // of inertia and weight, by shift and turn
  Mat6 curvature = Mat6::Zero();  // of inertia
  Vec3 shift = Vec3::Zero(), turn = Vec3::Zero();
  std::vector<std::uint32_t> contacts, pulls;  // terms
};

class CarriedPieces {
 public:
  explicit CarriedPieces(DeformableBody::State& state) : s_(state), number_of_(state.pieces.size(), kInvalidIndex) {}

  /// Whether there are any.
  bool gather() {
    for (std::uint32_t i = 0; i < s_.pieces.size(); ++i) {
      const detail::Piece& piece = s_.pieces[i];
      if (!piece.is_carried) continue;
      number_of_[i] = static_cast<std::uint32_t>(carried_.size());
      carried_.emplace_back();
    }
    if (carried_.empty()) return false;
    std::vector<std::size_t> awake(carried_.size());
    for_each([&](Carried& piece, VertexId v, const Vec3& x) {
      ++awake[static_cast<std::size_t>(&piece - carried_.data())];
      piece.weight += s_.motions[v].weight;
      piece.centre += s_.motions[v].weight * x;
    });
    bool is_any = false;
    for (std::uint32_t i = 0; i < s_.pieces.size(); ++i) {
      std::uint32_t& number = number_of_[i];
      if (number == kInvalidIndex) continue;
      if (awake[number] < s_.pieces[i].vertices) {  // a part of it sleeps: it does not move as a whole
        number = kInvalidIndex;
        continue;
      }
      carried_[number].centre /= carried_[number].weight;
      is_any = true;
    }
    return is_any;
  }

  void find_inertia() {
    for_each([&](Carried& piece, VertexId v, const Vec3& x) {
      const detail::Motion& motion = s_.motions[v];
      const Vec3 arm = x - piece.centre;
      Vec3 off;
      for (unsigned i = 0; i < 3; ++i) {
        off.data()[i] = x.data()[i] - static_cast<double>(motion.start[i]) - static_cast<double>(motion.aim[i]);
      }
      piece.slope.head<3>() += motion.weight * off;
      piece.slope.tail<3>() += motion.weight * arm.cross(off);
      piece.curvature.bottomRightCorner<3, 3>() +=
          motion.weight * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    });
    for (Carried& piece : carried_) piece.curvature.topLeftCorner<3, 3>() = piece.weight * Mat3::Identity();
  }

  void list_terms() {
    const auto add = [&](auto list, std::uint32_t term, std::uint32_t vertex, std::uint32_t other = kInvalidIndex) {
      const std::uint32_t one = number_at(vertex), two = number_at(other);
      if (one != kInvalidIndex) (carried_[one].*list).push_back(term);
      if (two != kInvalidIndex && two != one) (carried_[two].*list).push_back(term);
    };
    const auto& contacts = s_.contact.terms();
    for (std::uint32_t t = 0; t < contacts.size(); ++t)
      add(&Carried::contacts, t, contacts[t].vertices[0], contacts[t].vertices[1]);
    for (std::uint32_t t = 0; t < s_.terms.size(); ++t) {
      const detail::PullTerm& term = s_.terms[t];
      if (term.stiffness > 0)
        add(&Carried::pulls, t, term.vertices[0], term.is_tie() ? term.vertices[4] : kInvalidIndex);
    }
  }

  /// Each piece in turn goes to where its terms leave it as the others stand.
  void relax() {
    for (unsigned round = 0; round < detail::kCarriedRounds; ++round) {
      for (std::uint32_t i = 0; i < carried_.size(); ++i) move(i);
    }
  }

  void put() {
    for_each([&](Carried& piece, VertexId v, const Vec3& x) {
      const Vec3 moved = x + piece.shift + piece.turn.cross(x - piece.centre);
      for (unsigned i = 0; i < 3; ++i) s_.single(v)[i] = static_cast<float>(moved.data()[i]);
    });
  }

 private:
  template <class Visit>
  void for_each(const Visit& visit) {
    s_.for_each_awake([&](std::uint32_t slot) {
      const std::uint32_t number = number_of_[s_.piece_of[VertexId(slot)]];
      if (number != kInvalidIndex) visit(carried_[number], VertexId(slot), place_of(slot));
    });
  }
  [[nodiscard]] Vec3 place_of(std::uint32_t slot) const {
    const float* x = s_.single(VertexId(slot));
    return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
  }
  [[nodiscard]] std::uint32_t number_at(std::uint32_t slot) const {
    return slot < s_.piece_of.size() ? number_of_[s_.piece_of[VertexId(slot)]] : kInvalidIndex;
  }
  /// By how much a vertex has been moved here.
  [[nodiscard]] Vec3 moved_by(std::uint32_t slot) const {
    const std::uint32_t number = number_at(slot);
    if (number == kInvalidIndex) return Vec3::Zero();
    const Carried& piece = carried_[number];
    return piece.shift + piece.turn.cross(place_of(slot) - piece.centre);
  }

  /// Adds a force and a stiffness at a point of a piece, `weight` of the term's gap by its motion.
  static void add(double weight, const Vec3& arm, const Vec3& slope, const Mat3& stiffness, Vec6& g, Mat6& h) {
    Mat3 cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    g.head<3>() += weight * slope;
    g.tail<3>() += weight * arm.cross(slope);
    const Mat3 across = weight * weight * stiffness, by_turn = cross * across;
    h.topLeftCorner<3, 3>() += across;
    h.bottomLeftCorner<3, 3>() += by_turn;
    h.topRightCorner<3, 3>() += by_turn.transpose();
    h.bottomRightCorner<3, 3>() -= by_turn * cross;
  }

  void add_contact(std::uint32_t number, const detail::ContactTerm& term, Vec6& g, Mat6& h) const {
    Vec3 off, foot = Vec3::Zero(), n;
    for (unsigned i = 0; i < 3; ++i) {
      off.data()[i] = -static_cast<double>(term.reference[i]);
      n.data()[i] = static_cast<double>(term.normal[i]);
    }
    for (unsigned i = 0; i < 4; ++i) {
      const auto weight = static_cast<double>(term.weight(i));
      if (weight == 0) continue;
      off += weight * (place_of(term.vertices[i]) + moved_by(term.vertices[i]));
      if (i > 0) foot -= weight * place_of(term.vertices[i]);
    }
    const bool is_vertex = number_at(term.vertices[0]) == number, is_face = number_at(term.vertices[1]) == number;
    if (is_vertex == is_face) return;  // both of one piece: its motion changes nothing
    const double gap = n.dot(off), k = static_cast<double>(term.stiffness), limit = static_cast<double>(term.limit);
    const Vec3 slip = off - gap * n;
    const double length = slip.norm();
    const double drag = limit > 0 ? (k * length <= limit ? k : limit / length) : 0.0;
    if (!(gap < 0) && drag == 0) return;
    const Vec3 slope = (gap < 0 ? k * gap : 0.0) * n + drag * slip;
    const Mat3 stiffness = ((gap < 0 ? k : 0.0) - drag) * n * n.transpose() + drag * Mat3::Identity();
    add(is_vertex ? 1 : -1, (is_vertex ? place_of(term.vertices[0]) : foot) - carried_[number].centre, slope, stiffness,
        g, h);
  }

  void add_pull(std::uint32_t number, const detail::PullTerm& term, Vec6& g, Mat6& h) const {
    Vec3 off = -term.target;
    std::array<Vec3, 2> points = {Vec3::Zero(), Vec3::Zero()};  // of a tie: −a and b
    for (unsigned i = 0; i < term.corners; ++i) {
      if (term.weights[i] == 0) continue;
      off += term.weights[i] * (place_of(term.vertices[i]) + moved_by(term.vertices[i]));
      points[i / 4] += term.weights[i] * place_of(term.vertices[i]);
    }
    const detail::PullState pull = detail::pull_state(term, off);
    const Mat3 curvature = pull.curvature(term);
    const Vec3& centre = carried_[number].centre;
    if (!term.is_tie()) return add(1, points[0] - centre, pull.slope, curvature, g, h);
    const bool has_a = number_at(term.vertices[0]) == number, has_b = number_at(term.vertices[4]) == number;
    if (has_a == has_b) return;  // both of one piece: its motion changes nothing
    add(has_a ? -1 : 1, (has_a ? Vec3(-points[0]) : points[1]) - centre, pull.slope, curvature, g, h);
  }

  void move(std::uint32_t number) {
    Carried& piece = carried_[number];
    if (piece.contacts.empty() && piece.pulls.empty()) return;
    Vec6 motion, g = piece.slope;
    motion << piece.shift, piece.turn;
    Mat6 h = piece.curvature;
    g += piece.curvature * motion;
    for (const std::uint32_t t : piece.contacts) add_contact(number, s_.contact.terms()[t], g, h);
    for (const std::uint32_t t : piece.pulls) add_pull(number, s_.terms[t], g, h);
    const Vec6 step = h.ldlt().solve(g);
    if (!step.allFinite()) return;
    piece.shift -= step.head<3>();
    piece.turn -= step.tail<3>();
  }

  DeformableBody::State& s_;
  std::vector<std::uint32_t> number_of_;  // by piece
  std::vector<Carried> carried_;
};

}  // namespace

void DeformableBody::State::move_carried() {
  if (!has_carried_piece || options.relaxation == Relaxation::kPositionBased) return;
  CarriedPieces pieces_here(*this);
  if (!pieces_here.gather()) return;
  pieces_here.find_inertia();
  pieces_here.list_terms();
  pieces_here.relax();
  pieces_here.put();
}

}  // namespace v0
}  // namespace incise
