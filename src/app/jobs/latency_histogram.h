// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "app/jobs/report.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Counts durations in buckets of at most 1.6 % of their value, so that percentiles need no samples and no memory.
///
/// One thread adds, any thread reads meanwhile; a reader may see the last few durations in part. No allocation.
class LatencyHistogram {
 public:
  /// Adds one duration, ns; above 2³² - 1 ns (4.3 s) it counts as that. Cost: a few ns.
  void add(std::uint64_t nanoseconds);
  /// By nearest rank, µs, each the upper end of its bucket but never above `max`, which is exact; all 0 while empty.
  [[nodiscard]] Percentiles microseconds() const;
  [[nodiscard]] std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

 private:
  static constexpr unsigned kSubBits = 6;
  static constexpr std::size_t kBuckets = (32 - kSubBits + 1) << kSubBits;

  static std::size_t bucket_of(std::uint64_t nanoseconds);
  static std::uint64_t upper_end(std::size_t bucket);

  std::array<std::atomic<std::uint64_t>, kBuckets> buckets_{};
  std::atomic<std::uint64_t> count_{0}, max_{0};
};

}  // namespace app
}  // namespace v0
}  // namespace incise
