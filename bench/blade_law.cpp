// SPDX-License-Identifier: Apache-2.0
// The law of the progressive cut: the same blade, 24 elements wide, in the same steps through bodies of 10k to 10M
// tets. One process, one thread, processor time of the thread; the peers take their turns in the same run.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "count_new.h"
#include "floor_kernel.h"
#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/shapes.h"
#include "report.h"
#include "tet_box_tree.h"
#ifdef INCISE_BENCH_VTK
#include "vtk_clip.h"
#endif

namespace incise::bench {

namespace {

/// A body of unit cells, six tets each. The blade is as long as the least of them is wide, and stays clear of its
/// sides.
struct Body {
  std::string name;
  std::array<std::uint32_t, 3> cells;  ///< along the stroke, along the blade, across the cut
};

const std::vector<Body> kBodies = {
    {"10k", {20, 28, 3}}, {"100k", {25, 28, 25}}, {"1M", {55, 55, 55}}, {"10M", {119, 119, 119}}};

/// How the blade moves, and how the engine cuts.
struct Motion {
  std::string name;
  double step;        ///< in elements
  double snap;        ///< see `CutOptions::snap`
  unsigned segments;  ///< of the blade's edge; more than one: it is bent a little
  unsigned strokes;   ///< how many, each from another place
};

const std::vector<Motion> kMotions = {{"1 element, snap 0.2", 1.0, 0.2, 1, 16},
                                      {"1/4 element, snap 0.2", 0.25, 0.2, 1, 5},
                                      {"1 element, snap 0", 1.0, 0.0, 1, 16},
                                      {"1/4 element, snap 0", 0.25, 0.0, 1, 5},
                                      {"1 element, snap 0.2, 24 segments", 1.0, 0.2, 24, 16}};

constexpr double kBladeWidth = 24.0;
/// How many elements inside the body a stroke ends, at all sizes; a long one goes through to just before the far side.
constexpr double kStrokeDepth = 17.5;
/// The blade starts outside, and is this deep after its first step.
constexpr double kTouchDepth = 0.6;
/// So many steps after the first touch are not yet steady: the blade is not wholly inside.
constexpr std::size_t kWarmUpSteps = 1;
/// Strokes after which nothing should be allocated any more.
constexpr std::size_t kWarmUpStrokes = 2;

/// Where one stroke goes: the blade lies along `edge` and moves along `way`, a few degrees off the grid.
struct Course {
  Vec3 centre, edge, way;

  [[nodiscard]] Vec3 normal() const { return way.cross(edge).normalized(); }
  [[nodiscard]] BladePose pose_at(double depth, unsigned segments) const {
    BladePose pose;
    for (unsigned i = 0; i <= segments; ++i) {
      const double along = 2.0 * i / segments - 1.0;
      const double sag = segments > 1 ? 0.4 * (1.0 - along * along) : 0.0;
      pose.edge.push_back(centre + depth * way + 0.5 * kBladeWidth * along * edge + sag * way);
    }
    return pose;
  }
};

/// Repeatable numbers in [-1, 1].
class Numbers {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) / 4503599627370496.0 - 1.0;
  }

 private:
  std::uint64_t state_ = 0x2545F4914F6CDD1DULL;
};

/// The courses of one motion: the same angles for every body, at places spread over its face.
Course course_in(const Body& body, Numbers& numbers) {
  const double yaw = 0.05 + 0.01 * numbers.next(), pitch = 0.023 + 0.004 * numbers.next(),
               roll = 0.031 + 0.004 * numbers.next();
  const auto room = [&](unsigned axis, double need) { return std::max(0.0, 0.5 * body.cells[axis] - need); };
  Course course;
  course.way = Vec3(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  course.edge = Vec3(-std::sin(yaw), std::cos(yaw), std::sin(roll));
  course.edge = (course.edge - course.edge.dot(course.way) * course.way).normalized();
  course.centre = Vec3(0.0, 0.5 * body.cells[1] + numbers.next() * room(1, 0.5 * kBladeWidth + 1.2),
                       0.5 * body.cells[2] - 0.2 + numbers.next() * room(2, 1.3));
  return course;
}

/// Figures of one motion in one body.
struct Measurement {
  std::uint64_t tets = 0, vertices = 0;
  double first_prepare_ms = 0;                 ///< of the first stroke's beginning: the surface is looked for
  std::vector<double> prepare_ms, first_us;    ///< of later strokes; of the step that touches the body first
  std::vector<double> step_us, contact_us;     ///< steady
  std::vector<double> early_us, late_us;       ///< of a long stroke: its first and its last quarter
  std::vector<double> undo_us;                 ///< per step
  std::vector<double> floor_us;                ///< of the steady steps: their bytes written, and nothing else
  std::uint64_t journal_bytes = 0;             ///< of the steady steps
  std::uint64_t cut_tets = 0, made_tets = 0;   ///< in the steady steps
  std::uint64_t grown_tets = 0;                ///< made less replaced
  std::uint64_t allocations = 0, counted = 0;  ///< in steps after the warm-up strokes
  std::uint64_t hash = 0;
  std::uint64_t not_restored = 0;                   ///< strokes whose undo left another hash
  double tree_ask_ms = 0, tree_ms = 0, vtk_ms = 0;  ///< peers; 0 where not run
  std::size_t tree_hits = 0;

  [[nodiscard]] double steady_us() const {
    double sum = 0;
    for (const double us : step_us) sum += us;
    return sum;
  }
  [[nodiscard]] double per_step(std::uint64_t count) const {
    return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, step_us.size()));
  }
  [[nodiscard]] double allocations_per_step() const {
    return static_cast<double>(allocations) / static_cast<double>(std::max<std::uint64_t>(1, counted));
  }
  /// How many times as long a step takes as it takes to write its bytes.
  [[nodiscard]] double over_floor() const {
    double floor = 0;
    for (const double us : floor_us) floor += us;
    return floor > 0 ? steady_us() / floor : 0.0;
  }
  [[nodiscard]] double journal_bytes_per_cut_tet() const {
    return static_cast<double>(journal_bytes) / static_cast<double>(std::max<std::uint64_t>(1, cut_tets));
  }
  [[nodiscard]] double us_per(std::uint64_t count) const {
    return steady_us() / static_cast<double>(std::max<std::uint64_t>(1, count));
  }
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

template <class Work>
double time_us(Work&& work) {
  const double start = thread_ms();
  work();
  return 1e3 * (thread_ms() - start);
}

/// Takes the blade through a body, stroke by stroke, and takes every stroke back.
class Runner {
 public:
  Runner(Engine& engine, const Motion& motion) : engine_(engine), motion_(motion), floor_(engine.mesh()) {}

  /// Whether the engine did as told; says on stderr what it did not.
  bool stroke(const Course& course, double depth, bool is_long) {
    const std::uint64_t hash_before = engine_.mesh().hash();
    const std::size_t steps_before = engine_.journal().position();
    std::optional<Result<std::uint32_t>> began;
    const double prepare_us =
        time_us([&] { began.emplace(engine_.begin_stroke(pose(course, kTouchDepth - motion_.step))); });
    if (!began->ok()) return fail(began->error());
    (strokes_ == 0 ? out_.first_prepare_ms : out_.prepare_ms.emplace_back()) = 1e-3 * prepare_us;
    std::vector<double> times;
    for (double at = kTouchDepth; at < depth; at += motion_.step) {
      if (!step(pose(course, at), times, is_long)) return false;
    }
    if (!is_long) run_floor();
    const auto end = engine_.end_stroke();
    if (!end) return fail(end.error());
    out_.hash = out_.hash * 1099511628211ULL ^ engine_.mesh().hash();
    if (is_long) {
      const auto quarter = static_cast<std::ptrdiff_t>(times.size() / 4);
      out_.early_us.assign(times.begin() + 1, times.begin() + 1 + quarter);
      out_.late_us.assign(times.end() - quarter, times.end());
    }
    const double steps = static_cast<double>(engine_.journal().position() - steps_before);
    out_.undo_us.push_back(time_us([&] { engine_.undo(); }) / steps);
    out_.not_restored += engine_.mesh().hash() == hash_before ? 0U : 1U;
    ++strokes_;
    return true;
  }
  Measurement& out() { return out_; }

 private:
  [[nodiscard]] BladePose pose(const Course& course, double depth) const {
    return course.pose_at(depth, motion_.segments);
  }
  bool step(const BladePose& pose, std::vector<double>& times, bool is_long) {
    const std::size_t from = engine_.journal().position();
    const std::uint64_t allocations = heap_allocations();
    std::optional<Result<StepReport>> report;
    const double us = time_us([&] { report.emplace(engine_.step(pose)); });
    const std::uint64_t allocated = heap_allocations() - allocations;
    if (!report->ok()) return fail(report->error());
    times.push_back(us);
    if (times.size() == 1) out_.first_us.push_back(us);
    if (is_long || times.size() <= 1 + kWarmUpSteps) return true;
    out_.step_us.push_back(us);
    out_.contact_us.push_back(1e3 * (*report)->times[Stage::kCollision]);
    out_.cut_tets += (*report)->cut.cut_tets;
    out_.grown_tets += static_cast<std::uint64_t>((*report)->cut.created_tets);
    for (std::size_t i = from; i < engine_.journal().position(); ++i) {
      out_.made_tets += engine_.journal().step(i).produced.size();
    }
    steady_.push_back({from, engine_.journal().position()});
    if (strokes_ >= kWarmUpStrokes) {
      out_.allocations += allocated;
      ++out_.counted;
    }
    return true;
  }
  /// The floor under the steady steps of this stroke, in the same order, on the same machine in the same second.
  void run_floor() {
    const std::size_t before = floor_.journal_bytes();
    for (const auto& [from, to] : steady_) {
      out_.floor_us.push_back(
          time_us([&, from = from, to = to] { floor_.write(engine_.journal(), from, to, engine_.mesh()); }));
    }
    out_.journal_bytes += floor_.journal_bytes() - before;
    floor_.forget();
    steady_.clear();
  }
  static bool fail(const Error& error) {
    std::fprintf(stderr, "the engine refused: %s\n", error.message.c_str());
    return false;
  }

  Engine& engine_;
  const Motion& motion_;
  FloorKernel floor_;
  std::vector<std::array<std::size_t, 2>> steady_;  // journal positions before and after each
  Measurement out_;
  std::size_t strokes_ = 0;
};

TetSoup soup_of(const Body& body) {
  return kuhn_box(Vec3::Zero(), Vec3(body.cells[0], body.cells[1], body.cells[2]), body.cells);
}

std::optional<Measurement> measure(const Body& body, const Motion& motion) {
  EngineOptions options;
  options.cut.snap = motion.snap;
  options.maintain.merge = options.maintain.improve = false;  // cutting alone is measured
  Result<TetMesh> mesh = TetMesh::build(soup_of(body));
  if (!mesh) return std::nullopt;
  Result<Engine> engine = Engine::create(std::move(*mesh), options);
  if (!engine) return std::nullopt;
  Runner runner(*engine, motion);
  runner.out().tets = engine->mesh().tet_count();
  runner.out().vertices = engine->mesh().vertex_count();
  Numbers numbers;
  for (unsigned i = 0; i < motion.strokes; ++i) {
    if (!runner.stroke(course_in(body, numbers), kStrokeDepth, false)) return std::nullopt;
  }
  const double through = body.cells[0] - 1.5;
  if (through > 2.0 * kStrokeDepth && !runner.stroke(course_in(body, numbers), through, true)) return std::nullopt;
  return std::move(runner.out());
}

/// The peers on one body: an axis-aligned tree over all tets, refitted and asked, and VTK's clip along the same plane.
void run_peers(const Body& body, bool with_vtk, Measurement& out) {
  constexpr unsigned kRuns = 5;
  TetSoup soup = soup_of(body);
  Numbers numbers;
  const Course course = course_in(body, numbers);
#ifdef INCISE_BENCH_VTK
  if (with_vtk) {
    VtkClip vtk(soup);
    std::vector<double> ms;
    for (unsigned run = 0; run < kRuns; ++run) {
      ms.push_back(vtk.run_ms(course.normal(), course.normal().dot(course.centre), true));
    }
    out.vtk_ms = median(ms);
  }
#else
  static_cast<void>(with_vtk);
#endif
  const Result<TetMesh> mesh = TetMesh::build(std::move(soup));
  if (!mesh) return;
  TetBoxTree tree(*mesh);
  std::vector<double> refit_ms, ask_ms;
  for (unsigned run = 0; run < kRuns; ++run) {
    const auto from = course.pose_at(5.0 + run, 1).edge, to = course.pose_at(6.0 + run, 1).edge;
    const std::vector<std::array<Vec3, 3>> triangles = {{from[0], from[1], to[1]}, {from[0], to[1], to[0]}};
    refit_ms.push_back(1e-3 * time_us([&] { tree.refit(*mesh); }));
    ask_ms.push_back(1e-3 * time_us([&] { out.tree_hits = tree.count_hits(*mesh, triangles); }));
  }
  out.tree_ms = median(refit_ms) + median(ask_ms);
  out.tree_ask_ms = median(ask_ms);
}

std::string number(double value, int digits = 1) {
  return fmt::format("{:.{}f}", value, digits);
}

void add_row(Table& table, const Motion& motion, const Body& body, const Measurement& m) {
  const double p50 = median(m.step_us);
  table.add({motion.name,
             body.name,
             std::to_string(m.step_us.size()),
             number(m.first_prepare_ms, 2),
             number(median(m.prepare_ms), 2),
             number(1e-3 * median(m.first_us), 3),
             number(1e-3 * quantile(m.first_us, 1.0), 3),
             number(p50),
             number(quantile(m.step_us, 0.95)),
             number(quantile(m.step_us, 0.99)),
             number(quantile(m.step_us, 1.0)),
             number(quantile(m.step_us, 0.99) / p50, 2),
             number(m.per_step(m.cut_tets)),
             number(m.per_step(m.made_tets)),
             number(1e3 * m.us_per(m.cut_tets), 0),
             number(1e3 * m.us_per(m.made_tets), 0),
             number(1e3 * m.us_per(m.grown_tets), 0),
             number(median(m.floor_us)),
             number(m.over_floor()),
             number(m.journal_bytes_per_cut_tet(), 0),
             number(median(m.contact_us)),
             number(m.allocations_per_step()),
             number(median(m.undo_us)),
             m.late_us.empty() ? "-" : number(median(m.late_us) / median(m.early_us), 2),
             m.not_restored == 0 ? "yes" : "NO",
             fmt::format("{:016x}", m.hash)});
}

/// By motion and body.
using Measurements = std::map<std::pair<std::size_t, std::size_t>, Measurement>;

Measurements measure_all(const std::vector<Body>& bodies, std::size_t motions, const std::filesystem::path& folder) {
  Table table(
      "blade_law",
      "One step of a blade 24 elements wide. prepare: ms of begin_stroke, the first and later ones; touch: ms of "
      "the step that touches first, median and greatest; steps in µs; ns per cut tet, per tet made and per tet "
      "that the mesh grew by; floor: µs to write the step's bytes alone, and how many times that the step takes; "
      "B/cut: "
      "bytes of journal; contact: µs; allocations per step after two strokes; undo: µs per step; late/early: "
      "steps of a long stroke",
      {"step",       "tets",  "samples", "prepare",  "again",     "touch",      "most",     "p50",      "p95",
       "p99",        "max",   "p99/p50", "cut/step", "made/step", "ns/cut",     "ns/made",  "ns/grown", "floor",
       "over floor", "B/cut", "contact", "allocs",   "undo",      "late/early", "restored", "hash"});
  Measurements all;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (std::size_t i = 0; i < motions; ++i) {
      std::optional<Measurement> m = measure(bodies[b], kMotions[i]);
      if (!m) continue;
      if (i == 0) run_peers(bodies[b], bodies[b].name == "1M", *m);
      all.emplace(std::pair(i, b), std::move(*m));
      std::fprintf(stderr, "%s, %s: done\n", bodies[b].name.c_str(), kMotions[i].name.c_str());
    }
  }
  for (const auto& [key, m] : all) add_row(table, kMotions[key.first], bodies[key.second], m);
  table.print();
  table.write_csv(folder);
  return all;
}

void print_peers(const std::vector<Body>& bodies, const Measurements& all, const std::filesystem::path& folder) {
  Table table("blade_law_peers",
              "Peers, ms: an axis-aligned tree over all tets, refitted and asked as often as the blade moves, over our "
              "contact; VTK's table-based clip of the whole body, both parts made, over our whole step",
              {"tets", "tree hits", "refit+ask", "ask", "over contact", "over step", "VTK", "over step"});
  for (const auto& [key, m] : all) {
    if (m.tree_ms == 0) continue;
    const double p50 = median(m.step_us);
    table.add({bodies[key.second].name, std::to_string(m.tree_hits), number(m.tree_ms, 3), number(m.tree_ask_ms, 3),
               number(1e3 * m.tree_ms / median(m.contact_us), 0), number(1e3 * m.tree_ms / p50, 0),
               m.vtk_ms > 0 ? number(m.vtk_ms) : "-", m.vtk_ms > 0 ? number(1e3 * m.vtk_ms / p50, 0) : "-"});
  }
  table.print();
  table.write_csv(folder);
}

/// Twenty steps of a blade through the cube of 6,000 tets, from one side to the other.
struct CubeRun {
  std::vector<double> step_ms;
  std::size_t pieces = 0;
  double area = 0;
};

double boundary_area(const TetMesh& mesh) {
  double area = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      const auto v = mesh.vertices(Side(tet, s));
      area += 0.5 * (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).norm();
    }
  });
  return area;
}

std::optional<CubeRun> cut_cube(double snap) {
  constexpr unsigned kSteps = 20;
  EngineOptions options;
  options.cut.snap = snap;
  options.maintain.merge = options.maintain.improve = false;
  Result<Engine> engine = Engine::create(*TetMesh::build(kuhn_cube(10)), options);
  const auto pose = [](unsigned i) {
    const double y = -0.1 + 1.2 * i / kSteps;
    return BladePose{{Vec3(0.503, y, -0.2), Vec3(0.503, y, 1.2)}, Vec3::Zero()};
  };
  if (!engine || !engine->begin_stroke(pose(0))) return std::nullopt;
  CubeRun run;
  for (unsigned i = 1; i <= kSteps; ++i) {
    run.step_ms.push_back(1e-3 * time_us([&] { static_cast<void>(engine->step(pose(i))); }));
  }
  if (!engine->end_stroke()) return std::nullopt;
  run.pieces = find_components(engine->mesh()).count();
  run.area = boundary_area(engine->mesh());
  return run;
}

/// Adds the figures that a release must reach.
class Gates {
 public:
  Gates(const std::vector<Body>& bodies, const Measurements& all) : bodies_(bodies), all_(all) {}

  std::vector<Acceptance> lines() {
    for (const double step : {1.0, 0.25}) add_steps(step);
    add_peers();
    for (const double snap : {0.2, 0.0}) add_cube(snap);
    return lines_;
  }

 private:
  [[nodiscard]] const Measurement* find(std::size_t motion, const std::string& body) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const auto at = all_.find({motion, b});
      if (bodies_[b].name == body && at != all_.end()) return &at->second;
    }
    return nullptr;
  }
  void add(const std::string& figure, const std::string& must, const std::string& goal, const std::string& measured,
           bool is_met) {
    lines_.push_back({figure, must, goal, measured, is_met});
  }
  void add_at_most(const std::string& figure, double must, const std::string& goal, double value, int digits) {
    if (std::isnan(value)) return;  // not measured
    add(figure, "≤ " + fmt::format("{}", must), goal, number(value, digits), value <= must);
  }
  /// The worst over the bodies and the motions with steps of one size; NaN where there are none.
  template <class Figure>
  [[nodiscard]] double worst(double step, Figure&& figure) const {
    double value = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [key, m] : all_) {
      if (kMotions[key.first].step == step) value = std::fmax(value, figure(m));
    }
    return value;
  }
  /// The worst over the motions with steps of one size of a figure of the 100k and the 10M.
  template <class Figure>
  [[nodiscard]] double worst_growth(double step, Figure&& figure) const {
    double value = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < kMotions.size(); ++i) {
      const Measurement *small = find(i, "100k"), *large = find(i, "10M");
      if (small != nullptr && large != nullptr && kMotions[i].step == step) {
        value = std::fmax(value, figure(*small, *large));
      }
    }
    return value;
  }
  void add_steps(double step) {
    const std::string name = step == 1.0 ? "steps of 1 element: " : "steps of 1/4 element: ";
    add_at_most(
        name + "p50 at 10M over p50 at 100k", 1.25, "1.1",
        worst_growth(step, [](const Measurement& small,
                              const Measurement& large) { return median(large.step_us) / median(small.step_us); }),
        2);
    add_at_most(name + "p99 over p50", 2.5, "2",
                worst(step, [](const Measurement& m) { return quantile(m.step_us, 0.99) / median(m.step_us); }), 2);
    add_at_most(name + "µs per cut tet", step == 1.0 ? 1.5 : 5.0, step == 1.0 ? "1" : "3",
                worst(step, [](const Measurement& m) { return m.us_per(m.cut_tets); }), 2);
    if (step == 1.0) {
      add_at_most(name + "over writing their bytes alone, times", 7, "4",
                  worst(step, [](const Measurement& m) { return m.over_floor(); }), 1);
    }
    add_at_most(name + "journal, bytes per cut tet", 900, "600",
                worst(step, [](const Measurement& m) { return m.journal_bytes_per_cut_tet(); }), 0);
    add_at_most(name + "tets made per cut tet", step == 1.0 ? 10 : 15, step == 1.0 ? "7" : "-",
                worst(step,
                      [](const Measurement& m) {
                        return static_cast<double>(m.made_tets) /
                               static_cast<double>(std::max<std::uint64_t>(1, m.cut_tets));
                      }),
                1);
    add_at_most(name + "contact, µs", 40, "-", worst(step, [](const Measurement& m) { return median(m.contact_us); }),
                1);
    add_at_most(name + "first touch at 10M, ms", 16, "-",
                worst_growth(step, [](const Measurement& /*small*/,
                                      const Measurement& large) { return 1e-3 * quantile(large.first_us, 1.0); }),
                2);
    add_at_most(name + "allocations after warm-up", 0, "-",
                worst(step, [](const Measurement& m) { return m.allocations_per_step(); }), 1);
    add_at_most(name + "strokes whose undo did not restore the hash", 0, "-",
                worst(step, [](const Measurement& m) { return static_cast<double>(m.not_restored); }), 0);
  }
  void add_peers() {
    if (const Measurement* m = find(0, "10M"); m != nullptr && m->tree_ms > 0) {
      const double ratio = 1e3 * m->tree_ms / median(m->contact_us);
      add("tree over all tets, refitted and asked, over our contact at 10M", "≥ 1000", "-", number(ratio, 0),
          ratio >= 1000);
    }
    if (const Measurement* m = find(0, "1M"); m != nullptr && m->vtk_ms > 0) {
      const double ratio = 1e3 * m->vtk_ms / median(m->step_us);
      add("VTK's clip over our step at 1M", "≥ 300", "-", number(ratio, 0), ratio >= 300);
    }
  }
  void add_cube(double snap) {
    const std::optional<CubeRun> run = cut_cube(snap);
    if (!run) return;
    const std::string name = fmt::format("20 steps through the cube of 6,000 tets, snap {}: ", snap);
    add_at_most(name + "ms of the slowest", 1.0, "-", quantile(run->step_ms, 1.0), 3);
    add(name + "pieces, area", "2, 8.00", "-", fmt::format("{}, {:.9f}", run->pieces, run->area),
        run->pieces == 2 && std::abs(run->area - 8.0) <= 1e-9);
  }

  const std::vector<Body>& bodies_;
  const Measurements& all_;
  std::vector<Acceptance> lines_;
};

constexpr const char* kUsage =
    "usage: bench_blade_law [--out FOLDER] [--quick] [--body NAME] [--motions N]\n"
    "Times the steps of one blade through bodies of 10k, 100k, 1M and 10M tets.\n"
    "  --quick    leaves the 10M out\n"
    "  --body     10k, 100k, 1M or 10M alone\n"
    "  --motions  the first N motions alone\n";

int run(int argc, char** argv) {
  std::filesystem::path folder = "bench-results";
  std::vector<Body> bodies = kBodies;
  std::size_t motions = kMotions.size();
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--out" && i + 1 < argc) {
      folder = argv[++i];
    } else if (argument == "--quick") {
      bodies.pop_back();
    } else if (argument == "--body" && i + 1 < argc) {
      const std::string name = argv[++i];
      bodies.erase(std::remove_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.name != name; }),
                   bodies.end());
    } else if (argument == "--motions" && i + 1 < argc) {
      motions = std::min(motions, static_cast<std::size_t>(std::strtoul(argv[++i], nullptr, 10)));
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
  const Measurements all = measure_all(bodies, motions, folder);
  print_peers(bodies, all, folder);
  report_acceptance("blade_law", Gates(bodies, all).lines(), folder);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
