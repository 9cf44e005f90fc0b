// SPDX-License-Identifier: Apache-2.0
// Neighbours of a star get numbers as its blocks name them; where one part has no numbers left the star goes on in
// another. Room that a star leaves is kept for the next of its size (docs/internals.md, 4).
#include "sim/body/packed_stars.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

/// Finds `count` blocks where `room` has less; what it had is free from then on.
template <class Array>
void make_block_room(std::uint16_t count, std::uint32_t& first, std::uint16_t& room,
                     std::vector<std::vector<std::uint32_t>>& free, Array& array) {
  if (count <= room) return;
  if (room > 0) {
    if (free.size() <= room) free.resize(room + std::size_t{1});
    free[room].push_back(first);
  }
  room = count;
  if (count < free.size() && !free[count].empty()) {
    first = free[count].back();
    free[count].pop_back();
    return;
  }
  first = static_cast<std::uint32_t>(array.size());
  array.resize(array.size() + count);
}

std::uint16_t blocks_for(std::size_t lanes) {
  return static_cast<std::uint16_t>((lanes + kLanes - 1) / kLanes);
}

std::uint32_t lanes_in(const Star& star, std::uint32_t block) {
  return std::min(kLanes, star.lanes - block * kLanes);
}

}  // namespace

void PackedStars::ensure(std::uint32_t vertex_slots) {
  if (vertex_slots <= stars_.size()) return;
  stars_.resize(vertex_slots);
  rooms_.resize(vertex_slots);
  numbers_.resize(vertex_slots, 0);
  if (parts_.empty()) {
    parts_.resize(1);
    part_rooms_.resize(1);
  }
}

/// Parts beyond the first are free from now on, and keep their room.
void PackedStars::forget(std::uint32_t row) {
  for (std::uint32_t part = stars_[row].next; part != 0; part = parts_[part].next) free_parts_.push_back(part);
  stars_[row].next = 0;
}

/// Numbers the neighbours that a block has and that have none yet; returns how many there are now.
std::uint32_t PackedStars::number_block(const StarBlock& block, std::uint32_t lanes) {
  for (std::uint32_t i = 0; i < lanes; ++i) {
    for (const auto* corner : {&block.a, &block.b, &block.c}) {
      const std::uint32_t slot = (*corner)[i];
      if (numbers_[slot] != 0) continue;
      found_.push_back(slot);
      numbers_[slot] = static_cast<std::uint16_t>(found_.size());
    }
  }
  return static_cast<std::uint32_t>(found_.size());
}

/// Numbers the neighbours of as many blocks as one part holds; returns the one behind them.
std::uint32_t PackedStars::number_part(const Star& star, const StarBlock* blocks, std::uint32_t from) {
  found_.clear();
  std::uint32_t block = from;
  while (block < star.used_blocks()) {
    const std::size_t before = found_.size();
    if (number_block(blocks[block], lanes_in(star, block)) > kMostNear) {
      for (std::size_t i = before; i < found_.size(); ++i) numbers_[found_[i]] = 0;
      found_.resize(before);
      break;
    }
    ++block;
  }
  return block;
}

void PackedStars::make_room(PackedStar& part, Room& room) {
  make_block_room(part.near, part.first_near, room.near, free_near_, near_);
  make_block_room(part.tets, part.first_tets, room.tets, free_tets_, tets_);
}

void PackedStars::pack_near(std::uint32_t row, const KernelRows& rows, const PackedStar& part) {
  for (std::uint32_t k = 0; k < part.near * kLanes; ++k) {
    NearLanes& lanes = near_[part.first_near + k / kLanes];
    lanes.place[k % kLanes] = 4 * (k < found_.size() ? rows.of(VertexId(found_[k])) : row);
    lanes.weight[k % kLanes] = k < found_.size() ? static_cast<float>(weights_[k]) : 0.0F;
  }
}

/// Packs the blocks from one on, for which there is room and whose neighbours have numbers.
void PackedStars::pack_part(const Star& star, const StarBlock* blocks, std::uint32_t from, const PackedStar& part) {
  weights_.assign(found_.size(), 0);
  const auto code = [&](std::uint32_t slot, float weight) {
    const std::uint32_t number = numbers_[slot] - 1U;
    weights_[number] += static_cast<double>(weight);
    return static_cast<std::uint8_t>(near_code(number / kLanes, number % kLanes));
  };
  for (std::uint32_t k = 0; k < part.tets; ++k) {
    const StarBlock& block = blocks[from + k];
    TetLanes& lanes = tets_[part.first_tets + k];
    lanes = {};
    lanes.bulk = block.bulk;
    lanes.pressure = block.pressure;
    lanes.bend = block.bend;
    for (std::uint32_t i = 0; i < lanes_in(star, from + k); ++i) {
      lanes.a[i] = code(block.a[i], block.to_a[i]);
      lanes.b[i] = code(block.b[i], block.to_b[i]);
      lanes.c[i] = code(block.c[i], block.to_c[i]);
    }
  }
}

/// Takes a free part, or a new one.
std::uint32_t PackedStars::take_part() {
  if (free_parts_.empty()) {
    parts_.emplace_back();
    part_rooms_.emplace_back();
    return static_cast<std::uint32_t>(parts_.size() - 1);
  }
  const std::uint32_t part = free_parts_.back();
  free_parts_.pop_back();
  return part;
}

void PackedStars::update(VertexId vertex, const Stars& stars, const KernelRows& rows) {
  const Star& star = stars.of(vertex);
  const StarBlock* blocks = stars.blocks() + star.first;
  const std::uint32_t row = rows.of(vertex);
  forget(row);
  std::uint32_t part = 0;  // the vertex' own
  for (std::uint32_t from = 0;;) {
    const std::uint32_t end = number_part(star, blocks, from);
    PackedStar packed = part == 0 ? stars_[row] : parts_[part];
    packed.near = blocks_for(found_.size());
    packed.tets = static_cast<std::uint16_t>(end - from);
    make_room(packed, part == 0 ? rooms_[row] : part_rooms_[part]);
    pack_part(star, blocks, from, packed);
    pack_near(row, rows, packed);
    for (const std::uint32_t slot : found_) numbers_[slot] = 0;
    packed.next = end < star.used_blocks() ? take_part() : 0;
    (part == 0 ? stars_[row] : parts_[part]) = packed;
    if (packed.next == 0) return;
    part = packed.next;
    from = end;
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
