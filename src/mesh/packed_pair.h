// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace incise {
inline namespace v0 {

/// Two numbers as one that orders by the first, then by the second.
inline std::uint64_t pack(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{a} << 32U) | b;
}

}  // namespace v0
}  // namespace incise
