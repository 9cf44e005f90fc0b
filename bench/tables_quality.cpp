// SPDX-License-Identifier: Apache-2.0
#include "tables_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "maintenance_figures.h"

namespace incise::bench {

namespace {

constexpr double kBad = 200;  // L/r of a bad-shaped tet

const std::array<std::pair<Way, const char*>, 6> kRows = {{{Way::kPaperCut, "no optimisation"},
                                                           {Way::kPaperImproved, "paper, improve only"},
                                                           {Way::kPaper, "paper"},
                                                           {Way::kInciseCut, "incise, cut only"},
                                                           {Way::kInciseMerged, "incise, merge only"},
                                                           {Way::kIncise, "incise"}}};

/// What every row has: the mesh's figures, its mean over the original's, then the tets at the walls.
std::vector<std::string> cells_of(const std::string& of, const std::string& row, const MeshFigures& mesh,
                                  double original_mean) {
  const QualityStats& q = mesh.all;
  const auto wall = [&](double value) { return mesh.wall.tets == 0 ? std::string("-") : figure(value); };
  return {of,
          row,
          std::to_string(q.tets),
          figure(q.lr_min),
          figure(q.lr_mean),
          figure(q.lr_mean / original_mean),
          figure(q.lr_p99),
          figure(q.lr_max),
          figure(q.lr_over_200_pct),
          figure(q.dihedral_min_deg),
          figure(q.dihedral_max_deg),
          wall(mesh.wall.lr_mean),
          wall(mesh.wall.lr_max)};
}

void add_case(const CaseResults& r, Table& table) {
  const double mean = r.original.all.lr_mean;
  table.add(cells_of(r.of->name, "original", r.original, mean));
  for (const auto& [way, name] : kRows) {
    const CutResult& cut = r[way];
    if (cut.is_ok) {
      std::vector<std::string> cells = cells_of(r.of->name, name, cut.mesh, mean);
      const bool is_maintained = cut.stages[Stage::kMerge] + cut.stages[Stage::kImprove] > 0;
      cells.insert(cells.end(), {figure(cut.cut_ms), is_maintained ? figure(cut.maintain_ms) : "-",
                                 figure(cut.volume_error), cut.defects});
      table.add(std::move(cells));
    }
  }
}

void add_printed(Table& table) {
  table.add({"printed", "original", "-", "7.90", "12.277", "1", "-", "28.25", "0"});
  table.add({"printed", "no optimisation", "-", "7.90", "38.27", "3.117", "-", "850.14", "2.6"});
  table.add({"printed", "our method", "-", "7.63", "17.79", "1.449", "-", "762.98", "0.22"});
}

std::uint64_t count_bad(const MeshFigures& mesh) {
  return static_cast<std::uint64_t>(
      std::count_if(mesh.ratios.begin(), mesh.ratios.end(), [](double ratio) { return ratio > kBad; }));
}

/// The worst over the cases.
struct Tally {
  std::size_t runs = 0, valid = 0;
  Worst mean, bad, worst, volume, paper_mean, paper_bad, dihedral_max;
  Worst dihedral_min{true};

  void add(const CaseResults& r) {
    const std::string& name = r.of->name;
    const QualityStats &before = r.original.all, &after = r[Way::kIncise].mesh.all;
    runs += kWays;
    valid += static_cast<std::size_t>(std::count_if(
        r.cuts.begin(), r.cuts.end(), [](const CutResult& cut) { return cut.is_ok && cut.defects.empty(); }));
    mean.note(r.mean_ratio(Way::kIncise), name);
    bad.note(static_cast<double>(count_bad(r[Way::kIncise].mesh)) - static_cast<double>(count_bad(r.original)), name);
    worst.note(after.lr_max / std::max(25.0, before.lr_max), name);
    dihedral_min.note(after.dihedral_min_deg - std::min(10.0, before.dihedral_min_deg), name);
    dihedral_max.note(after.dihedral_max_deg - std::max(160.0, before.dihedral_max_deg), name);
    volume.note(r[Way::kIncise].volume_error, name);
    paper_mean.note(r.mean_ratio(Way::kPaper), name);
    paper_bad.note(r[Way::kPaper].mesh.all.lr_over_200_pct, name);
  }
};

void accept(const std::vector<CaseResults>& results, std::vector<Acceptance>& lines) {
  Tally t;
  for (const CaseResults& r : results) {
    if (r.of->is_in_table3) {
      t.add(r);
    }
  }
  if (t.runs == 0) {
    return;
  }
  lines.push_back({"Table 3: cuts that are valid, every way of making them", "all", "all",
                   fmt::format("{}/{}", t.valid, t.runs), t.valid == t.runs});
  lines.push_back(t.mean.at_most("Table 3: incise, mean L/r over the original's", 1.05, "≤ 1"));
  lines.push_back(t.bad.at_most("Table 3: incise, tets with L/r > 200 beyond the original's", 0, "0"));
  lines.push_back(t.worst.at_most("Table 3: incise, worst L/r over max(25, the original's)", 1, "-"));
  lines.push_back(
      t.dihedral_min.at_least("Table 3: incise, least dihedral above min(10, the original's), degrees", 0, "-"));
  lines.push_back(
      t.dihedral_max.at_most("Table 3: incise, greatest dihedral above max(160, the original's), degrees", 0, "-"));
  lines.push_back(t.volume.at_most("Table 3: incise, change of the volume", 1e-9, "-"));
  lines.push_back(t.paper_mean.line("Table 3: paper, mean L/r over the original's (printed 1.45)", "-", "-", true));
  lines.push_back(t.paper_bad.line("Table 3: paper, tets with L/r > 200, % (printed 0.22)", "-", "-", true));
}

}  // namespace

void report_table3(const std::vector<CaseResults>& results, const std::filesystem::path& folder,
                   std::vector<Acceptance>& lines) {
  Table table("table3", "Table 3, without the peers: L/r of all tets, then of those at the walls; times in ms",
              {"case", "mesh", "tets", "min", "mean", "mean/original", "p99", "max", "% > 200", "dihedral min",
               "dihedral max", "wall mean", "wall max", "ms cut", "ms maintain", "volume change", "defects"});
  add_printed(table);
  for (const CaseResults& r : results) {
    if (r.of->is_in_table3) {
      add_case(r, table);
    }
  }
  table.print();
  table.write_csv(folder);
  accept(results, lines);
}

}  // namespace incise::bench
