// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Edges with what is known about them, each once, found by their ends. `Edge` has members `a` and `b`.
/// Reusable: `clear` keeps the memory. Cost: O(1) for a search.
template <class Edge>
class BasicEdgeTable {
 public:
  void clear() {
    const bool is_crowded = kCrowded * edges_.size() > slots_.size();
    if (is_crowded) slots_.assign(slots_.size(), Slot());
    for (std::uint32_t i = is_crowded ? 0 : size(); i-- > 0;) {
      if (edges_[i].a.is_valid()) close_gap(slot_of(edges_[i].a, edges_[i].b));
    }
    edges_.clear();
    free_.clear();
  }
  /// Takes an edge out; its index is used again.
  void erase(std::uint32_t index) {
    close_gap(slot_of(edges_[index].a, edges_[index].b));
    edges_[index] = Edge();
    free_.push_back(index);
  }
  /// Gives an edge the ends a and b, in rising order, between which there is none; its index stays.
  void rename(std::uint32_t index, VertexId a, VertexId b) {
    close_gap(slot_of(edges_[index].a, edges_[index].b));
    edges_[index].a = a;
    edges_[index].b = b;
    slots_[slot_of(a, b)] = {a, b, index + 1};
  }
  /// The index of the edge, added where it is new.
  std::uint32_t find_or_add(VertexId a, VertexId b) {
    if (b < a) {
      std::swap(a, b);
    }
    if (slots_.size() < kRoom * (edges_.size() + 8)) {
      rehash(std::max<std::size_t>(1024, 2 * slots_.size()));
    }
    Slot& slot = slots_[slot_of(a, b)];
    if (slot.number == 0) {
      Edge edge;
      edge.a = a;
      edge.b = b;
      slot = {a, b, add(edge) + 1};
    }
    return slot.number - 1;
  }
  /// Takes over edges with their indices; those without valid ends are free. The table must be clear.
  void restore(std::span<const Edge> edges) {
    for (const Edge& edge : edges) {
      if (!edge.a.is_valid()) free_.push_back(size());
      edges_.push_back(edge);
    }
    const std::size_t room = std::max<std::size_t>(1024, kRoom * (edges.size() + 8));
    rehash(std::max<std::size_t>(slots_.size(), std::bit_ceil(room)));
  }
  Edge& operator[](std::uint32_t index) { return edges_[index]; }
  const Edge& operator[](std::uint32_t index) const { return edges_[index]; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(edges_.size()); }
  /// Those taken out have no valid ends.
  [[nodiscard]] GrowArray<Edge>& edges() { return edges_; }
  [[nodiscard]] const GrowArray<Edge>& edges() const { return edges_; }

 private:
  /// An edge's ends stand beside its number, so that a search reads the table alone.
  struct Slot {
    VertexId a, b;
    std::uint32_t number = 0;  // 0 empty, 1 + index
  };
  /// The table has at least so many slots for each edge: 7 edges start at a vertex of a typical mesh, which share 16.
  static constexpr std::size_t kRoom = 3;
  /// A table of fewer slots than so many for each edge is emptied as a whole.
  static constexpr std::size_t kCrowded = 16;
  /// Edges of vertices with neighbouring slots land on neighbouring lines of the table, 16 vertices at a time: tets are
  /// visited in slot order. The groups are scattered, so that those a multiple of the table apart do not pile up.
  static std::size_t hash_of(VertexId a, VertexId b) {
    const std::uint64_t group = (std::uint64_t{a.value >> 4U} * 0x9E3779B97F4A7C15ULL) >> 32U;
    return static_cast<std::size_t>(group * 256 + (a.value & 15U) * 16 + ((b.value * 0x9E3779B9U) >> 28U));
  }
  /// Where the edge stands, or would stand.
  [[nodiscard]] std::size_t slot_of(VertexId a, VertexId b) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = hash_of(a, b) & mask;
    while (slots_[i].number != 0 && (slots_[i].a != a || slots_[i].b != b)) {
      i = (i + 1) & mask;
    }
    return i;
  }
  std::uint32_t add(const Edge& edge) {
    if (free_.empty()) {
      edges_.push_back(edge);
      return size() - 1;
    }
    const std::uint32_t index = free_.back();
    free_.pop_back();
    edges_[index] = edge;
    return index;
  }
  /// Empties a slot, and moves those behind it up, so that no search ends before its edge.
  void close_gap(std::size_t gap) {
    const std::size_t mask = slots_.size() - 1;
    slots_[gap] = Slot();
    for (std::size_t i = (gap + 1) & mask; slots_[i].number != 0; i = (i + 1) & mask) {
      const std::size_t home = hash_of(slots_[i].a, slots_[i].b) & mask;
      if (((i - home) & mask) < ((i - gap) & mask)) continue;
      slots_[gap] = std::exchange(slots_[i], Slot());
      gap = i;
    }
  }
  void rehash(std::size_t capacity) {
    slots_.assign(capacity, Slot());
    const std::size_t mask = capacity - 1;
    for (std::uint32_t index = 0; index < size(); ++index) {
      if (!edges_[index].a.is_valid()) continue;
      std::size_t i = hash_of(edges_[index].a, edges_[index].b) & mask;
      while (slots_[i].number != 0) {
        i = (i + 1) & mask;
      }
      slots_[i] = {edges_[index].a, edges_[index].b, index + 1};
    }
  }

  GrowArray<Edge> edges_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_;  // indices of edges that were taken out
};

}  // namespace v0
}  // namespace incise
