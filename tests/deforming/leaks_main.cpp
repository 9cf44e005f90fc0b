// SPDX-License-Identifier: Apache-2.0
// Through-cuts of moving bodies, many at once: do they fall apart, and into nothing else? Prints a row per number of
// steps, and each run that did not come out as it should with what brings it back. Exits with 1 if there was one.
// usage: incise_leaks [--runs N] [--steps 30,120,240] [--seed S] [--stretch 0.25] [--mover solver|field]
//                     [--amplitude 0.1,0.3] [--body beam|cube|ball|shuffled|all] [--motion 0..7] [--snap 0.2]
//                     [--profile incise|paper] [--maintain] [--check-every 1] [--verbose]
// Run i has motion i mod 8 and seed S + i div 8; over `all` bodies and amplitudes they alternate with the seed.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "deforming/leak_run.h"

namespace incise::test {
namespace {

struct Arguments {
  unsigned runs = 48;
  std::vector<double> steps = {30, 120, 240}, amplitudes = {0.1, 0.25, 0.4, 0.6};
  std::vector<BodyKind> bodies = {BodyKind::kBeam};
  LeakSettings settings;
  int motion = -1;  // all of them
  bool is_verbose = false;
};

std::vector<double> numbers(const char* text) {
  std::vector<double> values;
  for (char* end = nullptr; *text != 0; text = *end == ',' ? end + 1 : end) {
    values.push_back(std::strtod(text, &end));
    if (end == text) return {};
  }
  return values;
}

std::vector<BodyKind> bodies(const std::string& name) {
  std::vector<BodyKind> kinds;
  for (unsigned i = 0; i < kBodyKinds; ++i) {
    const auto kind = static_cast<BodyKind>(i);
    if (name == "all" || name == name_of(kind)) kinds.push_back(kind);
  }
  return kinds;
}

/// Takes an option with a value; false where it is none.
bool take(const std::string& name, const char* value, Arguments& a) {
  const double number = std::strtod(value, nullptr);
  if (name == "--runs")
    a.runs = static_cast<unsigned>(number);
  else if (name == "--steps")
    a.steps = numbers(value);
  else if (name == "--seed")
    a.settings.seed = std::strtoull(value, nullptr, 10);
  else if (name == "--stretch")
    a.settings.stretch = number;
  else if (name == "--mover")
    a.settings.mover = std::string(value) == "field" ? Mover::kField : Mover::kSolver;
  else if (name == "--amplitude")
    a.amplitudes = numbers(value);
  else if (name == "--body")
    a.bodies = bodies(value);
  else if (name == "--motion")
    a.motion = static_cast<int>(number);
  else if (name == "--snap")
    a.settings.cut.snap = number;
  else if (name == "--profile")
    a.settings.cut.profile = std::string(value) == "paper" ? Profile::kPaper : Profile::kIncise;
  else if (name == "--check-every")
    a.settings.check_every = static_cast<unsigned>(number);
  else
    return false;
  return true;
}

bool parse(int argc, char** argv, Arguments& a) {
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--maintain") {
      a.settings.maintains = true;
    } else if (name == "--verbose") {
      a.is_verbose = true;
    } else if (i + 1 == argc || !take(name, argv[i + 1], a)) {
      return false;
    } else {
      ++i;
    }
  }
  return !a.steps.empty() && !a.bodies.empty() && !a.amplitudes.empty() && a.motion < static_cast<int>(kMotions);
}

LeakSettings settings_of(const Arguments& a, unsigned run, double steps) {
  LeakSettings settings = a.settings;
  const unsigned turn = a.motion < 0 ? run / kMotions : run;
  settings.steps = static_cast<unsigned>(steps);
  settings.motion = static_cast<Motion>(a.motion < 0 ? run % kMotions : static_cast<unsigned>(a.motion));
  settings.seed += turn;
  settings.body = a.bodies[turn % a.bodies.size()];
  settings.amplitude = a.amplitudes[turn % a.amplitudes.size()];
  return settings;
}

/// What a row of the table is made of.
struct Row {
  unsigned exact = 0, crumbs = 0, joined = 0, extra = 0, invalid = 0, failed = 0;
  std::size_t inverted = 0;
  std::vector<double> volume, turned, up, up_raw, down, speed, front_mean, front_max, engine_ms, solver_ms;

  void add(const LeakResult& r) {
    ++(r.is_exact() ? exact : r.pieces < r.expected ? joined : r.pieces > r.expected ? extra : crumbs);
    invalid += r.invalid > 0 ? 1U : 0U;
    failed += !r.failure.empty() && r.invalid == 0 ? 1U : 0U;
    inverted = std::max(inverted, r.inverted);
    volume.push_back(r.volume_change);
    turned.push_back(r.turned_over);
    up.push_back(100 * r.energy_up);
    up_raw.push_back(100 * r.energy_up_raw);
    down.push_back(100 * r.energy_down);
    speed.push_back(r.speed);
    front_mean.push_back(r.front_mean);
    front_max.push_back(r.front_max);
    engine_ms.push_back(r.engine_ms);
    solver_ms.push_back(r.solver_ms);
  }
};

double greatest(const std::vector<double>& v) {
  return v.empty() ? 0 : *std::max_element(v.begin(), v.end());
}
double mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return v.empty() ? 0 : sum / static_cast<double>(v.size());
}
double median(std::vector<double> v) {
  if (v.empty()) return 0;
  std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

void print_head() {
  std::puts(
      "| steps | exact / crumb / joined / extra | invalid | failed | energy up % median / max (raw max) | down % max | "
      "v max median / max | inverted | volume, turned over % max | front error mean / max (h) | engine ms, solver ms "
      "per run |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|");
}

void print(double steps, const Row& r) {
  std::printf(
      "| %.0f | %u / %u / %u / %u | %u | %u | %.2f / %.2f (%.2f) | %.1f | %.1f / %.1f | %zu | %.2g, %.2g | %.3f / %.2f "
      "| %.0f, "
      "%.0f "
      "|\n",
      steps, r.exact, r.crumbs, r.joined, r.extra, r.invalid, r.failed, median(r.up), greatest(r.up),
      greatest(r.up_raw), greatest(r.down), median(r.speed), greatest(r.speed), r.inverted, 100 * greatest(r.volume),
      100 * greatest(r.turned), mean(r.front_mean), greatest(r.front_max), mean(r.engine_ms), mean(r.solver_ms));
  std::fflush(stdout);
}

bool is_bad(const LeakResult& r) {
  return !r.is_exact() || !r.failure.empty() || r.energy_up > kEnergyRise;
}

void tell(const LeakSettings& s, const LeakResult& r) {
  std::fprintf(stderr,
               "%s --runs 1 --steps %u --seed %llu --motion %u --body %s%s: %zu pieces of %zu, %zu crumbs, %zu tets, "
               "energy up %.2f %% (raw %.2f), front %.3f / %.2f h%s%s\n",
               is_bad(r) ? "BAD" : "ok ", s.steps, static_cast<unsigned long long>(s.seed),
               static_cast<unsigned>(s.motion), name_of(s.body),
               s.mover == Mover::kField ? (" --mover field --amplitude " + std::to_string(s.amplitude)).c_str() : "",
               r.pieces, r.expected, r.crumbs, r.tets, 100 * r.energy_up, 100 * r.energy_up_raw, r.front_mean,
               r.front_max, r.failure.empty() ? "" : ": ", r.failure.c_str());
}

int run(const Arguments& a) {
  unsigned bad = 0;
  print_head();
  for (const double steps : a.steps) {
    Row row;
    for (unsigned i = 0; i < a.runs; ++i) {
      const LeakSettings settings = settings_of(a, i, steps);
      const LeakResult result = run_leak(settings);
      row.add(result);
      bad += is_bad(result) ? 1U : 0U;
      if (a.is_verbose || is_bad(result)) tell(settings, result);
    }
    print(steps, row);
  }
  return bad == 0 ? 0 : 1;
}

}  // namespace
}  // namespace incise::test

int main(int argc, char** argv) {
  incise::test::Arguments arguments;
  if (!incise::test::parse(argc, argv, arguments)) {
    std::fputs("incise_leaks: an option is unknown or lacks its value; see the head of leaks_main.cpp\n", stderr);
    return 2;
  }
  return incise::test::run(arguments);
}
