// SPDX-License-Identifier: Apache-2.0
// Maintenance along a series: of times within one stroke, and of strokes in one mesh.
#include "maintenance_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>

#include "maintenance_measure.h"

namespace incise::bench {

namespace {

/// The times at which a size of cube is looked at, in ms, and what must be reached.
struct AnytimeDemand {
  std::uint32_t cells;
  std::vector<double> times;
  std::size_t must_at, goal_at;  // indices of `times`
  double bound;                  // of L/r
};
const std::vector<AnytimeDemand> kAnytime = {{5, {0.5, 1, 2, 4}, 2, 1, 20}, {12, {2, 5, 10, 20}, 2, 1, 25}};

struct AnytimeTally {
  Worst must, goal;
};

void run_anytime(const Settings& settings, const Cube& cube, const AnytimeDemand& demand, double snap, Table& table,
                 AnytimeTally& tally) {
  EngineOptions options = settings.engine;
  options.cut.snap = snap;
  for (const char letter : {'A', 'B', 'C'}) {
    const Trial trial = make_trial(cube, letter);
    const std::string name = "anytime/" + cube.name + "/" + trial.name + (snap == 0 ? "/snap0" : "");
    const Result<TetMesh> mesh = TetMesh::build(trial.soup);
    if (!settings.wants(name) || !mesh) {
      continue;
    }
    const std::vector<double> worst = measure_anytime(*mesh, trial.stroke, options, demand.times, 5);
    for (std::size_t i = 0; i < worst.size(); ++i) {
      table.add({name, figure(snap), figure(demand.times[i]), figure(worst[i])});
    }
    tally.must.note(worst[demand.must_at], name);
    tally.goal.note(worst[demand.goal_at], name);
    std::printf("%-40s L/r max after %4g %4g %4g %4g ms: %8.4g %8.4g %8.4g %8.4g\n", name.c_str(), demand.times[0],
                demand.times[1], demand.times[2], demand.times[3], worst[0], worst[1], worst[2], worst[3]);
    std::fflush(stdout);
  }
}

void accept_anytime(const AnytimeDemand& demand, const AnytimeTally& tally, std::vector<Acceptance>& lines) {
  if (!tally.must.has_value()) {
    return;
  }
  const std::uint32_t tets = 6 * demand.cells * demand.cells * demand.cells;
  const double must_ms = demand.times[demand.must_at], goal_ms = demand.times[demand.goal_at];
  const std::string goal = fmt::format("< {} after {} ms: {}", demand.bound, goal_ms, figure(tally.goal.value()));
  lines.push_back(tally.must.line(fmt::format("anytime: worst L/r of {} tets after {} ms", tets, must_ms),
                                  fmt::format("< {}", demand.bound), goal, tally.must.value() < demand.bound));
}

/// Many strokes in one mesh.
struct Series {
  std::string name, what;
  std::uint32_t cells;
  std::function<Stroke(Noise&)> next_stroke;
  bool is_relative_to_first = false;  ///< growth counts from the mesh after the first stroke
  double must, goal;                  ///< of growth
};

constexpr unsigned kRepeats = 50;

std::vector<Series> make_series() {
  const auto again = [](Noise& noise) { return shaken_plane(noise, 0.1 / 12); };
  const auto patch = [](Noise& noise) { return random_patch(noise, 1.0 / 3); };
  return {{"repeat/i", "one path cut 50 times: tets over those after one cut", 12, again, true, 1.5, 1.2},
          {"repeat/ii", "50 patches in 48000 tets: growth", 20, patch, false, 1.6, 1.3},
          {"repeat/iii", "50 patches in 3072 tets: growth", 8, patch, false, 25, 12}};
}

struct SeriesTally {
  Worst bad_pct, lr_max;
  std::size_t cuts = 0, valid = 0, reference_tets = 0, tets = 0;
  double ms = 0;
};

/// One stroke of a series; false where it fails.
bool run_stroke(const Series& series, unsigned index, Engine& engine, const Stroke& stroke, const ValidityReport& input,
                Table& table, SeriesTally& tally) {
  const std::size_t first_step = engine.journal().position();
  const double start = thread_ms();
  const Result<StrokeReport> report = engine.cut(stroke);
  const double ms = thread_ms() - start;
  if (!report) {
    std::fprintf(stderr, "%s: cut %u failed: %s\n", series.name.c_str(), index, report.error().message.c_str());
    return false;
  }
  const TetMesh& mesh = engine.mesh();
  const QualityStats q = Touched(mesh, engine.journal(), first_step).quality(mesh);
  const std::string defects = new_defects(input, mesh);
  table.add({series.name, std::to_string(index), std::to_string(mesh.tet_count()), std::to_string(report->cut.cut_tets),
             figure(q.lr_max), figure(q.lr_mean), figure(q.lr_over_200_pct), figure(q.dihedral_min_deg),
             figure(q.dihedral_max_deg), figure(ms), defects.empty() ? "yes" : defects});
  const std::string where = series.name + ", cut " + std::to_string(index);
  tally.bad_pct.note(q.lr_over_200_pct, where);
  tally.lr_max.note(q.lr_max, where);
  tally.tets = mesh.tet_count();
  tally.ms += ms;
  ++tally.cuts;
  tally.valid += defects.empty() ? 1U : 0U;
  return true;
}

SeriesTally run_series(const Series& series, const EngineOptions& options, Table& table) {
  SeriesTally tally;
  Result<TetMesh> mesh = TetMesh::build(make_cube(series.cells, 1).soup);
  const ValidityReport input = validate(*mesh, ValidateLevel::kGeometry);
  tally.reference_tets = mesh->tet_count();
  Result<Engine> engine = Engine::create(std::move(*mesh), options);
  Noise noise(series.cells);
  for (unsigned i = 1; i <= kRepeats; ++i) {
    if (!run_stroke(series, i, *engine, series.next_stroke(noise), input, table, tally)) {
      break;
    }
    if (i == 1 && series.is_relative_to_first) {
      tally.reference_tets = tally.tets;
    }
  }
  return tally;
}

void accept_series(const Series& series, const SeriesTally& tally, std::vector<Acceptance>& lines) {
  const double growth = static_cast<double>(tally.tets) / static_cast<double>(tally.reference_tets);
  lines.push_back({series.name + ": " + series.what, "≤ " + figure(series.must), "≤ " + figure(series.goal),
                   figure(growth), growth <= series.must && tally.cuts == kRepeats});
  lines.push_back(tally.bad_pct.at_most(series.name + ": touched tets with L/r > 200 after any cut, %", 0, "0"));
  lines.push_back({series.name + ": cuts after which the mesh is valid", "all", "all",
                   fmt::format("{}/{}", tally.valid, kRepeats), tally.valid == kRepeats});
  std::printf("%-12s %s: %.3f (%zu > %zu tets), worst L/r %.4g, valid after %zu of %u, %.0f ms\n", series.name.c_str(),
              series.what.c_str(), growth, tally.reference_tets, tally.tets, tally.lr_max.value(), tally.valid,
              kRepeats, tally.ms);
  std::fflush(stdout);
}

}  // namespace

void study_anytime(const Settings& settings, const std::vector<Cube>& cubes, std::vector<Acceptance>& lines) {
  Table table("maintenance_anytime", "", {"case", "snap", "ms", "L/r max"});
  for (const AnytimeDemand& demand : kAnytime) {
    AnytimeTally tally, stress;
    for (const Cube& cube : cubes) {
      if (cube.cells == demand.cells) {
        run_anytime(settings, cube, demand, settings.engine.cut.snap, table, tally);
        if (settings.engine.cut.profile != Profile::kPaper) {
          run_anytime(settings, cube, demand, 0, table, stress);
        }
      }
    }
    accept_anytime(demand, tally, lines);
  }
  table.write_csv(settings.folder);
}

void study_repeated(const Settings& settings, std::vector<Acceptance>& lines) {
  Table table("maintenance_repeated", "",
              {"series", "cut", "tets", "cut tets", "L/r max", "L/r mean", "% > 200", "dihedral min", "dihedral max",
               "ms", "valid"});
  for (const Series& series : make_series()) {
    if (settings.wants(series.name) && !settings.is_quick) {
      accept_series(series, run_series(series, settings.engine, table), lines);
    }
  }
  table.write_csv(settings.folder);
}

}  // namespace incise::bench
