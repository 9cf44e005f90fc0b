// SPDX-License-Identifier: Apache-2.0
// Which faces may be near a point: a uniform grid, counted and sorted, without hashing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/geom/box.h"

namespace incise {
inline namespace v0 {
namespace detail {

class ContactGrid {
 public:
  /// Takes boxes up, in order; empty ones are left out. Cells are `cell` long, or longer where the boxes lie far apart.
  /// Cost: O(boxes).
  void build(std::span<const Box> boxes, double cell);
  /// The boxes that may hold a point, in ascending order. Cost: O(1).
  [[nodiscard]] std::span<const std::uint32_t> near(const Vec3& point) const;

 private:
  [[nodiscard]] std::array<std::uint32_t, 3> cell_of(const Vec3& point) const;
  [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return (std::size_t{z} * cells_[1] + y) * cells_[0] + x;
  }
  template <class Visit>
  void for_each_cell(const Box& box, const Visit& visit) const;

  Box all_;
  double per_length_ = 0;  // cells
  std::array<std::uint32_t, 3> cells_{1, 1, 1};
  std::vector<std::uint32_t> first_, members_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
