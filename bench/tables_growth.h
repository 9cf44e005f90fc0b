// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "report.h"
#include "tables_run.h"

namespace incise::bench {

/// The paper's Table 2 beside what we get: tets to table2_tets.csv, times to table2_times.csv. Appends lines of
/// acceptance.
/// Table 2 by one rule for the stroke (`make_rule_cases`), blades not fitted to counts: tets added, for each tet that
/// was cut, and what merging leaves of them, beside print.
void report_rule(const std::vector<CaseResults>& results, const std::filesystem::path& folder);

void report_table2(const std::vector<CaseResults>& results, const std::filesystem::path& folder,
                   std::vector<Acceptance>& lines);

}  // namespace incise::bench
