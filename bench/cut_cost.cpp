// SPDX-License-Identifier: Apache-2.0
// What a whole-plane cut costs: time per cut tet by stage, beside VTK's clip of the same mesh in the same run. One
// process, one thread; medians of the thread's processor time over runs that alternate between the programs.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"
#include "report.h"
#ifdef INCISE_BENCH_VTK
#include "vtk_clip.h"
#endif

namespace incise::bench {

namespace {

struct Size {
  std::uint32_t cells;
  unsigned runs;
};

struct Plane {
  std::string name;
  Vec3 normal;
  double offset;
  double snap;
  bool beside_vtk;
};

/// The planes for a cube of n³ cells. Layers lie at multiples of 1/n.
std::vector<Plane> planes_for(std::uint32_t n) {
  const double mid_layer = (n / 2 + 0.5) / n, off_layer = (n / 2 + 0.37) / n;
  const Vec3 oblique(0.37, 0.53, 0.76);
  const double through_centre = oblique.dot(Vec3(0.503, 0.498, 0.501));
  return {{"oblique", oblique, through_centre, 0.2, true},
          {"oblique, snap 0", oblique, through_centre, 0.0, false},
          {"axis, off-layer", Vec3::UnitX(), off_layer, 0.2, true},
          {"axis, mid-layer", Vec3::UnitX(), mid_layer, 0.2, true}};
}

struct Measurement {
  std::uint64_t tets = 0, cut_tets = 0, created_tets = 0;
  double cold_ms = 0;      ///< the first run, memory untouched
  std::vector<double> ms;  ///< the others
  std::vector<double> undo_ms;
  std::vector<StageTimes> stages;  ///< of the others; wall time
  std::vector<double> wall_ms;
  std::vector<double> vtk_one_ms, vtk_both_ms;

  [[nodiscard]] double us_per_cut_tet(double milliseconds) const {
    return 1e3 * milliseconds / static_cast<double>(std::max<std::uint64_t>(cut_tets, 1));
  }
  /// The stage's part of the processor time: its share of each run's wall time.
  [[nodiscard]] double stage_us(Stage stage) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      values.push_back(stages[i][stage] / wall_ms[i] * ms[i]);
    }
    return us_per_cut_tet(median(values));
  }
};

template <class Work>
double time_ms(Work&& work) {
  const double start = thread_ms();
  work();
  return thread_ms() - start;
}

/// Cuts and takes the cut back, `runs` + 1 times; between the runs VTK clips.
template <class Between>
Measurement measure(const TetMesh& mesh, const Plane& plane, unsigned runs, Between&& between) {
  Measurement out;
  out.tets = mesh.tet_count();
  EngineOptions options;
  options.cut.snap = plane.snap;
  options.maintain.merge = options.maintain.improve = false;  // cutting alone is measured
  Result<Engine> engine = Engine::create(mesh, options);
  const Result<Stroke> stroke = plane_stroke(rest_bounds(mesh), plane.normal, plane.offset);
  if (!engine || !stroke) {
    return out;
  }
  for (unsigned run = 0; run <= runs; ++run) {
    std::optional<Result<StrokeReport>> report;
    const double ms = time_ms([&] { report.emplace(engine->cut(*stroke)); });
    if (!report->ok()) {
      std::fprintf(stderr, "the cut failed: %s\n", report->error().message.c_str());
      return out;
    }
    out.cut_tets = (*report)->cut.cut_tets;
    out.created_tets = static_cast<std::uint64_t>((*report)->cut.created_tets);
    if (run == 0) {
      out.cold_ms = ms;
    } else {
      out.ms.push_back(ms);
      out.stages.push_back((*report)->times);
      out.wall_ms.push_back((*report)->step_ms.front());
    }
    out.undo_ms.push_back(time_ms([&] { engine->undo(); }));
    if (run > 0) {
      between(out);
    }
  }
  return out;
}

std::string number(double value, int digits = 2) {
  return fmt::format("{:.{}f}", value, digits);
}

struct Worst {
  double us_per_cut_tet = 0;
  std::string where;
  double vtk_one = 1e300, vtk_both = 1e300;  ///< smallest ratios at the largest size
};

void add_row(Table& table, const Plane& plane, const Measurement& m) {
  const double total = m.us_per_cut_tet(median(m.ms));
  const double stages[] = {m.stage_us(Stage::kCollision), m.stage_us(Stage::kSubdivide), m.stage_us(Stage::kSeparate)};
  const double rest = std::max(0.0, total - stages[0] - stages[1] - stages[2]);
  const auto ratio = [&](const std::vector<double>& vtk) {
    return vtk.empty() ? std::string("-") : number(median(vtk) / median(m.ms)) + "×";
  };
  const auto milliseconds = [&](const std::vector<double>& vtk) {
    return vtk.empty() ? std::string("-") : number(median(vtk), 1);
  };
  table.add({std::to_string(m.tets), plane.name, std::to_string(m.cut_tets), std::to_string(m.created_tets),
             number(total), number(m.us_per_cut_tet(*std::min_element(m.ms.begin(), m.ms.end()))),
             number(m.us_per_cut_tet(median(m.wall_ms))), number(m.us_per_cut_tet(m.cold_ms)), number(stages[0]),
             number(stages[1]), number(stages[2]), number(rest), number(m.us_per_cut_tet(median(m.undo_ms))),
             number(median(m.ms), 1), milliseconds(m.vtk_one_ms), milliseconds(m.vtk_both_ms), ratio(m.vtk_one_ms),
             ratio(m.vtk_both_ms)});
}

void note_worst(Worst& worst, const Plane& plane, const Measurement& m, bool is_largest) {
  const double cost = m.us_per_cut_tet(median(m.ms));
  if (cost > worst.us_per_cut_tet) {
    worst.us_per_cut_tet = cost;
    worst.where = fmt::format("{}, {} tets", plane.name, m.tets);
  }
  if (is_largest && !m.vtk_one_ms.empty()) {
    worst.vtk_one = std::min(worst.vtk_one, median(m.vtk_one_ms) / median(m.ms));
    worst.vtk_both = std::min(worst.vtk_both, median(m.vtk_both_ms) / median(m.ms));
  }
}

Worst measure_time(const std::vector<Size>& sizes, const std::filesystem::path& folder) {
  Table table("cut_cost",
              "Whole-plane cut of Kuhn cubes, adjacency and journal kept. µs per cut tet: medians; times in ms; ratio: "
              "VTK's median over ours, for one output part and for both; time on a core of one's own, wall: as it was",
              {"tets", "plane", "cut tets", "new tets", "µs/cut", "least", "wall", "cold", "collide", "subdivide",
               "separate", "rest", "undo", "ms", "VTK one", "VTK both", "ratio one", "ratio both"});
  Worst worst;
  for (const Size& size : sizes) {
    TetSoup soup = kuhn_cube(size.cells);
#ifdef INCISE_BENCH_VTK
    VtkClip vtk(soup);
#endif
    const Result<TetMesh> mesh = TetMesh::build(std::move(soup));
    for (const Plane& plane : planes_for(size.cells)) {
      const Measurement m = measure(*mesh, plane, size.runs, [&]([[maybe_unused]] Measurement& out) {
#ifdef INCISE_BENCH_VTK
        if (plane.beside_vtk) {
          out.vtk_one_ms.push_back(vtk.run_ms(plane.normal, plane.offset, false));
          out.vtk_both_ms.push_back(vtk.run_ms(plane.normal, plane.offset, true));
        }
#endif
      });
      if (m.ms.empty()) {
        continue;
      }
      add_row(table, plane, m);
      note_worst(worst, plane, m, size.cells == sizes.back().cells);
    }
  }
  table.print();
  table.write_csv(folder);
  return worst;
}

std::vector<Acceptance> accept(const Worst& worst) {
  std::vector<Acceptance> lines;
  lines.push_back({"whole-plane cut, worst case (" + worst.where + "), µs per cut tet", "≤ 3", "≤ 1.5",
                   number(worst.us_per_cut_tet), worst.us_per_cut_tet <= 3.0});
  if (worst.vtk_one < 1e299) {
    lines.push_back({"VTK's time over ours at the largest size, one part made", "≥ 2", "≥ 3", number(worst.vtk_one),
                     worst.vtk_one >= 2.0});
    lines.push_back({"VTK's time over ours at the largest size, both parts made", "≥ 4", "-", number(worst.vtk_both),
                     worst.vtk_both >= 4.0});
  }
  return lines;
}

constexpr const char* kUsage =
    "usage: bench_cut_cost [--out FOLDER] [--quick]\n"
    "Times whole-plane cuts of Kuhn cubes of 48k, 384k and 3M tets; --quick leaves the 3M out.\n";

int run(int argc, char** argv) {
  std::filesystem::path folder = "bench-results";
  std::vector<Size> sizes = {{20, 21}, {40, 11}, {80, 7}};
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--out" && i + 1 < argc) {
      folder = argv[++i];
    } else if (argument == "--quick") {
      sizes.pop_back();
    } else {
      const bool is_help = argument == "-h" || argument == "--help";
      std::fputs(kUsage, is_help ? stdout : stderr);
      return is_help ? 0 : 2;
    }
  }
#ifdef INCISE_BENCH_VTK
  std::printf("peer: VTK %s, vtkTableBasedClipDataSet, one thread\n", VtkClip::version().c_str());
#else
  std::printf("peer: none (built without VTK)\n");
#endif
  report_acceptance("cut_cost", accept(measure_time(sizes, folder)), folder);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
