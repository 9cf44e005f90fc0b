// SPDX-License-Identifier: Apache-2.0
#include "soak/attack_soak.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <utility>

#include "incise/io/mesh_file.h"
#include "incise/io/mesh_loader.h"
#include "soak/attack_run.h"
#include "soak/attack_strokes.h"
#include "soak/minimise.h"
#include "soak/models.h"
#include "soak/motion_soak.h"
#include "soak/watch.h"
#include "support/bodies.h"

namespace incise::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct AttackSettings {
  const AttackSet* set = nullptr;  // the kinds that there are
  std::uint64_t seed = 1;
  double seconds = 0;       // 0: no such limit
  std::uint64_t cases = 0;  // 0: no such limit; ten of each kind where there is none at all
  std::optional<std::uint64_t> only;
  Words meshes = {"made", "corpus"};
  Words kinds;  // empty: all
  Words options = {"default", "snap0", "raw", "paper"};
  fs::path keep;      // empty: nothing is kept
  double limit = 20;  // s, for one cut
};

// --- what the command line says
// -----------------------------------------------------------------------------------------------

Words split(const std::string& list) {
  Words words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

bool has(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool set(AttackSettings& settings, const std::string& key, const Words& values) {
  if (values.empty()) return false;
  const std::string& value = values.front();
  if (key == "--meshes") {
    settings.meshes = values;
    return true;
  }
  if (key == "--kinds") {
    settings.kinds = split(value);
  } else if (key == "--options") {
    settings.options = split(value);
  } else if (key == "--cases") {
    settings.cases = std::strtoull(value.c_str(), nullptr, 10);
  } else if (key == "--case") {
    settings.only = std::strtoull(value.c_str(), nullptr, 10);
  } else if (key == "--keep") {
    settings.keep = value;
  } else if (key == "--limit") {
    settings.limit = std::atof(value.c_str());
  } else {
    return false;
  }
  return values.size() == 1;
}

bool are_known(const AttackSettings& settings) {
  const auto is_kind = [&](const std::string& name) {
    const auto& kinds = settings.set->kinds;
    return std::any_of(kinds.begin(), kinds.end(), [&](const char* kind) { return name == kind; });
  };
  const auto are_options = [](const std::string& name) {
    return std::any_of(kAttackOptions.begin(), kAttackOptions.end(), [&](const auto& o) { return name == o.name; });
  };
  return std::all_of(settings.kinds.begin(), settings.kinds.end(), is_kind) &&
         std::all_of(settings.options.begin(), settings.options.end(), are_options) && !settings.options.empty();
}

std::optional<AttackSettings> read_settings(const AttackSet& attacks, const Words& arguments) {
  AttackSettings settings;
  settings.set = &attacks;
  for (std::size_t i = 0; i < arguments.size();) {
    const std::string& key = arguments[i++];
    Words values;
    while (i < arguments.size() && arguments[i].rfind("--", 0) != 0) values.push_back(arguments[i++]);
    if (!set(settings, key, values)) return std::nullopt;
  }
  if (const char* seconds = std::getenv("INCISE_SOAK_SECONDS")) settings.seconds = std::atof(seconds);
  if (const char* seed = std::getenv("INCISE_SOAK_SEED")) settings.seed = std::strtoull(seed, nullptr, 10);
  if (!are_known(settings)) return std::nullopt;
  return settings;
}

// --- bodies
// -------------------------------------------------------------------------------------------------------------------

void add_made(std::vector<AttackedBody>& bodies, const char* name, const TetSoup& soup) {
  bodies.emplace_back(name, fs::path(), TetMesh::build(soup).value());
}

void add_made_bodies(std::vector<AttackedBody>& bodies) {
  add_made(bodies, "kuhn_cube(3)", kuhn_cube(3));
  add_made(bodies, "kuhn_cube(5)", kuhn_cube(5));
  add_made(bodies, "kuhn_cube(8)", kuhn_cube(8));
  add_made(bodies, "jittered_cube(4, 1)", jittered_cube(4, 1));
  add_made(bodies, "jittered_cube(6, 2)", jittered_cube(6, 2));
  add_made(bodies, "renumbered(jittered_cube(5, 3), 3)", renumbered(jittered_cube(5, 3), 3));
  add_made(bodies, "ball(6)", ball(6));
}

/// Those without a defect and without flat tets: what a cut may make of others is hard to say.
void add_real_bodies(std::vector<AttackedBody>& bodies) {
  constexpr double kFlat = 1000;  // L/r
  for (const fs::path& path : sound_models()) {
    AttackedBody body(path.filename().string(), path, io::load_mesh(path).value().mesh);
    if (is_spotless(body.before) && body.before.worst_ratio < kFlat) bodies.push_back(std::move(body));
  }
}

bool add_body(std::vector<AttackedBody>& bodies, const std::string& file) {
  Result<io::LoadedMesh> loaded = io::load_mesh(file);
  const std::string fault = !loaded.ok()                    ? loaded.error().message
                            : loaded->mesh.tet_count() == 0 ? file + ": has no tets"
                                                            : "";
  if (fault.empty()) bodies.emplace_back(file, file, std::move(loaded->mesh));
  if (!fault.empty()) std::fprintf(stderr, "%s\n", fault.c_str());
  return fault.empty();
}

/// By the names of files; `made` and `corpus` stand for many.
std::optional<std::vector<AttackedBody>> bodies_of(const Words& names) {
  std::vector<AttackedBody> bodies;
  for (const std::string& name : names) {
    if (name == "made") {
      add_made_bodies(bodies);
    } else if (name == "corpus") {
      add_real_bodies(bodies);
    } else if (!add_body(bodies, name)) {
      return std::nullopt;
    }
  }
  if (bodies.empty()) std::fprintf(stderr, "there are no meshes: set INCISE_CORPUS to a folder with tets/ in it\n");
  if (bodies.empty()) return std::nullopt;
  return bodies;
}

// --- cases
// --------------------------------------------------------------------------------------------------------------------

std::size_t kind_of(const AttackSet& set, std::uint64_t number) {
  return number % set.kinds.size();
}

const AttackOptions& options_of(const AttackSet& set, std::uint64_t number) {
  return kAttackOptions[number / set.kinds.size() % set.options];
}

/// All that a case is made of.
struct AttackCase {
  std::uint64_t number;
  std::size_t kind;
  const char* kind_name;
  const AttackOptions& options;
  const AttackedBody& body;
  std::string name;  ///< says where it comes from
  Attack attack;
};

AttackCase make_case(const AttackSet& set, std::uint64_t seed, std::uint64_t number,
                     const std::vector<AttackedBody>& bodies) {
  Random mixed(seed);
  Random random(mixed.bits() ^ Random(number).bits());
  const std::size_t kind = kind_of(set, number);
  const AttackOptions& options = options_of(set, number);
  const auto last = static_cast<std::int64_t>(bodies.size()) - 1;
  const AttackedBody& body = bodies[static_cast<std::size_t>(random.integer(0, last))];
  const std::string name = std::string(set.kinds[kind]) + " " + options.name + " " + body.name + " seed " +
                           std::to_string(seed) + " case " + std::to_string(number);
  return {number, kind, set.kinds[kind], options, body, name, set.make(kind, body, random)};
}

enum class Verdict : std::uint8_t { kHolds, kFallsShort, kInShapeAlone };

/// Runs a case, and prints a line where it falls short.
Verdict run_case(const AttackCase& a, double limit) {
  watch(a.name);
  const Shortfall found = run_attack(a.body, a.attack, a.options, limit);
  if (found.faults.empty()) return Verdict::kHolds;
  std::printf("%s: %s\n", a.name.c_str(), found.text().c_str());
  return found.is_shape_alone ? Verdict::kInShapeAlone : Verdict::kFallsShort;
}

/// The same in a process of its own, so that a crash or a hang (see watch.h) ends that case alone.
Verdict run_case_apart(const AttackCase& a, double limit) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) return run_case(a, limit);
  if (child == 0) {
    const Verdict verdict = run_case(a, limit);
    std::fflush(nullptr);
    _exit(static_cast<int>(verdict));
  }
  int status = 0;
  if (waitpid(child, &status, 0) == child && WIFEXITED(status)) return static_cast<Verdict>(WEXITSTATUS(status));
  std::printf("%s: the process was killed\n", a.name.c_str());
  return Verdict::kFallsShort;
}

/// Writes what the command needs to do the same, and says how.
void keep(const AttackCase& a, const fs::path& folder) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  std::string stem = a.name.substr(a.name.rfind(" seed "));
  std::replace(stem.begin(), stem.end(), ' ', '-');
  stem = a.kind_name + stem;
  MotionCase motion;
  for (const Stroke& stroke : a.attack.strokes) motion.strokes.push_back({stroke.name, stroke.edges, false});
  const fs::path blade = folder / (stem + ".json"), mesh = a.body.is_made() ? folder / (stem + ".mesh") : a.body.file;
  io::MeshData data;
  data.soup = a.body.soup;
  const bool is_written = write_blade_file(motion, blade) && (!a.body.is_made() || io::write_mesh(mesh, data).ok());
  std::printf(is_written ? "  incise cut %s --blade %s %s\n" : "  cannot write %s, %s\n", mesh.c_str(), blade.c_str(),
              a.options.flags);
}

// --- the campaign
// --------------------------------------------------------------------------------------------------------------------

struct KindTally {
  std::uint64_t cases = 0, counted = 0, falls_short = 0, in_shape_alone = 0;

  void add(const KindTally& other) {
    cases += other.cases;
    counted += other.counted;
    falls_short += other.falls_short;
    in_shape_alone += other.in_shape_alone;
  }
};

class AttackCampaign {
 public:
  AttackCampaign(AttackSettings settings, std::vector<AttackedBody> bodies)
      : settings_(std::move(settings)), bodies_(std::move(bodies)), tally_(settings_.set->kinds.size()) {}

  int run() {
    if (settings_.only) {
      attack(*settings_.only);
    } else {
      for (std::uint64_t number = 0; !is_over(); ++number) {
        if (is_wanted(number)) attack(number);
      }
    }
    return print_table();
  }

 private:
  [[nodiscard]] double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  [[nodiscard]] bool is_over() const {
    const bool is_limited = settings_.cases > 0 || settings_.seconds > 0;
    const std::uint64_t cases = is_limited ? settings_.cases : 10 * settings_.set->kinds.size();
    return (cases > 0 && done_ >= cases) || (settings_.seconds > 0 && elapsed() >= settings_.seconds);
  }
  [[nodiscard]] bool is_wanted(std::uint64_t number) const {
    const AttackSet& set = *settings_.set;
    return (settings_.kinds.empty() || has(settings_.kinds, set.kinds[kind_of(set, number)])) &&
           has(settings_.options, options_of(set, number).name);
  }

  /// One that is repeated alone stays in this process, for the debugger.
  void attack(std::uint64_t number) {
    const AttackCase a = make_case(*settings_.set, settings_.seed, number, bodies_);
    const Verdict verdict = settings_.only ? run_case(a, settings_.limit) : run_case_apart(a, settings_.limit);
    ++done_;
    KindTally& tally = tally_[a.kind];
    ++tally.cases;
    if (a.options.counts_pieces && a.attack.pieces) ++tally.counted;
    if (verdict == Verdict::kHolds) return;
    ++(verdict == Verdict::kInShapeAlone ? tally.in_shape_alone : tally.falls_short);
    if (!settings_.keep.empty()) keep(a, settings_.keep);
  }

  static void print(const char* name, const KindTally& tally) {
    std::printf("%-14s %6llu cases %6llu pieces known %6llu fall short %6llu in shape alone\n", name,
                static_cast<unsigned long long>(tally.cases), static_cast<unsigned long long>(tally.counted),
                static_cast<unsigned long long>(tally.falls_short),
                static_cast<unsigned long long>(tally.in_shape_alone));
  }
  [[nodiscard]] int print_table() const {
    KindTally all;
    for (std::size_t kind = 0; kind < tally_.size(); ++kind) {
      if (tally_[kind].cases > 0) print(settings_.set->kinds[kind], tally_[kind]);
      all.add(tally_[kind]);
    }
    print(settings_.set->name, all);
    std::printf("%s: seed %llu, %zu bodies, %.0f s\n", settings_.set->name,
                static_cast<unsigned long long>(settings_.seed), bodies_.size(), elapsed());
    return all.falls_short == 0 ? 0 : 1;
  }

  AttackSettings settings_;
  std::vector<AttackedBody> bodies_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::uint64_t done_ = 0;
  std::vector<KindTally> tally_;  // by kind
};

int attack_usage(const AttackSet& set) {
  std::fprintf(stderr, "usage: incise_soak %s %s\nkinds:", set.name, kAttackUsage);
  for (const char* kind : set.kinds) std::fprintf(stderr, " %s", kind);
  std::fprintf(stderr, "\noptions:");
  for (const AttackOptions& options : kAttackOptions) std::fprintf(stderr, " %s", options.name);
  std::fprintf(stderr, "\n");
  return 2;
}

}  // namespace

int soak_attacks(const AttackSet& set, const std::vector<std::string>& arguments) {
  std::optional<AttackSettings> settings = read_settings(set, arguments);
  if (!settings) return attack_usage(set);
  std::optional<std::vector<AttackedBody>> bodies = bodies_of(settings->meshes);
  if (!bodies) return 2;
  return AttackCampaign(std::move(*settings), std::move(*bodies)).run();
}

}  // namespace incise::test
