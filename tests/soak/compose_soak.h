// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace incise::test {

struct ComposeLimits {
  std::uint64_t seed = 1;
  std::uint64_t rounds = 0;
  double seconds = 0;  ///< 0: no limit
};

/// Makes incisions in several strokes: rows of the compose table, turned at random, in cubes at rest, in such that are
/// moved between strokes, and in such that move while they are cut; at times a stroke is undone and redone. After each
/// pose the mesh must be valid; redo must give back what was undone, and undo the body. Prints how many fall into other
/// pieces than they must, and how many keep a tet of L/r > 60: those are no failures as yet. Returns what the program
/// should.
int soak_compositions(const ComposeLimits& limits);

}  // namespace incise::test
