// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "incise/sim/haptic_tool.h"
#include "incise/sim/pose_track.h"
#include "incise/sim/simulated_operator.h"

namespace incise::test {

/// 10 mm of blade in liver, relaxed at `place`; it cuts along -z, its flat faces x.
inline HapticSnapshot liver_at(const Vec3& place, std::uint64_t serial = 1) {
  HapticSnapshot s;
  s.serial = serial;
  s.touches = true;
  s.tool_position = s.contact_point = place;
  s.compliance.diagonal().setConstant(1.0 / 300);
  s.cutting_direction = -Vec3::UnitZ();
  s.flat_normal = Vec3::UnitX();
  s.engaged_length = 0.01;
  s.toughness = 200;
  s.cut_friction = 20;
  return s;
}

/// Straight from a to b and back within `seconds`, `times` over, resting a moment at both ends.
inline PoseTrack strokes(const Vec3& a, const Vec3& b, double seconds, int times) {
  std::vector<TimedPose> poses;
  for (int i = 0; i < times; ++i) {
    const double start = i * seconds;
    poses.push_back({start, a});
    poses.push_back({start + 0.25 * seconds, 0.5 * (a + b)});
    poses.push_back({start + 0.5 * seconds, b});
    poses.push_back({start + 0.75 * seconds, 0.5 * (a + b)});
  }
  poses.push_back({times * seconds, a});
  return PoseTrack::create(poses).value();
}

/// A position as a sensor with steps of `quantum` tells it.
inline Vec3 quantised(const Vec3& position, double quantum) {
  if (quantum <= 0) return position;
  return {quantum * std::floor(position.x() / quantum + 0.5), quantum * std::floor(position.y() / quantum + 0.5),
          quantum * std::floor(position.z() / quantum + 0.5)};
}

/// What one run of device, tool and physics came to.
struct HapticRun {
  PassivityReport passivity;
  double held_work = 0;        ///< J, summed by the test itself: Σ -F·Δx with the force held over Δx
  double held_minimum = 0;     ///< J
  double sampled_minimum = 0;  ///< J, Σ -F·v·dt, by the test itself
  double largest_force = 0;    ///< N
  double largest_step = 0;     ///< N, between two ticks
  double force_squared = 0;    ///< Σ over ticks
  Vec3 last_position = Vec3::Zero();
};

/// What physics makes of the tool's position; asked once per physics period.
using Physics = std::function<HapticSnapshot(const Vec3& tool, std::uint64_t serial)>;

struct HapticScene {
  Physics physics;
  HapticToolOptions options;
  double seconds = 2;
  double quantum = 0;  ///< m, of the position sensor; velocities are then differences of what it tells
  int period = 17;     ///< ticks per physics step
  int lag = 17;        ///< ticks from the tool position that physics saw to the tick that gets its snapshot
};

/// Runs `device` and a tool at 1 kHz with snapshots that come late.
inline HapticRun run(const HapticScene& scene, HapticDevice& device) {
  constexpr double kDt = 1e-3;
  HapticTool tool(scene.options);
  HapticRun run;
  std::vector<HapticSnapshot> under_way;
  std::size_t arrived = 0;
  Vec3 last = Vec3::Zero(), last_force = Vec3::Zero();
  double sampled = 0;
  const int ticks = static_cast<int>(scene.seconds / kDt);
  for (int i = 0; i < ticks; ++i) {
    const DeviceState state = device.read(kDt * i);
    const Vec3 position = quantised(state.position, scene.quantum);
    const Vec3 displacement = i == 0 ? Vec3(Vec3::Zero()) : Vec3(position - last);
    const Vec3 velocity = scene.quantum > 0 ? Vec3(displacement / kDt) : state.velocity;
    if (i % scene.period == 0)
      under_way.push_back(scene.physics(i == 0 ? position : tool.tool_position(), under_way.size() + 1));
    if (i >= scene.lag && (i - scene.lag) % scene.period == 0) tool.accept(under_way[arrived++]);
    run.held_work -= last_force.dot(displacement);
    run.held_minimum = std::min(run.held_minimum, run.held_work);
    const Vec3 force = tool.tick(kDt, position, velocity);
    sampled -= force.dot(velocity) * kDt;
    run.sampled_minimum = std::min(run.sampled_minimum, sampled);
    run.largest_force = std::max(run.largest_force, force.norm());
    run.largest_step = std::max(run.largest_step, (force - last_force).norm());
    run.force_squared += force.squaredNorm();
    device.command(force);
    last = position;
    last_force = force;
  }
  run.passivity = tool.passivity();
  run.last_position = last;
  return run;
}

/// An elastic wall below z = 0 with `stiffness` (N/m) that does not yield.
inline Physics wall(double stiffness) {
  return [stiffness](const Vec3& tool, std::uint64_t serial) {
    HapticSnapshot s = liver_at(tool, serial);
    s.toughness = s.cut_friction = 1e6;
    s.compliance = Eigen::Matrix3d::Identity() * 1e3;  // along the wall nearly nothing is felt
    s.compliance(2, 2) = 1 / stiffness;
    s.touches = tool.z() < 0;
    s.force = Vec3(0, 0, -stiffness * tool.z());
    return s;
  };
}

/// A hand that presses 5 mm into an elastic wall, over a link that is late each way and loses ticks of the loop.
struct DelayedPress {
  HandOptions hand{0.1, 200, 1};  ///< a light grip that hardly damps
  double wall = 1000;             ///< N/m
  int delay = 3;                  ///< ticks of 1 ms each way
  double lost = 0.01;             ///< share of the ticks
  std::uint64_t seed = 1;
  HapticToolOptions options;
};

/// What came of it, told at the device.
struct DelayedRun {
  double least_energy = 0;  ///< J from the hand, at its least
  double motion = 0;        ///< m, of the hand in the last two of six seconds, in which it is to rest
  double force = 0;         ///< N, its mean then
  PassivityReport passivity;
};

/// A number in [0, 1) by hashing.
inline double share_of(std::uint64_t seed, std::uint64_t tick) {
  std::uint64_t x = (seed + 1) * 0x9E3779B97F4A7C15ULL + tick * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 31U)) * 0x94D049BB133111EBULL;
  return static_cast<double>((x ^ (x >> 29U)) >> 11U) * 0x1p-53;
}

inline DelayedRun run(const DelayedPress& press) {
  constexpr double kDt = 1e-3;
  constexpr int kTicks = 6000, kResting = 4000;
  const PoseTrack plan =
      PoseTrack::create({{0.0, Vec3(0, 0, 0.01)}, {1.0, Vec3(0, 0, -0.005)}, {10.0, Vec3(0, 0, -0.005)}}).value();
  SimulatedOperator hand(plan, press.hand);
  HapticTool tool(press.options);
  const Physics physics = wall(press.wall);
  const auto late = static_cast<std::size_t>(press.delay) + 1;
  std::deque<Vec3> positions(late, Vec3(0, 0, 0.01)), forces(late, Vec3::Zero());
  DelayedRun run;
  Vec3 told = positions.front(), at_device = positions.front(), acting = Vec3::Zero();
  double energy = 0, low = 1, high = -1, since = 0;
  std::uint64_t serial = 0;
  for (int i = 0; i < kTicks; ++i) {
    const Vec3 position = hand.read(kDt * i).position;
    energy -= acting.dot(position - at_device);
    run.least_energy = std::min(run.least_energy, energy);
    at_device = position;
    positions.push_back(quantised(position, 2e-5));
    positions.pop_front();
    since += kDt;
    if (i % 17 == 0) tool.accept(physics(i == 0 ? positions.front() : tool.tool_position(), ++serial));
    if (!(share_of(press.seed, static_cast<std::uint64_t>(i)) < press.lost)) {
      tool.tick(since, positions.front(), (positions.front() - told) / since);
      told = positions.front();
      since = 0;
    }
    forces.push_back(tool.force());
    forces.pop_front();
    acting = forces.front();
    hand.command(acting);
    if (i < kResting) continue;
    low = std::min(low, position.z());
    high = std::max(high, position.z());
    run.force += acting.norm() / (kTicks - kResting);
  }
  run.motion = high - low;
  run.passivity = tool.passivity();
  return run;
}

}  // namespace incise::test
