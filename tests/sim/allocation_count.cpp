// SPDX-License-Identifier: Apache-2.0
// Replaces the allocation of the whole program; apart, since GCC takes inlined replacements for a mismatch.
#include "sim/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> g_allocations{0};

}  // namespace

void* operator new(std::size_t size) {
  ++g_allocations;
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

}  // namespace incise::test
