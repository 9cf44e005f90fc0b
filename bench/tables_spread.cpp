// SPDX-License-Identifier: Apache-2.0
#include "tables_spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "maintenance_figures.h"
#include "report.h"
#include "tables_run.h"

namespace incise::bench {

namespace {

const std::array<std::pair<Way, const char*>, 4> kRows = {{{Way::kPaperCut, "no optimisation"},
                                                           {Way::kPaperImproved, "paper, improve only"},
                                                           {Way::kPaper, "paper"},
                                                           {Way::kIncise, "incise"}}};

/// A way's figures, one value per seed.
struct Spread {
  std::vector<double> mean_ratio, worst, bad_pct;

  void add(const CaseResults& r, Way way) {
    const QualityStats& q = r[way].mesh.all;
    mean_ratio.push_back(r.mean_ratio(way));
    worst.push_back(q.lr_max);
    bad_pct.push_back(q.lr_over_200_pct);
  }
};

void append(const std::vector<double>& values, std::vector<std::string>& cells) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  cells.insert(cells.end(), {figure(*least), figure(median(values)), figure(*greatest)});
}

}  // namespace

void report_spread(std::uint64_t seeds, const std::filesystem::path& folder) {
  std::array<Spread, kRows.size()> spreads;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const TableCase one = make_oblique_case(seed);
    const CaseResults results = run_case(one, 1, "");
    for (std::size_t i = 0; i < kRows.size(); ++i) {
      spreads[i].add(results, kRows[i].first);
    }
  }
  Table table("table3_spread", fmt::format("Table 3, CUBE oblique over {} jitters: least, median, greatest", seeds),
              {"mesh", "mean/original", "median", "greatest", "L/r max", "median", "greatest", "% > 200", "median",
               "greatest"});
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    std::vector<std::string> cells = {kRows[i].second};
    append(spreads[i].mean_ratio, cells);
    append(spreads[i].worst, cells);
    append(spreads[i].bad_pct, cells);
    table.add(std::move(cells));
  }
  table.add({"printed: no optimisation", "", "3.117", "", "", "850.1", "", "", "2.6", ""});
  table.add({"printed: our method", "", "1.449", "", "", "763", "", "", "0.22", ""});
  table.print();
  table.write_csv(folder);
}

}  // namespace incise::bench
