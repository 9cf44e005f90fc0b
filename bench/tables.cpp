// SPDX-License-Identifier: Apache-2.0
// The paper's Tables 2 and 3 and the distribution of its Figure 15, as printed, beside what both profiles give. The
// peers of Table 3 are programs of their own: this one writes the meshes for them.
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include "report.h"
#include "tables_growth.h"
#include "tables_histogram.h"
#include "tables_quality.h"
#include "tables_spread.h"

namespace incise::bench {

namespace {

struct Settings {
  std::filesystem::path folder = "bench-results", root = ".";
  bool is_quick = false;
};

constexpr const char* kUsage =
    "usage: bench_tables [--out FOLDER] [--root FOLDER] [--quick]\n"
    "Prints the paper's Tables 2 and 3 beside ours, and writes them as CSV.\n"
    "  --root FOLDER  where models/ and scenes/ are; the folder at hand by default\n"
    "  --quick        fewer runs\n"
    "To OUT/table3_meshes go ID_original.mesh and ID_cut.mesh, the paper's cut without maintenance, for the peers.\n";

bool parse(int argc, char** argv, Settings& settings) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      settings.is_quick = true;
    } else if (argument == "--out" && i + 1 < argc) {
      settings.folder = argv[++i];
    } else if (argument == "--root" && i + 1 < argc) {
      settings.root = argv[++i];
    } else {
      return false;
    }
  }
  return true;
}

unsigned runs_of(const TableCase& of, const Settings& settings) {
  return settings.is_quick ? 3 : of.mesh.tet_count() > 2000 ? 7 : 15;
}

std::vector<CaseResults> run_cases(const std::vector<TableCase>& cases, const Settings& settings) {
  const std::filesystem::path meshes = settings.folder / "table3_meshes";
  std::error_code error;
  std::filesystem::create_directories(meshes, error);
  std::vector<CaseResults> results;
  for (const TableCase& one : cases) {
    results.push_back(run_case(one, runs_of(one, settings), one.is_in_table3 ? meshes : ""));
  }
  return results;
}

void report(const Settings& settings) {
  const std::vector<TableCase> cases = make_table_cases(settings.root);
  const std::vector<CaseResults> results = run_cases(cases, settings);
  std::vector<Acceptance> lines;
  report_table2(results, settings.folder, lines);
  const std::vector<TableCase> by_rule = make_rule_cases(settings.root);
  report_rule(run_cases(by_rule, settings), settings.folder);
  report_table3(results, settings.folder, lines);
  report_spread(settings.is_quick ? 5 : 20, settings.folder);
  report_figure15(results, settings.folder);
  report_acceptance("tables", lines, settings.folder);
}

int run(int argc, char** argv) {
  if (argc == 2 && (std::string(argv[1]) == "-h" || std::string(argv[1]) == "--help")) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  Settings settings;
  if (!parse(argc, argv, settings)) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  report(settings);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
