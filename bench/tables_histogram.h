// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "tables_run.h"

namespace incise::bench {

/// The distribution of L/r, as in the paper's Figure 15, of every case of Table 3: to figure15.csv, in classes of which
/// each ends at 2^(1/4) times the bound before, 25, 50, 100 and 200 among them. Printed for the first case.
void report_figure15(const std::vector<CaseResults>& results, const std::filesystem::path& folder);

}  // namespace incise::bench
