// SPDX-License-Identifier: Apache-2.0
// What maintenance makes of a mesh after cuts: quality around the incision, growth, time, volume and fidelity, on cubes
// with hard positions of the blade and on bodies with random strokes; quality against time; and cuts that repeat.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "incise/io/mesh_loader.h"
#include "maintenance_cases.h"
#include "maintenance_figures.h"
#include "maintenance_measure.h"
#include "maintenance_series.h"
#include "report.h"

namespace incise::bench {

namespace {

/// The worst figures over the cases of a kind.
struct Tally {
  std::size_t cases = 0, invalid = 0;
  Worst bad_pct, above_input, mean_ratio, lr_max, lr_over_bound, us, curved_us, new_per_cut, growth, growth_750,
      exact_volume, curved_volume, wall;
  Worst dihedral_min{true}, dihedral_max, dihedral_lost, dihedral_gained;

  void add(const std::string& name, const Measurement& m, bool is_cube, bool is_planar) {
    ++cases;
    invalid += m.is_valid() ? 0U : 1U;
    add_quality(name, m, is_cube);
    add_cost(name, m, is_planar);
    const bool is_exact = is_cube && is_planar && m.cut_work.bent_vertices == 0;
    (is_exact ? exact_volume : curved_volume).note(m.volume_change(), name);
    wall.note(m.wall_added, name);
  }

 private:
  void add_quality(const std::string& name, const Measurement& m, bool is_cube) {
    const QualityStats& q = m.after.touched;
    bad_pct.note(q.lr_over_200_pct, name);
    above_input.note(static_cast<double>(m.above_input), name);
    mean_ratio.note(m.after.all.lr_mean / m.input.lr_mean, name);
    lr_max.note(q.lr_max, name);
    lr_over_bound.note(q.lr_max / m.lr_bound(is_cube), name);
    dihedral_min.note(q.dihedral_min_deg, name);
    dihedral_max.note(q.dihedral_max_deg, name);
    dihedral_lost.note(std::min(10.0, m.neighbourhood.dihedral_min_deg) - q.dihedral_min_deg, name);
    dihedral_gained.note(q.dihedral_max_deg - std::max(160.0, m.neighbourhood.dihedral_max_deg), name);
  }
  void add_cost(const std::string& name, const Measurement& m, bool is_planar) {
    growth.note(m.growth(), name);
    if (m.input_tets == 750) {
      growth_750.note(m.growth(), name);
    }
    if (m.cut_work.cut_tets > 0) {
      (is_planar ? us : curved_us).note(m.us_per_cut_tet(m.cut_ms + m.maintain_ms), name);
      new_per_cut.note(m.new_per_cut_tet(), name);
    }
  }
};

const std::vector<std::string> kColumns = {"case",
                                           "planar",
                                           "snap",
                                           "tets",
                                           "cut",
                                           "after",
                                           "growth",
                                           "cut tets",
                                           "new/cut tet",
                                           "mean ratio",
                                           "L/r mean in",
                                           "L/r max in",
                                           "L/r mean",
                                           "L/r max",
                                           "touched min",
                                           "touched mean",
                                           "touched p99",
                                           "touched max",
                                           "touched %>200",
                                           "dihedral min",
                                           "dihedral max",
                                           "cut max",
                                           "cut %>200",
                                           "near mean in",
                                           "near max in",
                                           "near dih min in",
                                           "near dih max in",
                                           "above",
                                           "µs cut",
                                           "µs maintain",
                                           "pieces",
                                           "volume change",
                                           "bent",
                                           "wall added max",
                                           "wall added mean",
                                           "wall after",
                                           "collapses",
                                           "moves",
                                           "edges removed",
                                           "faces removed",
                                           "inserted",
                                           "work units",
                                           "valid"};

std::vector<std::string> cells_of(const std::string& name, bool is_planar, double snap, const Measurement& m) {
  const QualityStats &q = m.after.touched, &near = m.neighbourhood;
  const auto count = [](auto value) { return std::to_string(value); };
  return {name,
          is_planar ? "yes" : "no",
          figure(snap),
          count(m.input_tets),
          count(m.cut.tets),
          count(m.after.tets),
          figure(m.growth()),
          count(m.cut_work.cut_tets),
          figure(m.new_per_cut_tet()),
          figure(m.after.all.lr_mean / m.input.lr_mean),
          figure(m.input.lr_mean),
          figure(m.input.lr_max),
          figure(m.after.all.lr_mean),
          figure(m.after.all.lr_max),
          figure(q.lr_min),
          figure(q.lr_mean),
          figure(q.lr_p99),
          figure(q.lr_max),
          figure(q.lr_over_200_pct),
          figure(q.dihedral_min_deg),
          figure(q.dihedral_max_deg),
          figure(m.cut.touched.lr_max),
          figure(m.cut.touched.lr_over_200_pct),
          figure(near.lr_mean),
          figure(near.lr_max),
          figure(near.dihedral_min_deg),
          figure(near.dihedral_max_deg),
          count(m.above_input),
          figure(m.us_per_cut_tet(m.cut_ms)),
          figure(m.us_per_cut_tet(m.maintain_ms)),
          count(m.after.volumes.size()),
          figure(m.volume_change()),
          count(m.cut_work.bent_vertices),
          figure(m.wall_added),
          figure(m.mean_wall_added()),
          figure(m.after.wall.greatest),
          count(m.maintain_work.collapsed_edges),
          count(m.maintain_work.moved_vertices),
          count(m.maintain_work.removed_edges),
          count(m.maintain_work.removed_faces),
          count(m.maintain_work.inserted_vertices),
          count(m.maintain_work.work_units),
          m.is_valid() ? "yes" : m.defects};
}

void print_head() {
  std::printf("\n%-34s %21s %6s %6s %6s | %7s %7s %6s %13s | %8s | %6s %8s | %8s %8s %s\n", "case",
              "tets in > cut > after", "growth", "new/ct", "mean", "touched", "max", "%>200", "dihedral", "near max",
              "µs cut", "maintain", "volume", "wall", "valid");
}

void print_case(const std::string& name, const Measurement& m) {
  const QualityStats& q = m.after.touched;
  std::printf(
      "%-34s %6zu > %6zu > %6zu %5.2f %6.2f %6.3f | %7.2f %7.4g %6.2g %5.1f - %5.1f | %8.4g | %6.2f %8.2f | "
      "%8.1e %8.1e %s\n",
      name.c_str(), m.input_tets, m.cut.tets, m.after.tets, m.growth(), m.new_per_cut_tet(),
      m.after.all.lr_mean / m.input.lr_mean, q.lr_mean, q.lr_max, q.lr_over_200_pct, q.dihedral_min_deg,
      q.dihedral_max_deg, m.neighbourhood.lr_max, m.us_per_cut_tet(m.cut_ms), m.us_per_cut_tet(m.maintain_ms),
      m.volume_change(), m.wall_added, m.is_valid() ? "yes" : m.defects.c_str());
  std::fflush(stdout);
}

/// One case: measured, printed, counted.
void run_case(const Settings& settings, const std::string& name, const TetMesh& mesh, const Stroke& stroke,
              const EngineOptions& engine, unsigned runs, bool is_cube, bool is_planar, Tally& tally, Table& table) {
  if (!settings.wants(name)) {
    return;
  }
  const Measurement m = measure_maintenance(mesh, stroke, engine, runs);
  if (!m.is_ok) {
    std::printf("%-34s failed\n", name.c_str());
    ++tally.invalid;
    return;
  }
  print_case(name, m);
  table.add(cells_of(name, is_planar, engine.cut.snap, m));
  tally.add(name, m, is_cube, is_planar);
}

struct Study {
  Tally cubes, stress, bodies;
  Table table{"maintenance_cases", "Maintenance, case by case", kColumns};
};

void run_cube(const Settings& settings, const Cube& cube, Study& study) {
  const unsigned runs = settings.is_quick ? 3 : cube.soup.tets.size() > 2000 ? 5 : 15;
  for (const char letter : cuts_of(cube)) {
    const Trial trial = make_trial(cube, letter);
    const Result<TetMesh> mesh = TetMesh::build(trial.soup);
    if (!mesh) {
      std::fprintf(stderr, "%s/%s: %s\n", cube.name.c_str(), trial.name.c_str(), mesh.error().message.c_str());
      continue;
    }
    const std::string name = cube.name + "/" + trial.name;
    EngineOptions exact = settings.engine;
    exact.cut.snap = 0;
    run_case(settings, name, *mesh, trial.stroke, settings.engine, runs, true, trial.is_planar, study.cubes,
             study.table);
    if (settings.engine.cut.profile == Profile::kPaper) {
      continue;  // it never snaps
    }
    run_case(settings, name + "/snap0", *mesh, trial.stroke, exact, 1, true, trial.is_planar, study.stress,
             study.table);
  }
}

Result<io::LoadedMesh> load(const std::string& file) {
  Result<io::LoadedMesh> loaded = io::load_mesh(file);
  if (!loaded) {
    std::fprintf(stderr, "left out: %s\n", loaded.error().message.c_str());
  }
  return loaded;
}

std::vector<Cube> make_cubes(const Settings& settings) {
  std::vector<Cube> cubes;
  const std::uint64_t seeds = settings.is_quick ? 1 : 3;
  for (const std::uint32_t n : {5U, 12U}) {
    for (std::uint64_t seed = 0; seed <= seeds && (n == 5 || !settings.is_quick); ++seed) {
      cubes.push_back(make_cube(n, seed));
    }
  }
  for (const std::string& file : settings.boxes) {
    if (const Result<io::LoadedMesh> box = load(file); box.ok()) {
      cubes.push_back(make_cube(std::filesystem::path(file).stem().string(), box->mesh));
    }
  }
  return cubes;
}

using Lines = std::vector<Acceptance>;

void accept_cube_quality(const std::string& of, const Tally& t, Lines& out) {
  out.push_back(t.lr_max.at_most(of + "worst L/r of touched tets", 25, "≤ 15"));
  out.push_back(t.dihedral_min.at_least(of + "least dihedral angle, degrees", 10, "≥ 20"));
  out.push_back(t.dihedral_max.at_most(of + "greatest dihedral angle, degrees", 160, "≤ 147"));
}

/// Of bodies no more is asked than that the surroundings were before.
void accept_body_quality(const std::string& of, const Tally& t, Lines& out) {
  out.push_back(t.lr_over_bound.at_most(of + "worst L/r of touched tets over max(25, worst near before)", 1, "-"));
  out.push_back(t.lr_max.line(of + "worst L/r of touched tets", "-", "≤ 15", true));
  out.push_back(t.dihedral_lost.at_most(of + "least dihedral below min(10, least near before), degrees", 0, "-"));
  out.push_back(
      t.dihedral_gained.at_most(of + "greatest dihedral above max(160, greatest near before), degrees", 0, "-"));
}

void accept_quality(const std::string& of, const Tally& t, bool is_cube, Lines& out) {
  out.push_back(
      {of + "cases that are valid", "all", "all", fmt::format("{}/{}", t.cases - t.invalid, t.cases), t.invalid == 0});
  out.push_back(t.bad_pct.at_most(of + "touched tets with L/r > 200, %", 0, "0"));
  out.push_back(t.above_input.line(of + "touched tets with L/r > max(25, worst of the input)", "-", "0", true));
  out.push_back(t.mean_ratio.at_most(of + "mean L/r after over uncut", 1.05, "≤ 1"));
  (is_cube ? accept_cube_quality : accept_body_quality)(of, t, out);
}

void accept_cost(const std::string& of, const Tally& t, Lines& out) {
  const auto add = [&](const Worst& worst, const char* what, double must, const char* goal) {
    if (worst.has_value()) {
      out.push_back(worst.at_most(of + what, must, goal));
    }
  };
  add(t.growth_750, "growth of the cube of 750 tets", 1.4, "≤ 1.18");
  add(t.new_per_cut, "new tets per cut tet", 1.2, "≤ 0.6");
  add(t.us, "planes: cut and maintenance, µs per cut tet", 25, "≤ 8");
  add(t.curved_us, "others: cut and maintenance, µs per cut tet", 25, "≤ 8");
}

void accept_fidelity(const std::string& of, const Tally& t, Lines& out) {
  if (t.exact_volume.has_value()) {
    out.push_back(t.exact_volume.at_most(of + "change of a piece's volume, planes without bends", 1e-9, "-"));
  }
  if (t.curved_volume.has_value()) {
    out.push_back(t.curved_volume.at_most(of + "change of a piece's volume, others", 5e-4, "≤ 1e-5"));
  }
  out.push_back(t.wall.at_most(of + "distance of the walls from the sweep added, local edges", 0.02, "-"));
}

void accept_tally(const std::string& kind, const Tally& t, bool is_cube, Lines& out) {
  if (t.cases == 0) {
    return;
  }
  accept_quality(kind + ": ", t, is_cube, out);
  accept_cost(kind + ": ", t, out);
  accept_fidelity(kind + ": ", t, out);
}

constexpr const char* kUsage =
    "usage: bench_maintenance [--out FOLDER] [--quick] [--bare] [--only TEXT] [--profile incise|paper] [--box MESH]... "
    "[MESH]...\n"
    "Cuts and maintains Kuhn cubes, the box-shaped meshes named after --box, and other bodies.\n"
    "  --quick      the cubes of 750 tets with one seed, fewer runs, no repeated cuts\n"
    "  --bare       without any maintenance: what cutting alone gives\n"
    "  --only TEXT  cases whose names contain TEXT, for instance kuhn5/seed1/A\n";

/// Takes one option with its value; false where it is unknown.
bool take_option(const std::string& option, const std::string& value, Settings& settings) {
  if (option == "--out") {
    settings.folder = value;
  } else if (option == "--only") {
    settings.only = value;
  } else if (option == "--box") {
    settings.boxes.push_back(value);
  } else if (option == "--profile" && (value == "incise" || value == "paper")) {
    settings.engine.cut.profile = value == "paper" ? Profile::kPaper : Profile::kIncise;
  } else {
    return false;
  }
  return true;
}

bool parse(int argc, char** argv, Settings& settings) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      settings.is_quick = true;
    } else if (argument == "--bare") {
      settings.engine.maintain.merge = settings.engine.maintain.improve = false;
    } else if (argument.rfind("--", 0) != 0) {
      settings.bodies.push_back(argument);
    } else if (i + 1 >= argc || !take_option(argument, argv[++i], settings)) {
      return false;
    }
  }
  return true;
}

void run_body(const Settings& settings, const std::string& file, Study& study) {
  const Result<io::LoadedMesh> body = load(file);
  if (!body) {
    return;
  }
  const std::string name = std::filesystem::path(file).stem().string();
  for (const BodyStroke& stroke : make_body_strokes(body->mesh, body->mesh.tet_count())) {
    run_case(settings, name + "/" + stroke.name, body->mesh, stroke.stroke, settings.engine, 2, false, stroke.is_planar,
             study.bodies, study.table);
  }
}

/// Cases beyond what a release must reach.
void report_stress(const Tally& tally, const std::filesystem::path& folder) {
  Lines lines;
  accept_tally("cubes, snap 0", tally, true, lines);
  Table table("maintenance_stress", "Without snapping: a stress, no part of the acceptance",
              {"figure", "as above", "measured", "met"});
  for (const Acceptance& line : lines) {
    table.add({line.figure, line.must, line.measured, line.is_met ? "yes" : "no"});
  }
  table.print();
  table.write_csv(folder);
}

void run_studies(const Settings& settings) {
  Study study;
  Lines lines;
  const std::vector<Cube> cubes = make_cubes(settings);
  print_head();
  for (const Cube& cube : cubes) {
    run_cube(settings, cube, study);
  }
  for (const std::string& file : settings.bodies) {
    run_body(settings, file, study);
  }
  study.table.write_csv(settings.folder);
  accept_tally("cubes", study.cubes, true, lines);
  accept_tally("bodies", study.bodies, false, lines);
  study_anytime(settings, cubes, lines);
  study_repeated(settings, lines);
  report_stress(study.stress, settings.folder);
  report_acceptance("maintenance", lines, settings.folder);
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
  run_studies(settings);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
