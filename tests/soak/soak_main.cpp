// SPDX-License-Identifier: Apache-2.0
// Random cuts without end: on made meshes (`cuts`), or on every readable mesh of $INCISE_CORPUS/tets (`corpus`). Each
// body is cut in several courses: without maintenance, with all of it after each stroke, with random budgets and
// portions, as the paper does; the corpus is also maintained as a whole, uncut.
// After each stroke: the validity contract, the input's own defects not grown in number, no drift of volume (by
// course), no tet with L/r > 200 left at the cut where the input had none nearby. After each few strokes they are taken
// back, applied again and taken back one by one, and each time the hash must be what it was. A stroke that takes
// longer than kStrokeSeconds hangs: the program says which one and ends.
// `strokes` moves blades step by step, as people do, through made meshes (motions.h), `models` through those of the
// corpus; `seeds` does it with the seeds of a file, `describe` says what a seed makes, and `minimise` makes a failing
// one small. `attack` makes sheets in many ways of which it is known what must come out (attack_strokes.h), `hands`
// moves blades that shake, turn, dwell and wander (hand_strokes.h), `passes` makes incisions in several passes of
// several strokes (pass_strokes.h). usage: incise_soak strokes|models [--rounds N]
//        incise_soak seeds FILE
//        incise_soak describe|minimise strokes|models SEED...
//        incise_soak simulate [--rounds N] [--frames N] [--log N] [--judge-energy 1]
//        incise_soak compose [--rounds N]
//        incise_soak stability [--every N]
//        incise_soak cuts|corpus [--rounds N] [--strokes N] [--max-tets N] [--only NAME] [--skip NAME]
//        incise_soak attack|hands|passes [--meshes FILE|made|corpus...] [--kinds A,B] [--options A,B] [--cases N]
//        [--case N]
//                                        [--keep FOLDER] [--limit SECONDS]
// INCISE_SOAK_SECONDS: go on for this time (unset: one round); INCISE_SOAK_SEED: the first seed, 1 unless given;
// INCISE_SOAK_STROKES: `strokes` and `models` end after this number of strokes. A failure comes back with the seed that
// it names, `--rounds 1` or `--only NAME`, and the same other arguments.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/cut_job.h"
#include "incise/engine/engine.h"
#include "incise/geom/quality.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/star.h"
#include "incise/mesh/validate.h"
#include "soak/attack_soak.h"
#include "soak/compose_soak.h"
#include "soak/hand_strokes.h"
#include "soak/models.h"
#include "soak/motion_soak.h"
#include "soak/pass_strokes.h"
#include "soak/simulation_run.h"
#include "soak/stability.h"
#include "soak/watch.h"
#include "support/bodies.h"
#include "support/random_strokes.h"

namespace incise::test {
namespace {

namespace fs = std::filesystem;

constexpr int kSkipped = 77;
constexpr unsigned kStrokesInARow = 4;
/// The paper's quality figure counts tets above this L/r as bad. A few stay where walls of several strokes run close
/// together in a coarse body; more than this, and than this share of the tets at cuts, are a failure.
constexpr double kBadTetLr = 200;
constexpr std::size_t kFewBadTets = 10;
constexpr double kBadShare = 0.05;

struct Settings {
  std::uint64_t seed = 1;
  double seconds = 0;
  unsigned rounds = 0;  // of made meshes
  unsigned strokes = 20;
  unsigned frames = 2000;  // of a scene
  unsigned log_every = 0;  // frames
  bool judges_energy = false;
  unsigned every = 1;  // of this number of combinations one is run
  std::size_t max_tets = SIZE_MAX;
  std::string only, skip;  // parts of file names
};

class Clock {
 public:
  explicit Clock(double seconds) : seconds_(seconds) {}
  /// Whether a limited time is over; an unlimited one never is.
  [[nodiscard]] bool is_over() const { return seconds_ > 0 && elapsed() >= seconds_; }
  [[nodiscard]] double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_;
};

struct State {
  ValidityReport validity;
  Defects defects;
};

State examine(const TetMesh& mesh) {
  return {validate(mesh, ValidateLevel::kGeometry), find_defects(to_soup(mesh))};
}

// --- courses
// --------------------------------------------------------------------------------------------------------------------

enum class Upkeep { kNone, kAtOnce, kPortions };

/// How a body is cut.
struct CutCourse {
  const char* name;
  CutOptions cut;
  Upkeep upkeep = Upkeep::kNone;
  unsigned share = 1;  ///< of the corpus campaign's strokes: one in this number

  [[nodiscard]] bool is_paper() const { return cut.profile == Profile::kPaper; }
};

constexpr CutOptions kSnapped{Profile::kIncise, 0.2}, kUnsnapped{Profile::kIncise, 0}, kAsPaper{Profile::kPaper, 0};
constexpr std::array<CutCourse, 6> kCourses = {{{"cut", kSnapped, Upkeep::kNone},
                                                {"cut, no snap", kUnsnapped, Upkeep::kNone, 4},
                                                {"maintained", kSnapped, Upkeep::kAtOnce},
                                                {"maintained, no snap", kUnsnapped, Upkeep::kAtOnce, 2},
                                                {"in portions", kSnapped, Upkeep::kPortions, 2},
                                                {"paper", kAsPaper, Upkeep::kAtOnce, 4}}};

EngineOptions options_of(const CutCourse& course, Random& budget) {
  constexpr std::array<std::uint64_t, 4> kBudgets = {0, 100, 2000, 50000};
  EngineOptions options;
  options.check_step = TouchedCheck();
  options.cut = course.cut;
  options.maintain.merge = options.maintain.improve = course.upkeep != Upkeep::kNone;
  if (course.upkeep == Upkeep::kPortions) {
    options.maintain.work_units = kBudgets[static_cast<std::size_t>(budget.integer(0, 3))];
  }
  return options;
}

/// Whether a cut may add to a defect: the two lips of a cut coincide, and without snapping nothing keeps a plane from
/// shaving slivers off that are flat by their shape (though positive).
bool may_grow(std::string_view name, const CutOptions& options) {
  return name == "duplicate_vertices" || (name == "zero_volume" && options.snap == 0);
}

/// What a cut made worse, in words; empty where nothing.
std::string what_grew(const State& before, const State& after, const CutOptions& options, double drift_limit) {
  std::string text;
  const ValidityChange change = compare_with_input(before.validity, after.validity);
  for (std::size_t kind = 0; kind < kViolationKinds; ++kind) {
    if (change.grown[kind] > 0) {
      text += " +" + std::to_string(change.grown[kind]) + " " + std::string(name_of(static_cast<ViolationKind>(kind)));
    }
  }
  const double drift = std::abs(after.validity.volume - before.validity.volume) / before.validity.volume;
  if (!(drift <= drift_limit)) text += " drift " + std::to_string(drift * 1e12) + "e-12";
  const std::vector<NamedDefect> old_list = list_defects(before.defects), list = list_defects(after.defects);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!may_grow(list[i].name, options) && list[i].count > old_list[i].count) {
      text += " " + std::string(list[i].name) + " " + std::to_string(old_list[i].count) + " → " +
              std::to_string(list[i].count);
    }
  }
  return text;
}

// --- bad tets at the cut
// --------------------------------------------------------------------------------------------------------------------

bool is_bad(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return !(longest_edge_over_inradius(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])) <= kBadTetLr);
}

/// Knows where the input has bad tets, and counts those that maintenance left elsewhere at the cut.
class BadTets {
 public:
  explicit BadTets(const TetMesh& input) : is_excused_(input.vertex_slots()) {
    input.for_each_tet([&](TetId tet) {
      if (!is_bad(input, tet)) return;
      for (const VertexId v : input.vertices(tet)) is_excused_[v.value] = true;
    });
  }
  struct Count {
    std::size_t bad = 0, of = 0;
    [[nodiscard]] bool is_too_many() const {
      return bad > kFewBadTets && static_cast<double>(bad) > kBadShare * static_cast<double>(of);
    }
  };
  Count left(const TetMesh& mesh) {
    Count count;
    mesh.for_each_tet([&](TetId tet) {
      if (!touches_cut(mesh, tet)) return;
      ++count.of;
      if (is_bad(mesh, tet) && !is_excused(mesh, tet)) ++count.bad;
    });
    return count;
  }

 private:
  /// Whether a vertex of a bad tet of the input is near.
  bool is_excused(const TetMesh& mesh, TetId tet) {
    const TetVertices& corners = mesh.vertices(tet);
    return std::any_of(corners.begin(), corners.end(), [&](VertexId corner) {
      const std::vector<TetId>& star = walker_.star(mesh, corner);
      return std::any_of(star.begin(), star.end(), [&](TetId near) { return has_excused(mesh, near); });
    });
  }
  [[nodiscard]] bool has_excused(const TetMesh& mesh, TetId tet) const {
    const TetVertices& v = mesh.vertices(tet);
    return std::any_of(v.begin(), v.end(), [&](VertexId id) {
      const VertexId origin = mesh.origin(id);
      return origin.is_valid() && is_excused_[origin.value];
    });
  }

  std::vector<bool> is_excused_;
  StarWalker walker_;
};

/// Whether a body is skin nearly throughout.
bool is_needle(const TetMesh& mesh) {
  std::size_t interior = 0;
  mesh.for_each_vertex([&](VertexId v) { interior += mesh.shape_of(v) == 0 ? 1U : 0U; });
  return interior * 8 < mesh.vertex_count();
}

// --- one body
// --------------------------------------------------------------------------------------------------------------------

struct StrokeTally {
  std::uint64_t bodies = 0, strokes = 0, bad_tets = 0, failures = 0;
};

/// A body that is cut in one course.
class Soak {
 public:
  Soak(const TetMesh& mesh, std::string name, const CutCourse& course, std::uint64_t seed, StrokeTally& tally)
      : name_(std::move(name)),
        course_(course),
        seed_(seed),
        tally_(tally),
        strokes_(seed),
        budget_(seed + 1000),
        engine_(Engine::create(mesh, options_of(course, budget_)).value()),
        before_(examine(mesh)),
        box_(rest_bounds(mesh)),
        is_bulky_(!is_needle(mesh)),
        bad_tets_(mesh),
        hashes_{mesh.hash()} {
    ++tally.bodies;
  }

  /// `count` random strokes, a few in a row from the input each time.
  void run(unsigned count, const Clock& clock) {
    for (unsigned i = 0; i < count && !clock.is_over(); ++i) {
      const bool is_sound = cut(i);
      if ((!is_sound || (i + 1) % kStrokesInARow == 0 || i + 1 == count) && !go_back()) return;
    }
  }
  /// Maintains the uncut body.
  void improve() {
    begin("improve");
    const bool is_sound = is_done(engine_.improve()) && check();
    hashes_.push_back(engine_.mesh().hash());
    if (is_sound) go_back();
  }

 private:
  void begin(const std::string& what) {
    watch(name_ + ": seed " + std::to_string(seed_) + ", course '" + course_.name + "', " + what);
  }
  bool fail(const std::string& what) {
    ++tally_.failures;
    std::printf("FAILED %s:%s\n", watched(), what.c_str());
    return false;
  }
  bool is_done(const Result<MaintainReport>& report) { return report.ok() || fail(" " + report.error().message); }
  bool cut(unsigned i) {
    const Stroke stroke = random_stroke(strokes_, box_);
    begin("stroke " + std::to_string(i) + " (" + stroke.name + ")");
    ++tally_.strokes;
    if (const Result<StrokeReport> report = engine_.cut(stroke); !report.ok())
      return fail(" " + report.error().message);
    bool is_sound = check();
    if (course_.upkeep == Upkeep::kPortions) is_sound = is_sound && maintain_in_portions();
    hashes_.push_back(engine_.mesh().hash());
    return is_sound;
  }
  /// Portions of any size; sometimes the rest is left for the next stroke.
  bool maintain_in_portions() {
    constexpr std::array<std::uint64_t, 4> kPortions = {1, 100, 3000, 30000};
    for (auto i = budget_.integer(0, 12); i > 0 && engine_.has_maintenance(); --i) {
      if (!is_done(engine_.maintain(kPortions[static_cast<std::size_t>(budget_.integer(0, 3))]))) return false;
    }
    if (!check()) return false;
    if (budget_.integer(0, 2) == 0) return true;
    if (!is_done(engine_.maintain())) return false;
    return engine_.has_maintenance() ? fail(" maintenance without a budget left work") : check();
  }
  bool check() {
    const std::string grown = what_grew(before_, examine(engine_.mesh()), course_.cut, drift_limit());
    if (!grown.empty()) return fail(grown);
    const bool is_done = course_.upkeep != Upkeep::kNone && !course_.is_paper() && !engine_.has_maintenance();
    return !is_done || is_fit();
  }
  /// Whether maintenance left next to no bad tets; nothing is asked of needles, of bodies with flat tets at load, and
  /// of those that fold over themselves, which are not maintained.
  bool is_fit() {
    const BadTets::Count left = bad_tets_.left(engine_.mesh());
    tally_.bad_tets += left.bad;
    if (left.bad == 0) return true;
    const std::string text =
        " " + std::to_string(left.bad) + " of " + std::to_string(left.of) + " tets at cuts have L/r > 200";
    const TetMesh& mesh = engine_.mesh();
    const bool is_judged = is_bulky_ && mesh.flat_at_load().empty() && !mesh.folds_over_at_load();
    if (is_judged && left.is_too_many()) return fail(text);
    std::printf("note %s:%s\n", watched(), text.c_str());
    return true;
  }
  /// What a job allows per operation. The paper's maintenance pulls curved skin flat: of bodies that are skin nearly
  /// throughout, and where all of the skin is maintained, nothing is promised.
  [[nodiscard]] double drift_limit() const {
    const double limit = app::volume_tolerance(engine_.options());
    if (!course_.is_paper()) return limit;
    return is_bulky_ && engine_.stroke_count() > 0 ? limit * (1 + engine_.stroke_count()) : HUGE_VAL;
  }
  /// All back, all again, and back one by one; the hash tells.
  bool go_back() {
    go_on_watching();
    while (engine_.undo()) {
    }
    bool is_same = engine_.mesh().hash() == hashes_.front();
    for (std::size_t i = 1; i < hashes_.size(); ++i) is_same = is_same && engine_.redo() && has_hash(i);
    for (std::size_t i = hashes_.size() - 1; i > 0; --i) is_same = is_same && engine_.undo() && has_hash(i - 1);
    hashes_.resize(1);
    stop_watching();
    return is_same || fail(" undo and redo do not restore the hash");
  }
  [[nodiscard]] bool has_hash(std::size_t i) const { return engine_.mesh().hash() == hashes_[i]; }

  std::string name_;
  CutCourse course_;
  std::uint64_t seed_;
  StrokeTally& tally_;
  Random strokes_, budget_;
  Engine engine_;
  State before_;
  Box box_;
  bool is_bulky_;
  BadTets bad_tets_;
  std::vector<std::uint64_t> hashes_;  // of the input, and after each stroke
};

// --- made meshes
// --------------------------------------------------------------------------------------------------------------

TetSoup random_body(Random& random) {
  const auto n = static_cast<std::uint32_t>(random.integer(2, 6));
  const auto seed = static_cast<std::uint64_t>(random.integer(1, 1000));
  switch (random.integer(0, 4)) {
    case 0:
      return kuhn_cube(n);
    case 1:
      return ball(2 * std::max(2U, n / 2));
    case 2:
      return kuhn_box(Vec3(-3, -2, 5), Vec3(-3 + 2.0 * n, 2, 5.5), {4 * n, 8, 1});
    case 3:
      return renumbered(jittered_cube(n, seed), seed);
    default:
      return jittered_cube(n, seed);
  }
}

CutCourse random_course(Random& random) {
  constexpr std::array<double, 5> kSnaps = {0.2, 0.2, 0.1, 0.3, 0.0};
  CutCourse course = kCourses[static_cast<std::size_t>(random.integer(0, 5))];
  if (!course.is_paper()) course.cut.snap = kSnaps[static_cast<std::size_t>(random.integer(0, 4))];
  return course;
}

void print_tally(const char* what, std::uint64_t bodies, const StrokeTally& tally, const Clock& clock) {
  std::printf("%s: %llu bodies, %llu strokes, %llu bad tets left at cuts, %llu failures, %.0f s\n", what,
              static_cast<unsigned long long>(bodies), static_cast<unsigned long long>(tally.strokes),
              static_cast<unsigned long long>(tally.bad_tets), static_cast<unsigned long long>(tally.failures),
              clock.elapsed());
}

int soak_made_meshes(const Settings& settings) {
  const Clock clock(settings.seconds);
  StrokeTally tally;
  const unsigned rounds = settings.rounds > 0 ? settings.rounds : (settings.seconds > 0 ? UINT32_MAX : 100);
  for (unsigned round = 0; round < rounds && !clock.is_over(); ++round) {
    const std::uint64_t seed = settings.seed + round;
    Random random(seed);
    Result<TetMesh> mesh = TetMesh::build(random_body(random));
    Soak(*mesh, "made mesh", random_course(random), seed, tally).run(std::min(settings.strokes, 8U), clock);
  }
  print_tally("cuts", tally.bodies, tally, clock);
  return tally.failures == 0 ? 0 : 1;
}

// --- real meshes
// --------------------------------------------------------------------------------------------------------------

/// Every course of one real mesh.
void soak_real_mesh(const TetMesh& mesh, const std::string& name, const Settings& settings, std::uint64_t seed,
                    const Clock& clock, StrokeTally& tally) {
  for (const CutCourse& course : kCourses) {
    // Cuts of the paper profile make bodies that touch themselves worse, maintained or not.
    if (course.is_paper() && mesh.touched_itself_at_load()) continue;
    Soak soak(mesh, name, course, seed, tally);
    soak.run(std::max(1U, settings.strokes / course.share), clock);
    if (course.upkeep == Upkeep::kAtOnce && !mesh.folds_over_at_load()) soak.improve();
  }
}

int skip_without_corpus() {
  std::printf("INCISE_CORPUS is not set: real meshes are not cut\n");
  return kSkipped;
}

int soak_corpus(const Settings& settings) {
  const std::vector<fs::path> files = corpus_files();
  if (files.empty()) return skip_without_corpus();
  const Clock clock(settings.seconds);
  StrokeTally tally;
  std::uint64_t seed = settings.seed;
  do {
    for (const fs::path& path : files) {
      const std::string name = path.filename().string();
      const auto is_named = [&](const std::string& part) {
        return !part.empty() && name.find(part) != std::string::npos;
      };
      if (clock.is_over() || (!settings.only.empty() && !is_named(settings.only)) || is_named(settings.skip)) continue;
      const Result<io::LoadedMesh> loaded = io::load_mesh(path);
      if (!loaded.ok()) continue;  // refusals are the readers' tests
      if (loaded->mesh.tet_count() == 0 || loaded->mesh.tet_count() > settings.max_tets) continue;
      const double start = clock.elapsed();
      const std::uint64_t failures = tally.failures;
      soak_real_mesh(loaded->mesh, name, settings, seed, clock, tally);
      std::printf("%-44s %8zu tets %6.1f s %s\n", name.c_str(), loaded->mesh.tet_count(), clock.elapsed() - start,
                  tally.failures == failures ? "" : "FAILED");
    }
    ++seed;
  } while (settings.seconds > 0 && !clock.is_over());
  print_tally("corpus", tally.bodies, tally, clock);
  return tally.failures == 0 ? 0 : 1;
}

int usage() {
  std::fprintf(stderr,
               "usage: incise_soak strokes|models [--rounds N]\n"
               "       incise_soak seeds FILE\n"
               "       incise_soak describe|minimise strokes|models SEED...\n"
               "       incise_soak simulate [--rounds N] [--frames N] [--log N] [--judge-energy 1]\n"
               "       incise_soak compose [--rounds N]\n"
               "       incise_soak stability [--every N]\n"
               "       incise_soak cuts|corpus [--rounds N] [--strokes N] [--max-tets N] [--only NAME] [--skip NAME]\n"
               "       incise_soak attack|hands|passes %s\n",
               kAttackUsage);
  return 2;
}

bool set(Settings& settings, const std::string& key, const char* value) {
  const auto number = static_cast<unsigned>(std::strtoul(value, nullptr, 10));
  if (key == "--rounds") {
    settings.rounds = number;
  } else if (key == "--strokes") {
    settings.strokes = number;
  } else if (key == "--frames") {
    settings.frames = number;
  } else if (key == "--judge-energy") {
    settings.judges_energy = number != 0;
  } else if (key == "--log") {
    settings.log_every = number;
  } else if (key == "--every") {
    settings.every = std::max(1U, number);
  } else if (key == "--max-tets") {
    settings.max_tets = number;
  } else if (key == "--only") {
    settings.only = value;
  } else if (key == "--skip") {
    settings.skip = value;
  } else {
    return false;
  }
  return true;
}

/// The bodies of a campaign of moving blades; none: made ones.
std::vector<fs::path> models_of(const std::string& kind) {
  return kind == "models" ? sound_models() : std::vector<fs::path>();
}

/// Without a limit, a hundred scenes.
int soak_scenes(const Settings& settings) {
  const std::uint64_t scenes = settings.rounds > 0 ? settings.rounds : (settings.seconds > 0 ? UINT64_MAX : 100);
  return soak_simulations(
      {settings.seed, scenes, settings.frames, settings.seconds, settings.judges_energy, settings.log_every});
}

int run_campaign(const std::string& kind, Settings settings) {
  if (const char* seconds = std::getenv("INCISE_SOAK_SECONDS")) settings.seconds = std::atof(seconds);
  if (const char* seed = std::getenv("INCISE_SOAK_SEED")) settings.seed = std::strtoull(seed, nullptr, 10);
  if (kind == "cuts") return soak_made_meshes(settings);
  if (kind == "corpus") return soak_corpus(settings);
  if (kind == "compose") return soak_compositions({settings.seed, settings.rounds, settings.seconds});
  if (kind == "stability") return soak_stability(settings.every);
  if (kind == "simulate") return soak_scenes(settings);
  if (kind != "strokes" && kind != "models") return usage();
  MotionLimits limits{settings.seed, settings.rounds, 0, settings.seconds};
  if (const char* strokes = std::getenv("INCISE_SOAK_STROKES")) limits.strokes = std::strtoull(strokes, nullptr, 10);
  const std::vector<fs::path> models = models_of(kind);
  if (kind == "models" && models.empty()) return skip_without_corpus();
  return soak_motions(limits, models);
}

std::vector<std::uint64_t> numbers(const std::vector<std::string>& words) {
  std::vector<std::uint64_t> result;
  for (const std::string& word : words) result.push_back(std::strtoull(word.c_str(), nullptr, 10));
  return result;
}

int run(const std::vector<std::string>& arguments) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // nothing is lost in a crash
  start_watch();
  if (arguments.empty()) return usage();
  const std::string& kind = arguments[0];
  for (const AttackSet* set : {&kAttacks, &kHands, &kPasses}) {
    if (kind == set->name) return soak_attacks(*set, {arguments.begin() + 1, arguments.end()});
  }
  if (kind == "seeds") return arguments.size() == 2 ? soak_seeds(arguments[1]) : usage();
  if (kind == "describe" || kind == "minimise") {
    if (arguments.size() < 3) return usage();
    const std::vector<std::uint64_t> seeds = numbers({arguments.begin() + 2, arguments.end()});
    const std::vector<fs::path> models = models_of(arguments[1]);
    return kind == "minimise" ? minimise_seeds(seeds, models) : describe_seeds(seeds, models);
  }
  Settings settings;
  if (arguments.size() % 2 == 0) return usage();
  for (std::size_t i = 1; i < arguments.size(); i += 2) {
    if (!set(settings, arguments[i], arguments[i + 1].c_str())) return usage();
  }
  return run_campaign(kind, settings);
}

}  // namespace
}  // namespace incise::test

int main(int argc, char** argv) {
  return incise::test::run({argv + 1, argv + argc});
}
