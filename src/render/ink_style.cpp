// SPDX-License-Identifier: Apache-2.0
// One table of inks, each with two colours and three shapes; the casing around an ink follows from its lightness.
#include "render/ink_style.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

using Rgb = std::array<float, 3>;

constexpr Rgb rgb(unsigned hex) {
  constexpr float kMost = 255;
  return {static_cast<float>(hex >> 16U) / kMost, static_cast<float>((hex >> 8U) & 255U) / kMost,
          static_cast<float>(hex & 255U) / kMost};
}

struct InkRow {
  unsigned dark, light;  // colours, by theme
  LinePattern line;
  BallGlyph ball;
  FillPattern fill;
};

// In the order of app::Ink, then the front. No two inks have all three shapes in common.
constexpr std::array<InkRow, kStyles> kRows = {{
    {0xF2F5F8, 0x2A2F36, LinePattern::kSolid, BallGlyph::kDisc, FillPattern::kPlain},             // blade
    {0xCC79A7, 0xA8487F, LinePattern::kDashDot, BallGlyph::kDonut, FillPattern::kRising},         // trajectory
    {0xF0E442, 0xF0E442, LinePattern::kHollow, BallGlyph::kDisc, FillPattern::kFalling},          // incision
    {0x1FC79A, 0x009E73, LinePattern::kDotted, BallGlyph::kDisc, FillPattern::kDotted},           // vertex
    {0x56B4E9, 0x1F86C4, LinePattern::kDashed, BallGlyph::kRing, FillPattern::kPlain},            // preview
    {0x1FC79A, 0x009E73, LinePattern::kLongDashed, BallGlyph::kBullseye, FillPattern::kCrossed},  // target
    {0x4FA3DC, 0x0072B2, LinePattern::kDotted, BallGlyph::kDonut, FillPattern::kLevel},           // ideal
    {0xE69F00, 0xE69F00, LinePattern::kHollow, BallGlyph::kBullseye, FillPattern::kPlain},        // hook
    {0xF0F0F0, 0x30343A, LinePattern::kLongDashed, BallGlyph::kCross, FillPattern::kCrossed},     // pin
    {0xF0E442, 0xF0E442, LinePattern::kSolid, BallGlyph::kRing, FillPattern::kRising},            // picked
    {0xFF7A1F, 0xD55E00, LinePattern::kDashDot, BallGlyph::kDonut, FillPattern::kCrossed},        // worst
    {0xA9B4C0, 0x7A858F, LinePattern::kHollow, BallGlyph::kDisc, FillPattern::kPlain},            // tool
    {0x1FC79A, 0x009E73, LinePattern::kSolid, BallGlyph::kRing, FillPattern::kPlain},             // within
    {0xE69F00, 0xE69F00, LinePattern::kDashed, BallGlyph::kBullseye, FillPattern::kRising},       // near
    {0xFF7A1F, 0xD55E00, LinePattern::kDashDot, BallGlyph::kCross, FillPattern::kCrossed},        // far
    {0x6B3A2A, 0x6B3A2A, LinePattern::kSolid, BallGlyph::kDonut, FillPattern::kPlain},            // spot
    {0xFFF3D6, 0xFFF3D6, LinePattern::kSolid, BallGlyph::kDisc, FillPattern::kPlain},             // front
    {0x7A2620, 0x7A2620, LinePattern::kSolid, BallGlyph::kDisc, FillPattern::kPlain},             // contour
}};

float lightness(const Rgb& c) {
  return 0.3F * c[0] + 0.59F * c[1] + 0.11F * c[2];
}

}  // namespace

std::array<InkStyle, kStyles> ink_styles(app::Theme theme) {
  std::array<InkStyle, kStyles> styles;
  for (std::size_t i = 0; i < kStyles; ++i) {
    const InkRow& row = kRows[i];
    const bool is_dark = theme == app::Theme::kDark;
    const Rgb color = rgb(is_dark ? row.dark : row.light);
    // Light around dark inks and dark around light ones; in between, like the ground.
    const bool has_dark_casing = lightness(color) > (is_dark ? 0.3F : 0.6F);
    if (i == kContourStyle) {  // no casing: it is as if drawn on the skin
      styles[i] = {color, color, row.line, row.ball, row.fill};
      continue;
    }
    styles[i] = {color, has_dark_casing ? rgb(0x101317) : rgb(0xFFFFFF), row.line, row.ball, row.fill};
  }
  return styles;
}

Grounds grounds_of(app::Theme theme) {
  if (theme == app::Theme::kLight) return {rgb(0xF7F8FA), rgb(0xD9DEE5), rgb(0x39424C), 0.10F};
  return {rgb(0x2B323B), rgb(0x14171B), rgb(0xB4C0CC), 0.30F};
}

}  // namespace render
}  // namespace v0
}  // namespace incise
