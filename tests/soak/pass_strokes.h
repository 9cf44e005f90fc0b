// SPDX-License-Identifier: Apache-2.0
// Incisions in several passes, each of which is made in several strokes that go on from each other: deeper and deeper,
// from both sides, overlapping, with another cut in between, or across each other. However many strokes each pass has,
// the pieces must be those of its planes.
#pragma once

#include <array>

#include "soak/attack_strokes.h"

namespace incise::test {

/// The names of the ways, in the order in which cases take them.
inline constexpr std::array<const char*, 8> kPassKinds = {"deeper", "slices",  "both_sides", "overlap",
                                                          "back",   "between", "cross",      "tee"};

/// The strokes of one kind, an index into `kPassKinds`. Half of the planes are those of the axes.
[[nodiscard]] Attack make_passes(std::size_t kind, const AttackedBody& body, Random& random);
inline constexpr AttackSet kPasses = {"passes", kPassKinds, make_passes, 6};

}  // namespace incise::test
