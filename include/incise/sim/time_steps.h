// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {

/// Brings `now` to `time` (s) and calls `step(dt)` with equal steps of at most 1 ms, but at most 100 of them: a device
/// that was not read for a second must not stall the thread that reads it.
template <class Step>
void for_time_steps(double& now, double time, const Step& step) {
  const double elapsed = time - now;
  if (!(elapsed > 0) || !std::isfinite(elapsed)) return;
  // A little above 1 ms still is one step: times are sums of rounded numbers.
  const int count = static_cast<int>(std::min(100.0, std::ceil(elapsed / 1.001e-3)));
  for (int i = 0; i < count; ++i) step(elapsed / count);
  now = time;
}

}  // namespace v0
}  // namespace incise
