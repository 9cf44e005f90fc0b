// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace image {

/// Whether bytes begin as a gzip stream does. Cost: O(1).
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// Inflates the first `size` bytes of a gzip or zlib stream: fewer where it ends before.
///
/// Label images shrink far more than meshes, to a thousandth: their headers say how much to take.
/// @param bytes  the stream; several gzip members count as one.
/// @param size   bytes, at most; no more memory is taken than the stream can fill.
/// @param out    is replaced.
/// @param why    is set on failure: what is wrong and what to do, without the file's name.
/// @return false where the stream is damaged or cut off, or where this build has no zlib.
/// Cost: O(bytes inflated). Thread-safe.
[[nodiscard]] bool inflate_first(std::string_view bytes, std::uint64_t size, std::string& out, std::string& why);

}  // namespace image
}  // namespace v0
}  // namespace incise
