// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace incise {
inline namespace v0 {
namespace app {

/// Red, green, blue of sRGB, each in [0, 255].
using Color = std::array<std::uint8_t, 3>;

/// A colour of the map that shows quality: from dark blue (0, a regular tet) through green to yellow (255, bad shape).
///
/// Its lightness grows steadily, so that it reads in grey and to the colour-blind. **Source:** viridis, by van der Walt
/// and Smith (2015), in the polynomial approximation by Zucker, within 2 % of it.
[[nodiscard]] Color quality_color(std::uint8_t byte);

/// A colour for a label (a region, a stroke): eight that the colour-blind tell apart, then again from the first.
/// **Source:** Okabe and Ito, Color Universal Design (2008).
[[nodiscard]] Color label_color(std::uint32_t label);

}  // namespace app
}  // namespace v0
}  // namespace incise
