// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "app/jobs/latency_histogram.h"
#include "incise/core/triple_buffer.h"
#include "incise/sim/haptic_device.h"
#include "incise/sim/haptic_tool.h"

namespace incise {
inline namespace v0 {
namespace app {

struct HapticLoopOptions {
  double rate = 1000;           ///< ticks per second, in [10, 10000]
  bool wants_realtime = false;  ///< SCHED_FIFO where the system permits it, else nothing
  double spin = 0;  ///< s before each deadline that are waited out awake, in [0, 1/rate]; 150e-6 evens jitter
  HapticToolOptions tool;
};

/// Errors: kBadArgument names the first option out of its range.
[[nodiscard]] Status check(const HapticLoopOptions& options);

/// What the loop knows of the tool after a tick: for the physics (where to move the blade) and for display.
struct HapticToolState {
  std::uint64_t tick = 0;  ///< 1, 2, …
  double time = 0;         ///< s since the start
  DeviceState device;
  Vec3 tool_position = Vec3::Zero();  ///< m: what the physics moves its blade to
  Vec3 force = Vec3::Zero();          ///< N on the device
  std::uint64_t snapshot = 0;         ///< serial of the one that was felt
  PassivityReport passivity;
};

/// Times of a loop. Percentiles in µs.
struct HapticLoopStatistics {
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;     ///< deadlines at which the loop was still late from an earlier one: no tick was made
  std::uint64_t snapshots = 0;  ///< taken from the physics
  std::uint64_t refused = 0;    ///< of those, unsound or out of order
  Percentiles compute;          ///< from reading the device to having commanded the force
  Percentiles lateness;         ///< from the deadline to waking up
  bool is_realtime = false;     ///< SCHED_FIFO was asked for and granted
};

/// A thread that renders forces at a steady rate: read the device, take the newest snapshot, tick, command the force.
///
/// `device` must outlive the loop and is used by the loop's thread alone while it runs. The physics (one thread)
/// calls `publish` and `take_tool_state`; `statistics` may be called by any thread, at any time. After the start the
/// loop neither allocates nor locks. A deadline that was slept through is counted, not made up for.
class HapticLoop {
 public:
  explicit HapticLoop(HapticDevice& device, const HapticLoopOptions& options = {});
  HapticLoop(const HapticLoop&) = delete;
  HapticLoop& operator=(const HapticLoop&) = delete;
  /// Stops.
  ~HapticLoop() { stop(); }

  /// Starts the thread; it goes on where it was stopped, with the tool's state and the statistics. One thread only.
  /// Errors: kBadArgument for bad options or where it runs already; kInternal where no thread can be had.
  Status start();
  /// Commands no force, and returns once the thread has ended. Nothing where it does not run.
  void stop();
  [[nodiscard]] bool is_running() const { return thread_.joinable(); }

  /// Hands over the state after a physics step. Physics thread only; wait-free.
  void publish(const HapticSnapshot& snapshot) { snapshots_.publish(snapshot); }
  /// Takes the newest state of the tool, where there is a new one. Physics thread only; wait-free.
  bool take_tool_state() { return states_.take(); }
  [[nodiscard]] const HapticToolState& tool_state() const { return states_.value(); }

  [[nodiscard]] HapticLoopStatistics statistics() const;

 private:
  using Clock = std::chrono::steady_clock;
  void run();
  void tick(double dt);
  void take_snapshot();
  void wait_until(Clock::time_point deadline) const;

  HapticDevice& device_;
  HapticLoopOptions options_;
  TripleBuffer<HapticSnapshot> snapshots_;
  TripleBuffer<HapticToolState> states_;
  HapticTool tool_;        // the loop's thread
  HapticToolState state_;  // the loop's thread
  LatencyHistogram compute_, lateness_;
  std::atomic<std::uint64_t> missed_{0}, taken_{0}, refused_{0};
  std::atomic<bool> should_stop_{false}, is_realtime_{false};
  std::thread thread_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
