// SPDX-License-Identifier: Apache-2.0
// Frames per second: the whole pipeline but drawing, in the five scenes of the paper's Table 2, in a liver of 100k tets
// at 60 Hz, and in boxes of growing size.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "app/scene/scene_simulation.h"
#include "frames_large.h"
#include "frames_run.h"

namespace incise::bench {

namespace {

/// Frames per second, and shares of their time in %, as printed in Table 2.
struct Printed {
  double fps, relax, collision, draw, modify;
};

struct PaperScene {
  const char* name;
  const char* file;
  Printed printed;
  double must, goal;  // frames per second
};

constexpr std::array<PaperScene, 5> kScenes = {{
    {"CUBE straight", "sim_cube", {152.3, 8.6, 52.8, 30.3, 8.3}, 1000, 3000},
    {"CUBE complex", "sim_cube_complex", {91.1, 8.5, 59.6, 22.5, 9.4}, 700, 2000},
    {"MEAT", "sim_meat", {66.5, 8.1, 34.1, 18.9, 38.9}, 700, 2000},
    {"SPINE", "sim_spine", {20.2, 10.8, 36.8, 9.0, 43.4}, 250, 700},
    {"BUNNY", "sim_bunny", {13.1, 9.6, 40.1, 7.3, 43.0}, 200, 500},
}};

struct Settings {
  std::filesystem::path folder = "bench-results", root = ".";
  std::string only;
  unsigned repeats = 7;
  bool is_quick = false;
};

double fps_of(const SceneRun& run, Which which) {
  const double ms = mean(times_of(run, Clock::kCpu, which));
  return ms > 0 ? 1e3 / ms : 0;
}

struct Tables {
  Table frames{"frames",
               "Table 2, frames per second: the whole frame but drawing, processor time of one thread, frames with a "
               "blade. fps: 1 / mean, median of the runs; least: frame by frame the best of the runs; maintained: the "
               "frames of maintenance after each stroke too. p50, p99 and max in ms, medians of the runs; p99.9 of the "
               "frames of all runs",
               {"scene", "profile", "tets", "after", "frames", "of them cut", "awake", "fps", "least", "maintained",
                "p50", "p99", "p99.9", "max", "printed fps", "without drawing", "times faster", "must", "goal"}};
  Table stages{"frames_stages",
               "Table 2, mean ms of a frame with a blade. CD: collision, with what resists; RLX: the solver; GM: "
               "subdividing, separating, merging and improving; follow: the solver's stars, masses and momenta, by the "
               "paper's division part of GM; rest: what no stage claims, above all the journal; shares in %",
               {"scene", "profile", "CD", "RLX", "GM", "follow", "rest", "whole", "CD %", "RLX %", "GM + follow %",
                "printed CD %", "RLX %", "GM %", "without drawing CD %", "RLX %", "GM %"}};
};

const char* name_of(Profile profile) {
  return profile == Profile::kPaper ? "paper" : "incise";
}

void add_frames(const PaperScene& scene, Profile profile, const std::vector<SceneRun>& runs, double fps, Table& table) {
  const auto quantile_of = [&](double share) {
    return number(median_of(runs, [&](const SceneRun& run) { return quantile(times_of(run, Clock::kCpu), share); }), 3);
  };
  const SceneRun& run = runs.front();
  std::size_t frames = 0, cutting = 0;
  std::vector<double> awake;
  for (const FrameTime& frame : run.frames) {
    frames += frame.has_blade ? 1 : 0;
    cutting += frame.has_blade && frame.cut_tets > 0 ? 1 : 0;
    if (frame.has_blade) {
      awake.push_back(static_cast<double>(frame.awake));
    }
  }
  const Printed& printed = scene.printed;
  const double drawn = printed.relax + printed.collision + printed.draw + printed.modify;
  const double undrawn = printed.fps * drawn / (drawn - printed.draw);
  table.add({scene.name, name_of(profile), std::to_string(run.tets_before), std::to_string(run.tets_after),
             std::to_string(frames), std::to_string(cutting), number(median(awake), 0), number(fps, 0),
             number(1e3 / mean(least_of(runs, Clock::kCpu)), 0),
             number(median_of(runs, [](const SceneRun& one) { return fps_of(one, Which::kBladeAndMaintenance); }), 0),
             quantile_of(0.5), quantile_of(0.99), number(quantile(pooled(runs, Clock::kCpu), 0.999), 3), quantile_of(1),
             number(printed.fps, 1), number(undrawn, 1), number(fps / undrawn, 1), number(scene.must, 0),
             number(scene.goal, 0)});
}

void add_stages(const PaperScene& scene, Profile profile, const std::vector<SceneRun>& runs, Table& table) {
  const auto ms = [&](double Shares::*part) {
    return median_of(runs, [&](const SceneRun& run) { return shares_of(run).*part; });
  };
  const double collision = ms(&Shares::collision), relax = ms(&Shares::relax), modify = ms(&Shares::modify),
               follow = ms(&Shares::follow), rest = ms(&Shares::rest), whole = ms(&Shares::whole);
  const Printed& printed = scene.printed;
  const double undrawn = printed.relax + printed.collision + printed.modify;
  const auto share = [](double part, double of) { return number(of > 0 ? 100 * part / of : 0, 1); };
  table.add({scene.name, name_of(profile), number(collision, 3), number(relax, 3), number(modify, 3), number(follow, 3),
             number(rest, 3), number(whole, 3), share(collision, whole), share(relax, whole),
             share(modify + follow, whole), number(printed.collision), number(printed.relax), number(printed.modify),
             share(printed.collision, undrawn), share(printed.relax, undrawn), share(printed.modify, undrawn)});
}

/// Says where two runs did not do the same.
bool is_same(const PaperScene& scene, const std::vector<SceneRun>& runs) {
  for (const SceneRun& run : runs) {
    if (run.hash != runs.front().hash) {
      std::fprintf(stderr, "%s: two runs differ\n", scene.name);
      return false;
    }
  }
  return true;
}

void measure(const PaperScene& paper, Profile profile, const Settings& settings, Tables& tables,
             std::vector<Acceptance>& lines) {
  Result<app::Scene> scene = app::read_scene(settings.root / "scenes" / (std::string(paper.file) + ".json"));
  const Result<io::LoadedMesh> loaded = scene.ok() ? app::take_model(*scene) : Result<io::LoadedMesh>(scene.error());
  if (!loaded) {
    std::fprintf(stderr, "%s is left out: %s\n", paper.name, loaded.error().message.c_str());
    return;
  }
  scene->options.engine.cut.profile = profile;
  std::vector<SceneRun> runs;
  for (unsigned i = 0; i < settings.repeats; ++i) {
    runs.push_back(run_scene(*scene, loaded->mesh, 1));
  }
  if (times_of(runs.front(), Clock::kCpu).empty() || !is_same(paper, runs)) {
    return;
  }
  const double fps = median_of(runs, [](const SceneRun& run) { return fps_of(run, Which::kBlade); });
  const bool is_paper = profile == Profile::kPaper;
  const double must = is_paper ? paper.printed.fps : paper.must;
  add_frames(paper, profile, runs, fps, tables.frames);
  add_stages(paper, profile, runs, tables.stages);
  write_frames(runs, fmt::format("{}{}", paper.file, is_paper ? "_paper" : ""), settings.folder);
  lines.push_back({fmt::format("{}, profile {}, frames per second but drawing, one core", paper.name, name_of(profile)),
                   fmt::format("≥ {:.0f}", must), is_paper ? "-" : fmt::format("≥ {:.0f}", paper.goal), number(fps, 0),
                   fps >= must});
}

void report(const Settings& settings) {
  Tables tables;
  std::vector<Acceptance> lines;
  const auto wants = [&](const std::string& name) { return settings.only.empty() || settings.only == name; };
  for (const PaperScene& scene : kScenes) {
    if (wants(scene.file)) {
      for (const Profile profile : {Profile::kPaper, Profile::kIncise})
        measure(scene, profile, settings, tables, lines);
    }
  }
  if (!lines.empty()) {
    for (const Table* table : {&tables.frames, &tables.stages}) {
      table->print();
      table->write_csv(settings.folder);
    }
  }
  if (wants("liver")) {
    report_liver(settings.root, settings.folder, settings.is_quick ? 2 : 3, lines);
  }
  if (wants("growth")) {
    report_growth(settings.folder, settings.is_quick, lines);
  }
  report_acceptance("frames", lines, settings.folder);
}

constexpr const char* kUsage =
    "usage: bench_frames [--out FOLDER] [--root FOLDER] [--quick] [--repeats N] [--only NAME]\n"
    "Measures the frames of the scenes in ROOT/scenes while the blade cuts.\n"
    "  --root FOLDER  where models/ and scenes/ are; the folder at hand by default\n"
    "  --quick        fewer runs, no box of a million tets\n"
    "  --repeats N    runs of each of the paper's scenes; 7 by default\n"
    "  --only NAME    one of sim_cube, sim_cube_complex, sim_meat, sim_spine, sim_bunny, liver, growth\n";

bool parse(int argc, char** argv, Settings& settings) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      settings.is_quick = true;
      settings.repeats = 3;
    } else if (argument == "--out" && i + 1 < argc) {
      settings.folder = argv[++i];
    } else if (argument == "--root" && i + 1 < argc) {
      settings.root = argv[++i];
    } else if (argument == "--only" && i + 1 < argc) {
      settings.only = argv[++i];
    } else if (argument == "--repeats" && i + 1 < argc) {
      settings.repeats = static_cast<unsigned>(std::max(1, std::atoi(argv[++i])));
    } else {
      return false;
    }
  }
  return true;
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
