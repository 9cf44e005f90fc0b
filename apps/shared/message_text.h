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

/// Work that is counted as it goes on. Times in s.
struct CountProgress {
  std::size_t done = 0, total = 1;  ///< `done` is at most `total`, which is not 0
  std::string_view unit;
  double changed = 0;  ///< after this long `done` came to be what it is
  double now = 0;      ///< so long the work takes by now, at least `changed`
};

/// "[######      ] 12 of 50 frames, 0:12 left". A time is told after a second: what is left, which runs down while
/// nothing more is done; where nothing is done yet, or what is under way takes longer than it should, what has gone by.
[[nodiscard]] std::string progress_text(const CountProgress& progress);

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
