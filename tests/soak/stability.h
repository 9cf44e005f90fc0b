// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace incise::test {

/// Lets a cantilever hang for two seconds in every combination of stiffness, slivers, softening and start: held as it
/// left the mould, or with all of its vertices thrown anywhere. It must stay finite, never have more energy than at the
/// start, and never be faster than at first. Runs one combination in `every`; prints a table. Returns what the program
/// should.
int soak_stability(unsigned every);

}  // namespace incise::test
