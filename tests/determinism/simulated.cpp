// SPDX-License-Identifier: Apache-2.0
#include "simulated.h"

#include <cstdio>
#include <limits>
#include <utility>

#include "incise/engine/simulation.h"
#include "incise/mesh/join.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"

namespace incise::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool print(const char* name, unsigned frame, const Simulation& simulation) {
  std::printf("simulated.%s.%u %016llx\n", name, frame, static_cast<unsigned long long>(simulation.hash()));
  return simulation.body().is_finite() && validate(simulation.mesh(), ValidateLevel::kGeometry).ok;
}

SimulationOptions soft_options(unsigned threads) {
  SimulationOptions options;
  options.body.length_unit = 0.05;
  options.body.threads = options.engine.threads = threads;
  options.engine.maintain.work_units = 5000;
  options.materials.fallback.young = 5e3;
  return options;
}

/// A blade that goes down through the middle of the unit cube, swaying.
FrameInput blade_at(unsigned frame) {
  const double t = frame / 20.0, x = 0.47 + 0.04 * t * (1 - t), z = 1.1 - 1.2 * t;
  FrameInput input;
  input.blade = BladePose{{{x, -0.1, z}, {x, 0.5, z - 0.03}, {x, 1.1, z}}, Vec3(0, 0, -1)};
  return input;
}

bool run(const char* name, Simulation& simulation, const std::vector<FrameInput>& inputs) {
  bool is_sound = true;
  for (unsigned i = 0; i < inputs.size(); ++i) {
    is_sound &= simulation.frame(inputs[i]).ok();
    if (i % 10 == 9) is_sound &= print(name, i + 1, simulation);
  }
  return is_sound;
}

void hold_below(Simulation& simulation, double z) {
  simulation.mesh().for_each_vertex([&](VertexId v) {
    if (simulation.mesh().rest(v).z() < z) static_cast<void>(simulation.body().hold(v, kInfinity));
  });
}

/// Held below, pulled at by a hook, pressed on by a ball, and cut to half its depth.
bool run_held(const char* name, SimulationOptions options) {
  Simulation simulation = Simulation::create(TetMesh::build(jittered_cube(5, 11)).value(), std::move(options)).value();
  hold_below(simulation, 0.1);
  std::vector<FrameInput> inputs;
  for (unsigned i = 0; i < 30; ++i) {
    FrameInput input = i < 12 ? blade_at(i) : FrameInput{};
    input.hooks.push_back({1, Vec3(0.9 + 0.01 * i, 0.5, 1), 0.2, 20});
    input.tools = {BallTool{Vec3(0.2, 0.5, 1.4 - 0.01 * i), 0.3}};
    inputs.push_back(std::move(input));
  }
  return run(name, simulation, inputs);
}

/// Falls freely and is cut in two on the way.
bool run_falling(const char* name, SimulationOptions options) {
  Simulation simulation = Simulation::create(TetMesh::build(kuhn_cube(5)).value(), std::move(options)).value();
  std::vector<FrameInput> inputs;
  for (unsigned i = 0; i < 30; ++i) {
    FrameInput input = i < 25 ? blade_at(i) : FrameInput{};
    input.tools = {PlaneTool{Vec3::UnitZ(), -0.5}};
    inputs.push_back(std::move(input));
  }
  return run(name, simulation, inputs);
}

/// Held below and cut level, twice: the parts lie on each other and rub, and a ball rubs on the uppermost; then the
/// last cut is taken back and made again.
bool run_touching(const char* name, SimulationOptions options) {
  options.body.self.on = true;
  options.body.damping = 2;
  Simulation simulation = Simulation::create(TetMesh::build(jittered_cube(5, 12)).value(), std::move(options)).value();
  hold_below(simulation, 0.1);
  const auto level = [](double x, double height) {
    return BladePose{{{x, -0.1, height}, {x, 1.1, height + 0.1}}, Vec3(1, 0, 0)};
  };
  std::vector<FrameInput> inputs;
  for (const double height : {0.63, 0.31}) {
    for (unsigned i = 0; i <= 12; ++i) {
      FrameInput input;
      input.blade = level(-0.1 + 0.1 * i, height);
      inputs.push_back(std::move(input));
    }
    inputs.resize(inputs.size() + 7);
  }
  for (unsigned i = 20; i < 40; ++i) inputs[i].tools = {BallTool{Vec3(0.4 + 0.01 * i, 0.5, 1.2), 0.3}};
  bool is_sound = run(name, simulation, inputs);
  is_sound &= simulation.undo() && simulation.frame({}).ok() && print(name, 41, simulation);
  is_sound &= simulation.redo() && simulation.frame({}).ok() && print(name, 42, simulation);
  return is_sound;
}

/// Bone in the middle of a cube, which is held at one side, cut through with its bone, and drawn by a hook that slips;
/// a second cube falls on it.
bool run_bony(const char* name, SimulationOptions options) {
  TetSoup soup = jittered_cube(5, 12);
  for (const auto& tet : soup.tets) {
    Vec3 centre = Vec3::Zero();
    for (const std::uint32_t v : tet) centre += 0.25 * soup.points[v];
    soup.regions.push_back((centre - Vec3(0.6, 0.5, 0.5)).cwiseAbs().maxCoeff() < 0.3 ? 7 : 0);
  }
  append(kuhn_cube(2), Vec3(0.1, 0.2, 1.05), soup);
  Material bone = options.materials.fallback;
  bone.rigid = true;
  options.materials.by_region = {{7, bone}};
  options.body.self.on = true;
  Simulation simulation = Simulation::create(TetMesh::build(std::move(soup)).value(), std::move(options)).value();
  hold_below(simulation, 0.1);
  std::vector<FrameInput> inputs;
  for (unsigned i = 0; i < 30; ++i) {
    FrameInput input = i < 12 ? blade_at(i) : FrameInput{};
    input.hooks.push_back({1, Vec3(0.9 + 0.02 * i, 0.5, 0.9), 0.3, 50, HookReach::kBall, 0, 2, false});
    inputs.push_back(std::move(input));
  }
  bool is_sound = run(name, simulation, inputs);
  is_sound &= simulation.undo() && simulation.frame({}).ok() && print(name, 31, simulation);
  return is_sound;
}

}  // namespace

bool run_all_simulated(unsigned threads) {
  SimulationOptions tough = soft_options(threads), stiffening = tough, projected = soft_options(threads),
                    paper = soft_options(threads);
  tough.materials.fallback.toughness = 20;
  stiffening.materials.fallback.toughness = 20;
  stiffening.materials.fallback.stiffening = 10;
  stiffening.materials.fallback.rupture = 0.2;
  projected.body.relaxation = Relaxation::kPositionBased;
  paper.engine.cut.profile = Profile::kPaper;
  SimulationOptions fibres = tough, relaxing = soft_options(threads);
  fibres.materials.fallback.fibre = {1, 0.5, 0.2};
  fibres.materials.fallback.fibre_young = 2e4;
  relaxing.materials.fallback.prony = {PronyTerm{0.5, 0.05}, PronyTerm{0.3, 0.6}, {}};
  bool is_sound = run_held("held", soft_options(threads));
  is_sound &= run_held("tough", tough);
  is_sound &= run_held("stiffening", stiffening);
  is_sound &= run_held("fibres", fibres);
  is_sound &= run_held("relaxing", relaxing);
  is_sound &= run_bony("bony", soft_options(threads));
  is_sound &= run_held("projected", projected);
  is_sound &= run_held("paper", paper);
  is_sound &= run_falling("falling", soft_options(threads));
  return is_sound & run_touching("touching", soft_options(threads));
}

}  // namespace incise::test
