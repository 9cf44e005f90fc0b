// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace incise::test {

/// How often this program has called operator new so far, on any thread. Link `allocation_count.cpp`.
std::size_t allocation_count();

}  // namespace incise::test
