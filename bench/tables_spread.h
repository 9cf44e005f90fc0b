// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

namespace incise::bench {

/// How much the figures of Table 3 depend on where the plane happens to pass by vertices: the oblique cut of the cube
/// with the jitters 1 to `seeds`. Printed, and written to table3_spread.csv.
void report_spread(std::uint64_t seeds, const std::filesystem::path& folder);

}  // namespace incise::bench
