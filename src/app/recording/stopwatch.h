// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace incise {
inline namespace v0 {
namespace app {
namespace detail {

/// Milliseconds since its construction.
class Stopwatch {
 public:
  [[nodiscard]] double ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace detail
}  // namespace app
}  // namespace v0
}  // namespace incise
