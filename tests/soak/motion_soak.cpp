// SPDX-License-Identifier: Apache-2.0
#include "soak/motion_soak.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>

#include "incise/io/mesh_loader.h"
#include "soak/minimise.h"
#include "soak/models.h"
#include "soak/motion_run.h"
#include "soak/motions.h"

namespace incise::test {
namespace {

/// The results of many cases.
class MotionTally {
 public:
  void run(std::uint64_t seed, const std::vector<std::filesystem::path>& models) {
    const MotionCase motion = random_case(seed, models);
    const Outcome outcome = run_case(motion);
    ++cases_;
    strokes_ += outcome.strokes;
    for (unsigned i = 0; i < outcome.strokes; ++i) ++policies_[motion.strokes[i].policy];
    if (outcome.fault == Fault::kNone) return;
    ++failures_;
    std::printf("FAILED seed %llu: %s, snap %g, %s%s: %s\n", static_cast<unsigned long long>(seed),
                describe(motion.body).c_str(), motion.snap, motion.maintains ? "maintained, " : "",
                motion.wave > 0 ? "waving" : "at rest", outcome.text.c_str());
  }
  [[nodiscard]] std::uint64_t cases() const { return cases_; }
  [[nodiscard]] std::uint64_t strokes() const { return strokes_; }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  int print(const char* what) const {
    std::printf("%s: %llu cases, %llu strokes of %zu kinds, %llu failures, %.0f s\n", what,
                static_cast<unsigned long long>(cases_), static_cast<unsigned long long>(strokes_), policies_.size(),
                static_cast<unsigned long long>(failures_), seconds());
    return failures_ == 0 ? 0 : 1;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::uint64_t cases_ = 0, strokes_ = 0, failures_ = 0;
  std::map<std::string, std::uint64_t> policies_;
};

bool is_over(const MotionTally& tally, const MotionLimits& limits) {
  const bool is_limited = limits.cases > 0 || limits.strokes > 0 || limits.seconds > 0;
  const std::uint64_t cases = is_limited ? limits.cases : 100;
  return (cases > 0 && tally.cases() >= cases) || (limits.strokes > 0 && tally.strokes() >= limits.strokes) ||
         (limits.seconds > 0 && tally.seconds() >= limits.seconds);
}

}  // namespace

std::vector<std::filesystem::path> sound_models() {
  constexpr std::size_t kMaxTets = 20000;
  std::vector<std::filesystem::path> models;
  for (const std::filesystem::path& path : corpus_files()) {
    const Result<io::LoadedMesh> loaded = io::load_mesh(path);
    if (loaded.ok() && loaded->mesh.tet_count() > 0 && loaded->mesh.tet_count() <= kMaxTets) models.push_back(path);
  }
  return models;
}

int soak_motions(const MotionLimits& limits, const std::vector<std::filesystem::path>& models) {
  MotionTally tally;
  for (std::uint64_t seed = limits.first_seed; !is_over(tally, limits); ++seed) tally.run(seed, models);
  return tally.print(models.empty() ? "strokes" : "models");
}

int soak_seeds(const std::string& file) {
  std::ifstream lines(file);
  if (!lines) {
    std::fprintf(stderr, "cannot read %s\n", file.c_str());
    return 2;
  }
  MotionTally tally;
  for (std::string line; std::getline(lines, line);) {
    const std::string number = line.substr(0, line.find('#'));
    if (number.find_first_of("0123456789") != std::string::npos) tally.run(std::stoull(number), {});
  }
  return tally.print("seeds");
}

int describe_seeds(const std::vector<std::uint64_t>& seeds, const std::vector<std::filesystem::path>& models) {
  for (const std::uint64_t seed : seeds) {
    std::printf("seed %llu: %s", static_cast<unsigned long long>(seed), describe(random_case(seed, models)).c_str());
  }
  return 0;
}

int minimise_seeds(const std::vector<std::uint64_t>& seeds, const std::vector<std::filesystem::path>& models) {
  for (const std::uint64_t seed : seeds) {
    const MotionCase motion = random_case(seed, models);
    const FailureKind failure = failure_of(motion);
    if (failure.is_none()) {
      std::printf("seed %llu does not fail\n", static_cast<unsigned long long>(seed));
      continue;
    }
    const MotionCase small = minimise(motion, failure);
    const std::string file = "seed-" + std::to_string(seed) + ".json";
    std::printf("seed %llu: %s", static_cast<unsigned long long>(seed), describe(small).c_str());
    std::printf("%s %s\n", write_blade_file(small, file) ? "blade file" : "cannot write", file.c_str());
    if (failure.signal != 0) {
      std::printf("ends with signal %d\n", failure.signal);
    } else {
      std::printf("%s\n", run_case(small).text.c_str());
    }
  }
  return 0;
}

}  // namespace incise::test
