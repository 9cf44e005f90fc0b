// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace image {

/// Whether bytes begin as a gzip stream does. Cost: O(1).
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// No deflate stream grows by more than this factor; a header that promises more lies.
inline constexpr std::uint64_t kMaxInflation = 1040;

/// What a gzip or zlib stream unpacks to, piece by piece; several gzip members count as one stream.
///
/// Label images shrink far more than meshes, to a thousandth: their headers say how much to take.
class InflateStream {
 public:
  /// @param bytes  the stream; they outlive this.
  explicit InflateStream(std::string_view bytes);
  ~InflateStream();
  InflateStream(InflateStream&&) noexcept;
  InflateStream(const InflateStream&) = delete;
  InflateStream& operator=(const InflateStream&) = delete;

  /// Replaces `out` by the next bytes.
  ///
  /// @param size   bytes; fewer come where the stream ends before.
  /// @param why    is set on failure: what is wrong and what to do, without the file's name.
  /// @return false where the stream is damaged or cut off, or where this build has no zlib.
  /// Cost: O(bytes inflated).
  [[nodiscard]] bool read(std::size_t size, std::string& out, std::string& why);

 private:
  class Inflater;
  std::unique_ptr<Inflater> inflater_;
};

}  // namespace image
}  // namespace v0
}  // namespace incise
