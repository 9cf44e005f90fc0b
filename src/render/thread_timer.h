// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>
#include <utility>

namespace incise {
inline namespace v0 {
namespace render {

/// Processor time of this thread from one lap to the next: what others do on the same core does not count.
class ThreadTimer {
 public:
  /// Milliseconds since the last lap, or since it was made.
  double lap() {
    const double time = now();
    return time - std::exchange(last_, time);
  }

 private:
  static double now() {
    timespec time{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) != 0) return 0;
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  double last_ = now();
};

}  // namespace render
}  // namespace v0
}  // namespace incise
