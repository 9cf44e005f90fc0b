// SPDX-License-Identifier: Apache-2.0
// Makes the strokes of a row of the table in a body at rest or one that stands otherwise, and says what came out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "compose/compose_rows.h"
#include "incise/mesh/shapes.h"

namespace incise::test {

/// How the body stands; the blade is moved by the same map, so that strokes mean the same material.
enum class Stance : std::uint8_t {
  kRest,
  kSheared,    ///< by 0.3
  kStretched,  ///< by 1.4
  kSwaying     ///< sheared and stretched by turns, a little further with each step of the blade
};

struct ComposeOutcome {
  std::string error;  ///< a refused stroke, or what is not valid; empty where all is well
  std::size_t pieces = 0, tets = 0;
  double lr = 0, area = 0;  ///< the worst L/r; of one side of all walls
  bool is_undone = true;    ///< what was undone was gone, and came back when redone: bit for bit
};

/// With `again` the last stroke is undone, redone, undone and made anew.
[[nodiscard]] ComposeOutcome make_strokes(const TetSoup& soup, const BladePaths& strokes, Stance stance, bool again);

/// What a row gives, against its sheets in one stroke each.
struct ComposeFigures {
  ComposeOutcome outcome;
  double growth = 0, area = 0;  ///< tets and wall area, against those
};

[[nodiscard]] ComposeFigures measure_row(const TetSoup& soup, const ComposeRow& row, Stance stance, bool again);

/// The limit on L/r.
inline constexpr double kMostLr = 25.0;

/// Whether a row gives what it must.
[[nodiscard]] bool holds(const ComposeRow& row, const ComposeFigures& figures);

}  // namespace incise::test
