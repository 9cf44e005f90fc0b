// SPDX-License-Identifier: Apache-2.0
// The vertices around each vertex, each once, and which tets lie between the two.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/core/id_array.h"
#include "sim/body/stars.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// Where the neighbours of one vertex stand.
struct NeighbourList {
  std::uint32_t first = 0;       ///< of the slots: `count` neighbours, then the vertex itself
  std::uint32_t first_ring = 0;  ///< of the rings: where each neighbour's ends, then lanes of the star, fourfold
  std::uint16_t count = 0, room = 0, ring_room = 0;
};

/// The other corners of each vertex' tets, each once, with the lanes of the star that have them. Room that a list
/// outgrew is used again.
class Neighbours {
 public:
  /// Makes room for as many slots.
  void ensure(std::uint32_t vertex_slots);
  /// Lists the neighbours of a vertex anew; of rings, the lanes whose tets `takes_part(TetId)`. Cost: O(its tets).
  template <class TakesPart>
  void update(VertexId vertex, const Stars& stars, const TakesPart& takes_part) {
    lanes_.clear();
    stars.for_each_tet(vertex, [&](TetId t) { lanes_.push_back(takes_part(t) ? 1 : 0); });
    update(vertex, stars);
  }

  [[nodiscard]] std::span<const std::uint32_t> of(VertexId vertex) const {
    const NeighbourList& list = lists_[vertex];
    return {slots_.data() + list.first, list.count};
  }
  [[nodiscard]] const NeighbourList* lists() const { return lists_.data(); }
  [[nodiscard]] const std::uint32_t* slots() const { return slots_.data(); }
  [[nodiscard]] const std::uint16_t* rings() const { return rings_.data(); }

 private:
  using Free = std::vector<std::vector<std::uint32_t>>;  // first ones, by room / 8

  void update(VertexId vertex, const Stars& stars);
  void find(const Star& star, const StarBlock* blocks);
  void sort();

  IdArray<VertexId, NeighbourList> lists_;
  GrowArray<std::uint32_t> slots_;
  GrowArray<std::uint16_t> rings_;
  Free free_slots_, free_rings_;
  // scratch
  std::vector<std::uint8_t> lanes_;     // whether a lane takes part
  std::vector<std::uint16_t> numbers_;  // by vertex: which neighbour, from 1 on; zero between calls
  std::vector<std::uint32_t> found_;
  std::vector<std::uint16_t> ends_;
  std::vector<std::array<std::uint32_t, 2>> by_length_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
