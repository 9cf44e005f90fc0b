// SPDX-License-Identifier: Apache-2.0
// Replaces the allocation of the whole program; apart, since GCC takes inlined replacements for a mismatch.
#include "support/allocation.h"

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();
std::atomic<std::size_t> g_allocations{0};
std::atomic<std::size_t> g_last{kNever};  // calls above this fail

}  // namespace

void* operator new(std::size_t size) {
  if (++g_allocations > g_last) throw std::bad_alloc();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace incise::test {

std::size_t allocation_count() {
  return g_allocations;
}
FailingAllocator::FailingAllocator(std::size_t count) {
  g_last = g_allocations + count;
}
FailingAllocator::~FailingAllocator() {
  g_last = kNever;
}

}  // namespace incise::test
