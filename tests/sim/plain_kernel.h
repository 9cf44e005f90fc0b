// SPDX-License-Identifier: Apache-2.0
// The kernel of the descent once more, compiled without vector instructions: what machines without any run.
#pragma once

#include <cstdint>
#include <span>

namespace incise::test {

/// The members of `detail::Descent`, whose types have other names in the plain code.
struct PlainDescent {
  float* places;
  const void *blocks, *stars, *motions, *terms, *uses;
};

void plain_sweep(const PlainDescent& descent, std::span<const std::uint32_t> order, bool is_backward);
void plain_pick_starts(const PlainDescent& descent, std::span<const std::uint32_t> order);

}  // namespace incise::test
