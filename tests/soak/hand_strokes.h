// SPDX-License-Identifier: Apache-2.0
// How hands move a blade: they shake, dwell, turn back, wander and turn corners. A stroke right through a convex body
// must leave two pieces however the hand shook, one that ends inside must leave one, and no wall may enclose anything.
#pragma once

#include <array>

#include "soak/attack_strokes.h"

namespace incise::test {

/// The names of the ways, in the order in which cases take them.
inline constexpr std::array<const char*, 12> kHandKinds = {"tremor", "zigzag", "wave",  "corner", "uturn",   "stairs",
                                                           "fan",    "walk",   "dwell", "back",   "partial", "inside"};

/// One stroke of a kind, an index into `kHandKinds`. The body must be convex for what must come out to be known.
[[nodiscard]] Attack make_hand(std::size_t kind, const AttackedBody& body, Random& random);
inline constexpr AttackSet kHands = {"hands", kHandKinds, make_hand};

}  // namespace incise::test
