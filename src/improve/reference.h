// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "incise/geom/triangle_tree.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::inline v0 {

/// A triangle of a surface, by its corners.
using Facet = std::array<Vec3, 3>;

/// The surfaces that boundaries shall stay close to: the sweep of each stroke, at rest.
class References {
 public:
  void set(std::uint32_t stroke, TriangleTree sweep) { sweeps_[stroke] = std::move(sweep); }

  /// Whether the surface may change from `before` to `after` under a tag: no point of `after` lies further from the
  /// reference than `tolerance`, or than `before` did. Where there is no reference, `before` is it.
  /// Both are sampled at corners, middles of edges and centroids. Cost: O(|before|·|after|), or with a tree O(|after|).
  [[nodiscard]] bool allows(std::uint32_t tag, const std::vector<Facet>& before, const std::vector<Facet>& after,
                            double tolerance) const;

 private:
  std::map<std::uint32_t, TriangleTree> sweeps_;
};

}  // namespace incise::inline v0
