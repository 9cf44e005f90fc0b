// SPDX-License-Identifier: Apache-2.0
// Linux gives address space without memory: it is reserved once for the largest array, and pages come with their first
// use. Elsewhere, and under a limit on address space, nothing is reserved, and arrays double.
#include "incise/core/grow_array.h"

#if defined(__linux__) && !defined(__EMSCRIPTEN__)
#include <sys/mman.h>
#include <sys/resource.h>
#endif

namespace incise {
inline namespace v0 {
namespace detail {

#if defined(__linux__) && !defined(__EMSCRIPTEN__)

void* reserve_address_space(std::size_t bytes) noexcept {
  // Reserved space counts against a limit on virtual memory: what is left of it is for those who need it.
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) return nullptr;
  void* start = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  return start == MAP_FAILED ? nullptr : start;
}

void release_address_space(void* start, std::size_t bytes) noexcept {
  ::munmap(start, bytes);
}

#else

void* reserve_address_space(std::size_t /*bytes*/) noexcept {
  return nullptr;
}

void release_address_space(void* /*start*/, std::size_t /*bytes*/) noexcept {}

#endif

}  // namespace detail
}  // namespace v0
}  // namespace incise
