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
  const void* nodes = nullptr;
  const void *stiffening = nullptr, *fibres = nullptr;
  const std::uint32_t *rows = nullptr, *slots = nullptr;
  const void *packed = nullptr, *parts = nullptr, *near = nullptr, *tets = nullptr;
};

void plain_sweep(const PlainDescent& descent, std::span<const std::uint32_t> order, bool is_backward);
void plain_find_pressures(const PlainDescent& descent, std::span<const std::uint32_t> vertices);
void plain_pick_starts(const PlainDescent& descent, std::span<const std::uint32_t> order);

}  // namespace incise::test
