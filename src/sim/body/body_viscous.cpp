// SPDX-License-Identifier: Apache-2.0
// Stresses that relax: each tet has a metric per Prony term, which flows towards that of the tet as it stands. What a
// flow changes only ever lowers the energy: tr(C B) is least, of all B with determinant 1, at that of C⁻¹.
#include <algorithm>
#include <vector>

#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {

namespace {

constexpr std::uint32_t kTerms = 3, kNumbers = 6;  // of `Material::prony`, and of a metric

}  // namespace

void DeformableBody::State::add_metrics(const TetMesh& mesh) {
  std::vector<double> initial;
  for (std::uint32_t i = 0; i < kTerms; ++i) initial.insert(initial.end(), {1, 0, 0, 1, 0, 1});
  metric_id = *attributes.add(mesh, {"metric", Domain::kTet, kTerms * kNumbers, Transfer::kInherit, {}, initial});
}

/// Before there are any, and of tets that are none of the mesh's, the unit one.
detail::Metric DeformableBody::State::metric(TetId t, unsigned term) const {
  detail::Metric metric = {1, 0, 0, 1, 0, 1};
  if (!metric_id.is_valid()) return metric;
  const std::span<const double> all = attributes.values(metric_id);
  const std::size_t at = (std::size_t{t.value} * kTerms + term) * kNumbers;
  if (at + kNumbers > all.size() || !(all[at] > 0)) return metric;
  std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(at), kNumbers, metric.begin());
  return metric;
}

void DeformableBody::State::add_metrics(TetId t, StateHash& hash) const {
  for (unsigned k = 0; k < kTerms; ++k) {
    for (const double number : metric(t, k)) hash.add(number);
  }
}

/// Of tets that some awake vertex has. Sleeping tissue keeps its stresses.
void DeformableBody::State::relax_stresses(double dt) {
  if (!is_viscous) return;
  std::vector<std::uint32_t> flowing;
  is_touched_tet.ensure(static_cast<std::uint32_t>(tets.size()));
  has_changed_star.ensure(static_cast<std::uint32_t>(places.size()));
  for_each_awake([&](std::uint32_t v) {
    stars.for_each_tet(VertexId(v), [&](TetId t) {
      if (is_touched_tet[t.value] != 0) return;
      is_touched_tet[t.value] = 1;
      if (!is_bone(t) && materials.of(regions[t]).is_viscous()) flowing.push_back(t.value);
    });
  });
  for_each_awake(
      [&](std::uint32_t v) { stars.for_each_tet(VertexId(v), [&](TetId t) { is_touched_tet[t.value] = 0; }); });
  const std::span<double> all = attributes.values(metric_id);
  for (const std::uint32_t slot : flowing) {
    const TetId t(slot);
    const Material& material = materials.of(regions[t]);
    const detail::Metric to = detail::relaxed_metric(corners_at_rest(t), corners(t));
    for (unsigned k = 0; k < kTerms; ++k) {
      if (!(material.prony[k].share > 0)) continue;
      const double share = 1 - detail::decay(dt / material.prony[k].seconds);
      const detail::Metric gone = detail::flowed(metric(t, k), to, share);
      std::copy(gone.begin(), gone.end(),
                all.begin() + static_cast<std::ptrdiff_t>((std::size_t{slot} * kTerms + k) * kNumbers));
    }
    stars.set_laplacian(t, tets[t], soft_element(t, false));
    note_changed(tets[t]);
  }
  for (const std::uint32_t v : changed) {
    has_changed_star[v] = 0;
    motions[VertexId(v)].diagonal = stars.diagonal(VertexId(v));
    packed.update(VertexId(v), stars, rows);
  }
  changed.clear();
}

/// What undo and redo put in place bears no stress that has to relax: it would be one of the time of the cut.
void DeformableBody::State::forget_stresses() {
  const std::span<double> all = attributes.values(metric_id);
  for (const std::uint32_t slot : touched.tets) {
    const TetId t(slot);
    if (slot >= tets.size() || !tets[t][0].is_valid() || is_bone(t)) continue;
    const detail::Metric to = detail::relaxed_metric(corners_at_rest(t), corners(t));
    for (unsigned k = 0; k < kTerms; ++k)
      std::copy(to.begin(), to.end(),
                all.begin() + static_cast<std::ptrdiff_t>((std::size_t{slot} * kTerms + k) * kNumbers));
    stars.set_laplacian(t, tets[t], soft_element(t, false));
  }
}

}  // namespace v0
}  // namespace incise
