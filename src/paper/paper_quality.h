// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/geom/quality.h"
#include "incise/mesh/tet_mesh.h"
#include "paper/constants.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// Measures tets at rest as the paper does, L/r, lower is better, and counts how often: the work units.
/// **Source:** Paper §3.1.
class QualityMeter {
 public:
  explicit QualityMeter(const TetMesh& mesh) : mesh_(mesh) {}

  /// Infinite where the volume is not positive. Cost: one unit.
  double of(const TetVertices& v) {
    ++evaluations_;
    return longest_edge_over_inradius(mesh_.rest(v[0]), mesh_.rest(v[1]), mesh_.rest(v[2]), mesh_.rest(v[3]));
  }
  double of(TetId tet) { return of(mesh_.vertices(tet)); }

  /// That of a tet with `vertex` (none of its corners, or one) at `place`. Cost: one unit.
  double of_moved(TetId tet, VertexId vertex, const Vec3& place) {
    ++evaluations_;
    std::array<Vec3, 4> p;
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId v = mesh_.vertices(tet)[c];
      p[c] = v == vertex ? place : mesh_.rest(v);
    }
    return longest_edge_over_inradius(p[0], p[1], p[2], p[3]);
  }

  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  const TetMesh& mesh_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace paper
}  // namespace v0
}  // namespace incise
