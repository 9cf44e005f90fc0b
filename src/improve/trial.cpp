// SPDX-License-Identifier: Apache-2.0
// Change first, then mend the worst by single operations, and only then compare all that was touched with the tet as
// it was (docs/internals.md, 3.13).
#include "improve/trial.h"

#include <algorithm>

#include "improve/constants.h"
#include "improve/volume_return.h"

namespace incise {
inline namespace v0 {

namespace {

unsigned longest_edge_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  const auto length2 = [&](const auto& edge) { return (mesh.rest(v[edge[0]]) - mesh.rest(v[edge[1]])).squaredNorm(); };
  const auto longest = std::max_element(kEdgeCorners.begin(), kEdgeCorners.end(),
                                        [&](const auto& x, const auto& y) { return length2(x) < length2(y); });
  return static_cast<unsigned>(longest - kEdgeCorners.begin());
}

/// What all tets touched by a trial must be better than.
double bound_of(double before) {
  return std::max((1.0 + kLeastTrialGain) * before, kLeastRatio);
}

}  // namespace

bool Trial::split(Care& care, TetId tet, unsigned edge) {
  const double before = inradius_ratio(care.mesh, care.mesh.vertices(tet)), bound = bound_of(before);
  const unsigned most = before < kTriedHard ? kSplits : kFewSplits;
  begin(care);
  for (unsigned i = 0; i < most && split_edge(care, tet, edge); ++i) {
    mend(care);
    const Waiting worst = find_worst(care.mesh);
    if (worst.ratio > bound) {
      care.changed = touched_;
      return true;
    }
    tet = worst.tet;
    edge = longest_edge_of(care.mesh, tet);
  }
  return false;
}

bool Trial::merge(Care& care, TetId tet, unsigned edge, bool is_turned) {
  const double before = inradius_ratio(care.mesh, care.mesh.vertices(tet));
  const TetVertices& v = care.mesh.vertices(tet);
  VertexId from = v[kEdgeCorners[edge][0]], into = v[kEdgeCorners[edge][1]];
  if (is_turned) std::swap(from, into);
  begin(care);
  if (!(before < kTriedHard)) return false;
  const std::optional<double> lost6 = merger_.merge_loosely(care, from, into);
  if (!lost6 || !return_volume(care, into, *lost6)) return false;
  take_changed(care);
  mend(care);
  if (!(find_worst(care.mesh).ratio > bound_of(before))) return false;
  care.changed = touched_;
  return true;
}

void Trial::begin(const Care& care) {
  touched_.clear();
  born_.clear();
  last_unit_ = care.statistics.work_units + kMostWork;
}

/// Puts a vertex into the middle of an edge, whatever that makes; false where that may not be.
bool Trial::split_edge(Care& care, TetId tet, unsigned edge) {
  const TetVertices& v = care.mesh.vertices(tet);
  const std::array<VertexId, 2> ends = {v[kEdgeCorners[edge][0]], v[kEdgeCorners[edge][1]]};
  if ((care.mesh.shape_of(ends[0]) & care.mesh.shape_of(ends[1]) & shape::kPinched) != 0) return false;
  const SplitEdgePlan plan = plan_split_edge(care.mesh, ends[0], ends[1], tet, 0.5);
  if (!plan || !care.may_change(plan.ring) || exists_elsewhere(care, ends, plan.ring)) return false;
  const bool is_front = is_at_front(care.mesh, ends, tet);
  const SplitEdgeResult result = apply(care.transaction, plan);
  if (is_front) {
    const unsigned bits = care.mesh.shape_of(result.vertex) | unsigned{shape::kFront};
    care.transaction.set_shape(result.vertex, static_cast<std::uint8_t>(bits));
  }
  born_.push_back(result.vertex);
  ++care.statistics.inserted_vertices;
  care.changed.clear();
  for (const SplitHalves& halves : result.halves) {
    care.changed.insert(care.changed.end(), {halves.keeps_a, halves.keeps_b});
  }
  take_changed(care);
  return true;
}

/// Whether the lips of a cut meet at an edge.
bool Trial::is_at_front(const TetMesh& mesh, const std::array<VertexId, 2>& ends, TetId tet) {
  if ((mesh.shape_of(ends[0]) & mesh.shape_of(ends[1]) & shape::kFront) == 0) return false;
  find_edge_ring(mesh, ends[0], ends[1], tet, ring_);
  if (ring_.is_closed || ring_.tets.empty()) return false;
  const Side lip(ring_.tets.front(), mesh.corner_of(ring_.tets.front(), ring_.vertices[1]));
  const auto v = mesh.vertices(lip);
  const auto apex = static_cast<unsigned>(std::find(v.begin(), v.end(), ring_.vertices[0]) - v.begin());
  return mesh.link(lip).tag() != 0 && mesh.is_front_edge(lip, (apex + 1) % 3);
}

/// Hill climbing around what was split: the worst tet first.
void Trial::mend(Care& care) {
  while (!heap_.empty() && care.statistics.work_units < last_unit_) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Waiting worst = heap_.back();
    heap_.pop_back();
    care.spend(1);
    const TetMesh& mesh = care.mesh;
    if (!mesh.is_live(worst.tet) || inradius_ratio(mesh, mesh.vertices(worst.tet)) != worst.ratio) continue;
    if (mend_one(care, worst.tet)) take_changed(care);
  }
  heap_.clear();
}

bool Trial::mend_one(Care& care, TetId tet) {
  const TetVertices v = care.mesh.vertices(tet);
  return remover_.improve(care, tet) || face_remover_.improve(care, tet) ||
         std::any_of(v.begin(), v.end(), [&](VertexId id) { return smoother_.improve(care, id); });
}

void Trial::take_changed(const Care& care) {
  for (const TetId tet : care.changed) {
    touched_.push_back(tet);
    const double ratio = inradius_ratio(care.mesh, care.mesh.vertices(tet));
    if (ratio >= kGoal) continue;
    heap_.push_back({ratio, tet});
    std::push_heap(heap_.begin(), heap_.end());
  }
}

/// The worst of what is left of the tets touched, which it tidies: the live ones, each once.
Trial::Waiting Trial::find_worst(const TetMesh& mesh) {
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  std::erase_if(touched_, [&](TetId tet) { return !mesh.is_live(tet); });
  Waiting worst{2.0, {}};
  for (const TetId tet : touched_) {
    const double ratio = inradius_ratio(mesh, mesh.vertices(tet));
    if (ratio < worst.ratio) worst = {ratio, tet};
  }
  return worst;
}

}  // namespace v0
}  // namespace incise
