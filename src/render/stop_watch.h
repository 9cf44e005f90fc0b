// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <utility>

namespace incise::inline v0 {
namespace render {

/// Wall time from one lap to the next.
class StopWatch {
 public:
  /// Milliseconds since the last lap, or since it was made.
  double lap() {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double, std::milli> passed = now - std::exchange(last_, now);
    return passed.count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace render
}  // namespace incise::inline v0
