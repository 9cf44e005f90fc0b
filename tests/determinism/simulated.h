// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace incise::test {

/// Prints the state hashes of bodies that are cut while they deform, a few frames apart. Returns whether all were
/// valid throughout.
bool run_all_simulated(unsigned threads);

}  // namespace incise::test
