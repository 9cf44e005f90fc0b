// SPDX-License-Identifier: Apache-2.0
// Colours by formula and by table, in whole numbers: the same in windows, pictures and pages.
#include "app/view/color_map.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// Coefficients of t^0 to t^6, for red, green and blue.
constexpr std::array<std::array<double, 3>, 7> kViridis = {{{0.2777273272, 0.0054073445, 0.3340998053},
                                                            {0.1050930431, 1.4046135298, 1.3845901626},
                                                            {-0.3308618287, 0.2148475595, 0.0950951630},
                                                            {-4.6342304990, -5.7991009734, -19.3324409563},
                                                            {6.2282699332, 14.1799333668, 56.6905526007},
                                                            {4.7763849827, -13.7451453777, -65.3530326334},
                                                            {-5.4354558559, 4.6458526122, 26.3124352496}}};

constexpr std::array<Color, 8> kLabels = {{{86, 180, 233},
                                           {230, 159, 0},
                                           {0, 158, 115},
                                           {240, 228, 66},
                                           {0, 114, 178},
                                           {213, 94, 0},
                                           {204, 121, 167},
                                           {150, 150, 150}}};

}  // namespace

Color quality_color(std::uint8_t byte) {
  const double t = byte / 255.0;
  Color color{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double value = 0;
    for (std::size_t power = kViridis.size(); power-- > 0;) value = value * t + kViridis[power][channel];
    color[channel] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  }
  return color;
}

Color label_color(std::uint32_t label) {
  return kLabels[label % kLabels.size()];
}

}  // namespace app
}  // namespace v0
}  // namespace incise
