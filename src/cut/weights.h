// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace incise {
inline namespace v0 {

/// Barycentric weights of at least `margin` each, which is less than 1 / N; what the others give for it, they give in
/// proportion to what they have beyond it.
template <std::size_t N>
std::array<double, N> kept_off(std::array<double, N> weights, double margin) {
  double lacking = 0, excess = 0;
  for (const double w : weights) {
    (w < margin ? lacking : excess) += w < margin ? margin - w : w - margin;
  }
  for (double& w : weights) w = w < margin ? margin : w - (w - margin) * (lacking / excess);
  return weights;
}

}  // namespace v0
}  // namespace incise
