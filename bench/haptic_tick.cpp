// SPDX-License-Identifier: Apache-2.0
// Force feedback against the clock: what one tick computes, and how late a thread wakes that ticks at 1 kHz.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "app/hands/haptic_loop.h"
#include "incise/sim/simulated_operator.h"
#include "report.h"

namespace incise::bench {

namespace {

using Clock = std::chrono::steady_clock;

/// Liver that a hand presses and cuts: what the physics would say of a tool at `tool`, 10 mm of edge engaged.
HapticSnapshot liver_at(const Vec3& tool, std::uint64_t serial) {
  HapticSnapshot s;
  s.serial = serial;
  s.touches = tool.z() < 0;
  s.tool_position = tool;
  s.compliance << 4e-3, 1e-4, 2e-4, 1e-4, 5e-3, 3e-4, 2e-4, 3e-4, 3e-3;
  s.cutting_direction = -Vec3::UnitZ();
  s.flat_normal = Vec3::UnitX();
  s.engaged_length = 0.01;
  s.toughness = 200;
  s.cut_friction = 20;
  s.force = Vec3(0, 0, std::min(2.2, -300 * tool.z()));
  s.ruptured = s.force.z() >= 2.2;
  return s;
}

/// A hand that goes down 20 mm and up again, once a second.
PoseTrack strokes(int count) {
  std::vector<TimedPose> poses;
  for (int i = 0; i <= count; ++i) {
    poses.push_back({1.0 * i, Vec3(0, 0, 5e-3), Eigen::Quaterniond::Identity(), 0});
    poses.push_back({i + 0.5, Vec3(2e-3, 1e-3, -15e-3), Eigen::Quaterniond::Identity(), 0});
  }
  return PoseTrack::create(std::move(poses)).value();
}

std::vector<std::string> row(const std::string& name, std::uint64_t count, const app::Percentiles& p) {
  return {name,
          std::to_string(count),
          fmt::format("{:.2f}", p.p50),
          fmt::format("{:.2f}", p.p99),
          fmt::format("{:.2f}", p.p999),
          fmt::format("{:.2f}", p.max)};
}

/// Ticks back to back, each timed; the hand moves in between and is not.
app::Percentiles time_ticks(int count, PassivityReport& passivity) {
  SimulatedOperator hand(strokes(count / 1000 + 1));
  HapticTool tool;
  app::LatencyHistogram times;
  for (int i = 0; i < count; ++i) {
    const DeviceState state = hand.read(1e-3 * i);
    const HapticSnapshot snapshot = liver_at(tool.tool_position(), static_cast<std::uint64_t>(i + 1));
    const Clock::time_point start = Clock::now();
    if (i % 17 == 0) tool.accept(snapshot);
    const Vec3 force = tool.tick(1e-3, state.position, state.velocity);
    const Clock::time_point end = Clock::now();
    times.add(static_cast<std::uint64_t>((end - start).count()));
    hand.command(force);
  }
  passivity = tool.passivity();
  return times.microseconds();
}

/// The loop with a physics thread (this one) at 60 Hz beside it.
app::HapticLoopStatistics time_loop(double seconds, bool wants_realtime, double spin) {
  SimulatedOperator hand(strokes(static_cast<int>(seconds) + 2));
  app::HapticLoopOptions options;
  options.wants_realtime = wants_realtime;
  options.spin = spin;
  app::HapticLoop loop(hand, options);
  if (!loop.start().ok()) return {};
  const int steps = static_cast<int>(60 * seconds);
  for (int i = 0; i < steps; ++i) {
    loop.take_tool_state();
    loop.publish(liver_at(loop.tool_state().tool_position, static_cast<std::uint64_t>(i + 1)));
    std::this_thread::sleep_for(std::chrono::microseconds(16667));
  }
  loop.stop();
  return loop.statistics();
}

constexpr const char* kUsage =
    "usage: bench_haptic_tick [--out FOLDER] [--quick]\n"
    "Times the ticks of force feedback, and how late a 1 kHz loop wakes; --quick: a fifth of it.\n";

int run(int argc, char** argv) {
  std::filesystem::path folder = "bench-results";
  double scale = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--out" && i + 1 < argc) {
      folder = argv[++i];
    } else if (argument == "--quick") {
      scale = 0.2;
    } else {
      const bool is_help = argument == "-h" || argument == "--help";
      std::fputs(kUsage, is_help ? stdout : stderr);
      return is_help ? 0 : 2;
    }
  }
  const int ticks = static_cast<int>(1e6 * scale);
  PassivityReport passivity;
  const app::Percentiles tick = time_ticks(ticks, passivity);
  Table table("haptic_tick", "Force feedback: compute time of a tick, and a 1 kHz loop; µs",
              {"what", "count", "p50", "p99", "p99.9", "max"});
  table.add(row("one tick, snapshots at 60 Hz", static_cast<std::uint64_t>(ticks), tick));
  double least_missed = 1;
  const auto add_loop = [&](const std::string& name, bool wants_realtime, double spin) {
    const app::HapticLoopStatistics loop = time_loop(10 * scale, wants_realtime, spin);
    const std::string full = name + (loop.is_realtime ? ", SCHED_FIFO" : ", SCHED_OTHER");
    const double missed = static_cast<double>(loop.missed) / static_cast<double>(loop.ticks + loop.missed);
    table.add(row(full + ": compute", loop.ticks, loop.compute));
    table.add(row(fmt::format("{}: woken late, {:.3f} % missed", full, 100 * missed), loop.ticks, loop.lateness));
    least_missed = std::min(least_missed, missed);
  };
  add_loop("loop", false, 0);
  add_loop("loop, real time asked for", true, 0);
  add_loop("loop, real time asked for, 150 µs spin", true, 150e-6);
  table.print();
  table.write_csv(folder);
  report_acceptance(
      "haptic_tick",
      {{"compute time of a haptic tick, p99.9, µs", "≤ 50", "≤ 10", fmt::format("{:.2f}", tick.p999), tick.p999 <= 50},
       {"lowest observed energy, J", "≥ 0", "-", fmt::format("{:.1e}", passivity.sampled_minimum),
        passivity.sampled_minimum >= 0},
       {"missed deadlines of the best loop, % (on an idle machine)", "< 0.1", "-",
        fmt::format("{:.3f}", 100 * least_missed), least_missed < 1e-3}},
      folder);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
