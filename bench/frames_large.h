// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "report.h"

namespace incise::bench {

/// The liver of `root`/scenes/sim_liver.json with each tet divided into eight, on one thread and on two: a frame at 60
/// Hz.
void report_liver(const std::filesystem::path& root, const std::filesystem::path& folder, unsigned repeats,
                  std::vector<Acceptance>& lines);

/// The same local cut in bodies of 10k, 100k and 1M tets that rest: what of a frame grows with the body.
void report_growth(const std::filesystem::path& folder, bool is_quick, std::vector<Acceptance>& lines);

}  // namespace incise::bench
