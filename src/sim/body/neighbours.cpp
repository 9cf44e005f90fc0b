// SPDX-License-Identifier: Apache-2.0
#include "sim/body/neighbours.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

constexpr std::size_t kChunk = 8;

/// Finds room for `count` where `first` has less; what it had is free from then on.
template <class Array>
void make_room(std::size_t count, std::uint32_t& first, std::uint16_t& room,
               std::vector<std::vector<std::uint32_t>>& free, Array& array) {
  if (count <= room) return;
  if (room > 0) {
    const std::size_t chunks = room / kChunk;
    if (free.size() <= chunks) free.resize(chunks + 1);
    free[chunks].push_back(first);
  }
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  room = static_cast<std::uint16_t>(chunks * kChunk);
  if (chunks < free.size() && !free[chunks].empty()) {
    first = free[chunks].back();
    free[chunks].pop_back();
    return;
  }
  first = static_cast<std::uint32_t>(array.size());
  array.resize(array.size() + room);
}

/// Calls `visit(lane, slot)` for the three other corners in each lane of a star.
template <class Visit>
void for_each_corner(const Star& star, const StarBlock* blocks, const Visit& visit) {
  for (std::uint32_t lane = 0; lane < star.lanes; ++lane) {
    const StarBlock& block = blocks[star.first + lane / kLanes];
    for (const auto* corner : {&block.a, &block.b, &block.c}) visit(lane, (*corner)[lane % kLanes]);
  }
}

}  // namespace

void Neighbours::ensure(std::uint32_t vertex_slots) {
  if (vertex_slots <= lists_.size()) return;
  lists_.resize(vertex_slots);
  numbers_.resize(vertex_slots, 0);
}

/// Numbers the neighbours, and counts the lanes of each.
void Neighbours::find(const Star& star, const StarBlock* blocks) {
  found_.clear();
  ends_.clear();
  for_each_corner(star, blocks, [&](std::uint32_t lane, std::uint32_t slot) {
    if (numbers_[slot] == 0) {
      found_.push_back(slot);
      ends_.push_back(0);
      numbers_[slot] = static_cast<std::uint16_t>(found_.size());
    }
    if (lanes_[lane] != 0) ++ends_[numbers_[slot] - 1U];
  });
  sort();
}

/// Those with the longest rings first: a visit's loops over them are foreseen where they are as long as the last one.
void Neighbours::sort() {
  by_length_.clear();
  for (std::size_t i = 0; i < found_.size(); ++i) by_length_.push_back({ends_[i], found_[i]});
  std::stable_sort(by_length_.begin(), by_length_.end(), [](const auto& a, const auto& b) { return a[0] > b[0]; });
  for (std::size_t i = 0; i < found_.size(); ++i) {
    ends_[i] = static_cast<std::uint16_t>(by_length_[i][0]);
    found_[i] = by_length_[i][1];
    numbers_[found_[i]] = static_cast<std::uint16_t>(i + 1);
  }
}

void Neighbours::update(VertexId vertex, const Stars& stars) {
  const Star& star = stars.of(vertex);
  find(star, stars.blocks());
  const auto count = static_cast<std::uint32_t>(found_.size());
  std::uint32_t all = 0;
  for (std::uint16_t& end : ends_) {  // where each begins, counted on to its end below
    const std::uint32_t own = end;
    end = static_cast<std::uint16_t>(all);
    all += own;
  }
  NeighbourList& list = lists_[vertex];
  make_room(count + 1, list.first, list.room, free_slots_, slots_);
  make_room(count + all, list.first_ring, list.ring_room, free_rings_, rings_);
  list.count = static_cast<std::uint16_t>(count);
  std::uint16_t* ring = rings_.data() + list.first_ring + count;
  for_each_corner(star, stars.blocks(), [&](std::uint32_t lane, std::uint32_t slot) {
    if (lanes_[lane] != 0) ring[ends_[numbers_[slot] - 1U]++] = static_cast<std::uint16_t>(4 * lane);
  });
  std::copy(ends_.begin(), ends_.end(), rings_.data() + list.first_ring);
  std::uint32_t* slots = slots_.data() + list.first;
  std::copy(found_.begin(), found_.end(), slots);
  slots[count] = vertex.value;
  for (const std::uint32_t slot : found_) numbers_[slot] = 0;
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
