// SPDX-License-Identifier: Apache-2.0
// What scene files call the ways in which a body is drawn.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "app/scene/scene_view.h"

namespace incise {
inline namespace v0 {
namespace app {

inline constexpr std::array<std::string_view, 5> kColorNames = {"tissue", "region", "stroke", "quality", "defects"};
inline constexpr std::array<std::string_view, 2> kThemeNames = {"dark", "light"};
inline constexpr std::array<std::string_view, 4> kLookNames = {"skin", "liver", "vessel", "bone"};

constexpr std::string_view name_of(ColorBy color) {
  return kColorNames[static_cast<std::size_t>(color)];
}
constexpr std::string_view name_of(Theme theme) {
  return kThemeNames[static_cast<std::size_t>(theme)];
}
constexpr std::string_view name_of(TissueLook look) {
  return kLookNames[static_cast<std::size_t>(look)];
}

}  // namespace app
}  // namespace v0
}  // namespace incise
