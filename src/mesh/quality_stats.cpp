// SPDX-License-Identifier: Apache-2.0
// One pass keeps every ratio and two cosines; the percentile and the angles are found at the end.
#include "incise/mesh/quality_stats.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geom/constants.h"
#include "incise/geom/quality.h"
#include "incise/mesh/defects.h"
#include "mesh/sum_internal.h"

namespace incise {
inline namespace v0 {
namespace {

double longest_edge_squared(const std::array<Vec3, 4>& p) {
  double longest = 0;
  for (const auto& [i, j] : kEdgeCorners) longest = std::max(longest, (p[i] - p[j]).squaredNorm());
  return longest;
}

bool is_flat(const std::array<Vec3, 4>& p) {
  const double squared = longest_edge_squared(p);
  return !(signed_volume(p[0], p[1], p[2], p[3]) > kFlatTetRatio * squared * std::sqrt(squared));
}

double degrees(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegreesPerRadian;
}

class Gauge {
 public:
  void add(const std::array<Vec3, 4>& p) {
    ++stats_.tets;
    if (is_flat(p)) {
      ++stats_.flat_tets;
      return;
    }
    const double ratio = longest_edge_over_inradius(p[0], p[1], p[2], p[3]);
    ratios_.push_back(ratio);
    sum_.add(ratio);
    over_ += ratio > kBadRatio ? 1 : 0;
    const DihedralCosines cosines = dihedral_cosines(p[0], p[1], p[2], p[3]);
    least_ = std::max(least_, cosines.of_least);
    greatest_ = std::min(greatest_, cosines.of_greatest);
  }

  QualityStats finish() {
    const double bad = static_cast<double>(over_ + stats_.flat_tets);
    if (stats_.tets > 0) stats_.lr_over_200_pct = 100 * bad / static_cast<double>(stats_.tets);
    if (ratios_.empty()) return stats_;
    const std::size_t n = ratios_.size();
    const auto [low, high] = std::minmax_element(ratios_.begin(), ratios_.end());
    stats_.lr_min = *low;
    stats_.lr_max = *high;
    stats_.lr_mean = sum_.value() / static_cast<double>(n);
    const auto rank = ratios_.begin() + static_cast<std::ptrdiff_t>((n * 99 + 99) / 100 - 1);
    std::nth_element(ratios_.begin(), rank, ratios_.end());
    stats_.lr_p99 = *rank;
    stats_.dihedral_min_deg = degrees(least_);
    stats_.dihedral_max_deg = degrees(greatest_);
    return stats_;
  }

 private:
  QualityStats stats_;
  std::vector<double> ratios_;
  detail::Sum sum_;
  std::uint64_t over_ = 0;
  double least_ = -1;    // cosine of the least angle so far
  double greatest_ = 1;  // of the greatest
};

}  // namespace

QualityStats measure_quality(const TetMesh& mesh, const std::function<bool(TetId)>& is_counted) {
  Gauge gauge;
  mesh.for_each_tet([&](TetId tet) {
    if (is_counted && !is_counted(tet)) return;
    const TetVertices& v = mesh.vertices(tet);
    gauge.add({mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])});
  });
  return gauge.finish();
}

bool touches_cut(const TetMesh& mesh, TetId tet) {
  for (const VertexId v : mesh.vertices(tet)) {
    if ((mesh.shape_of(v) & shape::kWall) != 0) return true;
  }
  return false;
}

}  // namespace v0
}  // namespace incise
