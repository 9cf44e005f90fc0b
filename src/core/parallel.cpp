// SPDX-License-Identifier: Apache-2.0
// Blocks of a fixed size go to oneTBB where there is more than one thread; without it they run in order. Threads are
// capped at what the machine has, since oneTBB would complain on stderr.
#include "incise/core/parallel.h"

#include <algorithm>

#if INCISE_WITH_TBB
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>
#endif

namespace incise {
inline namespace v0 {

void parallel_blocks(std::size_t count, unsigned threads,
                     const std::function<void(std::size_t block, std::size_t begin, std::size_t end)>& work) {
  const std::size_t blocks = block_count(count);
  const auto run = [&](std::size_t block) {
    work(block, block * kBlockSize, std::min(count, (block + 1) * kBlockSize));
  };
#if INCISE_WITH_TBB
  if (threads > 1 && blocks > 1) {
    // More than the machine has would change nothing, and oneTBB would say so on stderr.
    tbb::task_arena arena(std::min(static_cast<int>(threads), tbb::info::default_concurrency()));
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, blocks, run); });
    return;
  }
#else
  static_cast<void>(threads);
#endif
  for (std::size_t block = 0; block < blocks; ++block) {
    run(block);
  }
}

#if INCISE_WITH_TBB
struct WorkPair::Arena {
  tbb::task_arena arena{2};
};
#else
struct WorkPair::Arena {};
#endif

WorkPair::WorkPair(unsigned threads) {
#if INCISE_WITH_TBB
  if (threads > 1 && tbb::info::default_concurrency() > 1) arena_ = std::make_unique<Arena>();
#else
  static_cast<void>(threads);
#endif
}

WorkPair::WorkPair(WorkPair&&) noexcept = default;
WorkPair& WorkPair::operator=(WorkPair&&) noexcept = default;
WorkPair::~WorkPair() = default;

void WorkPair::run(const std::function<void()>& first, const std::function<void()>& second) {
#if INCISE_WITH_TBB
  if (arena_ != nullptr) {
    arena_->arena.execute([&] { tbb::parallel_invoke(first, second); });
    return;
  }
#endif
  first();
  second();
}

}  // namespace v0
}  // namespace incise
