// SPDX-License-Identifier: Apache-2.0
// Random scenes of tissue that is cut while it hangs, is pulled and is pressed: each from one seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incise/engine/simulation.h"
#include "soak/motions.h"

namespace incise::test {

/// How the body is held.
enum class Support : std::uint8_t { kWall, kSprings, kTable };

/// A blade's stroke: where its edge is in the frames from `first` on.
struct FrameStroke {
  unsigned first = 0;
  std::string policy;  ///< in words
  std::vector<std::vector<Vec3>> edges;
  bool is_undone = false;  ///< and done again, after it
};

/// A hook that takes hold of what is nearest to a place at rest, and moves away from there.
struct FrameHook {
  unsigned first = 0, frames = 0;
  Vec3 at_rest = Vec3::Zero();
  Vec3 way = Vec3::Zero();  ///< from where it takes hold to where it lets go
  double radius = 0, stiffness = 0;
};

/// A ball or rod that moves on a line.
struct FrameTool {
  unsigned first = 0, frames = 0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  Vec3 axis = Vec3::Zero();  ///< of a rod; zero: a ball
  double radius = 0;
};

/// A scene of `frames` frames.
struct SimulationCase {
  std::uint64_t seed = 0;
  unsigned frames = 0;
  BodyPlan body;
  SimulationOptions options;
  Support support = Support::kWall;
  std::vector<FrameStroke> strokes;  ///< by time
  std::vector<FrameHook> hooks;
  std::vector<FrameTool> tools;
};

SimulationCase random_simulation(std::uint64_t seed, unsigned frames);

/// All about a case but its poses, in words.
std::string describe(const SimulationCase& scene);

/// What is done to the body: frame by frame, in order.
class Hands {
 public:
  explicit Hands(const SimulationCase& scene) : scene_(scene) {}
  /// `body` as it stands: hooks take hold there.
  FrameInput at(unsigned frame, const Simulation& simulation);

 private:
  const SimulationCase& scene_;
  std::vector<Vec3> grips_ = std::vector<Vec3>(scene_.hooks.size(), Vec3::Zero());  // where hooks took hold
};

}  // namespace incise::test
