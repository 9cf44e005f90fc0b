// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace incise::test {

/// How often this program has called operator new so far, on any thread. Programs that ask list
/// `allocation.cpp` among their own sources: it replaces operator new.
[[nodiscard]] std::size_t allocation_count();

/// While it lives, the calls of operator new after the first `count` throw std::bad_alloc. One at a time.
class FailingAllocator {
 public:
  explicit FailingAllocator(std::size_t count);
  FailingAllocator(const FailingAllocator&) = delete;
  FailingAllocator& operator=(const FailingAllocator&) = delete;
  ~FailingAllocator();
};

}  // namespace incise::test
