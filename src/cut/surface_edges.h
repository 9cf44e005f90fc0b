// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// The edges of some boundary sides, each with the sides that have it. Reusable: `clear` keeps the memory.
class SurfaceEdges {
 public:
  struct Edge {
    VertexId a, b;                       ///< a has the lower slot
    std::uint32_t count = 0;             ///< of sides
    std::uint32_t last = kInvalidIndex;  ///< the use added last
  };
  /// One side that has an edge; the uses of an edge are a list.
  struct Use {
    Side side;
    std::uint32_t before = kInvalidIndex;
  };

  void clear() {
    for (const std::uint32_t slot : taken_) slots_[slot] = 0;
    taken_.clear();
    edges_.clear();
    uses_.clear();
  }
  /// Cost: O(1).
  void add(VertexId a, VertexId b, Side side) {
    if (b < a) std::swap(a, b);
    if (slots_.size() < 2 * (edges_.size() + 1)) grow();
    const std::size_t slot = slot_of(a, b);
    if (slots_[slot] == 0) {
      edges_.push_back({a, b});
      slots_[slot] = static_cast<std::uint32_t>(edges_.size());
      taken_.push_back(static_cast<std::uint32_t>(slot));
    }
    Edge& edge = edges_[slots_[slot] - 1];
    uses_.push_back({side, edge.last});
    edge.last = static_cast<std::uint32_t>(uses_.size() - 1);
    ++edge.count;
  }
  /// In the order in which they were added first.
  [[nodiscard]] const std::vector<Edge>& all() const { return edges_; }
  [[nodiscard]] const Use& use(std::uint32_t index) const { return uses_[index]; }

 private:
  [[nodiscard]] std::size_t slot_of(VertexId a, VertexId b) const {
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t key = std::uint64_t{a.value} << 32U | b.value;
    std::size_t i = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32U) & mask;
    while (slots_[i] != 0 && (edges_[slots_[i] - 1].a != a || edges_[slots_[i] - 1].b != b)) i = (i + 1) & mask;
    return i;
  }
  void grow() {
    slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), 0U);
    taken_.clear();
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const std::size_t slot = slot_of(edges_[e].a, edges_[e].b);
      slots_[slot] = e + 1;
      taken_.push_back(static_cast<std::uint32_t>(slot));
    }
  }

  std::vector<Edge> edges_;
  std::vector<Use> uses_;
  std::vector<std::uint32_t> slots_, taken_;  // 0 empty, 1 + edge; the slots that are not
};

}  // namespace v0
}  // namespace incise
