// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "incise/geom/vec.h"

namespace incise::test {

/// Repeatable pseudo-random numbers, the same with every compiler (SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  /// An integer in [low, high].
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// A number in [low, high).
  double real(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11U) * 0x1p-53); }
  /// A point of the integer grid [low, high]³.
  Vec3 grid_point(std::int64_t low, std::int64_t high) {
    const auto x = static_cast<double>(integer(low, high)), y = static_cast<double>(integer(low, high));
    return {x, y, static_cast<double>(integer(low, high))};
  }
  /// A point of the box [low, high)³.
  Vec3 point(double low, double high) {
    const double x = real(low, high), y = real(low, high);
    return {x, y, real(low, high)};
  }

 private:
  std::uint64_t state_;
};

}  // namespace incise::test
