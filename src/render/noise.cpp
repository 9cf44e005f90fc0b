// SPDX-License-Identifier: Apache-2.0
// A linear congruential generator, of which the high bits are used.
#include "render/noise.h"

#include <cstddef>

namespace incise {
inline namespace v0 {
namespace render {

std::vector<std::uint8_t> noise_values() {
  std::vector<std::uint8_t> values(std::size_t{kNoiseSide} * kNoiseSide * kNoiseSide);
  std::uint32_t state = 1;
  for (std::uint8_t& value : values) {
    state = state * 1664525U + 1013904223U;  // the high bits of it are random enough for tissue
    value = static_cast<std::uint8_t>(state >> 24U);
  }
  return values;
}

}  // namespace render
}  // namespace v0
}  // namespace incise
