// SPDX-License-Identifier: Apache-2.0
// How marks and grounds look in each theme. Shapes as well as colours tell inks apart.
#pragma once

#include <array>
#include <cstddef>

#include "app/view/picture.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Numbers that the shaders know, too.
enum class LinePattern : int { kSolid, kDashed, kDotted, kDashDot, kHollow, kLongDashed };
enum class BallGlyph : int { kDisc, kRing, kBullseye, kCross, kDonut };
enum class FillPattern : int { kPlain, kRising, kFalling, kDotted, kCrossed, kLevel };

struct InkStyle {
  std::array<float, 3> color{};   ///< sRGB, in [0, 1]
  std::array<float, 3> casing{};  ///< around it, so that it reads on any ground
  LinePattern line = LinePattern::kSolid;
  BallGlyph ball = BallGlyph::kDisc;
  FillPattern fill = FillPattern::kPlain;
};

inline constexpr std::size_t kInks = static_cast<std::size_t>(app::Ink::kSpot) + 1;
inline constexpr std::size_t kFrontStyle = kInks;        ///< front edges come after the inks
inline constexpr std::size_t kContourStyle = kInks + 1;  ///< and then the rims of wounds
inline constexpr std::size_t kStyles = kInks + 2;

/// Indexed by ink. **Source** of the colours: Okabe and Ito, Color Universal Design (2008), and greys.
[[nodiscard]] std::array<InkStyle, kStyles> ink_styles(app::Theme theme);

/// The colours behind and around the surface; sRGB, in [0, 1].
struct Grounds {
  std::array<float, 3> top{}, bottom{};  ///< of the background
  std::array<float, 3> lone_wire{};      ///< of a wireframe without a surface
  float rim = 0;                         ///< strength of the light from behind
};

[[nodiscard]] Grounds grounds_of(app::Theme theme);

}  // namespace render
}  // namespace v0
}  // namespace incise
