// SPDX-License-Identifier: Apache-2.0
#include "soak/simulations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "support/random_strokes.h"

namespace incise::test {
namespace {

constexpr double kLengthUnit = 0.05;  // m: bodies are about 5 cm wide

template <class T, std::size_t N>
T one_of(Random& random, const std::array<T, N>& choices) {
  return choices[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(N) - 1))];
}

unsigned frames_in(Random& random, unsigned low, unsigned high) {
  return static_cast<unsigned>(random.integer(low, std::max(low, high)));
}

BodyPlan random_plan(Random& random) {
  using Body = BodyPlan::Kind;
  BodyPlan plan;
  plan.kind = one_of(random, std::array{Body::kKuhn, Body::kJittered, Body::kRenumbered, Body::kBall, Body::kPlate});
  plan.n = static_cast<std::uint32_t>(random.integer(3, 6));
  plan.seed = static_cast<std::uint64_t>(random.integer(1, 1000));
  return plan;
}

SimulationOptions random_options(Random& random) {
  SimulationOptions options;
  options.body.length_unit = kLengthUnit;
  options.body.damping = one_of(random, std::array{0.0, 0.0, 0.5, 5.0});
  options.materials.fallback.young = one_of(random, std::array{3e3, 10e3, 30e3, 100e3, 300e3});
  options.materials.fallback.poisson = one_of(random, std::array{0.3, 0.45, 0.45, 0.49});
  if (random.integer(0, 1) == 0) {
    options.materials.fallback.toughness = random.real(1, 300);
    options.materials.fallback.cut_friction = random.real(0, 20);
  }
  options.engine.maintain.work_units = one_of(random, std::array<std::uint64_t, 4>{500, 5000, 50000, kUnlimitedWork});
  options.flat_height = random.integer(0, 2) == 0 ? random.real(0.05, 0.4) : 0;
  return options;
}

std::vector<Vec3> between(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double share) {
  std::vector<Vec3> edge;
  for (std::size_t i = 0; i < a.size(); ++i) edge.emplace_back(a[i] + share * (b[i] - a[i]));
  if (a.front() == a.back()) edge.back() = edge.front();
  return edge;
}

/// A random stroke, straight or wavy, taken in this number of frames.
FrameStroke random_frames(Random& random, const Box& box, unsigned first, unsigned frames) {
  const Stroke stroke = random_stroke(random, box);
  FrameStroke result{first, stroke.name, {}, random.integer(0, 5) == 0};
  const std::size_t parts = stroke.edges.size() - 1;
  for (unsigned i = 0; i <= frames; ++i) {
    const double along = static_cast<double>(i) * static_cast<double>(parts) / frames;
    const std::size_t part = std::min(static_cast<std::size_t>(along), parts - 1);
    result.edges.push_back(between(stroke.edges[part], stroke.edges[part + 1], along - static_cast<double>(part)));
  }
  return result;
}

Vec3 inside(Random& random, const Box& box) {
  return box.lo + (box.hi - box.lo).cwiseProduct(random.point(0, 1));
}

FrameHook random_hook(Random& random, const Box& box, unsigned frames) {
  const double size = (box.hi - box.lo).norm();
  FrameHook hook;
  hook.first = frames_in(random, 5, frames);
  hook.frames = frames_in(random, 20, 200);
  hook.at_rest = inside(random, box);
  hook.way = random.real(0, 0.3) * size * random_direction(random);
  hook.radius = random.real(0.02, 0.2) * size;
  hook.stiffness = one_of(random, std::array{1.0, 10.0, 100.0, 1000.0});
  return hook;
}

FrameTool random_tool(Random& random, const Box& box, unsigned frames) {
  const double size = (box.hi - box.lo).norm();
  FrameTool tool;
  tool.first = frames_in(random, 5, frames);
  tool.frames = frames_in(random, 20, 200);
  tool.radius = random.real(0.05, 0.2) * size;
  const Vec3 way = random_direction(random), middle = inside(random, box);
  tool.from = middle + 0.8 * size * way;
  tool.to = middle + random.real(0.1, 0.4) * size * way;
  if (random.integer(0, 1) == 0) tool.axis = 0.5 * size * random_direction(random);
  return tool;
}

void add_strokes(Random& random, const Box& box, SimulationCase& scene) {
  const unsigned pause = frames_in(random, 10, 120);
  for (unsigned frame = frames_in(random, 5, 30); frame < scene.frames;) {
    const unsigned frames = frames_in(random, 10, 120);
    scene.strokes.push_back(random_frames(random, box, frame, frames));
    frame += frames + 1 + frames_in(random, 1, pause);
  }
}

bool is_on(unsigned frame, unsigned first, unsigned frames) {
  return frame >= first && frame - first < frames;
}

/// Where the vertex stands that is nearest to a place at rest.
Vec3 standing_place(const Simulation& simulation, const Vec3& rest) {
  const TetMesh& mesh = simulation.mesh();
  VertexId nearest;
  double least = HUGE_VAL;
  mesh.for_each_vertex([&](VertexId v) {
    const double distance = (mesh.rest(v) - rest).squaredNorm();
    if (distance >= least) return;
    least = distance;
    nearest = v;
  });
  return nearest.is_valid() ? simulation.body().positions()[nearest.value] : rest;
}

}  // namespace

SimulationCase random_simulation(std::uint64_t seed, unsigned frames) {
  Random random(seed);
  SimulationCase scene;
  scene.seed = seed;
  scene.frames = frames;
  scene.body = random_plan(random);
  scene.options = random_options(random);
  scene.support = one_of(random, std::array{Support::kWall, Support::kWall, Support::kSprings, Support::kTable});
  Box box;
  for (const Vec3& p : make_body(scene.body).points) box.extend(p);
  add_strokes(random, box, scene);
  const unsigned hooks = frames_in(random, 0, 1 + frames / 200), tools = frames_in(random, 0, 1 + frames / 300);
  for (unsigned i = 0; i < hooks; ++i) scene.hooks.push_back(random_hook(random, box, frames));
  for (unsigned i = 0; i < tools; ++i) scene.tools.push_back(random_tool(random, box, frames));
  return scene;
}

std::string describe(const SimulationCase& scene) {
  constexpr std::array<const char*, 3> kSupports = {"held at a wall", "held by springs", "on a table"};
  const Material& m = scene.options.materials.fallback;
  std::array<char, 400> words;
  std::snprintf(
      words.data(), words.size(),
      "%s, %s, %g Pa, Poisson %g, toughness %.3g J/m², friction %.3g N/m, damping %g/s, budget %llu, flat %.3g; "
      "%zu strokes, %zu hooks, %zu tools in %u frames",
      describe(scene.body).c_str(), kSupports[static_cast<std::size_t>(scene.support)], m.young, m.poisson, m.toughness,
      m.cut_friction, scene.options.body.damping,
      static_cast<unsigned long long>(scene.options.engine.maintain.work_units), scene.options.flat_height,
      scene.strokes.size(), scene.hooks.size(), scene.tools.size(), scene.frames);
  return words.data();
}

FrameInput Hands::at(unsigned frame, const Simulation& simulation) {
  FrameInput input;
  for (const FrameStroke& stroke : scene_.strokes) {
    if (is_on(frame, stroke.first, static_cast<unsigned>(stroke.edges.size()))) {
      input.blade = BladePose{stroke.edges[frame - stroke.first], Vec3::Zero()};
    }
  }
  for (std::uint32_t i = 0; i < scene_.hooks.size(); ++i) {
    const FrameHook& hook = scene_.hooks[i];
    if (!is_on(frame, hook.first, hook.frames)) continue;
    if (frame == hook.first) grips_[i] = standing_place(simulation, hook.at_rest);
    const double share = static_cast<double>(frame - hook.first) / hook.frames;
    input.hooks.push_back({i, grips_[i] + share * hook.way, hook.radius, hook.stiffness});
  }
  for (const FrameTool& tool : scene_.tools) {
    if (!is_on(frame, tool.first, tool.frames)) continue;
    const Vec3 place = tool.from + static_cast<double>(frame - tool.first) / tool.frames * (tool.to - tool.from);
    if (tool.axis.isZero(0)) {
      input.tools.emplace_back(BallTool{place, tool.radius});
    } else {
      input.tools.emplace_back(RodTool{place - tool.axis, place + tool.axis, tool.radius});
    }
  }
  return input;
}

}  // namespace incise::test
