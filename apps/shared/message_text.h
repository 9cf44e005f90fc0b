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

/// A stage of work as it goes on. Times in s.
struct StageProgress {
  std::string_view name;
  unsigned percent = 0;  ///< of the work's time that had gone by when it began, as a rule; at most 100
  double begun = 0;      ///< after this long it began
  double now = 0;        ///< so long the work takes by now, at least `begun`
};

/// "[######      ] 47 %: cutting, 0:12 left"; in the first stage, of which nobody knows how long it takes, and in one
/// that takes longer than it should, "[      ] 0 %: reading, 0:07" with the time that has gone by.
[[nodiscard]] std::string stage_text(const StageProgress& stage);

}  // namespace incise_apps
