// SPDX-License-Identifier: Apache-2.0
// What the programs' messages look like, whatever they are about.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace incise_apps {

/// One line of readable characters, at most 480 bytes: a longer text keeps its beginning and, with the remedy, its end.
[[nodiscard]] std::string one_line(std::string_view text);

/// "0:07", "12:34" or "1:02:03".
[[nodiscard]] std::string clock_text(double seconds);

/// "[######      ] 12 of 50 frames, 0:12 left" after `seconds` of work; `done` is at most `total`, which is not 0. The
/// time that is left is told once it can be: after a second, and where something is done.
[[nodiscard]] std::string progress_text(std::size_t done, std::size_t total, std::string_view unit, double seconds);

/// "[######      ] stage 2 of 5: cutting, 0:07" of work whose stages take times that nobody knows before: for how long
/// it has been going on. `done` stages came before this one.
[[nodiscard]] std::string stage_text(std::string_view name, std::size_t done, std::size_t total, double seconds);

}  // namespace incise_apps
