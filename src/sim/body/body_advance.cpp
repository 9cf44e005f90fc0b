// SPDX-License-Identifier: Apache-2.0
// One step in time: implicit Euler by vertex block descent.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "incise/geom/box.h"
#include "sim/body/body_state.h"
#include "sim/body/constants.h"
#include "sim/body/position_based.h"

namespace incise {
inline namespace v0 {

using Part = detail::SweepOrder::Part;

Result<AdvanceReport> DeformableBody::advance(double dt) {
  if (!(dt > 0 && dt <= 1)) {
    return Error{ErrorCode::kBadArgument, "the time step must lie in (0, 1] s", {}};
  }
  State& s = *state_;
  s.label_stale_pieces();
  if (s.bones_changed) s.bones.find(s);
  if (s.drifted > 0.5 * s.extent) s.centre();
  const bool touches = s.options.self.on && s.options.relaxation == Relaxation::kBlockDescent;
  if (touches) s.contact.find(s, dt);
  s.find_groups();
  s.wake_tied();
  s.lend_to_seam();
  s.prepare_pulls();
  s.bones.wake(s);
  s.order.refresh();
  s.bones.begin(s);
  s.list_awake_rows();
  s.find_resting();
  s.list_beside();
  s.list_strained();
  AdvanceReport report;
  report.active_vertices = s.order.awake_count();
  s.for_each_awake([&](std::uint32_t v) { s.travelled[VertexId(v)] = 0; });
  const double h = dt / s.options.substeps;
  if (s.options.coarse) s.lattice.prepare(s, h);
  const detail::EnergyNow before = s.watch_energy();
  for (unsigned i = 0; i < s.options.substeps; ++i) {
    s.expect_motion(h);
    s.begin_substep(h);
    s.descend(h);
    s.move_carried();
    s.end_substep(h, report.fastest);
    s.correct_motion(h);
    s.bones.settle(s);
  }
  s.keep_energy(before, dt);
  s.bones.settle(s);
  s.relax_stresses(dt);
  report.torn_holds = s.give_way();
  s.move_crumbs(dt);
  s.drifted += report.fastest * dt;
  if (touches) {
    s.contact.finish(s, dt, report.fastest);
    report.self_contacts = s.contact.count_pressing();
  }
  report.fastest *= s.unit();
  s.fall_asleep();
  return report;
}

detail::Descent DeformableBody::State::descent() {
  detail::Descent d{floats.data(), stars.blocks(),         stars.all(),   motions.data(), terms.data(),
                    uses.data(),   contact.terms().data(), contact.uses()};
  d.rows = rows.rows();
  d.slots = rows.slots();
  d.packed = packed.all();
  d.parts = packed.parts();
  d.near = packed.near();
  d.tets = packed.tets();
  d.stiffening = stars.stiffening();
  d.fibres = stars.fibres();
  if (nodal.is_on) d.nodes = nodal.terms();
  return d;
}

void DeformableBody::State::round_place(VertexId v) {
  const Vec3 p = places[v.value] - middle;
  for (unsigned i = 0; i < 3; ++i) single(v)[i] = static_cast<float>(p.data()[i]);
}

/// Single precision is spent on the body's size, not on where it is; where something holds a part of it, on that part,
/// and not on what fell off.
void DeformableBody::State::centre() {
  Box all, held_pieces;
  for (std::uint32_t slot = 0; slot < places.size(); ++slot) {
    const VertexId v(slot);
    if (!is_live(v) || in_crumb[v] != 0) continue;
    all.extend(places[slot]);
    if (!pieces.empty() && !pieces[piece_of[v]].is_free) held_pieces.extend(places[slot]);
  }
  const Box& box = held_pieces.is_empty() ? all : held_pieces;
  if (!box.is_empty()) {
    middle = 0.5 * (box.lo + box.hi);
    extent = (box.hi - box.lo).maxCoeff();
  }
  drifted = 0;
  if (!held_pieces.is_empty()) leave_lost_pieces();
  for (std::uint32_t v = 0; v < places.size(); ++v) round_place(VertexId(v));
}

// --- pulls

detail::PullTerm detail::term_of(const Pull& pull, const Vec3& middle, double unit) {
  detail::PullTerm term;
  Vec3 target = pull.target;
  for (unsigned i = 0; i < 4; ++i) {
    if (!pull.vertices[i].is_valid() || pull.stiffness == 0) continue;
    term.vertices[i] = pull.vertices[i].value;
    term.weights[i] = pull.weights[i];
    target -= pull.weights[i] * middle;
  }
  term.target = target;
  term.axis = pull.axis;
  term.has_axis = !pull.axis.isZero(0);
  term.pushes_only = pull.pushes_only && term.has_axis;
  term.stiffness = pull.stiffness;
  term.limit = pull.limit / unit;
  term.drag = term.has_axis ? pull.drag / unit : 0.0;
  term.anchor = pull.anchor - pull.target;
  return term;
}

void DeformableBody::State::wake_pulled(const Pull& pull) {
  for (unsigned i = 0; i < 4; ++i) {
    if (pull.weights[i] != 0 && pull.stiffness > 0) order.wake(pull.vertices[i]);
  }
}

/// Whether a pull does what it did, but for what moves nothing.
bool DeformableBody::State::is_as_before(const Pull& a, const Pull& b) const {
  const auto shape = [](const Pull& p) { return std::tie(p.vertices, p.weights, p.stiffness, p.pushes_only, p.limit); };
  if (shape(a) != shape(b) || !a.vertices[0].is_valid()) return false;
  const double least = 4 * options.sleep_below * static_cast<double>(motions[a.vertices[0]].reach);
  const Vec3 moved = b.target - a.target;
  if (a.axis.isZero(0) || b.axis.isZero(0)) return a.axis == b.axis && moved.norm() < least;
  if (!((a.axis - b.axis).squaredNorm() < 1e-8) || !(std::abs(a.axis.dot(moved)) < least)) return false;
  return std::abs(a.drag - b.drag) <= 0.01 * std::max(a.drag, b.drag) &&
         (a.drag == 0 || (b.anchor - a.anchor).norm() < least);
}

/// What pulls as it did lets its vertices sleep: a table under what rests on it, a hook that is held still.
void DeformableBody::State::wake_where_pulls_differ(const std::vector<Pull>& next) {
  const auto by_vertex = [](const std::vector<Pull>& list) {
    std::vector<std::uint32_t> sorted(list.size());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) sorted[i] = i;
    std::stable_sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
      return list[a].vertices[0].value < list[b].vertices[0].value;
    });
    return sorted;
  };
  const std::vector<std::uint32_t> old_order = by_vertex(pulls), new_order = by_vertex(next);
  std::size_t i = 0, j = 0;
  while (i < old_order.size() || j < new_order.size()) {
    const Pull* before = i < old_order.size() ? &pulls[old_order[i]] : nullptr;
    const Pull* after = j < new_order.size() ? &next[new_order[j]] : nullptr;
    if (before != nullptr && after != nullptr && is_as_before(*before, *after)) {
      ++i, ++j;
    } else if (after == nullptr || (before != nullptr && before->vertices[0].value <= after->vertices[0].value)) {
      wake_pulled(*before);
      ++i;
    } else {
      wake_pulled(*after);
      ++j;
    }
  }
}

void DeformableBody::State::forget_terms() {
  for (const detail::PullTerm& term : terms) {
    for (unsigned i = 0; i < term.corners; ++i) {
      if (term.weights[i] != 0) motions[VertexId(term.vertices[i])].pulls = 0;
    }
  }
  terms.clear();
  uses.clear();
}

void DeformableBody::State::add_holds() {
  for (const auto& [v, hold] : holds) {
    if (hold.is_rigid()) continue;
    terms.push_back(
        detail::term_of({{VertexId(v)}, {1, 0, 0, 0}, hold.target, Vec3::Zero(), hold.stiffness}, middle, unit()));
    if (!hold.limit.tears) terms.back().limit = hold.limit.force / unit();
  }
}

/// Lists what pulls at each vertex: springs that hold, pulls and ties alike.
void DeformableBody::State::prepare_pulls() {
  forget_terms();
  for (const Pull& pull : pulls) terms.push_back(detail::term_of(pull, middle, unit()));
  add_holds();
  for (const Tie& tie : ties) terms.push_back(detail::term_of(tie, unit()));
  list_uses();
}

void DeformableBody::State::list_uses() {
  const auto for_each_use = [&](const auto& visit) {
    for (std::uint32_t t = 0; t < terms.size(); ++t) {
      for (unsigned i = 0; i < terms[t].corners; ++i) {
        if (terms[t].weights[i] != 0) visit(t, VertexId(terms[t].vertices[i]), terms[t].weights[i]);
      }
    }
  };
  for_each_use([&](std::uint32_t /*t*/, VertexId v, double /*w*/) { ++motions[v].pulls; });
  std::uint32_t next = 0;
  for_each_use([&](std::uint32_t /*t*/, VertexId v, double /*w*/) {
    detail::Motion& motion = motions[v];
    if (motion.pulls == 0) return;
    motion.first_pull = next;
    next += motion.pulls;
    motion.pulls = 0;
  });
  uses.resize(next);
  for_each_use([&](std::uint32_t t, VertexId v, double w) {
    detail::Motion& motion = motions[v];
    uses[motion.first_pull + motion.pulls++] = {t, w};
  });
}

// --- one substep

void DeformableBody::State::list_awake_rows() {
  for (std::size_t part = 0; part < awake_rows.size(); ++part) {
    rows.find(order.awake(static_cast<Part>(part)), awake_rows[part]);
  }
}

/// Until the next call.
std::span<const std::uint32_t> DeformableBody::State::rows_of(std::span<const std::uint32_t> slots) {
  rows.find(slots, some_rows);
  return some_rows;
}

/// As places are now. To be called whenever anything but a visit moved them, before the next visit.
void DeformableBody::State::find_pressures() {
  if (!nodal.is_on) return;
  const detail::Descent d = descent();
  const auto find = [&](std::size_t part) { detail::find_pressures(d, awake_rows[part]); };
  pair.run([&] { find(0); }, [&] { find(1); });
  find(2);
  find_pressures_beside();
}

void DeformableBody::State::find_pressures_beside() {
  if (nodal.is_on) detail::find_pressures(descent(), beside_rows);
}

/// Everything starts where its velocity takes it.
void DeformableBody::State::begin_substep(double h) {
  const double kept = 1 / (1 + options.damping * h);
  const Vec3 fall = h * h / unit() * options.gravity;
  const double* mass = masses();
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    detail::Motion& motion = motions[v];
    const Vec3 way = h * kept / mass[slot] * momentum_of(v);
    motion.weight = mass[slot] / (h * h);
    const double safe = detail::kSafeLeap * static_cast<double>(motion.reach);
    motion.leaps = way.squaredNorm() > safe * safe;
    float* x = single(v);
    for (unsigned i = 0; i < 3; ++i) {
      motion.start[i] = x[i];
      motion.aim[i] = static_cast<float>(way.data()[i] + fall.data()[i]);
      x[i] = static_cast<float>(static_cast<double>(x[i]) + way.data()[i]);
    }
  });
}

/// The two parts at once, the seam after them.
void DeformableBody::State::descend(double h) {
  const detail::Descent d = descent();
  const auto visit = [&](const auto& work) {
    pair.run([&] { work(awake_rows[0]); }, [&] { work(awake_rows[1]); });
    work(awake_rows[2]);
  };
  if (options.relaxation == Relaxation::kPositionBased) {
    detail::project(*this, h);
    return;
  }
  bones.straighten(*this);
  find_pressures();
  visit([&](std::span<const std::uint32_t> part) { detail::pick_starts(d, part); });
  if (options.coarse) lattice.correct(*this);
  for (unsigned i = 0; i < options.iterations; ++i) {
    visit([&](std::span<const std::uint32_t> part) { detail::sweep(d, part, i % 2 == 1); });
    bones.visit(*this);
    find_pressures_beside();
  }
  const double longer = std::clamp(h / detail::kUsualSubstep, 1.0, 4.0);
  const auto more = strained.empty() ? 0U : static_cast<unsigned>(detail::kStrainedSweeps * longer);
  for (unsigned i = 0; i < more; ++i) {
    if (nodal.is_on) detail::find_pressures(d, around_strained);
    detail::sweep(d, rows_of(strained), i % 2 == 1);
  }
}

/// The slopes of the energy in all awake vertices, 4 numbers per vertex slot.
void DeformableBody::State::find_slopes(float* slopes) {
  const detail::Descent d = descent();
  const auto find = [&](std::size_t part) { detail::find_slopes(d, awake_rows[part], slopes); };
  pair.run([&] { find(0); }, [&] { find(1); });
  find(2);
}

/// Places are kept in double precision: the descent tells by how much they changed.
void DeformableBody::State::end_substep(double h, double& fastest) {
  const double* mass = masses();
  double fastest2 = fastest * fastest;
  for_each_awake([&](std::uint32_t slot) {
    const VertexId v(slot);
    const float* x = single(v);
    const auto& start = motions[v].start;
    Vec3 way;
    for (unsigned i = 0; i < 3; ++i) way.data()[i] = static_cast<double>(x[i]) - static_cast<double>(start[i]);
    places[slot] += way;
    set_momentum(v, mass[slot] / h * way);
    const double way2 = way.squaredNorm();
    travelled[v] += static_cast<float>(way2);
    fastest2 = std::max(fastest2, way2 / (h * h));
    round_place(v);
  });
  fastest = std::sqrt(fastest2);
}

/// Lets vertices go towards their balance with what stands around them, without inertia: with the terms that are
/// listed, or without any.
void DeformableBody::State::relax(std::span<const std::uint32_t> vertices, unsigned sweeps, bool with_terms) {
  if (vertices.empty()) return;
  for (const std::uint32_t slot : vertices) {
    detail::Motion& motion = motions[VertexId(slot)];
    motion.weight = 0;
    if (with_terms) continue;
    motion.pulls = 0;
    motion.contacts = 0;
  }
  std::vector<std::array<float, 3>> before;
  const auto place_of = [&](std::uint32_t slot) {
    const float* x = single(VertexId(slot));
    return std::array<float, 3>{x[0], x[1], x[2]};
  };
  for (const std::uint32_t slot : vertices) before.push_back(place_of(slot));
  const detail::Descent d = descent();
  std::vector<std::uint32_t> around;
  if (nodal.is_on) list_around(vertices, around);
  const std::span<const std::uint32_t> order_of_rows = rows_of(vertices);
  if (nodal.is_on) detail::find_pressures(d, order_of_rows);
  for (unsigned i = 0; i < sweeps; ++i) {
    if (nodal.is_on) detail::find_pressures(d, around);
    detail::sweep(d, order_of_rows, i % 2 == 1);
  }
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const std::array<float, 3> after = place_of(vertices[k]);
    for (unsigned i = 0; i < 3; ++i) {
      places[vertices[k]].data()[i] += static_cast<double>(after[i]) - static_cast<double>(before[k][i]);
    }
    round_place(VertexId(vertices[k]));
  }
}

/// Whether a vertex went further in the last `advance` than one that rests does.
bool DeformableBody::State::has_moved(VertexId v) const {
  const auto least = static_cast<float>(16 * options.sleep_below * options.sleep_below);
  const float reach = motions[v].reach;  // a quarter of the local edge length
  return travelled[v] * static_cast<float>(options.substeps) > least * reach * reach;
}

void DeformableBody::State::fall_asleep() {
  if (options.sleep_below <= 0) return;
  order.cool(
      stars, [&](VertexId v) { return has_moved(v); }, [&](VertexId v) { set_momentum(v, Vec3::Zero()); });
}

}  // namespace v0
}  // namespace incise
