// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace incise {
inline namespace v0 {

/// Elements per block of `parallel_blocks`: fixed, so that results that depend on blocks do not depend on threads.
inline constexpr std::size_t kBlockSize = std::size_t{1} << 15U;

/// The number of blocks of `count` elements.
constexpr std::size_t block_count(std::size_t count) {
  return (count + kBlockSize - 1) / kBlockSize;
}

/// Calls `work(block, begin, end)` for every block of [0, count), on up to `threads` threads (1: in order, on this
/// one).
///
/// Blocks must not depend on each other. `work` must not throw. Without oneTBB (WebAssembly) it runs on one thread.
/// Cost: a few µs for starting, where there is more than one block and thread.
void parallel_blocks(std::size_t count, unsigned threads,
                     const std::function<void(std::size_t block, std::size_t begin, std::size_t end)>& work);

/// Runs two pieces of work at once, again and again.
///
/// The work must not throw, and neither piece may depend on the other. Without oneTBB (WebAssembly), or with one
/// thread, they run one after the other. Cost: about 1 µs per call once the second thread is awake.
class WorkPair {
 public:
  /// On up to `threads` threads, at least 1; more than two are of no use.
  explicit WorkPair(unsigned threads);
  WorkPair(WorkPair&&) noexcept;
  WorkPair& operator=(WorkPair&&) noexcept;
  ~WorkPair();

  /// Runs both and waits for both.
  void run(const std::function<void()>& first, const std::function<void()>& second);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace v0
}  // namespace incise
