// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "report.h"
#include "tables_run.h"

namespace incise::bench {

/// The paper's Table 3 beside what we get, without the peers: to table3.csv. Appends lines of acceptance.
void report_table3(const std::vector<CaseResults>& results, const std::filesystem::path& folder,
                   std::vector<Acceptance>& lines);

}  // namespace incise::bench
