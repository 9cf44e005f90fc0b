// SPDX-License-Identifier: Apache-2.0
#include "maintenance_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <utility>

#include "incise/geom/quality.h"
#include "incise/geom/triangle_tree.h"
#include "incise/mesh/components.h"
#include "report.h"

namespace incise::bench {

namespace {

EngineOptions cut_only(EngineOptions options) {
  options.maintain.work_units = 0;
  return options;
}

using Wall = std::array<VertexId, 3>;

std::vector<Wall> walls_of(const TetMesh& mesh, std::uint32_t tag) {
  std::vector<Wall> walls;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.link(Side(tet, s)) == Link::boundary(tag)) {
        walls.push_back(mesh.vertices(Side(tet, s)));
      }
    }
  });
  return walls;
}

/// The mean length of the walls' edges at each vertex.
std::vector<double> edge_lengths(const TetMesh& mesh, const std::vector<Wall>& walls) {
  std::vector<double> sums(mesh.vertex_slots(), 0.0), counts(mesh.vertex_slots(), 0.0);
  for (const Wall& wall : walls) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = wall[i], b = wall[(i + 1) % 3];
      const double length = (mesh.rest(a) - mesh.rest(b)).norm();
      for (const VertexId v : {a, b}) {
        sums[v.value] += length;
        counts[v.value] += 1;
      }
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] /= std::max(counts[i], 1.0);
  }
  return sums;
}

std::vector<WallSample> sample_walls(const TetMesh& mesh, std::uint32_t tag, const TriangleTree& sweep) {
  std::vector<WallSample> samples;
  for (const auto& [i, j, k] : walls_of(mesh, tag)) {
    const Vec3 &a = mesh.rest(i), &b = mesh.rest(j), &c = mesh.rest(k);
    const std::array<Vec3, 7> places = {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3};
    for (const Vec3& place : places) {
      samples.push_back({place, std::sqrt(sweep.closest(place).distance2)});
    }
  }
  return samples;
}

/// The local length unit along the walls of a stroke: the mean of their edges around.
class WallUnit {
 public:
  WallUnit(const TetMesh& mesh, std::uint32_t tag) {
    const std::vector<Wall> walls = walls_of(mesh, tag);
    const std::vector<double> lengths = edge_lengths(mesh, walls);
    std::vector<Vec3> points;
    std::vector<TriangleTree::Triangle> triangles;
    for (const Wall& wall : walls) {
      const auto first = static_cast<std::uint32_t>(points.size());
      for (const VertexId v : wall) points.push_back(mesh.rest(v));
      triangles.push_back({first, first + 1, first + 2});
      units_.push_back((lengths[wall[0].value] + lengths[wall[1].value] + lengths[wall[2].value]) / 3);
    }
    tree_ = TriangleTree(points, triangles);
  }
  [[nodiscard]] double at(const Vec3& place) const {
    const TriangleTree::Hit hit = tree_.closest(place);
    return hit.is_valid() ? units_[hit.triangle] : 1.0;
  }

 private:
  TriangleTree tree_;
  std::vector<double> units_;
};

WallDistance wall_distance(const std::vector<WallSample>& samples, const WallUnit& unit) {
  WallDistance out;
  for (const WallSample& sample : samples) {
    const double distance = sample.distance / unit.at(sample.place);
    out.greatest = std::max(out.greatest, distance);
    out.mean += distance / static_cast<double>(samples.size());
  }
  return out;
}

/// `Measurement::wall_added`.
double added_distance(const std::vector<WallSample>& before, const std::vector<WallSample>& after,
                      const WallUnit& unit) {
  double greatest = 0;
  for (const WallSample& sample : after) {
    const double reach = unit.at(sample.place);
    if (sample.distance <= greatest * reach) {
      continue;
    }
    double known = 0;
    for (const WallSample& old : before) {
      if ((old.place - sample.place).squaredNorm() <= reach * reach) known = std::max(known, old.distance);
    }
    greatest = std::max(greatest, (sample.distance - known) / reach);
  }
  return greatest;
}

std::vector<double> piece_volumes(const TetMesh& mesh) {
  std::vector<double> volumes = find_components(mesh).volume;
  std::sort(volumes.begin(), volumes.end(), std::greater<>());
  return volumes;
}

Snapshot take_snapshot(const Engine& engine, const TriangleTree& sweep) {
  const TetMesh& mesh = engine.mesh();
  const Touched touched(mesh, engine.journal(), 0);
  Snapshot out;
  out.tets = mesh.tet_count();
  out.all = measure_quality(mesh);
  out.touched = touched.quality(mesh);
  out.volumes = piece_volumes(mesh);
  out.walls = sample_walls(mesh, engine.next_stroke() - 1, sweep);
  return out;
}

TriangleTree tree_of(const Stroke& stroke) {
  const SweptTriangles sweep = swept_triangles(stroke);
  return {sweep.points, sweep.triangles};
}

double lr_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return longest_edge_over_inradius(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3]));
}

std::uint64_t count_above(const Engine& engine, double bound) {
  const TetMesh& mesh = engine.mesh();
  const Touched touched(mesh, engine.journal(), 0);
  std::uint64_t count = 0;
  mesh.for_each_tet([&](TetId tet) { count += touched.touches(mesh, tet) && lr_of(mesh, tet) > bound ? 1U : 0U; });
  return count;
}

/// The input's vertices at places that changed later: of tets that gave way or got other vertices, moved or copied
/// ones, and all that in the end belong to a tet with such a vertex.
class ChangedPlaces {
 public:
  ChangedPlaces(const TetMesh& input, const Engine& engine) : is_changed_(input.vertex_slots(), false) {
    for (std::size_t i = 0; i < engine.journal().position(); ++i) {
      add(engine.journal().step(i));
    }
    const TetMesh& mesh = engine.mesh();
    const Touched touched(mesh, engine.journal(), 0);
    mesh.for_each_tet([&](TetId tet) {
      for (unsigned c = 0; c < 4 && touched.touches(mesh, tet); ++c) {
        add(mesh.origin(mesh.vertices(tet)[c]));
      }
    });
  }
  [[nodiscard]] QualityStats quality(const TetMesh& input) const {
    return measure_quality(input, [&](TetId tet) {
      const TetVertices& v = input.vertices(tet);
      return std::any_of(v.begin(), v.end(), [&](VertexId vertex) { return is_changed_[vertex.value]; });
    });
  }

 private:
  void add(VertexId v) {
    if (v.is_valid() && v.value < is_changed_.size()) {
      is_changed_[v.value] = true;
    }
  }
  void add(const TetVertices& vertices) {
    for (const VertexId v : vertices) add(v);
  }
  void add(const Step& step) {
    for (const ConsumedTet& tet : step.consumed) add(tet.vertices);
    for (const RewiredTet& tet : step.rewired) add(tet.old_vertices);
    for (const MovedVertex& v : step.moved) add(v.id);
    for (const CopiedVertex& v : step.copied) add(v.source);
  }

  std::vector<bool> is_changed_;
};

template <class Work>
double time_ms(Work&& work) {
  const double start = thread_ms();
  work();
  return thread_ms() - start;
}

/// Makes the stroke without its maintenance; false where it fails.
bool cut_once(Engine& engine, const Stroke& stroke, Measurement& out) {
  bool is_ok = false;
  const double ms = time_ms([&] {
    const Result<StrokeReport> report = engine.cut(stroke);
    is_ok = report.ok();
    if (is_ok) {
      out.cut_work = report->cut;
    } else {
      std::fprintf(stderr, "the cut failed: %s\n", report.error().message.c_str());
    }
  });
  out.cut_ms = std::min(out.cut_ms, ms);
  return is_ok;
}

void maintain_once(Engine& engine, Measurement& out) {
  const double ms = time_ms([&] { out.maintain_work = engine.maintain()->maintain; });
  out.maintain_ms = std::min(out.maintain_ms, ms);
}

void measure_input(const TetMesh& mesh, Measurement& out) {
  out.input_tets = mesh.tet_count();
  out.input = measure_quality(mesh);
  out.cut_ms = out.maintain_ms = 1e300;
}

void measure_result(const TetMesh& input, const Engine& engine, const TriangleTree& sweep, Measurement& out) {
  out.after = take_snapshot(engine, sweep);
  const WallUnit unit(engine.mesh(), engine.next_stroke() - 1);
  out.cut.wall = wall_distance(out.cut.walls, unit);
  out.after.wall = wall_distance(out.after.walls, unit);
  out.wall_added = added_distance(out.cut.walls, out.after.walls, unit);
  out.neighbourhood = ChangedPlaces(input, engine).quality(input);
  out.above_input = count_above(engine, std::max(25.0, out.input.lr_max));
  out.defects = new_defects(validate(input, ValidateLevel::kGeometry), engine.mesh());
}

}  // namespace

Touched::Touched(const TetMesh& mesh, const Journal& journal, std::size_t first_step)
    : is_touched_(mesh.vertex_slots(), false) {
  for (std::size_t i = first_step; i < journal.position(); ++i) {
    add(journal.step(i));
  }
  mesh.for_each_vertex([&](VertexId v) {
    if ((mesh.shape_of(v) & shape::kWall) != 0) add(v);
  });
}

void Touched::add(const Step& step) {
  for (const BornVertex& v : step.born) add(v.id);
  for (const MovedVertex& v : step.moved) add(v.id);
  for (const CopiedVertex& v : step.copied) {
    add(v.id);
    add(v.source);
  }
}

bool Touched::touches(const TetMesh& mesh, TetId tet) const {
  const TetVertices& v = mesh.vertices(tet);
  return std::any_of(v.begin(), v.end(), [&](VertexId vertex) { return holds(vertex); });
}

QualityStats Touched::quality(const TetMesh& mesh) const {
  return measure_quality(mesh, [&](TetId tet) { return touches(mesh, tet); });
}

double Measurement::growth() const {
  return static_cast<double>(after.tets) / static_cast<double>(std::max<std::size_t>(input_tets, 1));
}

double Measurement::new_per_cut_tet() const {
  const double added = static_cast<double>(after.tets) - static_cast<double>(input_tets);
  return added / static_cast<double>(std::max<std::uint64_t>(cut_work.cut_tets, 1));
}

double Measurement::us_per_cut_tet(double ms) const {
  return 1e3 * ms / static_cast<double>(std::max<std::uint64_t>(cut_work.cut_tets, 1));
}

double Measurement::volume_change() const {
  if (cut.volumes.size() != after.volumes.size()) {
    return 1;
  }
  double worst = 0;
  for (std::size_t i = 0; i < cut.volumes.size(); ++i) {
    worst = std::max(worst, std::abs(after.volumes[i] - cut.volumes[i]) / std::max(cut.volumes[i], 1e-300));
  }
  return worst;
}

double Measurement::lr_bound(bool is_cube) const {
  return is_cube ? 25.0 : std::max(25.0, neighbourhood.lr_max);
}

std::string new_defects(const ValidityReport& input, const TetMesh& mesh) {
  const ValidityChange change = compare_with_input(input, validate(mesh, ValidateLevel::kGeometry));
  std::string text;
  for (std::size_t kind = 0; kind < kViolationKinds; ++kind) {
    if (change.grown[kind] > 0) {
      text += (text.empty() ? "" : " ") + std::string(name_of(static_cast<ViolationKind>(kind))) + ":" +
              std::to_string(change.grown[kind]);
    }
  }
  return change.ok || !text.empty() ? text : "unnamed";
}

Measurement measure_maintenance(const TetMesh& mesh, const Stroke& stroke, const EngineOptions& options,
                                unsigned runs) {
  Measurement out;
  measure_input(mesh, out);
  const TriangleTree sweep = tree_of(stroke);
  Result<Engine> engine = Engine::create(mesh, cut_only(options));
  for (unsigned run = 0; run < runs; ++run) {
    if (run > 0) {
      engine->undo();
    }
    if (!engine || !cut_once(*engine, stroke, out)) {
      return out;
    }
    if (run == 0) {
      out.cut = take_snapshot(*engine, sweep);
    }
    maintain_once(*engine, out);
  }
  measure_result(mesh, *engine, sweep, out);
  out.is_ok = true;
  return out;
}

namespace {

constexpr std::uint64_t kChunk = 2500;  // units of work between looks at the clock: about 50 µs

double worst_touched(const Engine& engine) {
  return Touched(engine.mesh(), engine.journal(), 0).quality(engine.mesh()).lr_max;
}

/// Notes the worst at each time, before the chunk that would pass it. What a chunk that cannot be stopped in time made
/// does not count yet.
void note_anytime(Engine& engine, const std::vector<double>& times, std::vector<double>& best) {
  double spent = 0, last = 0, worst = worst_touched(engine);
  for (std::size_t i = 0; i < times.size(); ++i) {
    while (engine.has_maintenance() && spent + last < times[i]) {
      last = time_ms([&] { (void)engine.maintain(kChunk); });
      spent += last;
    }
    if (spent < 1.1 * times[i]) {
      worst = worst_touched(engine);
    }
    best[i] = std::min(best[i], worst);
  }
}

}  // namespace

std::vector<double> measure_anytime(const TetMesh& mesh, const Stroke& stroke, const EngineOptions& options,
                                    const std::vector<double>& times, unsigned runs) {
  std::vector<double> best(times.size(), 1e300);
  Result<Engine> engine = Engine::create(mesh, cut_only(options));
  for (unsigned run = 0; run < runs && engine.ok(); ++run) {
    if (!engine->cut(stroke).ok()) {
      break;
    }
    note_anytime(*engine, times, best);
    engine->undo();
  }
  return best;
}

}  // namespace incise::bench
