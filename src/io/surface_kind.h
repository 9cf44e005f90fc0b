// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace io {

inline constexpr std::size_t kStlHeader = 84;    ///< 80 bytes of text and a count
inline constexpr std::size_t kStlTriangle = 50;  ///< normal, three points, two spare bytes

/// A number of four bytes, the least first.
[[nodiscard]] inline std::uint32_t load_u32(const char* p) {
  std::uint32_t bits = 0;
  for (std::size_t i = 4; i-- > 0;) bits = (bits << 8U) | static_cast<unsigned char>(p[i]);
  return bits;
}

/// Whether a file is as long as a binary STL file with its count.
[[nodiscard]] inline bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kStlHeader &&
         bytes.size() - kStlHeader == std::size_t{load_u32(bytes.data() + kStlHeader - 4)} * kStlTriangle;
}

/// Whether a file of at most `limit` bytes that begins so may be as long as its count says; it begins with more than a
/// header.
[[nodiscard]] inline bool may_be_binary_stl(std::string_view beginning, std::uint64_t limit) {
  if (beginning.size() < kStlHeader) return false;
  const std::uint64_t size = kStlHeader + std::uint64_t{load_u32(beginning.data() + kStlHeader - 4)} * kStlTriangle;
  return size >= beginning.size() && size <= limit;
}

}  // namespace io
}  // namespace v0
}  // namespace incise
