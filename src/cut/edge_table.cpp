// SPDX-License-Identifier: Apache-2.0
#include "cut/edge_table.h"

#include <algorithm>
#include <utility>

namespace incise::inline v0 {

namespace {

/// Edges of vertices with neighbouring slots land on neighbouring lines of the table, 16 vertices at a time: tets are
/// visited in slot order. The groups are scattered, so that those a multiple of the table apart do not pile up.
std::size_t hash_of(VertexId a, VertexId b) {
  const std::uint64_t group = (std::uint64_t{a.value >> 4U} * 0x9E3779B97F4A7C15ULL) >> 32U;
  return static_cast<std::size_t>(group * 128 + (a.value & 15U) * 8 + ((b.value * 0x9E3779B9U) >> 28U));
}

}  // namespace

void EdgeTable::clear() {
  edges_.clear();
  std::fill(slots_.begin(), slots_.end(), 0U);
}

std::uint32_t EdgeTable::find_or_add(VertexId a, VertexId b) {
  if (b < a) {
    std::swap(a, b);
  }
  if (slots_.size() < 2 * (edges_.size() + 8)) {
    rehash(std::max<std::size_t>(1024, 2 * slots_.size()));
  }
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = hash_of(a, b) & mask;; i = (i + 1) & mask) {
    if (slots_[i] == 0) {
      CutEdge edge;
      edge.a = a;
      edge.b = b;
      edges_.push_back(edge);
      slots_[i] = size();
      return size() - 1;
    }
    const CutEdge& edge = edges_[slots_[i] - 1];
    if (edge.a == a && edge.b == b) {
      return slots_[i] - 1;
    }
  }
}

void EdgeTable::rehash(std::size_t capacity) {
  slots_.assign(capacity, 0U);
  const std::size_t mask = capacity - 1;
  for (std::uint32_t index = 0; index < size(); ++index) {
    std::size_t i = hash_of(edges_[index].a, edges_[index].b) & mask;
    while (slots_[i] != 0) {
      i = (i + 1) & mask;
    }
    slots_[i] = index + 1;
  }
}

}  // namespace incise::inline v0
