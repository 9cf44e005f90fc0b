// SPDX-License-Identifier: Apache-2.0
// Deadlines lie on a fixed grid of the steady clock, and ticks that were slept through are skipped. All that passes
// between the threads goes through triple buffers and relaxed counters, so that no thread waits for the other.
#include "app/hands/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#endif

namespace incise {
inline namespace v0 {
namespace app {

namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

/// Asks for SCHED_FIFO for the calling thread; whether it was granted.
bool become_realtime() {
#if defined(__linux__)
  sched_param priority{};
  priority.sched_priority = 50;  // above ordinary threads, below the kernel's own
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0;
#else
  return false;
#endif
}

std::uint64_t nanoseconds(std::chrono::steady_clock::duration duration) {
  const auto count = std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
  return count > 0 ? static_cast<std::uint64_t>(count) : 0;
}

void increase(std::atomic<std::uint64_t>& counter, std::uint64_t by) {
  counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

}  // namespace

Status check(const HapticLoopOptions& options) {
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  if (!(options.rate >= 10 && options.rate <= 10000)) return bad("a haptic loop's rate must lie in [10, 10000] per s");
  if (!(options.spin >= 0 && options.spin <= 1 / options.rate)) return bad("the spin must lie in [0, 1/rate] s");
  return check(options.tool);
}

HapticLoop::HapticLoop(HapticDevice& device, const HapticLoopOptions& options)
    : device_(device), options_(options), tool_(options.tool) {}

Status HapticLoop::start() {
  if (is_running()) return Error{ErrorCode::kBadArgument, "the haptic loop runs already", {}};
  if (Status status = check(options_); !status) return status;
  should_stop_ = false;
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error& error) {
    return Error{ErrorCode::kInternal, std::string("no thread for the haptic loop: ") + error.what(), {}};
  }
  return {};
}

void HapticLoop::stop() {
  if (!is_running()) return;
  should_stop_ = true;
  thread_.join();
  thread_ = std::thread();
}

void HapticLoop::wait_until(Clock::time_point deadline) const {
  std::this_thread::sleep_until(
      deadline - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.spin)));
  while (Clock::now() < deadline) {
  }
}

void HapticLoop::take_snapshot() {
  if (!snapshots_.take()) return;
  increase(taken_, 1);
  if (!tool_.accept(snapshots_.value())) increase(refused_, 1);
}

void HapticLoop::tick(double dt) {
  state_.device = device_.read(state_.time);
  take_snapshot();
  // A place that is no number gives no force, and the tool starts anew at the next one.
  const Vec3 place = state_.device.is_live ? state_.device.position : Vec3(Vec3::Constant(kNowhere));
  state_.force = tool_.tick(dt, place, state_.device.velocity);
  device_.command(state_.force);
  ++state_.tick;
  state_.tool_position = tool_.tool_position();
  state_.snapshot = tool_.tissue().snapshot().serial;
  state_.passivity = tool_.passivity();
  states_.publish(state_);
}

void HapticLoop::run() {
  is_realtime_ = options_.wants_realtime && become_realtime();
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / options_.rate));
  const double seconds = 1 / options_.rate;
  const double resumed_at = state_.time;
  const Clock::time_point start = Clock::now();
  Clock::time_point last = start;
  Clock::time_point deadline = start + period;
  while (!should_stop_.load(std::memory_order_relaxed)) {
    wait_until(deadline);
    const Clock::time_point woken = Clock::now();
    lateness_.add(nanoseconds(woken - deadline));
    state_.time = resumed_at + std::chrono::duration<double>(woken - start).count();
    // A late tick followed by one in time would make dampers of a very short dt.
    const double dt = std::chrono::duration<double>(woken - last).count();
    tick(std::clamp(dt, 0.5 * seconds, 10 * seconds));
    last = woken;
    const Clock::time_point done = Clock::now();
    compute_.add(nanoseconds(done - woken));
    deadline += period;
    if (done > deadline) {
      const auto passed = (done - deadline) / period + 1;
      increase(missed_, static_cast<std::uint64_t>(passed));
      deadline += passed * period;
    }
  }
  device_.command(Vec3::Zero());
}

HapticLoopStatistics HapticLoop::statistics() const {
  HapticLoopStatistics statistics;
  statistics.ticks = compute_.count();
  statistics.missed = missed_.load(std::memory_order_relaxed);
  statistics.snapshots = taken_.load(std::memory_order_relaxed);
  statistics.refused = refused_.load(std::memory_order_relaxed);
  statistics.compute = compute_.microseconds();
  statistics.lateness = lateness_.microseconds();
  statistics.is_realtime = is_realtime_;
  return statistics;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
