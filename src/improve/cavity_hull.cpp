// SPDX-License-Identifier: Apache-2.0
// Edges are pairs of vertex slots in one number; sorted, those of one edge stand beside each other.
#include "improve/cavity_hull.h"

#include <algorithm>
#include <cstddef>

namespace incise {
inline namespace v0 {

namespace {

template <class Number>
std::ptrdiff_t count_different(std::vector<Number>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return static_cast<std::ptrdiff_t>(numbers.size());
}

}  // namespace

bool CavityHull::is_simple(bool is_at_surface) {
  edges_.clear();
  vertices_.clear();
  for (const auto& facet : facets_) {
    for (unsigned k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(facet[k].value, facet[(k + 1) % 3].value);
      edges_.push_back((std::uint64_t{low} << 32U) | high);
      vertices_.push_back(facet[k].value);
    }
  }
  std::sort(edges_.begin(), edges_.end());
  for (std::size_t i = 2; i < edges_.size(); ++i) {
    if (edges_[i] == edges_[i - 2]) return false;
  }
  const std::ptrdiff_t characteristic =
      count_different(vertices_) - count_different(edges_) + static_cast<std::ptrdiff_t>(facets_.size());
  return characteristic == (is_at_surface ? 1 : 2);
}

}  // namespace v0
}  // namespace incise
