// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "incise/cut/stroke.h"
#include "incise/geom/box.h"

namespace incise::bench {

/// One cut of the growth study: strokes that go right through a body.
struct CutCase {
  std::string name;
  std::vector<Stroke> strokes;
  std::size_t pieces_of_cube = 0;  ///< pieces that a box falls into
  double curvature = 0;            ///< greatest, per side of the box; 0 for planes
  bool is_accepted = false;        ///< counts in the acceptance figure for growth

  [[nodiscard]] bool is_planar() const { return curvature == 0; }
};

/// The cuts of the study, fitted to a body's box: `kVariants` of each kind, one kind after the other.
inline constexpr unsigned kVariants = 4;
std::vector<CutCase> make_cuts(const Box& bounds);

}  // namespace incise::bench
