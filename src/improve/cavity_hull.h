// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/core/id.h"

namespace incise {
inline namespace v0 {

/// The faces around a cavity, by their vertices: what a vertex that fills the cavity is joined to.
class CavityHull {
 public:
  void clear() { facets_.clear(); }
  void add(const std::array<VertexId, 3>& facet) { facets_.push_back(facet); }

  /// Whether the facets form a sphere or, where the cavity lies at the surface, a disc: at most two meet at an edge,
  /// and the Euler characteristic is 2 or 1. Else the tets around a vertex of the hull would hang together by it alone,
  /// as bodies that overlap themselves allow. Cost: O(facets · log facets).
  [[nodiscard]] bool is_simple(bool is_at_surface);

 private:
  std::vector<std::array<VertexId, 3>> facets_;
  std::vector<std::uint64_t> edges_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace v0
}  // namespace incise
