// SPDX-License-Identifier: Apache-2.0
// Stars as visits read them: each neighbour once, and tets that name theirs by a byte.
//
// A visit takes the places of a vertex' neighbours once, from it, and its tets take theirs from there: some 14 reads in
// memory instead of 72. The Laplacian of an edge is summed up over its tets.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/core/id_array.h"
#include "sim/body/kernel_rows.h"
#include "sim/body/stars.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// Eight neighbours of a vertex. Unused lanes name the vertex itself and weigh nothing.
struct NearLanes {
  std::array<std::uint32_t, kLanes> place;  ///< where theirs begins: 4 · row
  std::array<float, kLanes> weight;         ///< the Laplacian between the two
};

/// Eight tets of a star, in the lanes of its `StarBlock`. Corners are codes of neighbours; unused lanes have bulk 0.
struct TetLanes {
  std::array<std::uint8_t, kLanes> a, b, c;
  std::array<std::uint8_t, kLanes> bend;     ///< as in `StarBlock`
  std::array<float, kLanes> bulk, pressure;  ///< as in `StarBlock`
};

/// The code of a neighbour by its block and lane: of the first two blocks the upper bit tells which, the lower three
/// which lane. So 16 neighbours can be picked out of registers by what code there is.
[[nodiscard]] constexpr std::uint32_t near_code(std::uint32_t block, std::uint32_t lane) {
  return (block / 2) * kLanes + (block % 2) * 128U + lane;
}
inline constexpr std::uint32_t kMostNear = 256;  ///< codes

/// The blocks of one vertex, or a part of them: as many tets, in whole blocks, as share no more neighbours than there
/// are codes.
struct PackedStar {
  std::uint32_t first_near = 0, first_tets = 0;
  std::uint16_t near = 0, tets = 0;  ///< blocks
  std::uint32_t next = 0;            ///< the part that goes on with it, in the list of all; 0: none

  [[nodiscard]] bool is_small() const { return near <= 2; }
};

/// The packed stars of a body. They follow `Stars`: what changes there is to be packed anew.
class PackedStars {
 public:
  /// Makes room for as many slots.
  void ensure(std::uint32_t vertex_slots);
  /// Packs a star as it stands. Stars that are packed one after the other for the first time lie so: the order is to be
  /// that of the sweeps. Cost: O(its tets).
  void update(VertexId vertex, const Stars& stars, const KernelRows& rows);

  /// By row.
  [[nodiscard]] const PackedStar* all() const { return stars_.data(); }
  [[nodiscard]] const PackedStar* parts() const { return parts_.data(); }
  [[nodiscard]] const NearLanes* near() const { return near_.data(); }
  [[nodiscard]] const TetLanes* tets() const { return tets_.data(); }

 private:
  using Free = std::vector<std::vector<std::uint32_t>>;  // first blocks, by how many they are
  struct Room {
    std::uint16_t near = 0, tets = 0;  // blocks
  };

  void forget(std::uint32_t row);
  std::uint32_t number_block(const StarBlock& block, std::uint32_t lanes);
  std::uint32_t number_part(const Star& star, const StarBlock* blocks, std::uint32_t from);
  void pack_part(const Star& star, const StarBlock* blocks, std::uint32_t from, const PackedStar& part);
  void pack_near(std::uint32_t row, const KernelRows& rows, const PackedStar& part);
  void make_room(PackedStar& part, Room& room);
  [[nodiscard]] std::uint32_t take_part();

  GrowArray<PackedStar> stars_;    // by row
  GrowArray<Room> rooms_;          // likewise
  std::vector<PackedStar> parts_;  // what does not fit into the first; the one numbered 0 is never used
  std::vector<Room> part_rooms_;
  std::vector<std::uint32_t> free_parts_;
  GrowArray<NearLanes> near_;
  GrowArray<TetLanes> tets_;
  Free free_near_, free_tets_;
  // scratch
  std::vector<std::uint16_t> numbers_;  // by vertex: which neighbour, from 1 on; zero between calls
  std::vector<std::uint32_t> found_;
  std::vector<double> weights_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
