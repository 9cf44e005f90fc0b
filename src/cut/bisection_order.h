// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "incise/core/id.h"

namespace incise::inline v0 {

/// The edges of one tet that are to be bisected, first bisected first: longest first, ties by ends. A total order of
/// the mesh's edges, so that neighbours divide their common face alike.
class BisectionOrder {
 public:
  void clear() { count_ = 0; }
  /// Adds the tet's edge `number`, which joins a and b (a with the lower slot); at most 6.
  void add(double length2, VertexId a, VertexId b, std::uint8_t number) {
    const Item item{length2, a, b};
    unsigned place = count_++;
    for (; place > 0 && item < items_[place - 1]; --place) {
      items_[place] = items_[place - 1];
      numbers_[place] = numbers_[place - 1];
    }
    items_[place] = item;
    numbers_[place] = number;
  }
  /// The edge numbers in order. Valid until the next change.
  [[nodiscard]] std::span<const std::uint8_t> numbers() const { return {numbers_.data(), count_}; }

 private:
  struct Item {
    double length2;
    VertexId a, b;
    bool operator<(const Item& other) const {
      if (length2 != other.length2) return length2 > other.length2;
      if (a != other.a) return a < other.a;
      return b < other.b;
    }
  };
  std::array<Item, 6> items_;
  std::array<std::uint8_t, 6> numbers_{};
  unsigned count_ = 0;
};

}  // namespace incise::inline v0
