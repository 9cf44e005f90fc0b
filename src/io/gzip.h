// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace io {

/// No deflate stream grows by more than this factor; a header that promises more lies.
inline constexpr std::uint64_t kMaxInflation = 1040;

/// Whether bytes begin as a gzip stream does. Cost: O(1).
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// Gunzip all members of `bytes`, to at most `max_bytes` and, beyond 64 MiB, 64 times their size. No more memory is
/// taken than what comes out, and none for what is refused as too large. On failure returns false and says why.
[[nodiscard]] bool gunzip(std::string_view bytes, std::uint64_t max_bytes, std::string& out, std::string& why);

/// The first bytes of what `bytes`, of which an end may be missing, gunzips to: at most `most`.
[[nodiscard]] std::string gunzip_beginning(std::string_view bytes, std::size_t most);

/// Inflate one zlib stream to exactly `size` bytes at `out`.
[[nodiscard]] bool inflate_to(std::string_view bytes, char* out, std::size_t size);

/// Deflate into one zlib stream.
[[nodiscard]] std::string deflate_block(std::string_view bytes);

/// Deflate into one gzip member, without name and time, so that equal content gives equal files.
[[nodiscard]] bool gzip(std::string_view bytes, std::string& out);

/// Whether this build can do any of the above.
[[nodiscard]] bool has_gzip();

}  // namespace io
}  // namespace v0
}  // namespace incise
