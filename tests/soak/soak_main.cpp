// SPDX-License-Identifier: Apache-2.0
// Random strokes without end: on made meshes, or on every readable mesh of $INCISE_CORPUS/tets.
// After each stroke: the validity contract, the input's own defects not grown in number, no drift of volume; after
// each few strokes they are taken back and the hash must be that of the input.
// usage: incise_soak strokes|corpus [--rounds N] [--strokes N] [--max-tets N] [--only NAME] [--skip NAME]
// INCISE_SOAK_SECONDS: go on for so long (unset: one round); INCISE_SOAK_SEED: the first seed, 1 unless given.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cut/bodies.h"
#include "cut/random_strokes.h"
#include "incise/app/mesh_loader.h"
#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/validate.h"

namespace incise::test {
namespace {

namespace fs = std::filesystem;

constexpr int kSkipped = 77;
constexpr double kDrift = 1e-12;
constexpr unsigned kStrokesInARow = 4;

struct Settings {
  std::string kind;
  std::uint64_t seed = 1;
  double seconds = 0;
  unsigned rounds = 0;  // of made meshes
  unsigned strokes = 20;
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

TetSoup to_soup(const TetMesh& mesh) {
  TetSoup soup;
  std::vector<std::uint32_t> number(mesh.vertex_slots());
  mesh.for_each_vertex([&](VertexId v) {
    number[v.value] = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(mesh.rest(v));
  });
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    soup.tets.push_back({number[v[0].value], number[v[1].value], number[v[2].value], number[v[3].value]});
  });
  return soup;
}

struct State {
  ValidityReport validity;
  Defects defects;
};

State examine(const TetMesh& mesh) {
  return {validate(mesh, ValidateLevel::kGeometry), find_defects(to_soup(mesh))};
}

/// Whether a cut may add to a defect: the two lips of a cut coincide, and without snapping nothing keeps a plane from
/// shaving slivers off that are flat by their shape (though positive).
bool may_grow(std::string_view name, const CutOptions& options) {
  return name == "duplicate_vertices" || (name == "zero_volume" && options.snap == 0);
}

/// What a cut made worse, in words; empty where nothing.
std::string what_grew(const State& before, const State& after, const CutOptions& options) {
  std::string text;
  const ValidityChange change = compare_with_input(before.validity, after.validity);
  for (std::size_t kind = 0; kind < kViolationKinds; ++kind) {
    if (change.grown[kind] > 0) {
      text += " +" + std::to_string(change.grown[kind]) + " " + std::string(name_of(static_cast<ViolationKind>(kind)));
    }
  }
  const double drift = std::abs(after.validity.volume - before.validity.volume) / before.validity.volume;
  if (!(drift <= kDrift)) text += " drift " + std::to_string(drift * 1e12) + "e-12";
  const std::vector<NamedDefect> old_list = list_defects(before.defects), list = list_defects(after.defects);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!may_grow(list[i].name, options) && list[i].count > old_list[i].count) {
      text += " " + std::string(list[i].name) + " " + std::to_string(old_list[i].count) + " → " +
              std::to_string(list[i].count);
    }
  }
  return text;
}

struct Tally {
  std::uint64_t bodies = 0, strokes = 0, failures = 0;
};

/// Cuts a body with `count` random strokes, a few in a row from the input each time.
void soak(const TetMesh& mesh, const std::string& name, CutOptions options, std::uint64_t seed, unsigned count,
          const Clock& clock, Tally& tally) {
  EngineOptions engine_options;
  engine_options.cut = options;
  engine_options.maintain.merge = engine_options.maintain.improve = false;  // what cutting alone promises
  Result<Engine> engine = Engine::create(mesh, engine_options);
  const State before = examine(mesh);
  const std::uint64_t hash = mesh.hash();
  const Box box = rest_bounds(mesh);
  Random random(seed);
  ++tally.bodies;
  const auto fail = [&](unsigned i, const Stroke& stroke, const std::string& what) {
    ++tally.failures;
    std::printf("FAILED %s: seed %llu, stroke %u (%s), profile %s, snap %g:%s\n", name.c_str(),
                static_cast<unsigned long long>(seed), i, stroke.name.c_str(),
                options.profile == Profile::kPaper ? "paper" : "incise", options.snap, what.c_str());
    std::fflush(stdout);
  };
  for (unsigned i = 0; i < count && !clock.is_over(); ++i) {
    const Stroke stroke = random_stroke(random, box);
    ++tally.strokes;
    bool is_broken = false;
    if (const Result<StrokeReport> report = engine->cut(stroke); !report.ok()) {
      fail(i, stroke, " " + report.error().message);
      is_broken = true;
    } else if (const std::string grown = what_grew(before, examine(engine->mesh()), options); !grown.empty()) {
      fail(i, stroke, grown);
      is_broken = true;
    }
    if (is_broken || (i + 1) % kStrokesInARow == 0 || i + 1 == count) {
      while (engine->undo()) {
      }
      if (engine->mesh().hash() != hash) {
        fail(i, stroke, " undo does not restore the hash");
        return;
      }
    }
  }
}

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

CutOptions random_options(Random& random) {
  constexpr std::array<double, 5> kSnaps = {0.2, 0.2, 0.1, 0.3, 0.0};
  CutOptions options;
  options.snap = kSnaps[static_cast<std::size_t>(random.integer(0, 4))];
  return options;
}

int soak_made_meshes(const Settings& settings) {
  const Clock clock(settings.seconds);
  Tally tally;
  const unsigned rounds = settings.rounds > 0 ? settings.rounds : (settings.seconds > 0 ? UINT32_MAX : 100);
  for (unsigned round = 0; round < rounds && !clock.is_over(); ++round) {
    const std::uint64_t seed = settings.seed + round;
    Random random(seed);
    Result<TetMesh> mesh = TetMesh::build(random_body(random));
    const CutOptions options = random_options(random);
    soak(*mesh, "made mesh", options, seed, std::min(settings.strokes, 8U), clock, tally);
  }
  std::printf("strokes: %llu bodies, %llu strokes, %llu failures, %.0f s\n",
              static_cast<unsigned long long>(tally.bodies), static_cast<unsigned long long>(tally.strokes),
              static_cast<unsigned long long>(tally.failures), clock.elapsed());
  return tally.failures == 0 ? 0 : 1;
}

// --- real meshes
// --------------------------------------------------------------------------------------------------------------

std::vector<fs::path> corpus_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    // A TetGen mesh is named by either of its files.
    if (entry.is_regular_file() && entry.path().extension() != ".node") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

int soak_corpus(const Settings& settings) {
  const char* root = std::getenv("INCISE_CORPUS");
  if (root == nullptr || !fs::is_directory(fs::path(root) / "tets")) {
    std::printf("INCISE_CORPUS is not set: real meshes are not cut\n");
    return kSkipped;
  }
  const Clock clock(settings.seconds);
  Tally tally;
  std::uint64_t seed = settings.seed;
  do {
    for (const fs::path& path : corpus_files(fs::path(root) / "tets")) {
      const std::string name = path.filename().string();
      const auto is_named = [&](const std::string& part) {
        return !part.empty() && name.find(part) != std::string::npos;
      };
      if (clock.is_over() || (!settings.only.empty() && !is_named(settings.only)) || is_named(settings.skip)) continue;
      const Result<app::LoadedMesh> loaded = app::load_mesh(path);
      if (!loaded.ok()) continue;  // refusals are the readers' tests
      if (loaded->mesh.tet_count() == 0 || loaded->mesh.tet_count() > settings.max_tets) continue;
      const double start = clock.elapsed();
      const std::uint64_t failures = tally.failures;
      CutOptions options;
      soak(loaded->mesh, name, options, seed, settings.strokes, clock, tally);
      options.snap = 0;
      soak(loaded->mesh, name, options, seed + 1000, std::max(1U, settings.strokes / 4), clock, tally);
      std::printf("%-44s %8zu tets %6.1f s %s\n", name.c_str(), loaded->mesh.tet_count(), clock.elapsed() - start,
                  tally.failures == failures ? "" : "FAILED");
      std::fflush(stdout);
    }
    ++seed;
  } while (settings.seconds > 0 && !clock.is_over());
  std::printf("corpus: %llu meshes, %llu strokes, %llu failures, %.0f s\n",
              static_cast<unsigned long long>(tally.bodies / 2), static_cast<unsigned long long>(tally.strokes),
              static_cast<unsigned long long>(tally.failures), clock.elapsed());
  return tally.failures == 0 ? 0 : 1;
}

int usage() {
  std::fprintf(
      stderr,
      "usage: incise_soak strokes|corpus [--rounds N] [--strokes N] [--max-tets N] [--only NAME] [--skip NAME]\n");
  return 2;
}

int run(int argc, char** argv) {
  Settings settings;
  if (argc < 2 || argc % 2 != 0) return usage();
  settings.kind = argv[1];
  for (int i = 2; i + 1 < argc; i += 2) {
    const std::string key = argv[i];
    const auto number = static_cast<unsigned>(std::strtoul(argv[i + 1], nullptr, 10));
    if (key == "--rounds") {
      settings.rounds = number;
    } else if (key == "--strokes") {
      settings.strokes = number;
    } else if (key == "--max-tets") {
      settings.max_tets = number;
    } else if (key == "--only") {
      settings.only = argv[i + 1];
    } else if (key == "--skip") {
      settings.skip = argv[i + 1];
    } else {
      return usage();
    }
  }
  if (const char* seconds = std::getenv("INCISE_SOAK_SECONDS")) settings.seconds = std::atof(seconds);
  if (const char* seed = std::getenv("INCISE_SOAK_SEED")) settings.seed = std::strtoull(seed, nullptr, 10);
  if (settings.kind == "strokes") return soak_made_meshes(settings);
  if (settings.kind == "corpus") return soak_corpus(settings);
  return usage();
}

}  // namespace
}  // namespace incise::test

int main(int argc, char** argv) {
  return incise::test::run(argc, argv);
}
