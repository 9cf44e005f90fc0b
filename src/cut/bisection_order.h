// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace incise {
inline namespace v0 {

/// The edges of one tet that are to be bisected, first bisected first: longest first, ties by the ranks of their ends.
/// A total order of the mesh's edges, so that neighbours divide their common face alike.
class BisectionOrder {
 public:
  void clear() { count_ = 0; }
  /// Adds the tet's edge `number`, whose ends rank as a and b among the mesh's vertices; at most 6.
  void add(double length2, std::uint64_t a, std::uint64_t b, std::uint8_t number) {
    const Item item{length2, std::min(a, b), std::max(a, b)};
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
    std::uint64_t a, b;
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

}  // namespace v0
}  // namespace incise
