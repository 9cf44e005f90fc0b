// SPDX-License-Identifier: Apache-2.0
// How much a cut makes the mesh grow, what that does to its quality, and how well the walls follow the blade: with
// snapping as it is by default and without, summed over meshes and positions of the blade.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "accuracy.h"
#include "blades.h"
#include "incise/engine/engine.h"
#include "incise/geom/predicates.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/shapes.h"
#include "report.h"

namespace incise::bench {

namespace {

struct NamedMesh {
  std::string name;
  TetMesh mesh;
};

/// Curved cuts are judged where mean edge × curvature is at most this: a coarser mesh cannot follow the blade.
constexpr double kResolved = 0.3;

/// One cut of one mesh.
struct Outcome {
  bool is_ok = false;
  CutStatistics cut;
  QualityStats quality;
  std::size_t pieces = 0;
  std::uint64_t inverted = 0;
  double drift = 0;
  double cpu_ms = 0;
  Accuracy accuracy;  ///< the worst over the strokes
};

std::uint64_t count_inverted(const TetMesh& mesh) {
  std::uint64_t count = 0;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    count += orient3d(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])) <= 0 ? 1U : 0U;
  });
  return count - std::min<std::uint64_t>(count, mesh.flat_at_load().size());
}

Outcome run_cut(const TetMesh& mesh, const Body& body, const CutCase& cut, double snap) {
  Outcome out;
  EngineOptions options;
  options.cut.snap = snap;
  options.maintain.merge = options.maintain.improve = false;  // cutting alone is measured
  Result<Engine> engine = Engine::create(mesh, options);
  if (!engine) {
    return out;
  }
  std::vector<std::uint32_t> numbers;
  const double start = thread_ms();
  for (const Stroke& stroke : cut.strokes) {
    const Result<StrokeReport> report = engine->cut(stroke);
    if (!report) {
      std::fprintf(stderr, "%s: %s\n", cut.name.c_str(), report.error().message.c_str());
      return out;
    }
    out.cut += report->cut;
    numbers.push_back(report->stroke);
  }
  out.cpu_ms = thread_ms() - start;
  const TetMesh& result = engine->mesh();
  out.quality = measure_quality(result);
  out.pieces = find_components(result).count();
  out.inverted = count_inverted(result);
  out.drift = std::abs(total_volume(result) - body.volume()) / body.volume();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Accuracy one = measure_accuracy(result, body, cut.strokes[i], numbers[i]);
    out.accuracy.hausdorff = std::max(out.accuracy.hausdorff, one.hausdorff);
    out.accuracy.mean = std::max(out.accuracy.mean, one.mean);
    out.accuracy.area_error = std::max(out.accuracy.area_error, one.area_error);
  }
  out.is_ok = true;
  return out;
}

/// All cuts of one kind with one snapping distance.
struct Tally {
  std::uint64_t runs = 0, pieces_right = 0, new_tets = 0, cut_tets = 0, inverted = 0, snapped = 0, bent = 0, crumbs = 0;
  double lr_mean_sum = 0, lr_max = 0, over_200_sum = 0, drift = 0, cpu_ms = 0;
  double hausdorff = 0, hausdorff_sum = 0, mean = 0, mean_sum = 0, area_error = 0, area_error_sum = 0;
  double hausdorff_unbent = 0;  ///< where every snapped vertex could be moved onto the sweep

  void add(const Outcome& o, std::size_t expected_pieces) {
    ++runs;
    pieces_right += o.pieces == expected_pieces ? 1U : 0U;
    new_tets += static_cast<std::uint64_t>(o.cut.created_tets);
    cut_tets += o.cut.cut_tets;
    inverted += o.inverted;
    snapped += o.cut.snapped_vertices;
    bent += o.cut.bent_vertices;
    crumbs += o.cut.crumbs_kept;
    lr_mean_sum += o.quality.lr_mean;
    lr_max = std::max(lr_max, o.quality.lr_max);
    over_200_sum += o.quality.lr_over_200_pct;
    drift = std::max(drift, o.drift);
    cpu_ms += o.cpu_ms;
    hausdorff = std::max(hausdorff, o.accuracy.hausdorff);
    hausdorff_sum += o.accuracy.hausdorff;
    mean = std::max(mean, o.accuracy.mean);
    mean_sum += o.accuracy.mean;
    area_error = std::max(area_error, o.accuracy.area_error);
    area_error_sum += o.accuracy.area_error;
    if (o.cut.bent_vertices == 0) {
      hausdorff_unbent = std::max(hausdorff_unbent, o.accuracy.hausdorff);
    }
  }
  [[nodiscard]] double per_run(double sum) const { return runs == 0 ? 0.0 : sum / static_cast<double>(runs); }
};

struct KindOfCut {
  std::string name;
  bool is_planar = false, is_accepted = false;
  Tally without, with;  ///< snapping
  Tally resolved;       ///< of `with`, where the mesh can follow the blade: h times curvature is small enough

  [[nodiscard]] double saved_pct() const {
    return without.new_tets == 0
               ? 0.0
               : 100.0 * (1.0 - static_cast<double>(with.new_tets) / static_cast<double>(without.new_tets));
  }
};

std::string number(double value, int digits = 2) {
  return fmt::format("{:.{}f}", value, digits);
}
/// Small or large figures alike.
std::string figure(double value) {
  return value != 0 && (value < 1e-3 || value >= 1e5) ? fmt::format("{:.1e}", value) : fmt::format("{:.4g}", value);
}

/// The pieces that a cut must give. Where the body is no box: counted independently for a plane, else what the exact
/// cut without snapping gave.
std::size_t expected_pieces(const NamedMesh& body, bool is_box, const CutCase& cut, const Outcome& exact) {
  if (is_box) {
    return cut.pieces_of_cube;
  }
  if (cut.is_planar() && cut.strokes.size() == 1) {
    const SweptTriangles plane = swept_triangles(cut.strokes.front());
    const auto& [a, b, c] = plane.triangles.front();
    const Vec3 normal = (plane.points[b] - plane.points[a]).cross(plane.points[c] - plane.points[a]);
    return count_pieces_of_plane(body.mesh, normal, normal.dot(plane.points[a]));
  }
  return exact.pieces;
}

void add_run(Table& runs, const NamedMesh& body, const CutCase& cut, double snap, const Outcome& o,
             std::size_t expected) {
  runs.add({body.name,
            std::to_string(body.mesh.tet_count()),
            cut.name,
            number(snap, 1),
            std::to_string(o.cut.cut_tets),
            std::to_string(o.cut.created_tets),
            std::to_string(expected),
            std::to_string(o.pieces),
            figure(o.quality.lr_mean),
            figure(o.quality.lr_max),
            figure(o.quality.lr_over_200_pct),
            std::to_string(o.inverted),
            figure(o.drift),
            figure(o.accuracy.hausdorff),
            figure(o.accuracy.mean),
            figure(o.accuracy.area_error),
            std::to_string(o.cut.snapped_vertices),
            std::to_string(o.cut.bent_vertices),
            std::to_string(o.cut.crumbs_kept),
            figure(o.cpu_ms)});
}

/// The cuts to make with a body; `is_wanted` may leave some out.
using CutFilter = bool (*)(const CutCase&);
bool is_any(const CutCase&) {
  return true;
}
bool is_one_curved_stroke(const CutCase& cut) {
  return !cut.is_planar() && cut.strokes.size() == 1;
}

std::vector<KindOfCut> run_study(const std::vector<NamedMesh>& bodies, bool is_box, Table& runs,
                                 CutFilter is_wanted = is_any) {
  std::vector<KindOfCut> kinds;
  for (const NamedMesh& named : bodies) {
    const Body body(named.mesh);
    for (const CutCase& cut : make_cuts(rest_bounds(named.mesh))) {
      if (!is_wanted(cut)) {
        continue;
      }
      if (std::none_of(kinds.begin(), kinds.end(), [&](const KindOfCut& k) { return k.name == cut.name; })) {
        kinds.push_back({cut.name, cut.is_planar(), cut.is_accepted, {}, {}, {}});
      }
      KindOfCut& kind =
          *std::find_if(kinds.begin(), kinds.end(), [&](const KindOfCut& k) { return k.name == cut.name; });
      const Outcome exact = run_cut(named.mesh, body, cut, 0.0);
      const Outcome snapped = run_cut(named.mesh, body, cut, CutOptions{}.snap);
      if (!exact.is_ok || !snapped.is_ok) {
        continue;
      }
      const std::size_t expected = expected_pieces(named, is_box, cut, exact);
      kind.without.add(exact, expected);
      kind.with.add(snapped, expected);
      if (cut.curvature * body.mean_edge() <= kResolved) {
        kind.resolved.add(snapped, expected);
      }
      add_run(runs, named, cut, 0.0, exact, expected);
      add_run(runs, named, cut, CutOptions{}.snap, snapped, expected);
    }
    std::fprintf(stderr, "%s done\n", named.name.c_str());
  }
  return kinds;
}

void print_growth(const std::vector<KindOfCut>& kinds, const std::string& name, const std::string& what,
                  const std::filesystem::path& folder) {
  Table table("growth_" + name, "Growth: " + what,
              {"cut", "snap", "runs", "new tets", "saved %", "new/cut tet", "L/r mean", "L/r max", "% > 200",
               "inverted", "pieces right", "drift", "µs/cut tet"});
  for (const KindOfCut& kind : kinds) {
    for (const bool is_snapped : {false, true}) {
      const Tally& t = is_snapped ? kind.with : kind.without;
      const double cut_tets = static_cast<double>(std::max<std::uint64_t>(t.cut_tets, 1));
      table.add({kind.name, is_snapped ? number(CutOptions{}.snap, 1) : "0", std::to_string(t.runs),
                 std::to_string(t.new_tets), is_snapped ? number(kind.saved_pct(), 1) : "",
                 number(static_cast<double>(t.new_tets) / cut_tets), figure(t.per_run(t.lr_mean_sum)), figure(t.lr_max),
                 figure(t.per_run(t.over_200_sum)), std::to_string(t.inverted),
                 fmt::format("{}/{}", t.pieces_right, t.runs), figure(t.drift), number(1e3 * t.cpu_ms / cut_tets)});
    }
  }
  table.print();
  table.write_csv(folder);
}

void print_accuracy(const std::vector<KindOfCut>& kinds, const std::string& name, const std::string& what,
                    const std::filesystem::path& folder) {
  Table table("accuracy_" + name,
              "Accuracy: " + what + ". Two-sided Hausdorff and mean distance in mean edge lengths h, area error in %",
              {"cut", "snap", "Hausdorff/h max", "avg", "mean/h max", "avg", "area error max", "avg", "snapped", "bent",
               "crumbs kept", "Hausdorff/h where none bent"});
  for (const KindOfCut& kind : kinds) {
    for (const bool is_snapped : {false, true}) {
      const Tally& t = is_snapped ? kind.with : kind.without;
      table.add({kind.name, is_snapped ? number(CutOptions{}.snap, 1) : "0", figure(t.hausdorff),
                 figure(t.per_run(t.hausdorff_sum)), figure(t.mean), figure(t.per_run(t.mean_sum)),
                 figure(100 * t.area_error), figure(100 * t.per_run(t.area_error_sum)), std::to_string(t.snapped),
                 std::to_string(t.bent), std::to_string(t.crumbs), figure(t.hausdorff_unbent)});
    }
  }
  table.print();
  table.write_csv(folder);
}

/// Figures of accuracy for curved strokes, as far as the mesh can follow them.
void accept_curved(const std::string& what, const std::vector<const KindOfCut*>& kinds, std::vector<Acceptance>& out) {
  double mean = 0, hausdorff = 0, area = 0;
  std::uint64_t runs = 0;
  for (const KindOfCut* kind : kinds) {
    runs += kind->resolved.runs;
    mean = std::max(mean, kind->resolved.mean);
    hausdorff = std::max(hausdorff, kind->resolved.hausdorff);
    area = std::max(area, 100 * kind->resolved.area_error);
  }
  const std::string where = fmt::format("{} ({} runs with h·curvature ≤ {}), worst", what, runs, kResolved);
  out.push_back({where + ": mean distance/h", "≤ 0.01", "-", figure(mean), mean <= 0.01});
  out.push_back({where + ": Hausdorff/h", "≤ 0.25", "-", figure(hausdorff), hausdorff <= 0.25});
  out.push_back({where + ": area error, %", "≤ 1", "-", figure(area), area <= 1.0});
}

std::vector<Acceptance> accept(const std::vector<KindOfCut>& kinds, const std::vector<KindOfCut>& fine) {
  std::uint64_t with = 0, without = 0, runs = 0, right = 0, right_exact = 0, inverted = 0;
  double least = 100, plane = 0, drift = 0;
  std::string least_name;
  std::vector<const KindOfCut*> single, crossing;
  for (const KindOfCut& kind : fine) {
    single.push_back(&kind);
  }
  for (const KindOfCut& kind : kinds) {
    runs += kind.with.runs;
    right += kind.with.pieces_right;
    right_exact += kind.without.pieces_right;
    inverted += kind.with.inverted + kind.without.inverted;
    drift = std::max({drift, kind.with.drift, kind.without.drift});
    if (kind.is_accepted) {
      with += kind.with.new_tets;
      without += kind.without.new_tets;
      if (kind.saved_pct() < least) {
        least = kind.saved_pct();
        least_name = kind.name;
      }
    }
    if (kind.is_planar) {
      plane = std::max(plane, kind.with.hausdorff_unbent);
    } else {
      (kind.is_accepted ? single : crossing).push_back(&kind);
    }
  }
  const double saved = without == 0 ? 0.0 : 100.0 * (1.0 - static_cast<double>(with) / static_cast<double>(without));
  std::vector<Acceptance> out = {
      {"new tets saved by snapping: oblique, curved, coring, cross summed, %", "≥ 60", "-", number(saved, 1),
       saved >= 60},
      {"new tets saved by snapping: least of the four (" + least_name + "), %", "≥ 45", "-", number(least, 1),
       least >= 45},
      {"planes: Hausdorff/h where every move was legal", "≤ 1e-12", "0", figure(plane), plane <= 1e-12}};
  accept_curved("curved sheet, coring", single, out);
  accept_curved("crossing curved sheets", crossing, out);
  out.push_back(
      {"pieces right without snapping", "all", "-", fmt::format("{}/{}", right_exact, runs), right_exact == runs});
  out.push_back({"pieces right with snapping", "all", "-", fmt::format("{}/{}", right, runs), right == runs});
  out.push_back({"volume drift, worst run", "≤ 1e-12", "-", figure(drift), drift <= 1e-12});
  out.push_back({"tets not positive after a cut", "0", "0", std::to_string(inverted), inverted == 0});
  return out;
}

std::vector<NamedMesh> box_meshes() {
  std::vector<NamedMesh> meshes;
  const auto add = [&](std::string name, TetSoup soup) {
    Result<TetMesh> mesh = TetMesh::build(std::move(soup));
    if (mesh) {
      meshes.push_back({std::move(name), std::move(*mesh)});
    }
  };
  add("Kuhn 5", kuhn_cube(5));
  add("Kuhn 10", kuhn_cube(10));
  TetSoup jittered = kuhn_cube(8);
  jitter(jittered, 0.15, 7);
  add("jittered Kuhn 8", std::move(jittered));
  return meshes;
}

/// A file's mesh, where it is sound enough for the figures to mean something; says on stderr why not.
void load(const std::string& file, std::vector<NamedMesh>& meshes) {
  Result<io::LoadedMesh> loaded = io::load_mesh(file);
  if (!loaded) {
    std::fprintf(stderr, "left out: %s\n", loaded.error().message.c_str());
  } else if (!loaded->mesh.flat_at_load().empty() || loaded->mesh.touched_itself_at_load()) {
    std::fprintf(stderr, "left out: %s has flat tets or touches itself\n", file.c_str());
  } else {
    meshes.push_back({std::filesystem::path(file).stem().string(), std::move(loaded->mesh)});
  }
}

constexpr const char* kUsage =
    "usage: bench_cut_growth [--out FOLDER] [--box MESH]... [MESH]...\n"
    "Cuts Kuhn cubes, the box-shaped meshes named after --box, and other bodies, with and without snapping.\n";

int run(int argc, char** argv) {
  std::filesystem::path folder = "bench-results";
  std::vector<NamedMesh> boxes = box_meshes(), bodies;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--out" && i + 1 < argc) {
      folder = argv[++i];
    } else if (argument == "--box" && i + 1 < argc) {
      load(argv[++i], boxes);
    } else if (argument.rfind('-', 0) == 0) {
      const bool is_help = argument == "-h" || argument == "--help";
      std::fputs(kUsage, is_help ? stdout : stderr);
      return is_help ? 0 : 2;
    } else {
      load(argument, bodies);
    }
  }
  Table runs("growth_runs", "",
             {"mesh",   "tets",       "cut",     "snap",    "cut tets",    "new tets", "expected pieces",
              "pieces", "L/r mean",   "L/r max", "% > 200", "inverted",    "drift",    "Hausdorff/h",
              "mean/h", "area error", "snapped", "bent",    "crumbs kept", "ms"});
  const std::vector<KindOfCut> of_boxes = run_study(boxes, true, runs);
  std::string names;
  for (const NamedMesh& mesh : boxes) {
    names += fmt::format("{}{} ({} tets)", names.empty() ? "" : ", ", mesh.name, mesh.mesh.tet_count());
  }
  const std::string cubes = fmt::format("cubes {}; {} positions of the blade each", names, kVariants);
  print_growth(of_boxes, "cubes", cubes, folder);
  print_accuracy(of_boxes, "cubes", "the same cubes", folder);
  std::vector<NamedMesh> fine_meshes;
  if (Result<TetMesh> mesh = TetMesh::build(kuhn_cube(16)); mesh.ok()) {
    fine_meshes.push_back({"Kuhn 16", std::move(*mesh)});
  }
  const std::vector<KindOfCut> fine = run_study(fine_meshes, true, runs, is_one_curved_stroke);
  print_accuracy(fine, "fine", "Kuhn 16 (24576 tets), fine enough for the curvature", folder);
  if (!bodies.empty()) {
    const std::vector<KindOfCut> of_bodies = run_study(bodies, false, runs);
    names.clear();
    for (const NamedMesh& mesh : bodies) {
      names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", mesh.name, mesh.mesh.tet_count());
    }
    print_growth(of_bodies, "bodies", names, folder);
    print_accuracy(of_bodies, "bodies", "the same bodies", folder);
  }
  runs.write_csv(folder);
  report_acceptance("cut_growth", accept(of_boxes, fine), folder);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
