// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace incise {
inline namespace v0 {
namespace render {

inline constexpr int kNoiseSide = 32;

/// Random values on a grid of `kNoiseSide`³ points, x fastest: the pattern of tissue, once filters of a texture that
/// repeats have smoothed it. The same on every machine.
[[nodiscard]] std::vector<std::uint8_t> noise_values();

}  // namespace render
}  // namespace v0
}  // namespace incise
