// SPDX-License-Identifier: Apache-2.0
// What force cuts tissue, and whether the work that goes in comes out: a straight edge goes 15 mm deep into a block of
// 40 × 20 × 20 mm across its width, at 30 mm/s, for tissue from soft to stiff and from brittle to tough, three sizes of
// elements and three frame rates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "incise/engine/simulation.h"
#include "incise/mesh/shapes.h"
#include "report.h"

namespace incise::bench {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHeight = 0.02;  // of the block, and as wide; m
constexpr double kStart = 0.0005, kDepth = 0.015, kSpeed = 0.03;
constexpr double kSettles = 0.001;  // m of the blade's way from the first opening on that do not count as steady

/// What is cut, and how finely.
struct Case {
  double young = 0, toughness = 0;
  unsigned cells = 0;  ///< across the block
  unsigned rate = 0;   ///< frames per second
};

/// What is cut in all cases, but for what `Case` says: tissue that is 24 times as stiff at a stretch of 1.3 as at rest.
Material tissue() {
  Material material;
  material.stiffening = 20;
  return material;
}

struct Choice {
  std::vector<double> young{3e3, 10e3, 30e3, 100e3, 300e3}, toughness{50, 200, 800, 2500}, cells{4, 8, 12},
      rates{30, 60, 120};
  Material material = tissue();
  bool prints_frames = false;
  unsigned iterations = BodyOptions{}.iterations, substeps = BodyOptions{}.substeps;
  std::filesystem::path folder = "build/bench-results";
};

/// Work in J, forces by toughness · length of edge.
struct Figures {
  double peak = 0;     ///< of the force until the tissue first opens
  double steady = 0;   ///< mean force after that
  double swing = 0;    ///< its standard deviation
  double dent = 0;     ///< the blade's way until the tissue opens, m; above 15 mm: it never does
  double hand = 0;     ///< work of the hand at the edge by what it pays for
  double balance = 0;  ///< work at the holds by what it pays for
  std::size_t inverted = 0, cracks = 0;
  double ms = 0;  ///< a frame, mean
};

double wall_area(const TetMesh& mesh) {
  double area = 0;
  mesh.for_each_tet([&](TetId t) {
    for (unsigned side = 0; side < 4; ++side) {
      const Link link = mesh.links(t)[side];
      if (!link.is_boundary() || link.tag() == 0) continue;
      const auto v = mesh.vertices(Side(t, side));
      area += 0.25 * (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).norm();
    }
  });
  return area;
}

Simulation block_of(const Case& what, const Choice& choice) {
  SimulationOptions options;
  options.body.gravity = Vec3::Zero();
  options.body.damping = 2;
  options.body.iterations = choice.iterations;
  options.body.substeps = choice.substeps;
  options.frame_seconds = 1.0 / what.rate;
  options.materials.fallback = choice.material;
  options.materials.fallback.young = what.young;
  options.materials.fallback.toughness = what.toughness;
  Result<TetMesh> mesh =
      TetMesh::build(kuhn_box(Vec3::Zero(), {2 * kHeight, kHeight, kHeight}, {2 * what.cells, what.cells, what.cells}));
  Simulation simulation = Simulation::create(std::move(mesh).value(), options).value();
  simulation.mesh().for_each_vertex([&](VertexId v) {
    const Vec3& p = simulation.mesh().rest(v);
    if (p.z() < 1e-9 || p.x() < 1e-9 || p.x() > 2 * kHeight - 1e-9) (void)simulation.body().hold(v, kInfinity);
  });
  return simulation;
}

/// One frame of the blade, as the figures need it.
struct Moment {
  double depth = 0;  ///< of the edge below the top, m
  double force = 0, at_holds = 0;
  bool yields = false;
};

void sum_up(const std::vector<Moment>& moments, double expected, Figures& figures) {
  const auto opening = std::find_if(moments.begin(), moments.end(), [](const Moment& m) { return m.yields; });
  figures.dent = opening == moments.end() ? kInfinity : opening->depth;
  for (auto m = moments.begin(); m != moments.end() && m <= opening; ++m) {
    figures.peak = std::max(figures.peak, m->force / expected);
  }
  double sum = 0, squares = 0, count = 0;
  bool was_yielding = true;
  for (auto m = opening; m != moments.end(); ++m) {
    if (m->yields && !was_yielding) ++figures.cracks;
    was_yielding = m->yields;
    if (m->depth < figures.dent + kSettles) continue;
    sum += m->force / expected;
    squares += m->force / expected * m->force / expected;
    ++count;
  }
  if (count == 0) return;
  figures.steady = sum / count;
  figures.swing = std::sqrt(std::max(0.0, squares / count - figures.steady * figures.steady));
}

Figures run(const Case& what, const Choice& choice) {
  Simulation simulation = block_of(what, choice);
  const double h = kHeight / what.cells, x = kHeight + 0.31 * h, expected = what.toughness * kHeight;
  const double begin = thread_ms();
  Figures figures;
  std::vector<Moment> moments;
  double work = 0, hand = 0;
  for (unsigned i = 0;; ++i) {
    const double depth = kSpeed * i / what.rate - kStart;
    if (depth > kDepth) break;
    FrameInput input;
    const double z = kHeight - depth;
    input.blade =
        BladePose{{{x, -0.5 * kHeight, z}, {x, 0.5 * kHeight, z}, {x, 1.5 * kHeight, z}}, Vec3(-Vec3::UnitZ())};
    const Result<FrameReport> report = simulation.frame(input);
    if (!report) {
      std::printf("error: %s\n", report.error().message.c_str());
      break;
    }
    Moment m{depth, report->blade.force.norm(), simulation.body().force_on_holds().z(), report->blade.yields};
    const double before = moments.empty() ? 0.0 : moments.back().at_holds;
    work -= 0.5 * (m.at_holds + before) * kSpeed / what.rate;
    figures.inverted = std::max(figures.inverted, simulation.body().count_inverted());
    if (choice.prints_frames) {
      const BodyEnergy e = simulation.body().energy();
      std::printf("%6.2f %8.3f %8.3f %d %8.3f %8.3f %8.3f %zu\n", 1e3 * depth, m.force / expected,
                  -m.at_holds / expected, m.yields ? 1 : 0, 1e3 * work,
                  1e3 * what.toughness * wall_area(simulation.mesh()), 1e3 * (e.elastic + e.kinetic),
                  simulation.body().count_inverted());
    }
    moments.push_back(m);
    hand += report->blade.tool_work;
  }
  figures.ms = (thread_ms() - begin) / static_cast<double>(moments.size());
  sum_up(moments, expected, figures);
  const BodyEnergy energy = simulation.body().energy();  // the springs at the edge have slipped since: they hold none
  const double stored = energy.elastic + energy.kinetic;
  const double paid = what.toughness * wall_area(simulation.mesh()) + stored;
  figures.balance = work / paid;
  figures.hand = hand / paid;
  return figures;
}

std::string cell(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("-");
}

/// How many cases keep to what they must.
struct Tally {
  std::size_t cases = 0, steady = 0, balanced = 0, upright = 0, steady_goal = 0, balanced_goal = 0;

  void add(const Figures& f) {
    ++cases;
    steady += std::abs(f.steady - 1) <= 0.15 ? 1U : 0U;
    steady_goal += std::abs(f.steady - 1) <= 0.05 ? 1U : 0U;
    balanced += std::abs(f.balance - 1) <= 0.15 ? 1U : 0U;
    balanced_goal += std::abs(f.balance - 1) <= 0.05 ? 1U : 0U;
    upright += f.inverted == 0 ? 1U : 0U;
  }
  [[nodiscard]] Acceptance acceptance(const char* figure, std::size_t good) const {
    return {figure, fmt::format("{}", cases), "-", fmt::format("{}", good), good == cases};
  }
};

void run_all(const Choice& choice) {
  Table table("cutting_force", "Force and work of cutting (forces by toughness · length of edge)",
              {"E, kPa", "J, J/m2", "h, mm", "Hz", "J/(E h)", "peak", "steady", "swing", "opens at, mm", "cracks",
               "hand", "balance", "inverted", "ms"});
  Tally tally;
  for (const double young : choice.young) {
    for (const double toughness : choice.toughness) {
      for (const double cells : choice.cells) {
        for (const double rate : choice.rates) {
          const Case what{young, toughness, static_cast<unsigned>(cells), static_cast<unsigned>(rate)};
          const Figures f = run(what, choice);
          const double h = kHeight / cells;
          tally.add(f);
          table.add({cell(1e-3 * young, 0), cell(toughness, 0), cell(1e3 * h, 2), cell(rate, 0),
                     cell(toughness / (young * h), 2), cell(f.peak, 2), cell(f.steady, 2), cell(f.swing, 2),
                     cell(1e3 * f.dent, 1), fmt::format("{}", f.cracks), cell(f.hand, 2), cell(f.balance, 2),
                     fmt::format("{}", f.inverted), cell(f.ms, 1)});
        }
      }
    }
  }
  table.print();
  table.write_csv(choice.folder);
  report_acceptance("cutting_force",
                    {tally.acceptance("steady force within 15 %", tally.steady),
                     tally.acceptance("steady force within 5 % (goal)", tally.steady_goal),
                     tally.acceptance("work balance within 15 %", tally.balanced),
                     tally.acceptance("work balance within 5 % (goal)", tally.balanced_goal),
                     tally.acceptance("no tet inverted", tally.upright)},
                    choice.folder);
}

std::vector<double> numbers_of(const char* text) {
  std::vector<double> numbers;
  std::istringstream in{std::string(text)};
  for (std::string part; std::getline(in, part, ',');) numbers.push_back(std::stod(part));
  return numbers;
}

/// Whether the argument was known.
bool read(std::string_view name, const char* value, Choice& choice) {
  if (name == "--young") {
    choice.young = numbers_of(value);
  } else if (name == "--toughness") {
    choice.toughness = numbers_of(value);
  } else if (name == "--cells") {
    choice.cells = numbers_of(value);
  } else if (name == "--hz") {
    choice.rates = numbers_of(value);
  } else if (name == "--poisson") {
    choice.material.poisson = std::stod(value);
  } else if (name == "--stiffening") {
    choice.material.stiffening = std::stod(value);
  } else if (name == "--rupture") {
    choice.material.rupture = std::stod(value);
  } else if (name == "--iterations") {
    choice.iterations = static_cast<unsigned>(std::stoul(value));
  } else if (name == "--substeps") {
    choice.substeps = static_cast<unsigned>(std::stoul(value));
  } else if (name == "--print") {
    choice.prints_frames = std::stod(value) != 0;
  } else if (name == "--out") {
    choice.folder = value;
  } else {
    return false;
  }
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  Choice choice;
  for (int i = 1; i < count; i += 2) {
    if (i + 1 >= count || !read(arguments[i], arguments[i + 1], choice)) {
      std::fprintf(
          stderr,
          "usage: %s [--young Pa,…] [--toughness J/m2,…] [--cells across,…] [--hz …] [--poisson ν]\n"
          "          [--stiffening b] [--rupture share] [--iterations n] [--substeps n] [--print 1] [--out FOLDER]\n",
          arguments[0]);
      return 2;
    }
  }
  run_all(choice);
  return 0;
}

}  // namespace incise::bench

int main(int count, char** arguments) {
  return incise::bench::main(count, arguments);
}
