// SPDX-License-Identifier: Apache-2.0
// Buckets as floating-point numbers have them: the exponent and the leading bits of a duration are its bucket.
#include "app/jobs/latency_histogram.h"

#include <algorithm>
#include <bit>

namespace incise {
inline namespace v0 {
namespace app {

namespace {

/// One writer needs no locked addition.
void increase(std::atomic<std::uint64_t>& counter) {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

}  // namespace

std::size_t LatencyHistogram::bucket_of(std::uint64_t nanoseconds) {
  const auto width = static_cast<unsigned>(std::bit_width(nanoseconds));
  if (width <= kSubBits) return static_cast<std::size_t>(nanoseconds);
  const unsigned shift = width - kSubBits - 1;  // the leading kSubBits + 1 bits stay
  return (std::size_t{shift} << kSubBits) + static_cast<std::size_t>(nanoseconds >> shift);
}

std::uint64_t LatencyHistogram::upper_end(std::size_t bucket) {
  if (bucket < (std::size_t{2} << kSubBits)) return bucket;
  const std::size_t shift = (bucket >> kSubBits) - 1;
  const std::uint64_t leading = bucket - (shift << kSubBits);
  return ((leading + 1) << shift) - 1;
}

void LatencyHistogram::add(std::uint64_t nanoseconds) {
  const std::uint64_t duration = std::min<std::uint64_t>(nanoseconds, 0xFFFFFFFFU);
  increase(buckets_[bucket_of(duration)]);
  if (duration > max_.load(std::memory_order_relaxed)) max_.store(duration, std::memory_order_relaxed);
  increase(count_);
}

Percentiles LatencyHistogram::microseconds() const {
  std::array<std::uint64_t, kBuckets> counts{};
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < kBuckets; ++i) total += counts[i] = buckets_[i].load(std::memory_order_relaxed);
  const std::uint64_t longest = max_.load(std::memory_order_relaxed);
  const auto at = [&](std::uint64_t per_mille) {
    const std::uint64_t rank = (total * per_mille + 999) / 1000;
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      seen += counts[i];
      if (seen >= rank) return 1e-3 * static_cast<double>(std::min(upper_end(i), longest));
    }
    return 1e-3 * static_cast<double>(longest);
  };
  if (total == 0) return {};
  return {at(500), at(990), at(999), 1e-3 * static_cast<double>(longest)};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
