// SPDX-License-Identifier: Apache-2.0
// One float per tet slot, 0 where there is no tet: a step of the journal changes a few, and sums are made anew from
// all, in the order of slots.
#include "app/session/quality_monitor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/surface_view.h"
#include "incise/geom/quality.h"
#include "incise/mesh/quality_stats.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::size_t kBytesPerBin = 256 / QualityFigures::kBins;

float ratio_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  const Vec3 &a = mesh.rest(v[0]), &b = mesh.rest(v[1]), &c = mesh.rest(v[2]), &d = mesh.rest(v[3]);
  if (is_flat(a, b, c, d)) return std::numeric_limits<float>::infinity();
  return static_cast<float>(longest_edge_over_inradius(a, b, c, d));
}

/// Least L/r of each bin: comparing is much cheaper than a logarithm per tet.
std::array<float, QualityFigures::kBins> bin_floors() {
  std::array<float, QualityFigures::kBins> floors{};
  for (std::size_t i = 1; i < floors.size(); ++i) {
    floors[i] = static_cast<float>(lr_of_quality_byte(static_cast<std::uint8_t>(i * kBytesPerBin)));
  }
  return floors;
}

}  // namespace

QualityMonitor::QualityMonitor(const TetMesh& mesh, const Journal& journal) : cursor_(journal) {
  measure_all(mesh);
  before_ = now_;
}

bool QualityMonitor::follow(const TetMesh& mesh, const Journal& journal) {
  const JournalCursor::Way way = cursor_.way_to(journal);
  if (way == JournalCursor::Way::kNone) return false;
  if (way == JournalCursor::Way::kElsewhere) {
    measure_all(mesh);
  } else {
    for (std::size_t i = cursor_.position(); i < journal.position(); ++i) apply(journal.step(i), mesh);
    sum();
  }
  cursor_.move_to(journal);
  return true;
}

void QualityMonitor::measure_all(const TetMesh& mesh) {
  ratios_.assign(mesh.tet_slots(), 0);
  mesh.for_each_tet([&](TetId tet) { ratios_[tet.value] = ratio_of(mesh, tet); });
  sum();
}

void QualityMonitor::measure(const TetMesh& mesh, TetId tet) {
  ratios_[tet.value] = mesh.is_live(tet) ? ratio_of(mesh, tet) : 0;
}

void QualityMonitor::apply(const Step& step, const TetMesh& mesh) {
  ratios_.resize(mesh.tet_slots(), 0);
  for (const ConsumedTet& tet : step.consumed) measure(mesh, tet.id);
  for (const ProducedTet& tet : step.produced) measure(mesh, tet.id);
  for (const RewiredTet& tet : step.rewired) measure(mesh, tet.id);
  for (const MovedVertex& moved : step.moved) {
    if (!mesh.is_live(moved.id)) continue;
    for (const TetId tet : walker_.star(mesh, moved.id)) measure(mesh, tet);
  }
}

void QualityMonitor::sum() {
  static const std::array<float, QualityFigures::kBins> kFloors = bin_floors();
  now_ = {};
  float least = std::numeric_limits<float>::infinity(), most = 0;
  std::uint64_t bad = 0, flat = 0;
  for (const float ratio : ratios_) {
    if (ratio == 0) continue;
    ++now_.tets;
    bad += ratio > static_cast<float>(kBadRatio) ? 1 : 0;
    const auto above = std::upper_bound(kFloors.begin() + 1, kFloors.end(), ratio);
    ++now_.histogram[static_cast<std::size_t>(above - kFloors.begin()) - 1];
    if (std::isinf(ratio)) {
      ++flat;
      continue;
    }
    least = std::min(least, ratio);
    most = std::max(most, ratio);
    now_.lr_mean += static_cast<double>(ratio);
  }
  if (now_.tets > 0) now_.lr_over_200_pct = 100.0 * static_cast<double>(bad) / static_cast<double>(now_.tets);
  if (now_.tets == flat) return;
  now_.lr_min = static_cast<double>(least);
  now_.lr_max = static_cast<double>(most);
  now_.lr_mean /= static_cast<double>(now_.tets - flat);
}

std::vector<TetId> QualityMonitor::worst(std::size_t count) const {
  std::vector<TetId> tets;
  for (std::uint32_t slot = 0; slot < ratios_.size(); ++slot) {
    if (ratios_[slot] > 0) tets.emplace_back(slot);
  }
  const auto is_worse = [&](TetId a, TetId b) {
    return ratios_[a.value] != ratios_[b.value] ? ratios_[a.value] > ratios_[b.value] : a.value < b.value;
  };
  const auto kept = tets.begin() + static_cast<std::ptrdiff_t>(std::min(count, tets.size()));
  std::partial_sort(tets.begin(), kept, tets.end(), is_worse);
  tets.erase(kept, tets.end());
  return tets;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
