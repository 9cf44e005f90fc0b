// SPDX-License-Identifier: Apache-2.0
// What relaxation costs: time per tet and iteration by size, on one thread and on two, beside an implicit step of
// Bullet's deformable body in the same run, and what it costs to follow a cut. All take turns; medians over the rounds.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/attributes.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"
#include "incise/sim/body.h"
#include "report.h"
#ifdef INCISE_BENCH_BULLET
#include "bullet_body.h"
#endif

namespace incise::bench {

namespace {

constexpr double kFrame = 1.0 / 60;  // s
constexpr unsigned kSubsteps = 4, kIterations = 5;
constexpr double kYoung = 30e3, kPoisson = 0.45;  // of muscle, about; Bullet is not stable on much softer ones
const Vec3 kSize(0.09, 0.03, 0.03);               // m

constexpr unsigned kRounds = 31;  // half a second of motion

/// A beam that is held at x = 0 and bends under its weight.
struct Beam {
  std::array<std::uint32_t, 3> cells;
  bool beside_bullet = true;
  bool is_shuffled = false;  ///< vertices and tets in any order, as in files
};

std::vector<Beam> beams(bool is_quick) {
  return {
      {{13, 4, 4}}, {{28, 8, 8}}, {{41, 14, 14}, !is_quick}, {{52, 18, 18}, false, true}, {{52, 18, 18}, !is_quick}};
}

template <class T>
void shuffle(std::vector<T>& values) {
  std::mt19937 random(3);
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[random() % i]);
  }
}

TetSoup make_beam(const Beam& beam) {
  TetSoup soup = kuhn_box(Vec3::Zero(), kSize, beam.cells);
  if (!beam.is_shuffled) {
    return soup;
  }
  std::vector<std::uint32_t> place(soup.points.size());
  std::iota(place.begin(), place.end(), 0U);
  shuffle(place);
  const std::vector<Vec3> points = soup.points;
  for (std::size_t i = 0; i < place.size(); ++i) {
    soup.points[place[i]] = points[i];
  }
  for (auto& tet : soup.tets) {
    for (std::uint32_t& vertex : tet) {
      vertex = place[vertex];
    }
  }
  shuffle(soup.tets);
  return soup;
}

std::string number(double value, int digits = 2) {
  return fmt::format("{:.{}f}", value, digits);
}

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Clock, class Work>
double time_ms(Clock&& clock, Work&& work) {
  const double start = clock();
  work();
  return clock() - start;
}

std::vector<VertexId> held_end(const TetMesh& mesh) {
  std::vector<VertexId> held;
  mesh.for_each_vertex([&](VertexId v) {
    if (mesh.rest(v).x() == 0) {
      held.push_back(v);
    }
  });
  return held;
}

Result<DeformableBody> hanging_body(const TetMesh& mesh, unsigned threads) {
  Materials materials;
  materials.fallback.young = kYoung;
  materials.fallback.poisson = kPoisson;
  BodyOptions options;
  options.substeps = kSubsteps;
  options.iterations = kIterations;
  options.sleep_below = 0;  // every tet counts in every iteration
  options.threads = threads;
  Result<DeformableBody> body = DeformableBody::create(mesh, {}, materials, options);
  if (body.ok()) {
    for (const VertexId v : held_end(mesh)) {
      (void)body->hold(v, std::numeric_limits<double>::infinity());
    }
  }
  return body;
}

/// How far the free end hangs below where it was, in mm: that both bodies moved, and alike.
template <class Places>
double sag_mm(const TetMesh& mesh, const Places& places) {
  double lowest = 0;
  mesh.for_each_vertex([&](VertexId v) { lowest = std::max(lowest, mesh.rest(v).z() - places[v.value].z()); });
  return 1e3 * lowest;
}

struct Measurement {
  std::size_t tets = 0;
  bool is_shuffled = false;
  std::vector<double> ms;                  ///< of a frame on one thread: its processor time
  std::vector<double> one_wall, two_wall;  ///< ms by the clock, on one thread and on two
  std::vector<double> bullet_ms;           ///< of one implicit step
  double sag = 0, bullet_sag = 0;
  bool is_same = false;  ///< one thread and two: the same bits

  [[nodiscard]] double ns_per_iteration(double milliseconds) const {
    return 1e6 * milliseconds / static_cast<double>(tets) / (kSubsteps * kIterations);
  }
  [[nodiscard]] double speed_up() const { return median(one_wall) / median(two_wall); }
  [[nodiscard]] double ratio() const { return bullet_ms.empty() ? 0 : median(bullet_ms) / median(ms); }
};

#ifdef INCISE_BENCH_BULLET
std::unique_ptr<BulletBody> make_peer(const TetMesh& mesh) {
  return std::make_unique<BulletBody>(mesh, BulletMaterial{1000, kYoung, kPoisson}, held_end(mesh));
}
#else
/// Stands for Bullet where it is not installed: never made.
struct BulletBody {
  void step(double /*dt*/) {}
  [[nodiscard]] std::vector<Vec3> positions() const { return {}; }
};
std::unique_ptr<BulletBody> make_peer(const TetMesh& /*mesh*/) {
  return nullptr;
}
#endif

/// One frame of each.
void measure_round(DeformableBody& one, DeformableBody& two, BulletBody* bullet, bool counts, Measurement& out) {
  double wall = 0;
  const double ms = time_ms(thread_ms, [&] { wall = time_ms(wall_ms, [&] { (void)one.advance(kFrame); }); });
  const double two_wall = time_ms(wall_ms, [&] { (void)two.advance(kFrame); });
  const double bullet_ms = bullet == nullptr ? 0 : time_ms(thread_ms, [&] { bullet->step(kFrame); });
  if (!counts) {
    return;
  }
  out.ms.push_back(ms);
  out.one_wall.push_back(wall);
  out.two_wall.push_back(two_wall);
  if (bullet != nullptr) {
    out.bullet_ms.push_back(bullet_ms);
  }
}

Measurement measure(const Beam& beam) {
  Measurement out;
  const Result<TetMesh> mesh = TetMesh::build(make_beam(beam));
  Result<DeformableBody> one = hanging_body(*mesh, 1), two = hanging_body(*mesh, 2);
  if (!one.ok() || !two.ok()) {
    return out;
  }
  out.tets = mesh->tet_count();
  out.is_shuffled = beam.is_shuffled;
  const std::unique_ptr<BulletBody> bullet = beam.beside_bullet ? make_peer(*mesh) : nullptr;
  for (unsigned round = 0; round < kRounds; ++round) {
    measure_round(*one, *two, bullet.get(), round > 0, out);  // the first one touches the memory
  }
  out.sag = sag_mm(*mesh, one->positions());
  out.bullet_sag = bullet == nullptr ? 0 : sag_mm(*mesh, bullet->positions());
  out.is_same = one->hash() == two->hash();
  return out;
}

std::vector<Measurement> measure_relaxation(bool is_quick, const std::filesystem::path& folder) {
  Table table(
      "relaxation",
      "Relaxation of a beam that is held at one end: 4 substeps of 5 iterations per 1/60 s; no vertex sleeps. "
      "ns: per tet and iteration, processor time of one thread; ms: of a frame, by the clock; Bullet: one "
      "implicit step of 1/60 s, µs per tet; ratio: that step over our whole frame; sags in mm after half a second",
      {"tets", "order", "ns", "least", "ms one", "ms two", "speed-up", "least/least", "same bits", "Bullet µs/tet",
       "ratio", "sag", "Bullet"});
  std::vector<Measurement> all;
  for (const Beam& beam : beams(is_quick)) {
    const Measurement m = measure(beam);
    if (m.ms.empty()) {
      std::fprintf(stderr, "a body could not be made\n");
      continue;
    }
    const auto least = [](const std::vector<double>& values) {
      return *std::min_element(values.begin(), values.end());
    };
    const bool has_peer = !m.bullet_ms.empty();
    table.add({std::to_string(m.tets), m.is_shuffled ? "any" : "grid", number(m.ns_per_iteration(median(m.ms))),
               number(m.ns_per_iteration(least(m.ms))), number(median(m.one_wall)), number(median(m.two_wall)),
               number(m.speed_up()), number(least(m.one_wall) / least(m.two_wall)), m.is_same ? "yes" : "NO",
               has_peer ? number(1e3 * median(m.bullet_ms) / static_cast<double>(m.tets)) : "-",
               has_peer ? number(m.ratio(), 1) + "×" : "-", number(m.sag, 1),
               has_peer ? number(m.bullet_sag, 1) : "-"});
    all.push_back(m);
  }
  table.print();
  table.write_csv(folder);
  return all;
}

/// How the body is cut that is followed.
struct Cut {
  std::string name;
  bool by_steps;
  bool maintains;
};

/// What following one cut took.
struct Following {
  std::size_t tets = 0;      ///< that the journal's steps take away and put in; a rewired one counts as both
  std::size_t replaced = 0;  ///< that the body took out and put in: also those whose neighbours alone changed
  std::size_t fresh = 0;     ///< vertices put in place
  double ms = 0;             ///< of `DeformableBody::follow`
  double matter_ms = 0;      ///< of following masses and momenta alone, a part of the former

  [[nodiscard]] double ns_per_tet() const { return per_tet(ms); }
  [[nodiscard]] double per_tet(double milliseconds) const {
    return 1e6 * milliseconds / static_cast<double>(std::max<std::size_t>(tets, 1));
  }
};

/// An engine, the body that follows it, and masses and momenta by themselves.
class Follower {
 public:
  Follower(Engine engine, DeformableBody body)
      : engine_(std::move(engine)), body_(std::move(body)), attributes_(engine_.mesh()) {
    (void)attributes_.add(engine_.mesh(), {"mass", Domain::kVertex, 1, Transfer::kConserve, {}, {}});
    (void)attributes_.add(engine_.mesh(), {"momentum", Domain::kVertex, 3, Transfer::kConserve, {}, {}});
  }
  /// Cuts the beam through at a share of its length. Nothing where a call fails.
  std::optional<Following> run(const Cut& cut, double share) {
    out_ = {};
    const bool is_ok = cut.by_steps ? cut_by_steps(share) : cut_at_once(share);
    return is_ok ? std::optional(out_) : std::nullopt;
  }

 private:
  static constexpr unsigned kSteps = 20;

  /// A few degrees off the layers of cells, across the whole beam.
  bool cut_at_once(double share) {
    const Vec3 normal(1, 0.3, 0.2);
    const Vec3 middle(share * kSize.x(), 0.5 * kSize.y(), 0.5 * kSize.z());
    const Result<Stroke> stroke = plane_stroke(rest_bounds(engine_.mesh()), normal, normal.dot(middle));
    return stroke.ok() && engine_.cut(*stroke).ok() && follow();
  }
  bool cut_by_steps(double share) {
    bool is_ok = engine_.begin_stroke(blade_at(share, 0)).ok();
    for (unsigned i = 1; i <= kSteps && is_ok; ++i) {
      is_ok = engine_.step(blade_at(share, static_cast<double>(i) / kSteps)).ok() && follow();
    }
    return is_ok && engine_.end_stroke().ok() && follow();
  }
  /// Comes down from above.
  static BladePose blade_at(double share, double time) {
    const double x = share * kSize.x(), z = kSize.z() * (1.1 - 1.2 * time);
    return {{Vec3(x - 0.002, -0.01, z), Vec3(x + 0.002, 0.04, z)}, Vec3(0, 0, -1)};
  }
  bool follow() {
    for (; seen_ < engine_.journal().position(); ++seen_) {
      const Step& step = engine_.journal().step(seen_);
      out_.tets += step.consumed.size() + step.produced.size() + 2 * step.rewired.size();
    }
    out_.matter_ms += time_ms(thread_ms, [&] { (void)attributes_.follow(engine_.journal(), engine_.mesh()); });
    std::optional<Result<FollowReport>> report;
    out_.ms += time_ms(thread_ms, [&] { report.emplace(body_.follow(engine_.journal(), engine_.mesh())); });
    if (!report->ok()) {
      return false;
    }
    out_.replaced += (*report)->removed_tets + (*report)->added_tets;
    out_.fresh += (*report)->fresh_vertices;
    return true;
  }

  Engine engine_;
  DeformableBody body_;
  Attributes attributes_;
  std::size_t seen_ = 0;
  Following out_;
};

std::optional<Follower> make_follower(const TetMesh& mesh, bool maintains) {
  EngineOptions options;
  options.maintain.merge = options.maintain.improve = maintains;
  Result<Engine> engine = Engine::create(mesh, options);
  Result<DeformableBody> body = hanging_body(mesh, 1);
  if (!engine.ok() || !body.ok() || !body->advance(kFrame).ok()) {
    return std::nullopt;
  }
  return std::optional<Follower>(std::in_place, std::move(engine).value(), std::move(body).value());
}

/// Cuts along the beam, one after the other: the first one is cold, memory grows.
std::vector<Following> follow_cuts(const TetMesh& mesh, const Cut& cut) {
  constexpr unsigned kCuts = 10;
  std::vector<Following> all;
  std::optional<Follower> follower = make_follower(mesh, cut.maintains);
  for (unsigned i = 0; i < kCuts && follower; ++i) {
    if (const auto one = follower->run(cut, 0.1 + 0.8 * i / kCuts)) {
      all.push_back(*one);
    }
  }
  return all;
}

/// Adds a row; returns the nanoseconds per tet.
double measure_cut(const TetMesh& mesh, const Cut& cut, Table& table) {
  const std::vector<Following> all = follow_cuts(mesh, cut);
  if (all.size() < 2) {
    std::fprintf(stderr, "the cut '%s' could not be followed\n", cut.name.c_str());
    return std::numeric_limits<double>::infinity();
  }
  const auto middle = [&](const auto& figure_of) {
    std::vector<double> values;
    for (auto one = all.begin() + 1; one != all.end(); ++one) {
      values.push_back(static_cast<double>(figure_of(*one)));
    }
    return median(values);
  };
  const double cost = middle([](const Following& one) { return one.ns_per_tet(); });
  table.add({std::to_string(mesh.tet_count()), cut.name, number(middle([](const auto& one) { return one.tets; }), 0),
             number(middle([](const auto& one) { return one.replaced; }), 0),
             number(middle([](const auto& one) { return one.fresh; }), 0), number(cost, 1),
             number(middle([](const auto& one) { return one.per_tet(one.matter_ms); }), 1),
             number(all.front().ns_per_tet(), 1), number(middle([](const auto& one) { return one.ms; }))});
  return cost;
}

/// The cost per tet of the dearest cut.
double measure_following(const std::filesystem::path& folder) {
  Table table(
      "relaxation_follow",
      "Following cuts of the beam through the journal, ten along it: medians of the second to the last. tets: "
      "taken away and put in by the journal's steps; replaced: likewise by the body; ns: processor time per tet "
      "of the first kind; of it masses: masses and momenta followed by themselves; ms: of a cut",
      {"body", "cut", "tets", "replaced", "fresh vertices", "ns", "of it masses", "first cut", "ms"});
  double worst = 0;
  for (const Beam& beam : {Beam{{28, 8, 8}}, Beam{{52, 18, 18}}}) {
    const Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), kSize, beam.cells));
    for (const Cut& cut : {Cut{"plane", false, false}, Cut{"plane, maintained", false, true},
                           Cut{"20 steps", true, false}, Cut{"20 steps, maintained", true, true}}) {
      worst = std::max(worst, measure_cut(*mesh, cut, table));
    }
  }
  table.print();
  table.write_csv(folder);
  return worst;
}

std::vector<Acceptance> accept(const std::vector<Measurement>& all, double following) {
  double slowest = 0, ratio = std::numeric_limits<double>::infinity();
  bool is_same = !all.empty();
  for (const Measurement& m : all) {
    slowest = std::max(slowest, m.ns_per_iteration(median(m.ms)));
    is_same = is_same && m.is_same;
    if (!m.bullet_ms.empty()) {
      ratio = std::min(ratio, m.ratio());
    }
  }
  std::vector<Acceptance> lines = {{"relaxation, worst size, ns per tet and iteration on one thread", "≤ 11", "≤ 8",
                                    number(slowest), slowest <= 11}};
  if (std::thread::hardware_concurrency() > 1 && !all.empty()) {
    const double speed_up = all.back().speed_up();
    lines.push_back(
        {"relaxation at the largest size, speed-up on two threads", "≥ 1.8", "-", number(speed_up), speed_up >= 1.8});
  }
  lines.push_back({"relaxation on one thread and on two, the same bits", "yes", "-", is_same ? "yes" : "no", is_same});
  if (ratio < std::numeric_limits<double>::infinity()) {
    lines.push_back({"one implicit step of Bullet's over our frame of 20 iterations, worst size", "≥ 30", "-",
                     number(ratio, 1), ratio >= 30});
  }
  lines.push_back({"following a cut, dearest one, ns per tet taken away or put in", "≤ 70", "-", number(following, 1),
                   following <= 70});
  return lines;
}

constexpr const char* kUsage =
    "usage: bench_relaxation [--out FOLDER] [--quick]\n"
    "Times the relaxation of beams of 1.2k to 101k tets and the following of cuts; --quick measures Bullet on the two\n"
    "smaller ones alone.\n";

int run(int argc, char** argv) {
  std::filesystem::path folder = "bench-results";
  bool is_quick = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--out" && i + 1 < argc) {
      folder = argv[++i];
    } else if (argument == "--quick") {
      is_quick = true;
    } else {
      const bool is_help = argument == "-h" || argument == "--help";
      std::fputs(kUsage, is_help ? stdout : stderr);
      return is_help ? 0 : 2;
    }
  }
#ifdef INCISE_BENCH_BULLET
  std::printf("peer: Bullet %s, btDeformableNeoHookeanForce, implicit, one thread\n", BulletBody::version().c_str());
#else
  std::printf("peer: none (built without Bullet)\n");
#endif
  const std::vector<Measurement> all = measure_relaxation(is_quick, folder);
  report_acceptance("relaxation", accept(all, measure_following(folder)), folder);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
