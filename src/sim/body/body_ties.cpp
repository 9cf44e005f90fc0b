// SPDX-License-Identifier: Apache-2.0
// Springs between two points of the tissue, of one piece or of two: sutures, staples, plates.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {

Status Solver::set_ties(std::vector<Tie> ties) {
  if (ties.empty()) return {};
  return Error{ErrorCode::kBadArgument, "this solver has no ties: override `set_ties` to hold tissue by sutures", {}};
}

Status DeformableBody::set_ties(std::vector<Tie> ties) {
  State& s = *state_;
  for (std::size_t i = 0; i < ties.size(); ++i) {
    if (Status status = s.check(ties[i], i); !status) return status;
  }
  std::vector<Vec3> spans;
  for (const Tie& tie : ties) {
    const auto old = std::find(s.ties.begin(), s.ties.end(), tie);
    if (old != s.ties.end()) {
      spans.push_back(s.tie_spans[static_cast<std::size_t>(old - s.ties.begin())]);
      continue;
    }
    s.wake_ends(tie);
    spans.push_back(s.span_of(tie));
  }
  for (const Tie& old : s.ties) {
    if (std::find(ties.begin(), ties.end(), old) == ties.end()) s.let_go(old);
  }
  s.ties = std::move(ties);
  s.tie_spans = std::move(spans);
  return {};
}

const std::vector<Tie>& DeformableBody::ties() const {
  return state_->ties;
}

Status DeformableBody::State::check(const Tie& tie, std::size_t index) const {
  const auto bad = [&](const char* what) {
    return Error{ErrorCode::kBadArgument, "tie " + std::to_string(index) + ": " + what, {}};
  };
  if (!(tie.stiffness >= 0 && std::isfinite(tie.stiffness))) return bad("the stiffness must be at least 0 N/m");
  if (!(tie.rest_length >= 0 && std::isfinite(tie.rest_length))) return bad("the rest length must be at least 0 m");
  for (const TissuePoint& end : tie.ends) {
    const bool is_there = end.tet.value < tets.size() && tets[end.tet][0].is_valid();
    if (!is_there || tets[end.tet] != end.vertices) return bad("an end is in no tet of the body");
    const double sum = std::accumulate(end.weights.begin(), end.weights.end(), 0.0);
    if (!(std::abs(sum - 1) < 1e-6)) return bad("the weights of an end must sum up to 1");
  }
  return {};
}

detail::PullTerm detail::term_of(const Tie& tie, double unit) {
  detail::PullTerm term;
  term.corners = 8;
  term.stiffness = tie.stiffness;
  term.rest_length = tie.rest_length / unit;
  term.pulls_only = !tie.pushes;
  for (unsigned i = 0; i < 8 && tie.stiffness > 0; ++i) {
    const TissuePoint& end = tie.ends[i / 4];
    term.vertices[i] = end.vertices[i % 4].value;
    term.weights[i] = (i < 4 ? -1 : 1) * end.weights[i % 4];
  }
  return term;
}

/// From a to b, length unit; zero where it acts no more.
Vec3 DeformableBody::State::span_of(const Tie& tie) const {
  Vec3 span = Vec3::Zero();
  if (!(tie.stiffness > 0)) return span;
  for (unsigned i = 0; i < 4; ++i) {
    span += tie.ends[1].weights[i] * places[tie.ends[1].vertices[i].value] -
            tie.ends[0].weights[i] * places[tie.ends[0].vertices[i].value];
  }
  return span;
}

/// In kg L²/s².
double DeformableBody::State::tied_energy() const {
  double sum = 0;
  for (const Tie& tie : ties) sum += detail::pull_state(detail::term_of(tie, unit()), span_of(tie)).energy;
  return sum;
}

void DeformableBody::State::wake_ends(const Tie& tie) {
  if (!(tie.stiffness > 0)) return;
  for (const TissuePoint& end : tie.ends) {
    for (const VertexId v : end.vertices) {
      dissolve_crumb_at(v);
      order.wake(v);
    }
  }
}

/// What a tie held wakes as a whole: it falls at once.
void DeformableBody::State::let_go(const Tie& tie) {
  wake_ends(tie);
  if (!(tie.stiffness > 0) || stale_pieces > 0) return;
  for (const TissuePoint& end : tie.ends) {
    const std::uint32_t piece = piece_of[end.vertices[0]];
    if (pieces[piece].is_held) continue;
    for (std::uint32_t v = 0; v < places.size(); ++v) {
      if (is_live(VertexId(v)) && piece_of[VertexId(v)] == piece) order.wake(VertexId(v));
    }
  }
}

/// Ends sleep where they are until the span between them has changed by what would keep one vertex awake.
void DeformableBody::State::wake_tied() {
  for (std::size_t i = 0; i < ties.size(); ++i) {
    const Vec3 span = span_of(ties[i]);
    const double reach = ties[i].stiffness > 0 ? static_cast<double>(motions[ties[i].ends[0].vertices[0]].reach) : 0.0;
    if (!((span - tie_spans[i]).norm() > 4 * options.sleep_below * reach)) continue;
    wake_ends(ties[i]);
    tie_spans[i] = span;
  }
}

/// No vertex of the first part may share a term with one of the second: they are visited with the seam instead.
void DeformableBody::State::lend_to_seam() {
  std::vector<std::uint32_t> lent;
  if (options.self.on) contact.add_lent(*this, lent);
  for (const Tie& tie : ties) {
    if (!(tie.stiffness > 0)) continue;
    bool touches[detail::SweepOrder::kParts + 1] = {};
    for (unsigned i = 0; i < 8; ++i)
      touches[static_cast<std::size_t>(order.part_of(tie.ends[i / 4].vertices[i % 4]))] = true;
    if (!touches[0] || !touches[1]) continue;
    for (const TissuePoint& end : tie.ends) {
      for (const VertexId v : end.vertices) {
        if (order.part_of(v) == detail::SweepOrder::Part::kFirst) lent.push_back(v.value);
      }
    }
  }
  std::sort(lent.begin(), lent.end());
  lent.erase(std::unique(lent.begin(), lent.end()), lent.end());
  order.lend_to_seam(lent);
}

/// A tie whose tet is another now waits for being set anew.
void DeformableBody::State::drop_lost_ties(const TetMesh& mesh) {
  for (Tie& tie : ties) {
    for (const TissuePoint& end : tie.ends) {
      const bool is_new = std::any_of(end.vertices.begin(), end.vertices.end(), [&](VertexId v) {
        return is_fresh[v.value] == static_cast<std::uint8_t>(Fresh::kNew);
      });
      if (is_new || !end.holds(mesh)) tie.stiffness = 0;
    }
  }
}

}  // namespace v0
}  // namespace incise
