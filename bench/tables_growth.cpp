// SPDX-License-Identifier: Apache-2.0
#include "tables_growth.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "maintenance_figures.h"

namespace incise::bench {

namespace {

std::string count(std::uint64_t value) {
  return std::to_string(value);
}
std::string fixed(double value, int digits) {
  return fmt::format("{:.{}f}", value, digits);
}
std::string signed_pct(double ratio) {
  return fmt::format("{:+.2f}", 100 * (ratio - 1));
}

/// A printed growth as a count of tets for our model, which may have a few tets more or fewer than the paper's.
std::uint64_t scaled(double growth, const CaseResults& r) {
  return static_cast<std::uint64_t>(std::lround(growth * static_cast<double>(r.original.all.tets)));
}

void add_tets(const CaseResults& r, Table& table) {
  const PrintedRow& printed = *r.of->printed;
  table.add({r.of->name, count(printed.tets), count(r.original.all.tets), count(printed.unmerged),
             count(scaled(printed.growth(), r)), count(r[Way::kPaperCut].tets()),
             signed_pct(r.growth(Way::kPaperCut) / printed.growth()), count(r[Way::kInciseCut].tets()),
             count(printed.merged), count(scaled(printed.merged_growth(), r)), count(r[Way::kPaperMerged].tets()),
             signed_pct(r.growth(Way::kPaperMerged) / printed.merged_growth()), count(r[Way::kInciseMerged].tets()),
             count(r[Way::kPaper].tets()), count(r[Way::kIncise].tets())});
}

void print_tets(const std::vector<CaseResults>& results, const std::filesystem::path& folder) {
  Table table("table2_tets",
              "Table 2, tets. 'scaled': the printed growth times the tets of our model; % is how far our profile paper "
              "is from that",
              {"model", "printed before", "ours", "printed unmerged", "scaled", "paper", "%", "incise",
               "printed merged", "scaled", "paper", "%", "incise", "all: paper", "incise"});
  for (const CaseResults& r : results) {
    if (r.of->printed) {
      add_tets(r, table);
    }
  }
  table.print();
  table.write_csv(folder);
}

void add_times(const CaseResults& r, Way way, Table& table) {
  const PrintedRow& printed = *r.of->printed;
  const CutResult& cut = r[way];
  const StageTimes& ms = cut.stages;
  const double collision = ms[Stage::kCollision], modifying = ms.total() - collision;
  table.add({r.of->name,
             way == Way::kPaper ? "paper" : "incise",
             count(cut.cut.cut_tets),
             fixed(ms[Stage::kCollision], 2),
             fixed(ms[Stage::kSubdivide], 2),
             fixed(ms[Stage::kSeparate], 2),
             fixed(ms[Stage::kMerge], 2),
             fixed(ms[Stage::kImprove], 2),
             "-",
             "-",
             fixed(cut.total_ms(), 2),
             fixed(100 * collision / ms.total(), 1),
             fixed(100 * modifying / ms.total(), 1),
             fixed(100 * collision / (ms.total() - ms[Stage::kImprove]), 1),
             fixed(printed.collision_share(), 1),
             fixed(100 - printed.collision_share(), 1),
             fixed(printed.collision_pct, 1),
             fixed(printed.modifying_pct, 1),
             fixed(printed.relaxation_pct, 1),
             fixed(printed.rendering_pct, 1),
             fixed(1e3 / cut.total_ms(), 1),
             fixed(printed.fps, 1)});
}

void print_times(const std::vector<CaseResults>& results, const std::filesystem::path& folder) {
  Table table(
      "table2_times",
      "Table 2, times in ms of the whole cut with all maintenance (GM = subdivide + separate + merge + improve), "
      "and shares in %",
      {"model",
       "profile",
       "cut tets",
       "CD",
       "subdivide",
       "separate",
       "merge",
       "improve",
       "RX",
       "RD",
       "whole",
       "CD %",
       "GM %",
       "CD % up to merging",
       "printed of both: CD",
       "GM",
       "printed: CD",
       "GM",
       "RX",
       "RD",
       "cuts/s",
       "printed fps"});
  for (const CaseResults& r : results) {
    if (r.of->printed) {
      add_times(r, Way::kPaper, table);
      add_times(r, Way::kIncise, table);
    }
  }
  table.print();
  table.write_csv(folder);
  std::printf(
      "RX (relaxation) and RD (rendering) are not built. Cuts per second and the printed frames per second are not the "
      "same\nthing yet: a frame of the paper's program relaxes, draws and advances the blade by one step; ours makes a "
      "whole cut,\nof many steps, and its maintenance, which the paper has after the cut.\n");
}

void accept(const std::vector<CaseResults>& results, std::vector<Acceptance>& lines) {
  Worst deviation, merged, grown;
  for (const CaseResults& r : results) {
    if (r.of->printed) {
      const PrintedRow& printed = *r.of->printed;
      deviation.note(100 * std::abs(r.growth(Way::kPaperCut) / printed.growth() - 1), r.of->name);
      merged.note(100 * std::abs(r.growth(Way::kPaperMerged) / printed.merged_growth() - 1), r.of->name);
      grown.note(r.growth(Way::kIncise) / printed.merged_growth(), r.of->name);
    }
  }
  if (deviation.has_value()) {
    lines.push_back(deviation.at_most("Table 2: profile paper, unmerged tets off the printed growth, %", 2, "0"));
    lines.push_back(merged.line("Table 2: profile paper, merged tets off the printed growth, %", "-", "-", true));
    lines.push_back(grown.at_most("Table 2: profile incise, tets in the end over the printed merged growth", 1, "-"));
  }
}

}  // namespace

void report_rule(const std::vector<CaseResults>& results, const std::filesystem::path& folder) {
  Table table(
      "table2_rule",
      "Table 2, the plane across the longest side of the body's box through its middle: tets added, by tet that the "
      "blade cut, and the share of them that merging leaves",
      {"model", "before", "cut tets", "paper: added", "by cut tet", "merged", "left %", "with all", "incise: added",
       "by cut tet", "with all", "printed: added", "merged", "left %"});
  for (const CaseResults& r : results) {
    const PrintedRow& printed = *r.of->printed;
    const double before = static_cast<double>(r.original.all.tets);
    const auto added = [&](Way way) { return static_cast<double>(r[way].tets()) - before; };
    const double cut_tets = static_cast<double>(r[Way::kPaperCut].cut.cut_tets);
    const double printed_added = static_cast<double>(printed.unmerged) - static_cast<double>(printed.tets);
    const double printed_merged = static_cast<double>(printed.merged) - static_cast<double>(printed.tets);
    table.add({r.of->name, count(r.original.all.tets), fixed(cut_tets, 0), fixed(added(Way::kPaperCut), 0),
               fixed(added(Way::kPaperCut) / cut_tets, 2), fixed(added(Way::kPaperMerged), 0),
               fixed(100 * added(Way::kPaperMerged) / added(Way::kPaperCut), 0), fixed(added(Way::kPaper), 0),
               fixed(added(Way::kInciseCut), 0), fixed(added(Way::kInciseCut) / cut_tets, 2),
               fixed(added(Way::kIncise), 0), fixed(printed_added, 0), fixed(printed_merged, 0),
               fixed(100 * printed_merged / printed_added, 0)});
  }
  table.print();
  table.write_csv(folder);
}

void report_table2(const std::vector<CaseResults>& results, const std::filesystem::path& folder,
                   std::vector<Acceptance>& lines) {
  print_tets(results, folder);
  print_times(results, folder);
  accept(results, lines);
}

}  // namespace incise::bench
