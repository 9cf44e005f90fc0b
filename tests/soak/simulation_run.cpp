// SPDX-License-Identifier: Apache-2.0
#include "soak/simulation_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "app/jobs/cut_job.h"
#include "incise/mesh/attributes.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/step_check.h"
#include "incise/mesh/tet_tables.h"
#include "incise/mesh/validate.h"
#include "soak/watch.h"
#include "support/random.h"

namespace incise::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kG = 9.81;
/// Light vertices that a stiff hook lets go of may well be fast; what flies apart is faster still, all of it.
constexpr double kFastest = 100;       // m/s, besides free fall
constexpr double kMeanSpeed = 5;       // m/s, likewise: of the mass
constexpr double kEnergyGain = 1e-3;   // in a frame in which nothing is done to the body, of the peak
constexpr double kRunaway = 0.02;      // likewise: beyond, it is a fault whatever is judged
constexpr double kJournalGain = 0.03;  // of elastic energy where the solver follows the mesh, of its peak
constexpr double kConserved = 1e-12;
constexpr std::uint64_t kReplayed = 10;  // one scene in this number, by its seed

std::string number(double value) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

/// Looks at the body before it follows what a call of the engine did to the mesh: the engine has its steps checked
/// first.
struct StepWatch {
  const Simulation* simulation = nullptr;
  TouchedCheck check;
  std::optional<BodyEnergy> before;  ///< of this frame, where the mesh changed

  Status operator()(const TetMesh& mesh, const Journal& journal, std::size_t first_step) {
    if (simulation != nullptr && !before) before = simulation->body().energy();
    return check(mesh, journal, first_step);
  }
};

Simulation simulation_for(const SimulationCase& scene, unsigned threads, StepWatch& watch) {
  SimulationOptions options = scene.options;
  options.body.threads = threads;
  options.engine.threads = threads;
  options.engine.check_step = std::ref(watch);
  Simulation simulation = Simulation::create(TetMesh::build(make_body(scene.body)).value(), options).value();
  if (scene.support == Support::kTable) return simulation;
  const Box box = rest_bounds(simulation.mesh());
  const double reach = box.lo.z() + 0.12 * (box.hi - box.lo).z();
  simulation.mesh().for_each_vertex([&](VertexId v) {
    if (simulation.mesh().rest(v).z() > reach) return;
    (void)simulation.body().hold(v, scene.support == Support::kWall ? kInfinity : 20.0);
  });
  return simulation;
}

/// The sums of a random vector per vertex that follows the journal by itself.
class ConservedSum {
 public:
  explicit ConservedSum(const Simulation& simulation) : attributes_(simulation.mesh()) {
    id_ = *attributes_.add(simulation.mesh(), {"vector", Domain::kVertex, 3, Transfer::kConserve, {}, {}});
    Random random(1);
    const std::span<double> values = attributes_.values(id_);
    simulation.mesh().for_each_vertex([&](VertexId v) {
      for (std::size_t k = 0; k < 3; ++k) values[std::size_t{3} * v.value + k] = random.real(-1, 1);
    });
    first_ = sum();
  }
  /// How far the sum is off after what the journal has now, by the sum of all that is in it.
  double drift(const Simulation& simulation) {
    if (!attributes_.follow(simulation.engine().journal(), simulation.mesh())) return kInfinity;
    const Vec3 now = sum();
    const double drift = (now - first_).norm() / size_;
    first_ = now;
    return drift;
  }

 private:
  Vec3 sum() {
    Vec3 sum = Vec3::Zero();
    size_ = 0;
    const std::span<const double> values = attributes_.values(id_);
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      const Vec3 value(values[i], values[i + 1], values[i + 2]);
      sum += value;
      size_ += value.norm();
    }
    return sum;
  }

  Attributes attributes_;
  AttributeId id_;
  Vec3 first_ = Vec3::Zero();
  double size_ = 0;
};

/// A vertex of the piece that each vertex is in, through tets; kInvalidIndex where there is none.
std::vector<std::uint32_t> pieces_of(const TetMesh& mesh) {
  std::vector<std::uint32_t> up(mesh.vertex_slots());
  std::iota(up.begin(), up.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (up[v] != v) v = up[v] = up[up[v]];
    return v;
  };
  mesh.for_each_tet([&](TetId t) {
    for (const VertexId v : mesh.vertices(t)) up[root(v.value)] = root(mesh.vertices(t)[0].value);
  });
  std::vector<std::uint32_t> piece(up.size(), kInvalidIndex);
  mesh.for_each_vertex([&](VertexId v) { piece[v.value] = root(v.value); });
  return piece;
}

/// How many pieces a mesh has, through tets that share vertices.
std::size_t count_pieces(const TetMesh& mesh) {
  std::size_t count = 0;
  const std::vector<std::uint32_t> pieces = pieces_of(mesh);
  for (std::uint32_t v = 0; v < pieces.size(); ++v) count += pieces[v] == v ? 1U : 0U;
  return count;
}

/// Says at intervals of frames how a scene gets on.
class FrameLog {
 public:
  explicit FrameLog(unsigned every) : every_(every) {}
  void add(std::uint64_t seed, unsigned frame, const FrameReport& report, const Simulation& simulation) {
    if (every_ == 0) return;
    times_ += report.times;
    slowest_ = std::max(slowest_, report.times.total());
    if ((frame + 1) % every_ != 0) return;
    const TetMesh& mesh = simulation.mesh();
    std::fprintf(stderr, "seed %llu, frame %u: %zu tets, %zu vertices, %zu awake, %zu pieces; ms per frame %.2f:",
                 static_cast<unsigned long long>(seed), frame, mesh.tet_count(), mesh.vertex_count(),
                 report.relax.active_vertices, count_pieces(mesh), times_.total() / every_);
    for (std::size_t stage = 0; stage < kStageNames.size(); ++stage) {
      std::fprintf(stderr, " %s %.2f", kStageNames[stage], times_.ms[stage] / every_);
    }
    std::fprintf(stderr, "; at most %.1f\n", slowest_);
    times_ = {};
    slowest_ = 0;
  }

 private:
  unsigned every_;
  StageTimes times_;  // of the frames since the last line
  double slowest_ = 0;
};

/// The greatest rise of energy so far.
struct Rise {
  double most = 0;     ///< J
  unsigned frame = 0;  ///< when

  void note(double rise, unsigned at) {
    if (!(rise > most)) return;
    most = rise;
    frame = at;
  }
  [[nodiscard]] double share_of(double peak) const { return most > 0 ? most / peak : 0.0; }
};

class SimulationRun {
 public:
  SimulationRun(const SimulationCase& scene, unsigned threads, unsigned log_every)
      : scene_(scene),
        log_(log_every),
        simulation_(simulation_for(scene, threads, watch_)),
        hands_(scene),
        counts_(validate(simulation_.mesh(), ValidateLevel::kCounts)),
        geometry_(validate(simulation_.mesh(), ValidateLevel::kGeometry)),
        sum_(simulation_),
        mass_(simulation_.body().mass()) {
    const Box box = rest_bounds(simulation_.mesh());
    size_ = (box.hi - box.lo).norm() * scene.options.body.length_unit;
    floor_ = box.lo.z();
    watch_.simulation = &simulation_;
  }
  SimulationRun(const SimulationRun&) = delete;
  SimulationRun& operator=(const SimulationRun&) = delete;

  SimulationOutcome run() {
    for (; out_.frames < scene_.frames && out_.fault.empty(); ++out_.frames) step();
    stop_watching();
    check_energy();
    out_.hash = simulation_.hash();
    out_.tets = simulation_.mesh().tet_count();
    return out_;
  }

 private:
  void fail(const std::string& what) {
    if (out_.fault.empty()) out_.fault = "frame " + std::to_string(out_.frames) + ": " + what;
  }
  void step() {
    watch("seed " + std::to_string(scene_.seed) + ", frame " + std::to_string(out_.frames));
    FrameInput input = hands_.at(out_.frames, simulation_);
    const bool is_alone = !input.blade && input.hooks.empty() && input.tools.empty();
    if (scene_.support == Support::kTable) input.tools.emplace_back(PlaneTool{Vec3::UnitZ(), floor_});
    const std::size_t position = simulation_.engine().journal().position();
    watch_.before.reset();
    const Result<FrameReport> report = simulation_.frame(input);
    if (!report.ok()) return fail(report.error().message);
    log_.add(scene_.seed, out_.frames, *report, simulation_);
    const bool has_changed = simulation_.engine().journal().position() != position;
    check_motion(*report);
    note_energy(is_alone);
    if (has_changed) check_mesh();
    if (has_changed) check_pieces(position);
    if (was_cutting_ && !input.blade) end_stroke();
    was_cutting_ = input.blade.has_value();
  }

  /// Sometimes taken back and done again. The lift itself is in the frame before.
  void end_stroke() {
    check_geometry();
    const auto ended = std::find_if(scene_.strokes.begin(), scene_.strokes.end(), [&](const FrameStroke& stroke) {
      return stroke.first + stroke.edges.size() == out_.frames;
    });
    if (ended == scene_.strokes.end() || !ended->is_undone || !is_together() || !simulation_.undo()) return;
    check_mesh();
    check_geometry();
    if (!simulation_.redo()) fail("what was undone cannot be done again");
    check_mesh();
    check_geometry();
    pieces_ = pieces_of(simulation_.mesh());
    energy_ = simulation_.body().energy().total();  // undo brings tissue together wherever it stands by then
  }

  void check_motion(const FrameReport& report) {
    const DeformableBody& body = simulation_.body();
    if (!body.is_finite()) return fail("not finite");
    const double fall = kG * (out_.frames + 1) * scene_.options.frame_seconds;
    out_.fastest = std::max(out_.fastest, report.relax.fastest);
    if (!(report.relax.fastest < kFastest + fall)) fail("a vertex flies at " + number(report.relax.fastest) + " m/s");
    const double speed = std::sqrt(2 * body.energy().kinetic / mass_);
    if (!(speed < kMeanSpeed + fall)) fail("the body flies apart, at " + number(speed) + " m/s");
    const double drift = std::abs(body.mass() - mass_) / mass_;
    if (!(drift < kConserved * (1 + out_.frames))) fail("the mass is off by " + number(drift));
  }

  /// Following the mesh adds next to nothing, and neither does a frame in which nothing is done to the body; what such
  /// a frame does to the mesh is judged by the first of these. No frame is left out.
  void note_energy(bool is_alone) {
    const BodyEnergy now = simulation_.body().energy(), before = watch_.before.value_or(now);
    peak_ = std::max(peak_, before.total() - before.potential);
    elastic_peak_ = std::max(elastic_peak_, before.elastic);
    journal_rise_.note(now.elastic - before.elastic, out_.frames);
    if (is_alone && energy_) alone_rise_.note(before.total() - *energy_, out_.frames);
    energy_ = now.total();
  }
  /// Against the peaks of the whole run, which are known at its end.
  void check_energy() {
    out_.journal_gain = journal_rise_.share_of(elastic_peak_);
    out_.energy_gain = alone_rise_.share_of(peak_);
    if (!(out_.journal_gain <= kJournalGain)) {
      out_.energy_fault = "frame " + std::to_string(journal_rise_.frame) + ": a step of the journal adds " +
                          number(out_.journal_gain) + " of the peak of energy";
    } else if (!(out_.energy_gain <= kEnergyGain)) {
      out_.energy_fault = "frame " + std::to_string(alone_rise_.frame) + ": left alone it has gained " +
                          number(out_.energy_gain) + " of the peak of energy";
    }
    if (!(out_.energy_gain <= kRunaway)) fail("left alone it has gained " + number(out_.energy_gain) + " of the peak");
  }

  /// Undo brings together what has come apart, wherever it is by then: here only what is still near.
  [[nodiscard]] bool is_together() const {
    Box box = rest_bounds(simulation_.mesh());
    const Vec3 margin = 0.5 * (box.hi - box.lo);
    bool is_inside = true;
    simulation_.mesh().for_each_vertex([&](VertexId v) {
      const Vec3& p = simulation_.body().positions()[v.value];
      is_inside = is_inside && ((p - box.lo + margin).array() > 0).all() && ((box.hi + margin - p).array() > 0).all();
    });
    return is_inside;
  }
  /// Pieces come apart, and never together.
  void check_pieces(std::size_t position) {
    const Journal& journal = simulation_.engine().journal();
    const auto forget = [&](VertexId v) {  // who has a slot now is not who had it, be it left in the same step
      if (v.value < pieces_.size()) pieces_[v.value] = kInvalidIndex;
    };
    for (std::size_t i = position; i < journal.position(); ++i) {
      const Step& step = journal.step(i);
      for (const VertexId v : step.new_vertices) forget(v);
      for (const BornVertex& v : step.born) forget(v.id);
      for (const CopiedVertex& v : step.copied) forget(v.id);
    }
    std::vector<std::uint32_t> now = pieces_of(simulation_.mesh());
    std::vector<std::uint32_t> came_from(now.size(), kInvalidIndex);
    for (std::uint32_t v = 0; v < pieces_.size(); ++v) {
      if (pieces_[v] == kInvalidIndex || now[v] == kInvalidIndex) continue;
      std::uint32_t& from = came_from[now[v]];
      if (from != kInvalidIndex && from != pieces_[v]) return fail_joined(from, pieces_[v]);
      from = pieces_[v];
    }
    pieces_ = std::move(now);
  }
  void fail_joined(std::uint32_t a, std::uint32_t b) {
    const auto size = [&](std::uint32_t piece) { return std::count(pieces_.begin(), pieces_.end(), piece); };
    double longest = 0;
    const std::span<const Vec3> places = simulation_.body().positions();
    simulation_.mesh().for_each_tet([&](TetId t) {
      const TetVertices& v = simulation_.mesh().vertices(t);
      for (const auto& [i, j] : kEdgeCorners) {
        const double rest = (simulation_.mesh().rest(v[i]) - simulation_.mesh().rest(v[j])).norm();
        longest = std::max(longest, (places[v[i].value] - places[v[j].value]).norm() / rest);
      }
    });
    fail("two pieces have become one, of " + std::to_string(size(a)) + " and " + std::to_string(size(b)) +
         " vertices; an edge is now " + number(longest) + " times as long as at rest");
  }
  /// What the steps touched, the engine has looked at (`TouchedCheck`).
  void check_mesh() {
    check(counts_, validate(simulation_.mesh(), ValidateLevel::kCounts));
    if (const double drift = sum_.drift(simulation_); !(drift < kConserved)) {
      fail("a conserved vector is off by " + number(drift));
    }
  }
  void check_geometry() {
    const ValidityReport now = validate(simulation_.mesh(), ValidateLevel::kGeometry);
    check(geometry_, now);
    const double drift = std::abs(now.volume - geometry_.volume) / geometry_.volume;
    if (!(drift <= app::volume_tolerance(scene_.options.engine))) fail("the volume is off by " + number(drift));
  }
  void check(const ValidityReport& input, const ValidityReport& now) {
    const ValidityChange change = compare_with_input(input, now);
    for (std::size_t kind = 0; kind < kViolationKinds; ++kind) {
      if (change.grown[kind] == 0) continue;
      fail("+" + std::to_string(change.grown[kind]) + " " + std::string(name_of(static_cast<ViolationKind>(kind))));
    }
  }

  const SimulationCase& scene_;
  FrameLog log_;
  StepWatch watch_;
  Simulation simulation_;
  Hands hands_;
  ValidityReport counts_, geometry_;
  ConservedSum sum_;
  double mass_ = 0, size_ = 0, floor_ = 0;
  bool was_cutting_ = false;
  std::vector<std::uint32_t> pieces_ = pieces_of(simulation_.mesh());
  std::optional<double> energy_;        // after the last frame
  double peak_ = 0, elastic_peak_ = 0;  // of all energy but gravity's, which has no zero, and of the shape's alone
  Rise journal_rise_, alone_rise_;
  SimulationOutcome out_;
};

/// Whether a scene ends as it did, once more and on two threads.
std::string replay_fault(const SimulationCase& scene, const SimulationOutcome& first) {
  for (const unsigned threads : {1U, 2U}) {
    const SimulationOutcome again = run_simulation(scene, threads);
    if (again.hash != first.hash || again.fault != first.fault) {
      return "run again on " + std::to_string(threads) + " threads it ends otherwise";
    }
  }
  return {};
}

}  // namespace

SimulationOutcome run_simulation(const SimulationCase& scene, unsigned threads, unsigned log_every) {
  return SimulationRun(scene, threads, log_every).run();
}

int soak_simulations(const SimulationLimits& limits) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  std::uint64_t scenes = 0, frames = 0, strokes = 0, failures = 0;
  double fastest = 0, gain = 0, journal_gain = 0;
  for (; scenes < limits.scenes && !(limits.seconds > 0 && elapsed() >= limits.seconds); ++scenes) {
    const SimulationCase scene = random_simulation(limits.first_seed + scenes, limits.frames);
    SimulationOutcome outcome = run_simulation(scene, 1, limits.log_every);
    frames += outcome.frames;
    strokes += scene.strokes.size();
    fastest = std::max(fastest, outcome.fastest);
    gain = std::max(gain, outcome.energy_gain);
    journal_gain = std::max(journal_gain, outcome.journal_gain);
    if (scene.seed % kReplayed == 0) {
      const std::string fault = replay_fault(scene, outcome);
      if (!fault.empty()) outcome.fault = fault;
    }
    if (!outcome.energy_fault.empty()) {
      std::printf("ENERGY seed %llu: %s\n", static_cast<unsigned long long>(scene.seed), outcome.energy_fault.c_str());
      if (limits.judges_energy && outcome.fault.empty()) outcome.fault = outcome.energy_fault;
    }
    if (outcome.fault.empty()) continue;
    ++failures;
    std::printf("FAILED seed %llu: %s\n  %s\n", static_cast<unsigned long long>(scene.seed), outcome.fault.c_str(),
                describe(scene).c_str());
  }
  std::printf(
      "simulate: %llu scenes, %llu frames, %llu strokes, %llu failures, fastest %.3g m/s, gain of energy left alone "
      "%.2g, in a step of the journal %.2g, %.0f s\n",
      static_cast<unsigned long long>(scenes), static_cast<unsigned long long>(frames),
      static_cast<unsigned long long>(strokes), static_cast<unsigned long long>(failures), fastest, gain, journal_gain,
      elapsed());
  return failures == 0 ? 0 : 1;
}

}  // namespace incise::test
