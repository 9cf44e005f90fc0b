// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "app/session/session_thread.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A row of a display: what, how much, and where there is something to say about it, what.
struct HudRow {
  std::string label, value, remark;
};

/// The paper's stages: CD collision detection, GM changes of the mesh, RLX relaxation, RD drawing.
struct StageRow {
  const char* label = "";
  double ms = 0;       ///< per frame of the simulation; of RD per picture
  double percent = 0;  ///< of the four
};

/// The figures that change while a person looks: rates and shares over the last second, without a clock of its own.
class Hud {
 public:
  /// A picture was drawn at `now` (s, never falling), in `draw_ms`, of a session with these figures.
  void add(double now, double draw_ms, std::uint64_t session, const SessionFigures& figures);

  [[nodiscard]] double pictures_per_second() const;
  [[nodiscard]] std::array<StageRow, 4> stages() const;

 private:
  struct Sample {
    double now = 0;
    std::uint64_t session = 0;
    std::uint64_t pictures = 0, frames = 0;  // sums
    StageTimes times;
    double draw_ms = 0;
  };
  std::deque<Sample> samples_;  // of the last second
};

/// Rates: pictures and steps apart, and whether the simulation keeps up.
[[nodiscard]] std::vector<HudRow> rate_rows(const Hud& hud, const SessionView& view);
/// Tets with their growth, vertices, strokes.
[[nodiscard]] std::vector<HudRow> mesh_rows(const SessionView& view);
/// L/r before and now, as a table: label, before, now.
struct QualityRow {
  std::string label, before, now;
};
[[nodiscard]] std::vector<QualityRow> quality_rows(const SessionView& view);
/// Force now and at most, and the length of edge in the tissue.
[[nodiscard]] std::vector<HudRow> force_rows(const SessionView& view);

/// 12345 as "12,345".
[[nodiscard]] std::string with_commas(std::uint64_t number);

}  // namespace app
}  // namespace v0
}  // namespace incise
