// SPDX-License-Identifier: Apache-2.0
// The table of ways to make an incision in several strokes. What they cut together is the union of their sheets, so
// each row names the strokes that make the same sheets in one go.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "incise/geom/vec.h"

namespace incise::test {

using Row = std::vector<Vec3>;       ///< the blade's edge at one moment, in the rest shape
using BladePath = std::vector<Row>;  ///< one stroke
using BladePaths = std::vector<BladePath>;

/// Of the bodies: a unit cube of 5³ or 6³ cells.
inline constexpr double kElement = 0.2;

struct ComposeRow {
  std::string name;
  BladePaths strokes;
  BladePaths single;       ///< the same sheets, each in one stroke
  std::size_t pieces = 2;  ///< that must come out
  double growth = 1.3;     ///< tets at most, against those of `single`
  bool is_short = false;   ///< wall area falls short of that of `single`, as it should: a gap stays
};

/// All rows, some 80.
[[nodiscard]] std::vector<ComposeRow> compose_rows();

}  // namespace incise::test
