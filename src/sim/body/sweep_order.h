// SPDX-License-Identifier: Apache-2.0
// Which vertices the descent visits, in which order, and on which of two threads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/core/id_array.h"
#include "incise/mesh/tet_mesh.h"
#include "sim/body/constants.h"
#include "sim/body/stars.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// The vertices that move, in three parts: no vertex of the first shares a tet with one of the second, so that both
/// may be visited at once; the seam between them is visited after both. Within a part vertices are visited along the
/// body's longest axis, later ones behind. Those that rest fall asleep and are left out until something wakes them.
class SweepOrder {
 public:
  enum class Part : std::uint8_t { kFirst, kSecond, kSeam, kNone };
  static constexpr std::size_t kParts = 3;

  void ensure(std::uint32_t vertex_slots);
  /// Takes vertices up in a first order, all awake. `is_first` tells on which side of the middle each is.
  void begin(std::span<const std::uint32_t> order, const std::vector<bool>& is_first, const Stars& stars);
  /// Takes a new vertex up, or sets one right whose star has changed: it goes to the seam where it touches both parts.
  void settle(VertexId vertex, const Stars& stars);
  /// Leaves a vertex out: dead or rigidly held.
  void drop(VertexId vertex);

  /// The part that a vertex belongs to, lent or not.
  [[nodiscard]] Part part_of(VertexId vertex) const { return parts_[vertex]; }
  /// Until the next call these vertices, and no others, are visited with the seam, whatever their part: what they share
  /// besides tets with the other part. Ascending. Cost: O(lent).
  void lend_to_seam(std::span<const std::uint32_t> vertices);

  [[nodiscard]] bool moves(VertexId vertex) const { return parts_[vertex] != Part::kNone; }
  [[nodiscard]] bool is_awake(VertexId vertex) const { return heat_[vertex] > 0; }
  void wake(VertexId vertex) { warm(vertex, kHotSteps); }
  void wake_star(VertexId vertex, const Stars& stars);
  void put_to_sleep(VertexId vertex);

  /// Brings the lists below up to date. To be called before they are used. Cost: O(awake) where anything changed.
  void refresh();
  [[nodiscard]] std::span<const std::uint32_t> awake(Part part) const { return awake_[static_cast<std::size_t>(part)]; }
  /// As the lists have it.
  [[nodiscard]] std::size_t awake_count() const;
  [[nodiscard]] std::size_t moving_count() const { return moving_; }  ///< awake or asleep
  /// As it is now. Cost: O(slots) where anything changed since `refresh`.
  [[nodiscard]] std::size_t count_awake() const;
  /// After a step: what moved stays awake and wakes what is around it; what has not for a while falls asleep.
  /// `moved(vertex)` tells which it was; `rest(vertex)` hears of those that fall asleep.
  template <class Moved, class Rest>
  void cool(const Stars& stars, const Moved& moved, const Rest& rest);

  /// Calls `visit(vertex slot)` for the other corners of a star, each perhaps more than once.
  template <class Visit>
  static void for_each_neighbour(const Stars& stars, VertexId vertex, Visit&& visit);

 private:
  void warm(VertexId vertex, std::uint8_t heat);
  [[nodiscard]] Part part_beside(VertexId vertex, const Stars& stars) const;

  IdArray<VertexId, Part> parts_;
  IdArray<VertexId, std::uint8_t> heat_;  // 0: asleep
  IdArray<VertexId, std::uint32_t> rank_;
  IdArray<VertexId, std::uint8_t> is_lent_;
  std::vector<std::uint32_t> lent_;  // ascending
  std::uint32_t next_rank_ = 0;
  std::size_t moving_ = 0;  // vertices in a part
  std::array<std::vector<std::uint32_t>, kParts> awake_;
  std::vector<std::uint32_t> woken_;
  bool is_stale_ = false;
};

template <class Visit>
void SweepOrder::for_each_neighbour(const Stars& stars, VertexId vertex, Visit&& visit) {
  const Star& star = stars.of(vertex);
  for (std::uint32_t lane = 0; lane < star.lanes; ++lane) {
    const StarBlock& block = stars.blocks()[star.first + lane / kLanes];
    for (const auto* corner : {&block.a, &block.b, &block.c}) visit(VertexId((*corner)[lane % kLanes]));
  }
}

template <class Moved, class Rest>
void SweepOrder::cool(const Stars& stars, const Moved& moved, const Rest& rest) {
  const bool has_sleepers = awake_count() < moving_;
  for (const auto& list : awake_) {
    for (const std::uint32_t slot : list) {
      const VertexId v(slot);
      if (moved(v)) {
        heat_[v] = kHotSteps;
        if (has_sleepers) for_each_neighbour(stars, v, [&](VertexId n) { warm(n, kWarmSteps); });
      } else if (heat_[v] > 0 && --heat_[v] == 0) {
        rest(v);
        is_stale_ = true;
      }
    }
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
