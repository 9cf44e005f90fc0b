// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "soak/attack_strokes.h"

namespace incise::test {

/// What `attack` and `hands` take, for the program's usage.
inline constexpr const char* kAttackUsage =
    "[--meshes FILE|made|corpus...] [--kinds A,B] [--options A,B] [--cases N] [--case N] [--keep FOLDER] "
    "[--limit SECONDS]";

/// Attacks the cutter with strokes that nobody tuned on. Returns what the program should: 1 where any case falls short.
///
/// Which kind and which options a case has is in its number; the mesh and the strokes are in the seed and the number.
int soak_attacks(const AttackSet& set, const std::vector<std::string>& arguments);

}  // namespace incise::test
