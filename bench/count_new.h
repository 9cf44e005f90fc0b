// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace incise::bench {

/// How often the program has asked for heap memory so far. Programs that link `count_new.cpp` count every `operator
/// new` of the process, shared libraries included; one thread is enough for it.
std::uint64_t heap_allocations();

}  // namespace incise::bench
