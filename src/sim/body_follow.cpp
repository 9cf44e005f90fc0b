// SPDX-License-Identifier: Apache-2.0
// How the solver's data follow the mesh: tets that a step touched leave their stars and come back as they are now.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/body_state.h"

namespace incise::inline v0 {

using detail::Hold;

namespace detail {

void Touched::sort() {
  for (auto* list : {&tets, &vertices, &fresh}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
}

void Touched::add(const Step& step) {
  for (const TetImage& tet : step.before.tets) tets.push_back(tet.id.value);
  for (const TetId tet : step.new_tets) tets.push_back(tet.value);
  for (const VertexImage& vertex : step.before.vertices) vertices.push_back(vertex.id.value);
  for (const VertexId vertex : step.new_vertices) vertices.push_back(vertex.value);
  for (const BornVertex& born : step.born) fresh.push_back(born.id.value);
  for (const CopiedVertex& copied : step.copied) fresh.push_back(copied.id.value);
  for (const MovedVertex& moved : step.moved) fresh.push_back(moved.id.value);
}

}  // namespace detail

namespace {

/// A birth between vertices that are all held rigidly is held as they are; a copy is held as its source.
void hand_on_holds(const Step& step, std::map<std::uint32_t, Hold>& holds) {
  for (const BornVertex& born : step.born) {
    bool is_held = true;
    for (unsigned i = 0; i < 4; ++i) {
      if (!born.parents[i].is_valid() || born.weights[i] == 0) continue;
      const auto hold = holds.find(born.parents[i].value);
      is_held = is_held && hold != holds.end() && hold->second.is_rigid();
    }
    if (is_held) holds[born.id.value] = {std::numeric_limits<double>::infinity(), born.current};
  }
  for (const MovedVertex& moved : step.moved) {
    if (const auto hold = holds.find(moved.id.value); hold != holds.end()) hold->second.target = moved.current;
  }
  for (const CopiedVertex& copied : step.copied) {
    const auto hold = holds.find(copied.source.value);
    if (hold != holds.end()) holds[copied.id.value] = Hold(hold->second);
  }
}

}  // namespace

// --- from the mesh

std::array<Vec3, 4> DeformableBody::State::corners_at_rest(TetId t) const {
  const TetVertices& v = tets[t];
  return {rest[v[0]], rest[v[1]], rest[v[2]], rest[v[3]]};
}

std::array<Vec3, 4> DeformableBody::State::corners(TetId t) const {
  const TetVertices& v = tets[t];
  return {places[v[0].value], places[v[1].value], places[v[2].value], places[v[3].value]};
}

detail::Element DeformableBody::State::element(TetId t) const {
  const Material& material = materials.of(regions[t]);
  // Pa are kg/(m s²): by metres per unit they become kg/(L s²). The energy's own λ is Lamé's + μ: only then are small
  // strains Hooke's (Smith et al. 2018, section 3.4).
  const double mu = material.mu() * unit(), lambda = material.lambda() * unit() + mu;
  return detail::element_of(corners_at_rest(t), lambda, mu, options.thinnest);
}

void DeformableBody::State::ensure(const TetMesh& mesh) {
  tets.resize(mesh.tet_slots());
  regions.resize(mesh.tet_slots());
  const std::uint32_t slots = mesh.vertex_slots();
  rest.resize(slots, Vec3::Zero());
  places.resize(slots, Vec3::Zero());
  floats.resize(std::size_t{4} * slots);
  motions.resize(slots);
  travelled.resize(slots);
  piece_of.resize(slots);
  stars.ensure(slots, mesh.tet_slots());
  order.ensure(slots);
}

/// A tet that was flat at load has no part in the body.
bool DeformableBody::State::add_tet(const TetMesh& mesh, TetId t) {
  if (!mesh.is_live(t) || !(mesh.rest_volume6(t) > 0)) return false;
  tets[t] = mesh.vertices(t);
  regions[t] = mesh.region(t);
  stars.add(t, tets[t], element(t));
  for (const VertexId v : tets[t]) changed.push_back(v.value);
  return true;
}

bool DeformableBody::State::remove_tet(TetId t) {
  if (t.value >= tets.size() || !tets[t][0].is_valid()) return false;
  stars.remove(t, tets[t]);
  for (const VertexId v : tets[t]) changed.push_back(v.value);
  tets[t][0] = VertexId();
  return true;
}

/// What follows from a vertex' star.
void DeformableBody::State::settle_vertex(VertexId v) {
  detail::Motion& motion = motions[v];
  motion.diagonal = stars.diagonal(v);
  double sum = 0;
  std::uint32_t count = 0;
  detail::SweepOrder::for_each_neighbour(stars, v, [&](VertexId n) {
    sum += (rest[n] - rest[v]).norm();
    ++count;
  });
  motion.reach = count > 0 ? static_cast<float>(0.25 * sum / count) : 0.0F;
  const auto hold = holds.find(v.value);
  if (count == 0 || (hold != holds.end() && hold->second.is_rigid())) {
    order.drop(v);
  } else {
    order.settle(v, stars);
    order.wake(v);
  }
}

/// Vertices that follow each other are seldom neighbours, so that one visit need not wait for the one before it.
static void interleave(std::vector<std::uint32_t>& order) {
  constexpr std::size_t kWindow = 64, kStride = 8;
  std::vector<std::uint32_t> window;
  for (std::size_t begin = 0; begin < order.size(); begin += kWindow) {
    const std::size_t end = std::min(order.size(), begin + kWindow);
    window.assign(order.begin() + static_cast<std::ptrdiff_t>(begin), order.begin() + static_cast<std::ptrdiff_t>(end));
    std::size_t next = begin;
    for (std::size_t first = 0; first < kStride; ++first) {
      for (std::size_t i = first; i < window.size(); i += kStride) order[next++] = window[i];
    }
  }
}

/// Stars are laid out as the sweeps go, along the longest axis: they are read in a row.
void DeformableBody::State::lay_out_stars() {
  std::vector<std::uint32_t> count(rest.size()), sorted;
  for (const TetVertices& tet : tets) {
    if (tet[0].is_valid()) {
      for (const VertexId v : tet) ++count[v.value];
    }
  }
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::uint32_t v = 0; v < count.size(); ++v) {
    if (count[v] == 0) continue;
    sorted.push_back(v);
    low = low.cwiseMin(rest[VertexId(v)]);
    high = high.cwiseMax(rest[VertexId(v)]);
  }
  Eigen::Index axis = 0;
  if (!sorted.empty()) (high - low).maxCoeff(&axis);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return rest[VertexId(a)][axis] < rest[VertexId(b)][axis]; });
  interleave(sorted);
  for (const std::uint32_t v : sorted) stars.lay_out(VertexId(v), count[v]);
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    if (tets[TetId(t)][0].is_valid()) stars.add(TetId(t), tets[TetId(t)], element(TetId(t)));
  }
  std::vector<bool> is_first(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) is_first[i] = i < sorted.size() / 2;
  order.begin(sorted, is_first, stars);
}

void DeformableBody::State::build(const TetMesh& mesh) {
  ensure(mesh);
  mesh.for_each_vertex([&](VertexId v) {
    rest[v] = mesh.rest(v);
    places[v.value] = mesh.current(v);
  });
  std::vector<double> mass(mesh.vertex_slots());
  const double volume_unit = unit() * unit() * unit();
  mesh.for_each_tet([&](TetId t) {
    if (!(mesh.rest_volume6(t) > 0)) return;
    tets[t] = mesh.vertices(t);
    regions[t] = mesh.region(t);
    const double share = materials.of(regions[t]).density * volume_unit * mesh.rest_volume6(t) / 24;
    for (const VertexId v : tets[t]) mass[v.value] += share;
  });
  lay_out_stars();
  mass_id = *attributes.add(mesh, {"mass", Domain::kVertex, 1, Transfer::kConserve, {}, {}});
  momentum_id = *attributes.add(mesh, {"momentum", Domain::kVertex, 3, Transfer::kConserve, {}, {}});
  std::copy(mass.begin(), mass.end(), masses());
  for (std::uint32_t v = 0; v < rest.size(); ++v) settle_vertex(VertexId(v));
  position = attributes.position();
  centre();
  label_pieces();
}

// --- through the journal

namespace {

/// What was undone may be gone from the journal: whatever is otherwise was touched.
detail::Touched differences(const DeformableBody::State& s, const TetMesh& mesh) {
  detail::Touched touched;
  const auto has_moved = [&](VertexId v) { return v.value >= s.rest.size() || s.rest[v] != mesh.rest(v); };
  const auto differs = [&](TetId t) {
    const bool was_live = t.value < s.tets.size() && s.tets[t][0].is_valid();
    if (was_live != mesh.is_live(t) || !was_live) return was_live || mesh.is_live(t);
    const TetVertices& now = mesh.vertices(t);
    return s.tets[t] != now || s.regions[t] != mesh.region(t) || std::any_of(now.begin(), now.end(), has_moved);
  };
  const auto tet_slots = std::max(static_cast<std::uint32_t>(s.tets.size()), mesh.tet_slots());
  for (std::uint32_t t = 0; t < tet_slots; ++t) {
    if (differs(TetId(t))) touched.tets.push_back(t);
  }
  mesh.for_each_vertex([&](VertexId v) {
    if (has_moved(v) || !s.is_live(v)) touched.vertices.push_back(v.value);
    if (!s.is_live(v)) touched.fresh.push_back(v.value);
  });
  return touched;
}

}  // namespace

Result<FollowReport> DeformableBody::follow(const Journal& journal, const TetMesh& mesh) {
  State& s = *state_;
  FollowReport report;
  if (journal.position() == s.position && journal.rewinds() == s.rewinds) return report;
  const bool has_rewound = journal.rewinds() != s.rewinds;
  detail::Touched touched;
  if (has_rewound) {
    touched = differences(s, mesh);
  } else {
    for (std::size_t i = s.position; i < journal.position(); ++i) {
      touched.add(journal.step(i));
      hand_on_holds(journal.step(i), s.holds);
    }
  }
  if (Status status = s.attributes.follow(journal, mesh); !status) return status.error();
  s.position = journal.position();
  s.rewinds = journal.rewinds();
  touched.sort();
  s.replace(mesh, touched, has_rewound, report);
  s.release_lost_holds();
  std::erase_if(touched.fresh,
                [&](std::uint32_t v) { return v >= mesh.vertex_slots() || !s.order.moves(VertexId(v)); });
  report.fresh_vertices = touched.fresh.size();
  s.stale_pieces = std::max(s.stale_pieces, 1U);
  s.relax(touched.fresh, 4);
  return report;
}

/// Vertices that were there before an undo stay where the body has them.
void DeformableBody::State::replace(const TetMesh& mesh, const detail::Touched& touched, bool has_rewound,
                                    FollowReport& report) {
  changed.clear();
  for (const std::uint32_t t : touched.tets) report.removed_tets += remove_tet(TetId(t)) ? 1U : 0U;
  ensure(mesh);
  for (const std::uint32_t slot : touched.vertices) {
    const VertexId v(slot);
    if (!mesh.is_live(v)) continue;
    const bool is_fresh = std::binary_search(touched.fresh.begin(), touched.fresh.end(), slot);
    rest[v] = mesh.rest(v);
    if (!has_rewound || is_fresh) places[slot] = mesh.current(v);
    round_place(v);
  }
  for (const std::uint32_t t : touched.tets) report.added_tets += add_tet(mesh, TetId(t)) ? 1U : 0U;
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const std::uint32_t v : changed) settle_vertex(VertexId(v));
}

void DeformableBody::State::release_lost_holds() {
  std::erase_if(holds, [&](const auto& hold) { return !is_live(VertexId(hold.first)); });
  for (Pull& pull : pulls) {
    for (unsigned i = 0; i < 4; ++i) {
      if (pull.weights[i] != 0 && !is_live(pull.vertices[i])) pull.stiffness = 0;
    }
  }
}

}  // namespace incise::inline v0
