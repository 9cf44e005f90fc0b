// SPDX-License-Identifier: Apache-2.0
// Large bodies: a liver of about 100k tets at 60 Hz, and what of a frame grows with the body.
#include "frames_large.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "app/scene/scene_simulation.h"
#include "frames_run.h"
#include "incise/mesh/shapes.h"

namespace incise::bench {

namespace {

constexpr double kFrameBudget = 1000.0 / 60;  // ms

// --- each tet in eight

class Refinement {
 public:
  explicit Refinement(const TetSoup& coarse) : coarse_(coarse) { fine_.points = coarse.points; }

  TetSoup run() {
    for (std::size_t t = 0; t < coarse_.tets.size(); ++t) {
      divide(coarse_.tets[t]);
      if (!coarse_.regions.empty()) {
        fine_.regions.insert(fine_.regions.end(), 8, coarse_.regions[t]);
      }
    }
    return std::move(fine_);
  }

 private:
  using Corners = std::array<std::uint32_t, 4>;

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] = middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine_.points.size()));
    if (is_new) {
      fine_.points.push_back(0.5 * (coarse_.points[a] + coarse_.points[b]));
    }
    return at->second;
  }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    Corners tet = {a, b, c, d};
    const auto& p = fine_.points;
    if ((p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]) < 0) {
      std::swap(tet[2], tet[3]);
    }
    fine_.tets.push_back(tet);
  }
  [[nodiscard]] double length2(std::uint32_t a, std::uint32_t b) const {
    return (fine_.points[a] - fine_.points[b]).squaredNorm();
  }

  /// Four tets at the corners; the octahedron between them falls into four around the shortest of its diagonals.
  void divide(const Corners& c) {
    const std::uint32_t m01 = middle(c[0], c[1]), m02 = middle(c[0], c[2]), m03 = middle(c[0], c[3]),
                        m12 = middle(c[1], c[2]), m13 = middle(c[1], c[3]), m23 = middle(c[2], c[3]);
    add(c[0], m01, m02, m03);
    add(c[1], m01, m12, m13);
    add(c[2], m02, m12, m23);
    add(c[3], m03, m13, m23);
    // A diagonal and the ring of four around it.
    struct Diagonal {
      std::uint32_t from, to;
      Corners ring;
    };
    const std::array<Diagonal, 3> diagonals = {
        {{m01, m23, {m02, m03, m13, m12}}, {m02, m13, {m01, m03, m23, m12}}, {m03, m12, {m01, m02, m23, m13}}}};
    const Diagonal& d = *std::min_element(
        diagonals.begin(), diagonals.end(),
        [&](const Diagonal& a, const Diagonal& b) { return length2(a.from, a.to) < length2(b.from, b.to); });
    for (unsigned i = 0; i < 4; ++i) {
      add(d.from, d.to, d.ring[i], d.ring[(i + 1) % 4]);
    }
  }

  const TetSoup& coarse_;
  TetSoup fine_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

Result<TetMesh> refine(const TetMesh& mesh) {
  TetSoup soup;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
    soup.points.push_back(mesh.rest(VertexId(v)));
  }
  mesh.for_each_tet([&](TetId t) {
    const TetVertices& v = mesh.vertices(t);
    soup.tets.push_back({v[0].value, v[1].value, v[2].value, v[3].value});
    soup.regions.push_back(mesh.region(t));
  });
  return TetMesh::build(Refinement(soup).run());
}

}  // namespace

// --- the liver

namespace {

/// The stages of the frames with a blade, in ms by the clock: medians.
std::vector<std::string> stage_cells(const std::vector<SceneRun>& runs) {
  const auto middle = [&](const auto& part) {
    return number(median_of(runs, [&](const SceneRun& run) {
      std::vector<double> values;
      for (const FrameTime& frame : run.frames) {
        if (frame.has_blade) {
          values.push_back(part(frame));
        }
      }
      return median(values);
    }));
  };
  const auto modify = [](const FrameTime& f) {
    return f.stages.total() - f.stages[Stage::kRelax] - f.stages[Stage::kCollision];
  };
  return {middle([](const FrameTime& f) { return f.stages[Stage::kCollision]; }),
          middle([](const FrameTime& f) { return f.stages[Stage::kRelax] - f.follow; }),
          middle([](const FrameTime& f) { return f.follow; }), middle(modify),
          middle([](const FrameTime& f) { return f.wall - f.stages.total(); })};
}

double most_awake(const SceneRun& run) {
  std::size_t most = 0;
  for (const FrameTime& frame : run.frames) {
    most = std::max(most, frame.awake);
  }
  return static_cast<double>(most);
}

struct LiverFigures {
  double p99 = 0, least_p99 = 0;
};

LiverFigures add_liver(const std::vector<SceneRun>& runs, unsigned threads, Table& table) {
  const auto wall = [&](double share) {
    return median_of(runs, [&](const SceneRun& run) { return quantile(times_of(run, Clock::kWall), share); });
  };
  const LiverFigures figures = {wall(0.99), quantile(least_of(runs, Clock::kWall), 0.99)};
  const SceneRun& run = runs.front();
  const double within = median_of(runs, [](const SceneRun& one) {
    const std::vector<double> times = times_of(one, Clock::kWall);
    const auto fit = std::count_if(times.begin(), times.end(), [](double ms) { return ms <= kFrameBudget; });
    return 100 * static_cast<double>(fit) / static_cast<double>(std::max<std::size_t>(times.size(), 1));
  });
  std::vector<std::string> row = {std::to_string(threads),
                                  std::to_string(run.tets_before),
                                  std::to_string(run.tets_after),
                                  number(most_awake(run), 0),
                                  std::to_string(times_of(run, Clock::kWall).size()),
                                  number(wall(0.5)),
                                  number(figures.p99),
                                  number(quantile(pooled(runs, Clock::kWall), 0.999)),
                                  number(quantile(least_of(runs, Clock::kWall), 0.5)),
                                  number(figures.least_p99),
                                  number(within, 1)};
  for (std::string& cell : stage_cells(runs)) {
    row.push_back(std::move(cell));
  }
  table.add(row);
  return figures;
}

}  // namespace

void report_liver(const std::filesystem::path& root, const std::filesystem::path& folder, unsigned repeats,
                  std::vector<Acceptance>& lines) {
  const Result<app::Scene> scene = app::read_scene(root / "scenes" / "sim_liver.json");
  const Result<io::LoadedMesh> loaded = scene.ok() ? app::load_model(*scene) : Result<io::LoadedMesh>(scene.error());
  const Result<TetMesh> mesh = loaded.ok() ? refine(loaded->mesh) : Result<TetMesh>(loaded.error());
  if (!mesh) {
    std::fprintf(stderr, "the liver is left out: %s\n", mesh.error().message.c_str());
    return;
  }
  Table table("frames_liver",
              "A liver of 100k tets, cut as sim_liver.json says, at 60 Hz: frames with a blade, in ms by the clock. "
              "least: frame by frame the best of the runs; % in time: within 16.7 ms; stages: medians; rest: what no "
              "stage claims",
              {"threads", "tets", "after", "awake at most", "frames", "p50", "p99", "p99.9", "least p50", "least p99",
               "% in time", "CD", "RLX", "follow", "GM", "rest"});
  for (const unsigned threads : {2U, 1U}) {
    std::vector<SceneRun> runs;
    for (unsigned i = 0; i < (threads == 2 ? repeats : std::min(repeats, 2U)); ++i) {
      runs.push_back(run_scene(*scene, *mesh, threads));
    }
    write_frames(runs, "liver_" + std::to_string(threads), folder);
    const LiverFigures figures = add_liver(runs, threads, table);
    if (threads == 2) {
      lines.push_back({"a liver of 100k tets, cut on two threads, p99 of the frame by the clock, ms", "≤ 16.7", "-",
                       number(figures.p99), figures.p99 <= 16.7});
    }
  }
  table.print();
  table.write_csv(folder);
}

// --- growth with the body

namespace {

constexpr unsigned kSleepFrames = 60, kCutFrames = 60;
constexpr double kCell = 0.005;  // m

struct BoxBody {
  std::array<std::uint32_t, 3> cells;
  bool has_tool = false;
};

/// At rest and held below; one far corner is off its place, so that the body counts as one that moved.
std::optional<Simulation> resting_box(const BoxBody& box) {
  Vec3 size;
  for (unsigned i = 0; i < 3; ++i) {
    size[i] = kCell * box.cells[i];
  }
  Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), size, box.cells));
  SimulationOptions options;
  options.body.gravity = Vec3::Zero();
  options.body.sleep_below = 1e-5;  // of an edge: single precision tells less apart in the largest box
  Result<Simulation> made = Simulation::create(std::move(*mesh), options);
  if (!made) {
    return std::nullopt;
  }
  made->mesh().for_each_vertex([&](VertexId v) {
    if (made->mesh().rest(v).z() == 0) {
      (void)made->body().hold(v, std::numeric_limits<double>::infinity());
    }
  });
  (void)made->body().move_hold(VertexId(0), 1e-6 * kCell * Vec3::Ones());
  return std::move(*made);
}

/// A blade of 5 cells that stands in the top of the box and goes along it by 0.15 of a cell per frame, off the grid.
FrameInput box_input(const BoxBody& box, unsigned frame) {
  const Vec3 top = kCell * Vec3(0.5 * box.cells[0], 0.5 * box.cells[1], box.cells[2]);
  const double way = frame < 10 ? 1.5 - 0.3 * frame : -1.5;  // comes down first
  const Vec3 along = kCell * 0.15 * std::max(0, static_cast<int>(frame) - 10) * Vec3(1, 0.07, 0);
  FrameInput input;
  const Vec3 base = top + along + kCell * Vec3(0.31, 0.17, way);
  input.blade = BladePose{{base + kCell * Vec3(0, -2.5, 0.11), base + kCell * Vec3(0.03, 2.5, 0)}, Vec3::Zero()};
  if (box.has_tool) {
    input.tools.emplace_back(PlaneTool{Vec3::UnitZ(), -kCell});
  }
  return input;
}

void add_growth(const BoxBody& box, const std::filesystem::path& folder, Table& table, std::vector<double>& p50) {
  std::optional<Simulation> simulation = resting_box(box);
  if (!simulation) {
    return;
  }
  std::vector<SceneRun> runs(1);
  SceneRun& run = runs.front();
  run.tets_before = simulation->mesh().tet_count();
  for (unsigned i = 0; i < kSleepFrames; ++i) {
    FrameInput idle = box_input(box, 0);
    idle.blade.reset();
    run.frames.push_back(time_frame(*simulation, idle));
  }
  const double asleep = run.frames.back().cpu;
  for (unsigned i = 0; i < kCutFrames; ++i) {
    run.frames.push_back(time_frame(*simulation, box_input(box, i)));
  }
  run.tets_after = simulation->mesh().tet_count();
  write_frames(runs, "box_" + std::to_string(run.tets_before) + (box.has_tool ? "_tool" : ""), folder);
  const std::vector<double> times = times_of(run, Clock::kCpu);
  if (!box.has_tool) {
    p50.push_back(median(times));
  }
  std::vector<std::string> row = {std::to_string(run.tets_before),
                                  std::to_string(simulation->mesh().vertex_count()),
                                  box.has_tool ? "plane" : "none",
                                  std::to_string(run.tets_after - run.tets_before),
                                  std::to_string(run.frames.back().awake),
                                  number(asleep, 3),
                                  number(times.front()),
                                  number(median(times), 3),
                                  number(quantile(times, 0.9), 3),
                                  number(quantile(times, 1), 3)};
  for (std::string& cell : stage_cells(runs)) {
    row.push_back(std::move(cell));
  }
  table.add(row);
}

}  // namespace

void report_growth(const std::filesystem::path& folder, bool is_quick, std::vector<Acceptance>& lines) {
  Table table("frames_growth",
              "The same local cut in boxes of the same cells that rest: ms of processor time per frame. idle: nothing "
              "awake, no blade; first: puts the blade in place; stages: medians by the clock",
              {"tets", "vertices", "tool", "tets grown", "awake", "idle", "first", "p50", "p90", "max", "CD", "RLX",
               "follow", "GM", "rest"});
  std::vector<BoxBody> boxes = {{{12, 12, 12}}, {{26, 26, 26}}, {{12, 12, 12}, true}, {{26, 26, 26}, true}};
  if (!is_quick) {
    boxes.push_back({{55, 55, 55}});
    boxes.push_back({{55, 55, 55}, true});
  }
  std::vector<double> p50;
  for (const BoxBody& box : boxes) {
    add_growth(box, folder, table, p50);
  }
  table.print();
  table.write_csv(folder);
  if (p50.size() > 1 && p50.front() > 0) {
    lines.push_back({"the same cut in the largest resting box over that in the smallest, p50 of the frame", "-", "-",
                     number(p50.back() / p50.front()), true});
  }
}

}  // namespace incise::bench
