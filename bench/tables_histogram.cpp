// SPDX-License-Identifier: Apache-2.0
#include "tables_histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "maintenance_figures.h"
#include "report.h"

namespace incise::bench {

namespace {

constexpr int kClassesToBad = 22;  // so that the first begins below 2√6
constexpr std::size_t kMeshes = 4;
const std::array<const char*, kMeshes> kNames = {"original", "no optimisation", "paper", "incise"};

/// Where a class begins.
double bound_of(int index) {
  return 200 * std::exp2(0.25 * (index - kClassesToBad));
}

/// The class of an L/r; flat tets go with the worst.
std::size_t class_of(double ratio, std::size_t classes) {
  std::size_t index = 0;
  while (index + 1 < classes && bound_of(static_cast<int>(index) + 1) < ratio) {
    ++index;
  }
  return index;
}

/// Enough classes for the worst tet that has a finite L/r.
std::size_t count_classes(const std::array<const MeshFigures*, kMeshes>& meshes) {
  double worst = 0;
  for (const MeshFigures* mesh : meshes) {
    worst = std::max(worst, mesh->all.lr_max);
  }
  return std::max<std::size_t>(class_of(worst, 200) + 1, kClassesToBad);
}

/// How many tets of each mesh fall into each class.
struct Histogram {
  std::vector<std::array<std::uint64_t, kMeshes>> counts;
  std::array<std::uint64_t, kMeshes> tets{};

  explicit Histogram(const CaseResults& r) {
    const std::array<const MeshFigures*, kMeshes> meshes = {&r.original, &r[Way::kPaperCut].mesh, &r[Way::kPaper].mesh,
                                                            &r[Way::kIncise].mesh};
    counts.resize(count_classes(meshes));
    for (std::size_t m = 0; m < kMeshes; ++m) {
      tets[m] = meshes[m]->ratios.size();
      for (const double ratio : meshes[m]->ratios) {
        ++counts[class_of(ratio, counts.size())][m];
      }
    }
  }
  [[nodiscard]] double share_pct(std::size_t index, std::size_t mesh) const {
    return 100 * static_cast<double>(counts[index][mesh]) / static_cast<double>(std::max<std::uint64_t>(tets[mesh], 1));
  }
};

/// How far the shares of a mesh are from the original's: the share of tets, in %, that would have to change their
/// class.
double distance_pct(const Histogram& histogram, std::size_t mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    sum += std::abs(histogram.share_pct(i, mesh) - histogram.share_pct(i, 0));
  }
  return sum / 2;
}

void add_distances(const std::string& of, const Histogram& histogram, Table& table) {
  const double cut = distance_pct(histogram, 1), paper = distance_pct(histogram, 2),
               incise = distance_pct(histogram, 3);
  table.add({of, fmt::format("{:.1f}", cut), fmt::format("{:.1f}", paper), fmt::format("{:.1f}", incise),
             fmt::format("{:.2f}", cut > 0 ? paper / cut : 0), fmt::format("{:.2f}", cut > 0 ? incise / cut : 0)});
}

std::string bound_text(std::size_t index) {
  return fmt::format("{:.4g}", bound_of(static_cast<int>(index)));
}

void add_rows(const std::string& of, const Histogram& histogram, Table& table) {
  for (std::size_t m = 0; m < kMeshes; ++m) {
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
      table.add({of, kNames[m], bound_text(i), bound_text(i + 1), std::to_string(histogram.counts[i][m]),
                 figure(histogram.share_pct(i, m))});
    }
  }
}

void print(const std::string& of, const Histogram& histogram) {
  Table table("", "Figure 15: share of tets by L/r, in %, " + of,
              {"L/r above", "up to", kNames[0], kNames[1], kNames[2], kNames[3]});
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    std::vector<std::string> cells = {bound_text(i), bound_text(i + 1)};
    for (std::size_t m = 0; m < kMeshes; ++m) {
      cells.push_back(histogram.counts[i][m] == 0 ? "." : fmt::format("{:.2f}", histogram.share_pct(i, m)));
    }
    table.add(std::move(cells));
  }
  table.print();
}

}  // namespace

void report_figure15(const std::vector<CaseResults>& results, const std::filesystem::path& folder) {
  Table rows("figure15", "", {"case", "mesh", "L/r above", "up to", "tets", "share %"});
  Table distances(
      "figure15_distance",
      "Figure 15: share of tets, in %, that would have to change their class for the original's distribution; "
      "the paper: \"considerably closer\" than without optimisation",
      {"case", kNames[1], kNames[2], kNames[3], "paper over none", "incise over none"});
  bool is_first = true;
  for (const CaseResults& r : results) {
    if (r.of->is_in_table3) {
      const Histogram histogram(r);
      add_rows(r.of->name, histogram, rows);
      add_distances(r.of->name, histogram, distances);
      if (is_first) {
        print(r.of->name, histogram);
      }
      is_first = false;
    }
  }
  rows.write_csv(folder);
  distances.print();
  distances.write_csv(folder);
}

}  // namespace incise::bench
