// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace incise {
inline namespace v0 {
namespace image {

/// Leaves out triangles that have two equal corners, or the corners of an earlier one in whatever order.
/// @return how many of the second kind there were. Cost: O(n log n).
std::size_t drop_repeated(std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Turns triangles so that those on both sides of an edge agree, where no more than two share it: the fewer ones of
/// what hangs together so. @return how many were turned. Cost: O(n log n).
std::size_t turn_alike(std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace image
}  // namespace v0
}  // namespace incise
