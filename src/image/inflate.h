// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace image {

[[nodiscard]] bool is_gzip(std::string_view bytes);

/// Inflate the first `size` bytes of a gzip or zlib stream: fewer where it ends before. No more memory is taken than
/// the stream can fill. On failure returns false and says why.
///
/// Label images shrink far more than meshes, to a thousandth: their headers say how much to take.
[[nodiscard]] bool inflate_first(std::string_view bytes, std::uint64_t size, std::string& out, std::string& why);

}  // namespace image
}  // namespace v0
}  // namespace incise
